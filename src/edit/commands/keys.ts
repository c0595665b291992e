/** Creating, moving and deleting keys. Seconds are the clip's. */
import { compileClip } from '../../evaluate/compiled-clip.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { followingSamples, TANGENT_KINDS, type TangentKind } from '../../model/clip.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { finiteNumber, indexIn, listOf, oneOf } from '../arguments.ts';
import {
  changeKeys,
  checkedChannels,
  checkedKeys,
  clipOf,
  keyable,
  type OfChannels,
  type OfKeys,
  requireKeyable,
  withClipChannels,
} from '../channel-edits.ts';
import { checkPlacing } from '../check-placing.ts';
import { COLLISIONS, type Collision } from '../keys/arrange.ts';
import { type KeyPlacing, placeOf } from '../keys/cycle.ts';
import { insertKey } from '../keys/insert.ts';
import { withKeysMoved } from '../keys/move.ts';
import { putKeyAt } from '../keys/put-key.ts';
import { withKeysRemoved } from '../keys/remove.ts';
import { rippleRoom, withKeysRippled } from '../keys/ripple.ts';
import { withKeysScaled } from '../keys/scale.ts';
import { type TypedKey, withKeysSet, withKeysSnapped } from '../keys/set.ts';
import { curvesIn, keysIn } from '../step-names.ts';
import { type Command, CommandError, type Edit } from '../store.ts';

export interface AtTime {
  /** Of the clip. */
  readonly timeSeconds: number;
}

/** A time at which to create keys. */
export interface NewKeyAt extends AtTime, KeyPlacing {}

/**
 * Inserts keys on the curves without changing their shape (`keys/insert.ts`), and selects them, or existing keys there.
 * Sampled channels are skipped; refused if there are no others.
 */
export const insertKeys: Command<OfChannels & NewKeyAt, Edit> = {
  id: 'keys.insert',
  label: (document, { characterId, channels }) =>
    channels.length === 1
      ? `Insert key on ${curvesIn(document, characterId, channels)}`
      : `Insert ${channels.length} keys`,
  run(document, { characterId, channels, timeSeconds, ...placing }) {
    const clip = clipOf(document, characterId);
    const time = finiteNumber(timeSeconds, '"timeSeconds"');
    checkPlacing(placing);
    const changed = [...clip.channels];
    const keys = keyable(clip, checkedChannels(clip, channels)).map((index): ChannelKeys => {
      const place = placeOf(changed[index], time, placing);
      const inserted = insertKey(place.channel, place.time);
      changed[index] = inserted.channel;
      return { channel: index, indices: [inserted.index] };
    });
    return { document: withClipChannels(document, characterId, changed), keys };
  },
};

export interface AddKey extends NewKeyAt {
  readonly characterId: string;
  readonly channel: number;
  readonly value: number;
  /** Of both sides of a new key; default smooth. `fixed` is level. */
  readonly tangents?: TangentKind;
}

/**
 * Adds a key off the curve, which then passes through it. An existing key at that time takes the value. Refused for
 * sampled channels.
 */
export const addKey: Command<AddKey, Edit> = {
  id: 'keys.add',
  label: (document, { characterId, channel }) => `Add key on ${curvesIn(document, characterId, [channel])}`,
  run(document, { characterId, channel: index, timeSeconds, value, tangents = 'smooth', ...placing }) {
    const clip = clipOf(document, characterId);
    indexIn(index, 0, clip.channels.length, 'channel');
    requireKeyable(clip, [index]);
    checkPlacing(placing);
    const put = putKeyAt(
      clip.channels[index],
      finiteNumber(timeSeconds, '"timeSeconds"'),
      finiteNumber(value, '"value"'),
      TANGENT_KINDS.indexOf(oneOf(tangents, TANGENT_KINDS, '"tangents"')),
      placing,
    );
    const channels = clip.channels.map((c, i) => (i === index ? put.channel : c));
    return {
      document: withClipChannels(document, characterId, channels),
      keys: [{ channel: index, indices: [put.index] }],
    };
  },
};

export interface MoveKeysArgs extends OfKeys {
  /** Added to their times. */
  readonly seconds: number;
  /** Added to the values, one number per entry of `keys`; default none. */
  readonly values?: readonly number[];
  /** What happens to a key that a moved one lands on; default: it is replaced. */
  readonly onCollision?: Collision;
}

