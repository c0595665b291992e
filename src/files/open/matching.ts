/** Which of the open characters a file belongs to, by its name and folder. */
import type { Character } from '../../model/document.ts';
import { folderOf, type SourceFile, sameName, stemOf } from '../../model/files.ts';
import { MARKERS_EXTENSION } from '../../model/takes/markers.ts';
import { prefixFit } from './grouping.ts';

/** The character whose skin name is the longest prefix of the morph's: `head1.morph` → `head.skin`. */
export function bySkinName(source: SourceFile, characters: readonly Character[]): Character | undefined {
  let best: Character | undefined;
  let length = 0;
  for (const character of characters) {
    const { skeleton, skins = [] } = character.parts ?? {};
    for (const file of character.skins.length ? [skeleton?.file, ...skins.map((mark) => mark.file)] : []) {
      const fit = file ? prefixFit(stemOf(file.source), stemOf(source)) : 0;
      if (fit <= length) continue;
      best = character;
      length = fit;
    }
  }
  return best;
}

/** `walk.markers.json` → the take `walk` and its character, first of one from the same folder; `take` is its index. */
export function takeCalled(
  source: SourceFile,
  characters: readonly Character[],
): { readonly character: Character; readonly take: number } | undefined {
  const name = source.name.slice(0, -MARKERS_EXTENSION.length - 1);
  const folder = folderOf(source);
  const isNear = (c: Character) => c.sources.some((own) => folderOf(own) === folder);
  for (const character of [...characters.filter(isNear), ...characters]) {
    const take = character.takes.findIndex((own) => sameName(own.name, name));
    if (take >= 0) return { character, take };
  }
  return undefined;
}

/** Whether the character has a file of that name from the same folder, read or not. */
export function hasSource({ sources, unread = [] }: Character, source: SourceFile): boolean {
  return [...sources, ...unread].some((own) => isSameFile(own, source));
}

/** Whether the files are of one name and folder; one without a folder matches any. */
export function isSameFile(one: SourceFile, other: SourceFile): boolean {
  if (!sameName(one.name, other.name)) return false;
  const [a, b] = [folderOf(one), folderOf(other)];
  return a === b || a === '' || b === '';
}
