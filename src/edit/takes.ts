/**
 * Takes as targets for editing. Keys are added to the shown take; if there is none, one is created that changes
 * nothing, since its channels have no keys and rest in the pose.
 */

import { type Character, shownTake } from '../model/document.ts';
import { type SourceFile, sameName, stemOf } from '../model/files.ts';
import { characterDofs } from '../model/skeleton/dofs.ts';
import { withMotions } from '../model/takes/layers.ts';
import { type Channel, restChannel, spanOfChannel, type Take } from '../model/takes/take.ts';
import { CommandError } from './command-error.ts';

/** The shown take. Throws a `CommandError` if there is none. */
export function requireTake(character: Character): Take {
  const take = shownTake(character);
  if (!take) throw new CommandError(`${character.name} has no current take.`);
  return take;
}

/** The character with the take at `index` replaced; the same object if it is the same. */
export function withTake(character: Character, index: number, take: Take): Character {
  if (character.takes[index] === take) return character;
  return { ...character, takes: character.takes.map((c, i) => (i === index ? take : c)) };
}

/**
 * The character showing a take with at least one channel per DOF. New channels rest in the pose, so that nothing moves.
 * Throws a `CommandError` for a character without a skeleton, since channels correspond to its DOFs.
 *
 * @param range playback range of a take that has to be created, in seconds of the take
 */
export function withChannels(character: Character, range: readonly [number, number]): Character {
  if (!character.skeleton) {
    throw new CommandError(`${character.name} has no skeleton, and its channels need DOFs.`);
  }
  const count = characterDofs(character.skeleton, character.morphs).length;
  const take = shownTake(character);
  if (!take) return withNewTake(character, newTakeName(character), range);
  if (take.channels.length >= count) return character;
  // What rests in a layer leaves its DOF alone.
  const extended = withMotions(take, ({ channels, samples }, layer) => ({
    channels: [...channels, ...restingChannels(layer < 0 ? character : STILL, channels.length, count)],
    ...(samples && { samples }),
  }));
  return withTake(character, character.shownTake, extended);
}

/** The character with a new take, which is shown: without keys, at rest in the pose. */
export function withNewTake(character: Character, name: string, range: readonly [number, number]): Character {
  const count = characterDofs(character.skeleton, character.morphs).length;
  const take: Take = { name, range, channels: restingChannels(character, 0, count) };
  return { ...character, takes: [...character.takes, take], shownTake: character.takes.length };
}

const STILL: Pick<Character, 'pose'> = { pose: [] };

function restingChannels({ pose }: Pick<Character, 'pose'>, from: number, to: number): Channel[] {
  return Array.from({ length: to - from }, (_, i) => restChannel(pose[from + i] ?? 0));
}

/**
 * `wasp_anim`: files are matched by the beginning of their names, so that the `.anim` finds `wasp.skel` again when both
 * are dropped.
 */
export function newTakeName(character: Character): string {
  return takeNameOf(character, 'anim');
}

/** The name of a new take, with another suffix than `anim`: `wasp_dance`, for the take `dance` of another character. */
export function takeNameOf(character: Character, what: string): string {
  const file = character.parts?.skeleton?.file;
  const stem = character.skeleton?.name || (file && stemOf(file.source)) || character.name;
  const isSaid = what.toLowerCase().startsWith(`${stem.toLowerCase()}_`);
  return uniqueTakeName(character, isSaid ? what : `${stem}_${what}`);
}

/**
 * The name itself, or with the first number that makes it unique among the character's takes. Files of takes that were
 * renamed count too, so that they are not overwritten.
 */
export function uniqueTakeName(character: Character, name: string): string {
  // Names become file names, and some file systems ignore case.
  const names = [...character.takes.map((c) => c.name), ...takeFiles(character).map(stemOf)];
  const taken = new Set(names.map((taken) => taken.toLowerCase()));
  if (!taken.has(name.toLowerCase())) return name;
  const stem = name.replace(/_\d+$/, '');
  for (let n = 2; ; n++) {
    const next = `${stem}_${n}`;
    if (!taken.has(next.toLowerCase())) return next;
  }
}

/** The file that a take of this name would overwrite, if that file is not its own. */
export function fileInTheWay(character: Character, take: number, name: string): SourceFile | undefined {
  if (sameName(character.takes[take].name, name)) return undefined;
  const found = takeFiles(character).find((file) => sameName(stemOf(file), name));
  return found?.path === character.parts?.takes[take]?.file?.source.path ? undefined : found;
}

function takeFiles({ parts }: Character): readonly SourceFile[] {
  return parts?.takes.flatMap(({ file }) => (file?.kind === 'anim' ? file.source : [])) ?? [];
}

/** First to last key or frame of a take's channels, in seconds of the take; undefined if nothing is animated. */
export function rangeOfKeys(take: Take): readonly [number, number] | undefined {
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const c of take.channels.keys()) {
    const span = spanOfChannel(take, c);
    if (!span) continue;
    first = Math.min(first, span[0]);
    last = Math.max(last, span[1]);
  }
  return first <= last ? [first, last] : undefined;
}
