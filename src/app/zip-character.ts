/** Characters as one zip. Loaded on first use, with the zip library. */

import { besideOf, SAVED_KINDS, type SavedKind } from '../files/kinds.ts';
import { isCopy, saveCharacter } from '../files/save/saving.ts';
import { type ZippedFile, zipFiles } from '../io/zip-files.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { Character, Document } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';

export interface CharactersZip {
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Those that it holds. */
  readonly characters: readonly Character[];
  /** About those that it doesn't. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Everything of a character in its own formats, with textures, so that it opens again unchanged. */
export function zipCharacter(character: Character): CharactersZip {
  const folder = folderOf(character);
  const bytes = zipFiles(folder, filesOf(character));
  return { name: `${folder}.zip`, bytes, characters: [character], diagnostics: [] };
}

/** All characters, each in a folder of its own. One that can't be written doesn't keep the others from it. */
export function zipDocument({ characters }: Document): CharactersZip {
  const files: ZippedFile[] = [];
  const written: Character[] = [];
  const diagnostics: Diagnostic[] = [];
  const folders = new Set<string>();
  for (const character of characters) {
    try {
      const own = filesOf(character);
      const folder = freeFolder(folderOf(character), folders);
      folders.add(folder);
      files.push(...own.map((file) => ({ ...file, name: `${folder}/${file.name}` })));
      written.push(character);
    } catch (error) {
      const why = sentenceOf(error);
      diagnostics.push(withoutPlace('error', 'save-failed', `${character.name} is not in the zip. ${why}`, ''));
    }
  }
  return { name: 'marrow.zip', bytes: zipFiles('marrow', files), characters: written, diagnostics };
}

function filesOf(character: Character): readonly ZippedFile[] {
  const isOwn = (kind: SavedKind) => !isCopy(character, kind);
  // A rig names a `.skel`, which motion capture doesn't have.
  const isRig = (kind: SavedKind) => kind === 'rig' && (isOwn('skel') || isOwn('axskel'));
  const kinds = SAVED_KINDS.filter((kind) => isOwn(kind) || besideOf(kind) || isRig(kind));
  const texts = kinds
    .flatMap((kind) => saveCharacter(character, kind))
    .map(({ name, text }) => ({ name: inOneFolder(name), content: text }));
  const textures = character.textures.map(({ name, bytes }) => ({ name: inOneFolder(name), content: bytes }));
  // The plain file of a take with layers is one of both kinds.
  const byName = new Map([...texts, ...textures].map((file) => [file.name, file]));
  return [...byName.values()];
}

/** A name is free text: characters that separate folders are replaced. */
function inOneFolder(name: string): string {
  return name.replace(/[/\\:]/g, '_');
}

/** `..` is no folder of its own. */
function folderOf({ name }: Character): string {
  const folder = inOneFolder(name);
  return /^\.*$/.test(folder) ? 'character' : folder;
}

function freeFolder(folder: string, taken: ReadonlySet<string>): string {
  for (let n = 1; ; n++) {
    const free = n === 1 ? folder : `${folder} (${n})`;
    if (!taken.has(free)) return free;
  }
}
