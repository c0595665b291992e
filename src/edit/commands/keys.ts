/** Creating, moving and deleting keys. Seconds are the take's. */

import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import type { Character, Document } from '../../model/document.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { wholeFilePose } from '../../model/skeleton/dofs.ts';
import { followingSamples, type KeyedChannel } from '../../model/takes/take.ts';
import { TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { indexIn } from '../arguments.ts';
import {
  changeKeys,
  checkedChannels,
  checkedKeys,
  editedChannels,
  keyable,
  type OfKeys,
  requireKeyable,
  takeOf,
} from '../channel-edits.ts';
import { requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { type KeyPlacing, placeOf } from '../keys/cycle.ts';
import { insertKey, insertKeyAmong } from '../keys/insert.ts';
import { withKeysMoved } from '../keys/move.ts';
import { putKeyAt } from '../keys/put-key.ts';
import { withKeysRemoved } from '../keys/remove.ts';
import { rippleRoom, withKeysRippled } from '../keys/ripple.ts';
import { withKeysScaled } from '../keys/scale.ts';
import { withKeysSet, withKeysSnapped } from '../keys/set.ts';
import { wholeSteps } from '../keys/steps.ts';
import { type KeyTween, withKeysTweened } from '../keys/tween.ts';
import { boolean, ifGiven, index, list, number, oneOf, optional } from '../schema/shape.ts';
import { CHANNELS, KEYS, NOW, onCollision, PLACING, tangentKind } from '../schema/shared-shapes.ts';
import { curvesIn, keysIn } from '../step-names.ts';

/** A time at which keys are made. */
export interface AtTime {
  /** Seconds of the take. */
  readonly timeSeconds: number;
}

/** A time at which to create keys. */
export interface NewKeyAt extends AtTime, KeyPlacing {}

/**
 * Inserts keys on the curves (`keys/insert.ts`), and selects them, or existing keys there. The curves keep their shape,
 * but between `auto` tangents, unless `keepShape` is set, the new key is `auto` too and the shape follows. Sampled
 * channels are skipped; refused if there are no others.
 */
export const insertKeys = command({
  id: 'keys.insert',
  args: { ...CHANNELS, timeSeconds: number, keepShape: optional(boolean), ...PLACING },
  label: (document, { characterId, channels }) =>
    channels.length === 1
      ? `Insert key on ${curvesIn(document, characterId, channels)}`
      : `Insert ${channels.length} keys`,
  run(document, { characterId, channels, timeSeconds: time, keepShape = false, ...placing }) {
    const take = takeOf(document, characterId);
    const changed = [...take.channels];
    const keys = keyable(take, checkedChannels(take, channels)).map((index): ChannelKeys => {
      const place = placeOf(changed[index], time, placing);
      const inserted = (keepShape ? insertKey : insertKeyAmong)(place.channel, place.time);
      changed[index] = inserted.channel;
      return { channel: index, indices: [inserted.index] };
    });
    return editedChannels(document, characterId, changed, keys);
  },
});

/**
 * Adds a key off the curve, which then passes through it. An existing key at that time takes the value. Refused for
 * sampled channels.
 */
export const addKey = command({
  id: 'keys.add',
  args: {
    ...NOW,
    channel: index,
    value: number,
    /** Kind of the tangents on both sides of a new key; default smooth. `fixed` is level. */
    tangents: optional(tangentKind),
    ...PLACING,
  },
  label: (document, { characterId, channel }) => `Add key on ${curvesIn(document, characterId, [channel])}`,
  run(document, { characterId, channel: index, timeSeconds, value, tangents = 'smooth', ...placing }) {
    const take = takeOf(document, characterId);
    indexIn(index, 0, take.channels.length, 'channel');
    requireKeyable(take, [index]);
    const put = putKeyAt(take.channels[index], timeSeconds, value, TANGENT_KINDS.indexOf(tangents), placing);
    const channels = take.channels.map((c, i) => (i === index ? put.channel : c));
    return editedChannels(document, characterId, channels, [{ channel: index, indices: [put.index] }]);
  },
});

/** Moves keys in time and value, and selects them at their new places. */
export const moveKeys = command({
  id: 'keys.move',
  args: {
    ...KEYS,
    /** Added to their times. */
    seconds: number,
    /** Added to the values, one number per entry of `keys`; default none. */
    values: optional(list(number)),
    /** Treatment of a key that a moved one lands on; default: it is replaced. */
    onCollision,
  },
  label: (document, { characterId, keys }) => `Move ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, seconds, values, onCollision = 'replace' }) {
    const by = values && numberForEach(values, keys, '"values"');
    return changeKeys(document, { characterId, keys }, (channel, indices, entry) =>
      withKeysMoved(channel, indices, seconds, by?.[entry] ?? 0, onCollision),
    );
  },
});

/** The values that keys can be scaled about: of the selected ones of each channel, or the file pose. */
export const SCALE_ABOUT = ['first', 'last', 'mean', 'pose'] as const;

/** Scales keys in time and value about a point, and selects them at their new places; see `keys/scale.ts`. */
export const scaleKeys = command({
  id: 'keys.scale',
  args: {
    ...KEYS,
    /** Take time that stays fixed. */
    pivotSeconds: optional(number),
    /** Negative mirrors; default 1. */
    timeFactor: optional(number),
    valueFactor: number,
    /** The value that stays fixed, one per entry of `keys`; default 0. */
    pivotValues: optional(list(number)),
    /** Which value stays fixed, instead: the first, last or mean one of the keys of a channel, or the file pose. */
    about: optional(oneOf(SCALE_ABOUT)),
    onCollision,
  },
  label: (document, { characterId, keys }) => `Scale ${keysIn(document, characterId, keys)}`,
  run(document, args) {
    const { characterId, keys, pivotSeconds = 0, timeFactor = 1, valueFactor, onCollision = 'replace' } = args;
    const { pivotValues, about } = args;
    const file = about === 'pose' ? filePoseOf(requireCharacter(document, characterId)) : undefined;
    const pivots = pivotValues && numberForEach(pivotValues, keys, '"pivotValues"');
    return changeKeys(document, { characterId, keys }, (channel, indices, entry) => {
      const own = about && pivotOf(about, channel, indices, file?.[keys[entry].channel] ?? 0);
      const pivotValue = own ?? pivots?.[entry] ?? 0;
      return withKeysScaled(channel, indices, { pivotSeconds, timeFactor, pivotValue, valueFactor }, onCollision);
    });
  },
});

function filePoseOf({ skeleton, morphs }: Character): readonly number[] {
  return wholeFilePose(skeleton, morphs);
}

function pivotOf(
  about: (typeof SCALE_ABOUT)[number],
  { values }: KeyedChannel,
  indices: readonly number[],
  file: number,
): number {
  if (about === 'pose') return file;
  if (about === 'first') return values[indices[0]];
  if (about === 'last') return values[indices[indices.length - 1]];
  return indices.reduce((sum, k) => sum + values[k], 0) / indices.length;
}

/** Exact numbers, as typed. A time can only be set for one key per channel, otherwise refused. */
export const setKeys = command({
  id: 'keys.set',
  args: {
    ...KEYS,
    timeSeconds: ifGiven(number),
    value: optional(number),
    slopeIn: optional(number),
    slopeOut: optional(number),
  },
  label(document, { characterId, keys, timeSeconds, value }) {
    const what = timeSeconds !== undefined ? 'time' : value !== undefined ? 'value' : 'slope';
    return `Set ${what} of ${keysIn(document, characterId, keys)}`;
  },
  run(document, { characterId, keys, timeSeconds, value, slopeIn, slopeOut }) {
    const typed = { timeSeconds, value, slopeIn, slopeOut };
    if (Object.values(typed).every((number) => number === undefined)) {
      throw new CommandError('Give at least one of "timeSeconds", "value", "slopeIn" and "slopeOut".');
    }
    return changeKeys(document, { characterId, keys }, (channel, indices) => {
      const [first] = indices;
      if (timeSeconds !== undefined && wholeSteps(channel, [first]).length < indices.length) {
        throw new CommandError('Only one key per channel can be set to a time; several are selected in one channel.');
      }
      return withKeysSet(channel, indices, typed);
    });
  },
});

/** Moves keys to the nearest frame. */
export const snapKeys = command({
  id: 'keys.snap',
  args: {
    ...KEYS,
    framesPerSecond: number,
    /**
     * Time of frame 0, in seconds of the take; default 0. Pass the character's time offset to use the transport's
     * frames, which are the visible ones.
     */
    offsetSeconds: optional(number),
  },
  label: (document, { characterId, keys }) => `Snap ${keysIn(document, characterId, keys)} to frames`,
  run(document, { characterId, keys, framesPerSecond, offsetSeconds = 0 }) {
    if (framesPerSecond <= 0) {
      throw new CommandError(`The frame rate must be greater than 0, found ${framesPerSecond}.`);
    }
    return changeKeys(document, { characterId, keys }, (channel, indices) =>
      withKeysSnapped(channel, indices, framesPerSecond, offsetSeconds),
    );
  },
});

/** Sets keys to values between the keys around each run of them. */
export const tweenKeys = command({
  id: 'keys.tween',
  args: { ...KEYS, u: number },
  label: (document, { characterId, keys }) => `Tween ${keysIn(document, characterId, keys)}`,
  run: (document, { u, ...of }) => tweened(document, of, { kind: 'tween', u }),
});

/** Moves keys toward the straight line between the keys around each run, by a share; less than 0 pushes them away. */
export const relaxKeys = command({
  id: 'keys.relax',
  args: { ...KEYS, amount: number },
  label: (document, { characterId, keys, amount }) =>
    `${amount < 0 ? 'Push' : 'Relax'} ${keysIn(document, characterId, keys)}`,
  run: (document, { amount, ...of }) => tweened(document, of, { kind: 'relax', amount }),
});

/** Eases keys: more than 0 keeps them near the key before their run, less than 0 near the one after it. */
export const easeKeys = command({
  id: 'keys.ease',
  args: { ...KEYS, amount: number },
  label: (document, { characterId, keys }) => `Ease ${keysIn(document, characterId, keys)}`,
  run: (document, { amount, ...of }) => tweened(document, of, { kind: 'ease', amount }),
});

function tweened(document: Document, of: OfKeys, tween: KeyTween) {
  return changeKeys(document, of, (channel, indices) => ({
    channel: withKeysTweened(channel, indices, tween),
    indices,
  }));
}

/**
 * Channels that lose all their keys rest at their value at the given time; those converted from samples that are still
 * there follow these again. Nothing is selected afterwards.
 */
export const removeKeys = command({
  id: 'keys.remove',
  args: { ...KEYS, timeSeconds: number },
  label: (document, { characterId, keys }) => `Delete ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, timeSeconds }) {
    const take = takeOf(document, characterId);
    const curves = compileTake(take);
    const channels = [...take.channels];
    for (const { channel, index, indices } of checkedKeys(take, keys)) {
      channels[index] = withKeysRemoved(channel, indices, evaluateChannel(curves, index, timeSeconds));
    }
    return editedChannels(document, characterId, followingSamples(channels, take.samples), [], keys);
  },
});

/**
 * Moves keys and all later keys of their channels (`keys/ripple.ts`). All channels move by the same amount, limited by
 * the one with the least room, so that poses stay together.
 */
export const rippleKeys = command({
  id: 'keys.ripple',
  args: { ...KEYS, seconds: number },
  label: (document, { characterId, keys }) => `Ripple ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, seconds }) {
    const take = takeOf(document, characterId);
    let by = seconds;
    for (const { channel, indices } of checkedKeys(take, keys)) by = Math.max(by, rippleRoom(channel, indices[0]));
    return changeKeys(document, { characterId, keys }, (channel, indices) => withKeysRippled(channel, indices, by));
  },
});

function numberForEach(numbers: readonly number[], keys: readonly ChannelKeys[], what: string): readonly number[] {
  if (numbers.length !== keys.length) {
    throw new CommandError(`${what} needs a number for each channel in "keys".`);
  }
  return numbers;
}
