/**
 * `marrow/import`: characters of files of every format that Marrow reads, as the page opens them: matched by name, with
 * unit, up axis and ground.
 *
 *     const { characters } = await readCharacters([{ name: 'wasp.skel', content }, { name: 'wasp.skin', content }]);
 */
import { openFiles } from '../files/open/open-files.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { byPath } from '../model/files.ts';
import { parse } from '../worker/parse.ts';
import { bytesOf, type Content } from './content.ts';

export type { Diagnostic } from '../model/diagnostic.ts';
export type { Character } from '../model/document.ts';
export type { Content } from './content.ts';

/** A file: its name says the format, and what belongs together. */
export interface NamedFile {
  /** `wasp.skel`, or with folders, `/` between them. */
  readonly name: string;
  readonly content: Content;
}

/** Characters that were read. */
export interface ReadCharacters {
  /** Without those whose files have errors. */
  readonly characters: readonly Character[];
  readonly diagnostics: readonly Diagnostic[];
}

/** A character that was read; absent if there is an error. */
export interface ReadCharacter {
  readonly character?: Character;
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Reads files of any formats, zips too, and makes characters of them. Nothing else is opened: what a `.gltf` or a `.rig`
 * names must be among them. Never throws for anything that the files hold.
 * @throws UserError if a content is neither text nor bytes
 */
export async function readCharacters(files: readonly NamedFile[]): Promise<ReadCharacters> {
  const given = files.map(({ name, content }) => ({ path: name, blob: new Blob([bytesOf(content)]) }));
  const { files: read, broken, diagnostics } = await parse({ files: given }, () => undefined);
  const opened = openFiles(EMPTY_DOCUMENT, read, broken, undefined, byPath);
  return { characters: opened.document.characters, diagnostics: [...diagnostics, ...opened.diagnostics] };
}

/**
 * Reads a `.glb`, or a `.gltf`, `.vrm` or `.vrma` that needs no other files.
 * @param fileName in messages; default `character.glb`
 */
export async function readGltf(content: Content, fileName = 'character.glb'): Promise<ReadCharacter> {
  return readOne({ name: fileName, content });
}

/**
 * Reads an `.fbx`, binary or text.
 * @param fileName in messages; default `character.fbx`
 */
export async function readFbx(content: Content, fileName = 'character.fbx'): Promise<ReadCharacter> {
  return readOne({ name: fileName, content });
}

async function readOne(file: NamedFile): Promise<ReadCharacter> {
  const { characters, diagnostics } = await readCharacters([file]);
  return { ...(characters[0] && { character: characters[0] }), diagnostics };
}
