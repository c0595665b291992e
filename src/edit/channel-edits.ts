/**
 * Changing channels of the clip that a character shows: what all commands on keys have in common. They name keys by
 * channel and index, check what a console may have given them, leave every other channel the object it is, and say
 * where their keys are afterwards.
 */
import { silentChannels } from '../evaluate/retarget/moved-dofs.ts';
import { type Channel, type ChannelClip, type KeyedChannel, keysOf } from '../model/clip.ts';
import { type Document, shownClip } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { indexIn, listOf } from './arguments.ts';
import { changeCharacter, requireCharacter } from './characters.ts';
import type { EditedChannel } from './keys/arrange.ts';
import { countKeys } from './keys/selection.ts';
import { refuseMoved } from './refuse-moved.ts';
import { CommandError, type Edit } from './store.ts';
import { requireTake, withTake } from './takes.ts';

export interface OfChannels {
  readonly characterId: string;
  /** Indices into the shown clip's channels. */
  readonly channels: readonly number[];
}

export interface OfKeys {
  readonly characterId: string;
  /** Of the shown clip; as the selection holds them. */
  readonly keys: readonly ChannelKeys[];
}

/** The clip that a character shows; refuses where there is none. */
export function clipOf(document: Document, characterId: string): ChannelClip {
  return requireTake(requireCharacter(document, characterId));
}

/**
 * The document with other channels in the clip that a character shows; the same object where all of them are. Refuses
 * changes of what nobody sees: of joints that another character's take moves.
 */
export function withClipChannels(document: Document, characterId: string, channels: readonly Channel[]): Document {
  return changeCharacter(document, characterId, (character) => {
    const clip = shownClip(character);
    if (!clip || channels.every((channel, i) => channel === clip.channels[i])) return character;
    const silent = silentChannels(character);
    if (channels.some((channel, i) => i < silent && channel !== clip.channels[i])) refuseMoved(character);
    return withTake(character, character.shownClip, { ...clip, channels });
  });
}

/**
 * Changes the channels of some keys, each by itself.
 * @param change gives the channel and where the keys are; `entry` counts the list of keys
 */
export function changeKeys(
  document: Document,
  { characterId, keys }: OfKeys,
  change: (channel: KeyedChannel, indices: readonly number[], entry: number) => EditedChannel,
): Edit {
  const clip = clipOf(document, characterId);
  const channels = [...clip.channels];
  const now: ChannelKeys[] = [];
  checkedKeys(clip, keys).forEach(({ channel, index, indices }, entry) => {
    const moved = change(channel, indices, entry);
    channels[index] = moved.channel;
    if (moved.indices.length) now.push({ channel: index, indices: moved.indices });
  });
  return { document: withClipChannels(document, characterId, channels), keys: now };
}

/** As `changeKeys`, where the keys stay what and where they are. */
export function changeTangents(
  document: Document,
  of: OfKeys,
  change: (channel: KeyedChannel, indices: readonly number[]) => KeyedChannel,
): Edit {
  return changeKeys(document, of, (channel, indices) => ({ channel: change(channel, indices), indices }));
}

/** Keys of one channel, and the channel that has them. */
interface KeysOfChannel {
  readonly channel: KeyedChannel;
  readonly index: number;
  /** Of the keys. */
  readonly indices: readonly number[];
}

/** The keys with their channels. Refuses keys that are not there, and lists that are not in order. */
export function checkedKeys({ channels }: ChannelClip, keys: unknown): readonly KeysOfChannel[] {
  const checked: KeysOfChannel[] = [];
  let before = -1;
  for (const entry of listOf(keys, '"keys"')) {
    if (typeof entry !== 'object' || entry === null || !('channel' in entry) || !('indices' in entry)) {
      throw new CommandError('"keys" must be a list of { channel, indices }.');
    }
    const index = indexIn(entry.channel, 0, channels.length, 'channel');
    if (index <= before) throw new CommandError('"keys" must name each channel once, in ascending order.');
    before = index;
    const channel = channels[index];
    const indices = checkedIndices(entry.indices, keysOf(channel).times.length);
    // Without keys it had none of those indices.
    if (channel.kind === 'keys') checked.push({ channel, index, indices });
  }
  return checked;
}

function checkedIndices(given: unknown, keyCount: number): readonly number[] {
  const indices = listOf(given, '"indices"');
  if (indices.length === 0) throw new CommandError('"indices" must name at least one key.');
  let before = -1;
  for (const k of indices) {
    // Not by `indexIn`'s sentence: this loop is run for every key on every move of the mouse.
    if (typeof k !== 'number' || !Number.isInteger(k) || k <= before || k >= keyCount) {
      indexIn(k, 0, keyCount, 'key');
      throw new CommandError('"indices" must name each key once, in ascending order.');
    }
    before = k;
  }
  // Each was found to be a number.
  return indices as readonly number[];
}

/** Refuses channels that are not there. Each once, ascending. */
export function checkedChannels(clip: Pick<ChannelClip, 'channels'>, channels: unknown): readonly number[] {
  const list = listOf(channels, '"channels"').map((c) => indexIn(c, 0, clip.channels.length, 'channel'));
  return [...new Set(list)].sort((a, b) => a - b);
}

/**
 * Those of the channels that can have keys. One that follows the clip's samples can't: a single key would take the
 * place of thousands of frames. Refuses, with the way out, where none is left of some.
 */
export function keyable(clip: ChannelClip, channels: readonly number[]): readonly number[] {
  const left = channels.filter((channel) => clip.channels[channel]?.kind !== 'samples');
  if (left.length === 0 && channels.length > 0) throw new CommandError(followsSamples(channels.length));
  return left;
}

/** Refuses all of them where one follows the samples: what would be done in part would not be what was meant. */
export function allKeyable(clip: ChannelClip, channels: readonly number[]): void {
  const count = channels.filter((channel) => clip.channels[channel]?.kind === 'samples').length;
  if (count > 0) throw new CommandError(followsSamples(count));
}

function followsSamples(count: number): string {
  const what = count === 1 ? 'This curve is sampled' : `${count} curves are sampled`;
  return `${what}. Convert to keys first: Keys > Samples.`;
}

/** "key", "3 keys": for labels. */
export function keyCountText(keys: readonly ChannelKeys[]): string {
  const count = countKeys(keys);
  return count === 1 ? 'key' : `${count} keys`;
}
