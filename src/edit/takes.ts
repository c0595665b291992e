/**
 * Takes: a character's clips as something to write into. What is keyed goes into the take that is shown; where there is
 * none, one is made that changes nothing by itself, for its channels have no keys and stand where the pose stands.
 */
import { type Channel, type ChannelClip, restChannel, spanOfChannel } from '../model/clip.ts';
import { type Character, shownClip } from '../model/document.ts';
import { characterDofs } from '../model/dofs.ts';
import { type SourceFile, sameName, stemOf } from '../model/files.ts';
import { CommandError } from './store.ts';

/** The take that the character shows. Throws a `CommandError` where it shows none. */
export function requireTake(character: Character): ChannelClip {
  const clip = shownClip(character);
  if (!clip) throw new CommandError(`${character.name} shows no take.`);
  return clip;
}

/** The character with another clip in place of the one at `index`; the same object where it is that clip. */
export function withTake(character: Character, index: number, clip: ChannelClip): Character {
  if (character.clips[index] === clip) return character;
  return { ...character, clips: character.clips.map((c, i) => (i === index ? clip : c)) };
}

/**
 * The character, showing a take with a channel for each of its DOFs at least. Channels that are made stand at the pose,
 * so that nothing moves. Throws a `CommandError` for a character without a skeleton: its DOFs are what channels are
 * counted by.
 *
 * @param range what a take plays that has to be made, in seconds of the clip
 */
export function withChannels(character: Character, range: readonly [number, number]): Character {
  if (!character.skeleton) {
    throw new CommandError(`${character.name} has no skeleton, and its channels need DOFs.`);
  }
  const count = characterDofs(character.skeleton, character.morphs).length;
  const clip = shownClip(character);
  if (!clip) return withNewTake(character, newTakeName(character), range);
  if (clip.channels.length >= count) return character;
  const added = restingChannels(character, clip.channels.length, count);
  return withTake(character, character.shownClip, { ...clip, channels: [...clip.channels, ...added] });
}

/** The character with one take more, which is shown: nothing keyed, everything standing at the pose. */
export function withNewTake(character: Character, name: string, range: readonly [number, number]): Character {
  const count = characterDofs(character.skeleton, character.morphs).length;
  const clip: ChannelClip = { name, range, channels: restingChannels(character, 0, count) };
  return { ...character, clips: [...character.clips, clip], shownClip: character.clips.length };
}

function restingChannels({ pose }: Character, from: number, to: number): Channel[] {
  return Array.from({ length: to - from }, (_, i) => restChannel(pose[from + i] ?? 0));
}

/**
 * `wasp_anim`: files are told by the beginning of their names what they belong to, so the `.anim` finds `wasp.skel`
 * again when both are dropped.
 */
export function newTakeName(character: Character): string {
  return takeNameOf(character, 'anim');
}

/** The same with more than `anim` behind it: `wasp_dance`, for the take `dance` of another. */
export function takeNameOf(character: Character, what: string): string {
  const file = character.parts?.skeleton?.file;
  const stem = character.skeleton?.name || (file && stemOf(file.source)) || character.name;
  const isSaid = what.toLowerCase().startsWith(`${stem.toLowerCase()}_`);
  return uniqueTakeName(character, isSaid ? what : `${stem}_${what}`);
}

/**
 * The name itself, or with the first number behind it that none of the character's takes has. A file whose take has
 * another name by now is still there, and nobody means to save over it.
 */
export function uniqueTakeName(character: Character, name: string): string {
  // Names become file names, and some file systems don't tell cases apart.
  const names = [...character.clips.map((c) => c.name), ...takeFiles(character).map(stemOf)];
  const taken = new Set(names.map((taken) => taken.toLowerCase()));
  if (!taken.has(name.toLowerCase())) return name;
  const stem = name.replace(/_\d+$/, '');
  for (let n = 2; ; n++) {
    const next = `${stem}_${n}`;
    if (!taken.has(next.toLowerCase())) return next;
  }
}

/** The file that a take would be saved over if it were called so, where that file is not its own. */
export function fileInTheWay(character: Character, take: number, name: string): SourceFile | undefined {
  if (sameName(character.clips[take].name, name)) return undefined;
  const found = takeFiles(character).find((file) => sameName(stemOf(file), name));
  return found?.path === character.parts?.clips[take]?.file?.source.path ? undefined : found;
}

function takeFiles({ parts }: Character): readonly SourceFile[] {
  return parts?.clips.flatMap(({ file }) => (file?.kind === 'anim' ? file.source : [])) ?? [];
}

/** First to last key or frame of a clip's channels, in seconds of the clip; undefined where nothing is animated. */
export function rangeOfKeys(clip: ChannelClip): readonly [number, number] | undefined {
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const c of clip.channels.keys()) {
    const span = spanOfChannel(clip, c);
    if (!span) continue;
    first = Math.min(first, span[0]);
    last = Math.max(last, span[1]);
  }
  return first <= last ? [first, last] : undefined;
}
