/** Which of the open characters a file belongs to, by its name and folder. */
import type { Character } from '../../model/document.ts';
import { folderOf, type SourceFile, sameName, stemOf } from '../../model/files.ts';
import { type Beside, nameBeside } from '../kinds.ts';
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

/** The place that a file is beside: a character, and the index of its take, or -1 for its skeleton. */
export interface BesidePlace {
  readonly character: Character;
  readonly take: number;
}

/**
 * `walk.markers.json` → the take `walk`; `wasp_2.sets.json` → the skeleton with the longest name that begins so, or else
 * the only one. Characters with a file from the same folder come first.
 */
export function besidePlace(of: Beside, source: SourceFile, characters: readonly Character[]): BesidePlace | undefined {
  const name = nameBeside(source.name);
  const folder = folderOf(source);
  const near = characters.filter((c) => c.sources.some((own) => folderOf(own) === folder));
  if (of === 'skeleton') return skeletonBefore(name, near) ?? skeletonBefore(name, characters) ?? onlyOf(characters);
  for (const character of [...near, ...characters]) {
    const take = character.takes.findIndex((own) => sameName(own.name, name));
    if (take >= 0) return { character, take };
  }
  return undefined;
}

function skeletonBefore(name: string, characters: readonly Character[]): BesidePlace | undefined {
  let best: BesidePlace | undefined;
  let length = 0;
  for (const character of characters) {
    const { skeleton, parts } = character;
    if (!skeleton) continue;
    const file = parts?.skeleton?.file ?? parts?.takes[0]?.file;
    const fit = Math.max(prefixFit(skeleton.name, name), file ? prefixFit(stemOf(file.source), name) : 0);
    if (fit <= length) continue;
    best = { character, take: -1 };
    length = fit;
  }
  return best;
}

function onlyOf(characters: readonly Character[]): BesidePlace | undefined {
  const own = [...new Set(characters.filter(({ skeleton }) => skeleton))];
  return own.length === 1 ? { character: own[0], take: -1 } : undefined;
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
