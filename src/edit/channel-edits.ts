/**
 * Changing channels of a character's shown take: what all commands on keys share. They identify keys by channel and
 * index, check arguments from the console, keep the identity of all other channels, and return the new positions of the
 * keys.
 */

import { dofCountOf } from '../evaluate/pose.ts';
import { silentChannels } from '../evaluate/retarget/moved-dofs.ts';
import { type Character, type Document, shownTake } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { lockedDofs } from '../model/sets.ts';
import { withChannelsOf } from '../model/takes/channels-with-goals.ts';
import { withCurvesOfGoals } from '../model/takes/layer-code.ts';
import { type Channel, type KeyedChannel, keysOf, type Take } from '../model/takes/take.ts';
import { indexIn } from './arguments.ts';
import type { Edit } from './change.ts';
import { changeCharacter, requireCharacter } from './characters.ts';
import { CommandError } from './command-error.ts';
import type { EditedChannel } from './keys/arrange.ts';
import { wholeSteps, withoutStepsAfter } from './keys/steps.ts';
import type { TangentSide } from './keys/tangents.ts';
import { stepsKept } from './limbs/switch-steps.ts';
import { AllLockedError } from './pose/locks.ts';
import { refuseMoved } from './refuse-moved.ts';
import { requireTake, withTake } from './takes.ts';

/** Channels of a character's shown take, as arguments of commands. */
export interface OfChannels {
  readonly characterId: string;
  /** Indices into the shown take's channels. */
  readonly channels: readonly number[];
}

/** Keys of a character's shown take, as arguments of commands. */
export interface OfKeys {
  readonly characterId: string;
  /** Keys of the shown take; same form as in the selection. */
  readonly keys: readonly ChannelKeys[];
}

/** The shown take of a character, the curves of its goals among its channels; throws if there is none. */
export function takeOf(document: Document, characterId: string): Take {
  return withGoalsOf(requireCharacter(document, characterId));
}

function withGoalsOf(character: Character): Take {
  return withCurvesOfGoals(requireTake(character), dofCountOf(character));
}

/**
 * An edit of curves: other channels in a character's shown take. Those of locked DOFs stay as they are; the edit says
 * how many would have changed. Refuses changes to joints that a retargeted take drives, since they would have no
 * effect.
 *
 * @param keys selected after it
 * @param before selected before it; of channels that stay these are kept
 * @throws CommandError if all channels that would change are of locked DOFs
 */
export function editedChannels(
  document: Document,
  characterId: string,
  channels: readonly Channel[],
  keys: readonly ChannelKeys[],
  before: readonly ChannelKeys[] = [],
): Edit {
  const character = requireCharacter(document, characterId);
  const { channels: own } = withGoalsOf(character);
  const stay = new Set([...lockedDofs(character)].filter((dof) => channels[dof] !== own[dof]));
  if (stay.size === 0) return { document: withTakeChannels(document, characterId, channels), keys };
  const open = channels.map((channel, i) => (stay.has(i) ? own[i] : channel));
  if (open.every((channel, i) => channel === own[i])) throw new AllLockedError(stay.size);
  const kept = [...keys.filter((k) => !stay.has(k.channel)), ...before.filter((k) => stay.has(k.channel))];
  return {
    document: withTakeChannels(document, characterId, open),
    keys: kept.sort((a, b) => a.channel - b.channel),
    locked: stay.size,
  };
}

/** The document with other channels in a character's shown take; the same object if none changed. */
function withTakeChannels(document: Document, characterId: string, channels: readonly Channel[]): Document {
  return changeCharacter(document, characterId, (character) => {
    const take = shownTake(character);
    const own = take && withGoalsOf(character).channels;
    if (!own || channels.every((channel, i) => channel === own[i])) return character;
    const silent = silentChannels(character);
    if (channels.some((channel, i) => i < silent && channel !== own[i])) refuseMoved(character);
    return withTake(character, character.shownTake, withChannelsOf(take, channels, dofCountOf(character)));
  });
}

/**
 * Changes the channels of some keys, each independently.
 * @param change returns the channel and the positions of the keys; `entry` counts the list of keys
 */
