/** A character as one zip. Loaded on first use, with the zip library. */
import { zipFiles } from '../io/zip-files.ts';
import type { Character } from '../model/document.ts';
import { SAVED_KINDS, type SavedKind } from '../project/kinds.ts';
import { isCopy, saveCharacter } from '../project/save/saving.ts';

/** Everything of a character in its own formats, with textures, so that it opens again unchanged. */
export function zipCharacter(character: Character): { readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } {
  const isOwn = (kind: SavedKind) => !isCopy(character, kind);
  // A rig names a `.skel`, which motion capture doesn't have.
  const kinds = SAVED_KINDS.filter((kind) => isOwn(kind) || (kind === 'rig' && (isOwn('skel') || isOwn('axskel'))));
  const texts = kinds
    .flatMap((kind) => saveCharacter(character, kind))
    .map(({ name, text }) => ({
      name,
      content: text,
    }));
  const textures = character.textures.map(({ name, bytes }) => ({ name, content: bytes }));
  // A name is free text; characters that separate folders are replaced.
  const folder = character.name.replace(/[/\\:]/g, '_') || 'character';
  return { name: `${folder}.zip`, bytes: zipFiles(folder, [...texts, ...textures]) };
}
