/**
 * Changes of an opening that the eye does not see by itself: a morph at weight 0, poses in the library, a take beside
 * others, a skin shown instead of another one, a file that waits for others. Without a sentence it would seem that
 * nothing had happened, or that something had been lost.
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { type Character, type Document, findCharacter, shownSkin, shownTake } from '../../model/document.ts';
import type { ParsedFile } from '../../model/files.ts';
import { lockedDofs } from '../../model/sets.ts';

/** Sentences shown at most; a count stands for the others. */
const MAX_SENTENCES = 2;

interface Named {
  readonly name: string;
}

/**
 * One line, or undefined if everything new is in the picture. New characters are.
 * @param files those of this opening
 * @param told what was told of them while they were read: buffers of glTF files may wait, too
 */
export function unseenChanges(
  before: Document,
  after: Document,
  files: readonly ParsedFile[],
  told: readonly Diagnostic[] = [],
): string | undefined {
  const sentences = after.characters.flatMap((character) => {
    const was = findCharacter(before, character.id);
    return was && was !== character ? changesOf(was, character) : [];
  });
  for (const { file, why } of after.unused) {
    if (files.includes(file)) sentences.push(isKept(file.source.name, why));
  }
  for (const { code, file, message } of told) if (code === 'file-unused') sentences.push(isKept(file, message));
  if (sentences.length === 0) {
    // Dumps are compared, and have a banner.
    const isSilent = after === before && files.length > 0 && !files.some(({ kind }) => kind === 'dump');
    return isSilent ? 'Nothing has changed.' : undefined;
  }
  const more = sentences.length - MAX_SENTENCES;
  const rest = more > 0 ? [`${more} more ${more === 1 ? 'change' : 'changes'}.`] : [];
  return [...sentences.slice(0, MAX_SENTENCES), ...rest].join(' ');
}

const isKept = (name: string, why: string) => `${name} is kept for a matching file. ${why}`;

function changesOf(before: Character, after: Character): string[] {
  return [
    ...(before.skeleton && after.skeleton !== before.skeleton ? [`The skeleton of ${after.name} was replaced.`] : []),
    ...skinChange(before, after),
    ...morphChanges(before, after),
    ...takeChange(before, after),
    ...poseChange(before, after),
    ...setsChange(before, after),
  ];
}

function skinChange(before: Character, after: Character): string[] {
  const [was, is] = [shownSkin(before), shownSkin(after)];
  if (!was || !is || was === is) return [];
  if (after.skins.includes(was))
    return [`${after.name} now shows the skin ${is.name}; ${was.name} stays in the outliner.`];
  return [`The skin ${is.name} of ${after.name} was replaced.`];
}

function morphChanges(before: Character, after: Character): string[] {
  const { added, replaced } = difference(before.morphs, after.morphs);
  const where = `set ${added.length === 1 ? 'its weight' : 'their weights'} in the inspector`;
  return [
    ...(added.length ? [`${after.name} has ${listed('the new morph', 'new morphs', added)}; ${where}.`] : []),
    ...(replaced.length
      ? [`${capital(listed('the morph', 'morphs', replaced))} of ${after.name} ${was(replaced)} replaced.`]
      : []),
  ];
}

function takeChange(before: Character, after: Character): string[] {
  const [shown, is] = [shownTake(before), shownTake(after)];
  if (!shown || !is || shown === is) return [];
  if (after.takes.includes(shown))
    return [`${after.name} now plays the take ${is.name}; ${shown.name} stays in Takes.`];
  return [`The take ${is.name} of ${after.name} was replaced.`];
}

function poseChange({ poses: before = [] }: Character, { name, poses = [] }: Character): string[] {
  const { added, replaced } = difference(before, poses);
  return [
    ...(added.length ? [`The pose library of ${name} has ${listed('the new pose', 'new poses', added)}.`] : []),
    ...(replaced.length
      ? [`${capital(listed('the pose', 'poses', replaced))} of ${name} ${was(replaced)} replaced.`]
      : []),
  ];
}

function setsChange(before: Character, { name, sets, skeleton }: Character): string[] {
  if (!sets || !skeleton || sets === before.sets) return [];
  const locks = lockedDofs({ sets, skeleton }).size;
  const has = `${sets.sets.length} selection ${sets.sets.length === 1 ? 'set' : 'sets'}`;
  return [`${name} has ${has} and ${locks} locked ${locks === 1 ? 'DOF' : 'DOFs'}.`];
}

/** Parts that are new, and parts that another one of the same name replaced. */
function difference<T extends Named>(before: readonly T[], after: readonly T[]) {
  const fresh = after.filter((part) => !before.includes(part));
  const isReplaced = ({ name }: T) => before.some((old) => old.name === name && !after.includes(old));
  return { added: fresh.filter((part) => !isReplaced(part)), replaced: fresh.filter(isReplaced) };
}

/** `the new morph smile`, `3 new morphs`. */
function listed(one: string, many: string, parts: readonly Named[]): string {
  return parts.length === 1 ? `${one} ${parts[0].name}` : `${parts.length} ${many}`;
}

const was = ({ length }: readonly unknown[]) => (length === 1 ? 'was' : 'were');
const capital = (text: string) => text[0].toUpperCase() + text.slice(1);
