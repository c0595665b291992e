/** Characters as one zip. Loaded on first use, with the zip library. */

import { ownFiles, ownFolders } from '../files/save/own-files.ts';
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
  const [folder] = ownFolders([character]);
  const bytes = zipFiles(folder, ownFiles(character, 'all'));
  return { name: `${folder}.zip`, bytes, characters: [character], diagnostics: [] };
}

/** All characters, each in a folder of its own. One that can't be written doesn't keep the others from it. */
export function zipDocument({ characters }: Document): CharactersZip {
  const files: ZippedFile[] = [];
  const written: Character[] = [];
  const diagnostics: Diagnostic[] = [];
  const folders = ownFolders(characters);
  characters.forEach((character, i) => {
    try {
      files.push(...ownFiles(character, 'all').map((file) => ({ ...file, name: `${folders[i]}/${file.name}` })));
      written.push(character);
    } catch (error) {
      const why = sentenceOf(error);
      diagnostics.push(withoutPlace('error', 'save-failed', `${character.name} is not in the zip. ${why}`, ''));
    }
  });
  return { name: 'marrow.zip', bytes: zipFiles('marrow', files), characters: written, diagnostics };
}
