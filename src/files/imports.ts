/** Characters of other programs: fetched when a file needs them, since few do. */

import { readFbx } from '../import/fbx/read.ts';
import { readGltf } from '../import/gltf/read.ts';
import { type Import, ImportError, type Imported } from '../import/imported.ts';
import { toCharacter } from '../import/to-character.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { baseName, type ContentOf, type FileContent, type SourceFile } from '../model/files.ts';

/** The kinds of files that are read as whole characters of other programs. */
export type ImportedKind = 'gltf' | 'fbx';

/** The result of reading a file of another program. */
export interface ImportedFile<C = FileContent> {
  /** Absent if there is an error, or a warning that the file is skipped. */
  readonly value?: C;
  readonly diagnostics: readonly Diagnostic[];
  /** Other files that were used. */
  readonly beside: readonly SourceFile[];
  /** It is no such file, and read as others of its extension are. */
  readonly isOther?: true;
  /** It has an error because another file is missing: it is read again when that is given. */
  readonly isWaiting?: true;
}

const SCENES: { readonly [K in ImportedKind]: (given: Import) => Promise<Imported> } = {
  gltf: readGltf,
  fbx: async ({ fileName, bytes }) => {
    const { value, diagnostics } = readFbx(fileName, bytes);
    return value ? { scene: value, diagnostics } : { diagnostics };
  },
};

/** Never throws for anything that the file holds. */
export async function importFile(kind: ImportedKind, given: Import): Promise<ImportedFile<ContentOf<'character'>>> {
  const { scene, diagnostics, beside = [] } = await SCENES[kind](given);
  if (!scene) return { diagnostics, beside };
  const failed = (code: string, message: string): ImportedFile<ContentOf<'character'>> => {
    return { diagnostics: [...diagnostics, withoutPlace('error', code, message, given.fileName)], beside };
  };
  try {
    const character = toCharacter(scene);
    if (character) return { value: { kind: 'character', characters: [character] }, diagnostics, beside };
  } catch (error) {
    if (error instanceof ImportError) return failed(error.code, error.message);
    throw error;
  }
  return failed('file-empty', 'Expected a mesh, a skin or an animation, found none.');
}

/** How a file at a path finds those that it names among others that were given with it: all may be thousands. */
export function besideIn<T extends { readonly path: string }>(
  given: readonly T[],
): (path: string, relative: string) => T | undefined {
  const byPath = new Map<string, T>();
  const byName = new Map<string, T>();
  for (const file of given.toReversed()) {
    const path = resolved(file.path).toLowerCase();
    byPath.set(path, file);
    byName.set(baseName(path), file);
  }
  return (path, relative) => {
    const folder = path.slice(0, path.lastIndexOf('/') + 1);
    const wanted = resolved(folder + relative.replaceAll('\\', '/')).toLowerCase();
    // Files picked one by one have no folders.
    return byPath.get(wanted) ?? byName.get(baseName(wanted));
  };
}

function resolved(path: string): string {
  const parts: string[] = [];
  for (const part of path.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '.' && part !== '') parts.push(part);
  }
  return parts.join('/');
}