export const moveKeys: Command<MoveKeysArgs, Edit> = {
  id: 'keys.move',
  label: (document, { characterId, keys }) => `Move ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, seconds, values, onCollision = 'replace' }) {
    finiteNumber(seconds, '"seconds"');
    oneOf(onCollision, COLLISIONS, '"onCollision"');
    const by = values && numberForEach(values, keys, '"values"');
    return changeKeys(document, { characterId, keys }, (channel, indices, entry) =>
      withKeysMoved(channel, indices, seconds, by?.[entry] ?? 0, onCollision),
    );
  },
};

export interface ScaleKeysArgs extends OfKeys {
  /** Clip time that stays fixed. */
  readonly pivotSeconds: number;
  /** Negative mirrors. */
  readonly timeFactor: number;
  readonly valueFactor: number;
  /** The value that stays fixed, one per entry of `keys`; default 0. */
  readonly pivotValues?: readonly number[];
  readonly onCollision?: Collision;
}

export const scaleKeys: Command<ScaleKeysArgs, Edit> = {
  id: 'keys.scale',
  label: (document, { characterId, keys }) => `Scale ${keysIn(document, characterId, keys)}`,
  run(document, args) {
    const { characterId, keys, pivotValues, onCollision = 'replace' } = args;
    const pivotSeconds = finiteNumber(args.pivotSeconds, '"pivotSeconds"');
    const timeFactor = finiteNumber(args.timeFactor, '"timeFactor"');
    const valueFactor = finiteNumber(args.valueFactor, '"valueFactor"');
    oneOf(onCollision, COLLISIONS, '"onCollision"');
    const pivots = pivotValues && numberForEach(pivotValues, keys, '"pivotValues"');
    return changeKeys(document, { characterId, keys }, (channel, indices, entry) => {
      const pivotValue = pivots?.[entry] ?? 0;
      return withKeysScaled(channel, indices, { pivotSeconds, timeFactor, pivotValue, valueFactor }, onCollision);
    });
  },
};

/** Exact numbers, as typed. A time can only be set for one key per channel, otherwise refused. */
export const setKeys: Command<OfKeys & TypedKey, Edit> = {
  id: 'keys.set',
  label(document, { characterId, keys, timeSeconds, value }) {
    const what = timeSeconds !== undefined ? 'time' : value !== undefined ? 'value' : 'slope';
    return `Set ${what} of ${keysIn(document, characterId, keys)}`;
  },
  run(document, { characterId, keys, timeSeconds, value, slopeIn, slopeOut }) {
    const typed = { timeSeconds, value, slopeIn, slopeOut };
    const given = Object.entries(typed).filter(([, number]) => number !== undefined);
    for (const [name, number] of given) finiteNumber(number, `"${name}"`);
    if (given.length === 0) {
      throw new CommandError('Give at least one of "timeSeconds", "value", "slopeIn" and "slopeOut".');
    }
    return changeKeys(document, { characterId, keys }, (channel, indices) => {
      if (timeSeconds !== undefined && indices.length > 1) {
        throw new CommandError('Only one key per channel can be set to a time; several are selected in one channel.');
      }
      return withKeysSet(channel, indices, typed);
    });
  },
};

export interface SnapKeys extends OfKeys {
  readonly framesPerSecond: number;
  /**
   * Time of frame 0, in seconds of the clip; default 0. Pass the character's time offset to use the transport's frames,
   * which are the visible ones.
   */
  readonly offsetSeconds?: number;
}

/** Moves keys to the nearest frame. */
export const snapKeys: Command<SnapKeys, Edit> = {
  id: 'keys.snap',
  label: (document, { characterId, keys }) => `Snap ${keysIn(document, characterId, keys)} to frames`,
  run(document, { characterId, keys, framesPerSecond, offsetSeconds = 0 }) {
    if (finiteNumber(framesPerSecond, '"framesPerSecond"') <= 0) {
      throw new CommandError(`The frame rate must be greater than 0, found ${framesPerSecond}.`);
    }
    finiteNumber(offsetSeconds, '"offsetSeconds"');
    return changeKeys(document, { characterId, keys }, (channel, indices) =>
      withKeysSnapped(channel, indices, framesPerSecond, offsetSeconds),
    );
  },
};

/**
 * Channels that lose all their keys rest at their value at the given time; those converted from samples that are still
 * there follow these again. Nothing is selected afterwards.
 */
export const removeKeys: Command<OfKeys & AtTime, Edit> = {
  id: 'keys.remove',
  label: (document, { characterId, keys }) => `Delete ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, timeSeconds }) {
    const time = finiteNumber(timeSeconds, '"timeSeconds"');
    const clip = clipOf(document, characterId);
    const curves = compileClip(clip);
    const channels = [...clip.channels];
    for (const { channel, index, indices } of checkedKeys(clip, keys)) {
      channels[index] = withKeysRemoved(channel, indices, evaluateChannel(curves, index, time));
    }
    const after = withClipChannels(document, characterId, followingSamples(channels, clip.samples));
    return { document: after, keys: [] };
  },
};

/**
 * Moves keys and all later keys of their channels (`keys/ripple.ts`). All channels move by the same amount, limited by
 * the one with the least room, so that poses stay together.
 */
export const rippleKeys: Command<OfKeys & { readonly seconds: number }, Edit> = {
  id: 'keys.ripple',
  label: (document, { characterId, keys }) => `Ripple ${keysIn(document, characterId, keys)}`,
  run(document, { characterId, keys, seconds }) {
    finiteNumber(seconds, '"seconds"');
    const clip = clipOf(document, characterId);
    let by = seconds;
    for (const { channel, indices } of checkedKeys(clip, keys)) by = Math.max(by, rippleRoom(channel, indices[0]));
    return changeKeys(document, { characterId, keys }, (channel, indices) => withKeysRippled(channel, indices, by));
  },
};

function numberForEach(given: unknown, keys: readonly ChannelKeys[], what: string): readonly number[] {
  const numbers = listOf(given, what).map((n) => finiteNumber(n, `Each of ${what}`));
  if (numbers.length !== listOf(keys, '"keys"').length) {
    throw new CommandError(`${what} needs a number for each channel in "keys".`);
  }
  return numbers;
}
