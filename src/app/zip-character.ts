/** A character as one zip. A script of its own, with the library that zips: fetched when someone asks for one. */
import { zipFiles } from '../io/zip-files.ts';
import type { Character } from '../model/document.ts';
import { FORMAT_KINDS, type FormatKind } from '../project/kinds.ts';
import { isExport } from '../project/save/own-formats.ts';
import { saveCharacter } from '../project/save/saving.ts';

/** Everything of a character in its own formats, its textures too: what opens again as it is. */
export function zipCharacter(character: Character): { readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } {
  const isOwn = (kind: FormatKind) => !isExport(character, kind);
  // A rig names a `.skel`, and motion capture has none.
  const kinds = FORMAT_KINDS.filter((kind) => isOwn(kind) && (kind !== 'rig' || isOwn('skel') || isOwn('axskel')));
  const texts = kinds
    .flatMap((kind) => saveCharacter(character, kind))
    .map(({ name, text }) => ({
      name,
      content: text,
    }));
  const textures = character.textures.map(({ name, bytes }) => ({ name, content: bytes }));
  // A name may be anything; what the file system would take for a folder is no part of it.
  const folder = character.name.replace(/[/\\:]/g, '_') || 'character';
  return { name: `${folder}.zip`, bytes: zipFiles(folder, [...texts, ...textures]) };
}