export function changeKeys(
  document: Document,
  { characterId, keys }: OfKeys,
  change: (channel: KeyedChannel, indices: readonly number[], entry: number) => EditedChannel,
): Edit {
  const take = takeOf(document, characterId);
  const channels = [...take.channels];
  const now: ChannelKeys[] = [];
  checkedKeys(take, keys).forEach(({ channel, index, indices }, entry) => {
    const moved = change(channel, indices, entry);
    channels[index] = moved.channel;
    if (moved.indices.length) now.push({ channel: index, indices: wholeSteps(moved.channel, moved.indices) });
  });
  return editedChannels(document, characterId, channels, now, keys);
}

/**
 * Like `changeKeys`, for changes of tangents. Switches of limbs that are steps stay so among keys of other channels
 * (`limbs/switch-steps.ts`); the edit says how many.
 * @param side held steps that follow the keys end unless this is `in`
 */
export function changeTangents(
  document: Document,
  of: OfKeys,
  side: TangentSide,
  change: (channel: KeyedChannel, indices: readonly number[]) => KeyedChannel,
): Edit {
  const keptOf = stepsKept(requireCharacter(document, of.characterId), of.keys);
  let switches = 0;
  const edit = changeKeys(document, of, (channel, indices, entry) => {
    const kept = keptOf(of.keys[entry].channel);
    const stay = new Set(kept && indices.filter((k) => kept.stays(channel, k)));
    switches += new Set([...stay].map((k) => channel.times[k])).size;
    if (stay.size > 0)
      return {
        channel: change(
          channel,
          indices.filter((k) => !stay.has(k)),
        ),
        indices,
      };
    const free = side === 'in' ? { channel, indices } : withoutStepsAfter(channel, indices, kept?.spaceTimes);
    return { channel: change(free.channel, free.indices), indices: free.indices };
  });
  return switches > 0 ? { ...edit, switches } : edit;
}

/** Keys of one channel, with the channel. */
interface KeysOfChannel {
  readonly channel: KeyedChannel;
  readonly index: number;
  /** Indices of the keys. */
  readonly indices: readonly number[];
}

/** The keys with their channels. Refuses keys that don't exist, and unsorted lists. */
export function checkedKeys({ channels }: Take, keys: readonly ChannelKeys[]): readonly KeysOfChannel[] {
  const checked: KeysOfChannel[] = [];
  let before = -1;
  for (const entry of keys) {
    const index = indexIn(entry.channel, 0, channels.length, 'channel');
    if (index <= before) throw new CommandError('"keys" must name each channel once, in ascending order.');
    before = index;
    const channel = channels[index];
    const { indices } = entry;
    checkIndices(indices, keysOf(channel).times.length);
    // A channel without keys has none of these indices.
    if (channel.kind === 'keys') checked.push({ channel, index, indices });
  }
  return checked;
}

function checkIndices(indices: readonly number[], keyCount: number): void {
  if (indices.length === 0) throw new CommandError('"indices" must name at least one key.');
  let before = -1;
  for (const k of indices) {
    // Not through `indexIn`: this loop runs for every key on every mouse move.
    if (k <= before || k >= keyCount) {
      indexIn(k, 0, keyCount, 'key');
      throw new CommandError('"indices" must name each key once, in ascending order.');
    }
    before = k;
  }
}

/** Refuses channels that don't exist. Unique and ascending. */
export function checkedChannels(take: Pick<Take, 'channels'>, channels: readonly number[]): readonly number[] {
  const list = channels.map((c) => indexIn(c, 0, take.channels.length, 'channel'));
  return [...new Set(list)].sort((a, b) => a - b);
}

/**
 * The channels that can have keys. A sampled channel can't: a single key would replace thousands of frames. If none is
 * left, refuses and says what to do.
 */
export function keyable(take: Take, channels: readonly number[]): readonly number[] {
  const left = channels.filter((channel) => take.channels[channel]?.kind !== 'samples');
  if (left.length === 0 && channels.length > 0) throw new CommandError(followsSamples(channels.length));
  return left;
}

/** Refuses if any channel is sampled, rather than change only the others. */
export function requireKeyable(take: Take, channels: readonly number[]): void {
  const count = channels.filter((channel) => take.channels[channel]?.kind === 'samples').length;
  if (count > 0) throw new CommandError(followsSamples(count));
}

function followsSamples(count: number): string {
  const what = count === 1 ? 'This curve is sampled' : `${count} curves are sampled`;
  return `${what}. Convert to keys first (Keys > Samples).`;
}
