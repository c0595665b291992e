/** All files of a character: its parts in its own formats, and its textures. */
import type { Character } from '../../model/document.ts';
import { besideOf, SAVED_KINDS, type SavedKind } from '../kinds.ts';
import { isCopy, saveCharacter } from './saving.ts';

/** A file of a character: text, or the bytes of a picture. */
export interface OwnFile {
  readonly name: string;
  readonly content: string | Uint8Array<ArrayBuffer>;
}

/**
 * Kinds of files. `all` is what opens again unchanged, `plain` what moves and looks the same without anything beside
 * it.
 */
export type OwnKinds = 'all' | 'plain';

/** The files of a character, with names that lie in one folder. */
export function ownFiles(character: Character, which: OwnKinds): readonly OwnFile[] {
  const isOwn = (kind: SavedKind) => !isCopy(character, kind);
  // A rig names a `.skel`, which motion capture doesn't have.
  const isRig = (kind: SavedKind) => kind === 'rig' && (isOwn('skel') || isOwn('axskel'));
  const isPlain = (kind: SavedKind) => isOwn(kind) && !besideOf(kind) && kind !== 'pose';
  const isWanted = which === 'plain' ? isPlain : (kind: SavedKind) => isOwn(kind) || besideOf(kind) || isRig(kind);
  const texts = SAVED_KINDS.filter(isWanted)
    .flatMap((kind) => saveCharacter(character, kind))
    .map(({ name, text }): OwnFile => ({ name: inOneFolder(name), content: text }));
  const textures = character.textures.map(({ name, bytes }) => ({ name: inOneFolder(name), content: bytes }));
  // The plain file of a take with layers is one of both kinds.
  const byName = new Map([...texts, ...textures].map((file) => [file.name, file]));
  return [...byName.values()];
}

/** A name is free text: characters that separate folders are replaced. */
function inOneFolder(name: string): string {
  return name.replace(/[/\\:]/g, '_');
}

/** Folders for characters that are saved together, one each, called like them. */
export function ownFolders(characters: readonly Pick<Character, 'name'>[]): readonly string[] {
  const taken = new Set<string>();
  return characters.map(({ name }) => {
    const folder = freeFolder(folderOf(name), taken);
    taken.add(folder);
    return folder;
  });
}

/** `..` is no folder of its own. */
function folderOf(name: string): string {
  const folder = inOneFolder(name);
  return /^\.*$/.test(folder) ? 'character' : folder;
}

function freeFolder(folder: string, taken: ReadonlySet<string>): string {
  for (let n = 1; ; n++) {
    const free = n === 1 ? folder : `${folder} (${n})`;
    if (!taken.has(free)) return free;
  }
}
