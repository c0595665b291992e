/** Which of the open characters a file belongs to, by its name and folder. */
import type { Character } from '../../model/document.ts';
import { folderOf, type SourceFile, sameName, stemOf } from '../../model/files.ts';
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
