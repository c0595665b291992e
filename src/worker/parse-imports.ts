/**
 * The part of the `parse` job that reads files of other programs, as a whole and with the files that they name: buffers
 * and textures, which may have been given earlier, or come later.
 */

import { isBesideTakes, isBuffer, skeletonKindFor } from '../files/kinds.ts';
import { type Format, formatOf } from '../files/readers.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type BrokenFile, baseName, folderOf, type ParsedFile, type SourceFile } from '../model/files.ts';
import { perObject } from '../model/per-object.ts';
import { sourceOf, tooLargeToPost, unreadable } from './parsed-blob.ts';
import { passageOf } from './passage.ts';
import type { GivenBlob } from './protocol.ts';
import { settledTakes } from './settled-takes.ts';
import { withCharacters } from './tracked-takes.ts';

export interface ImportedBlob {
  readonly files: readonly ParsedFile[];
  readonly broken: readonly BrokenFile[];
}

export interface ImportedBlobs {
  /** What becomes of these files, and of those that are parts of them, by their paths. */
  readonly imported: ReadonlyMap<string, ImportedBlob>;
  /** Paths of files that later ones may need, or that may need later ones. */
  readonly keeps: readonly string[];
}

/**
 * @param before given earlier, and none of `given`: parts that these may need, and files that may need parts of these
 * @param count is told what was read: a name and its bytes
 */
export async function importedFrom(
  given: readonly GivenBlob[],
  before: readonly GivenBlob[],
  diagnostics: Diagnostic[],
  count: (name: string, bytes: number) => void,
): Promise<ImportedBlobs> {
  const imported = new Map<string, ImportedBlob>();
  const keeps = new Set(given.map(({ path }) => path).filter(isBuffer));
  for (const file of given) {
    const format = formatOf(baseName(file.path));
    if (!format?.imports) continue;
    // Its name is told before it is read: it is read as a whole, which may take long.
    count(baseName(file.path), 0);
    const read = await importOne(file, format, [given, before]);
    if (read.isOther) continue;
    diagnostics.push(...read.diagnostics);
    const earlier = read.parts.filter(({ path }) => before.some((own) => own.path === path));
    if (earlier.length && read.files.length) diagnostics.push(withEarlier(baseName(file.path), earlier));
    const own = read.parts.filter((part) => !imported.has(part.path) && given.some(({ path }) => path === part.path));
    count(
      baseName(file.path),
      own.reduce((sum, { bytes }) => sum + bytes, file.blob.size),
    );
    for (const { path } of read.parts) imported.set(path, NOTHING);
    imported.set(file.path, read);
    if (format.format === 'gltf') for (const { path } of [file, ...read.parts]) keeps.add(path);
    // Motions of a skeleton may come later, and a skeleton after its motions.
    if (isBesideTakes(file.path) || read.isWaiting) keeps.add(file.path);
  }
  for (const file of given.some(({ path }) => isBesideTakes(path)) ? before : []) {
    const format = formatOf(baseName(file.path));
    if (!format || !skeletonKindFor(file.path)) continue;
    const read = await importOne(file, format, [given, before]);
    if (read.isWaiting) continue;
    diagnostics.push(...read.diagnostics);
    imported.set(file.path, read);
  }
  // Buffers without their `.gltf` may be those of one that was given earlier.
  const loose = given.filter(({ path }) => isBuffer(path) && !imported.has(path));
  for (const file of loose.length ? before : []) {
    const format = formatOf(baseName(file.path));
    if (format?.format !== 'gltf') continue;
    // Many are called `scene.bin`: one from another folder is that of another file.
    const folder = folderOf(sourceOf(file.path, 0));
    const near = loose.filter(({ path }) => !path.includes('/') || folderOf(sourceOf(path, 0)) === folder);
    const read = await importOne(file, format, [near, before]);
    if (!read.parts.some(({ path }) => near.some((own) => own.path === path))) continue;
    diagnostics.push(...read.diagnostics);
    for (const { path } of read.parts) imported.set(path, NOTHING);
    imported.set(file.path, read);
  }
  return { imported, keeps: [...keeps] };
}

const NOTHING: ImportedBlob = { files: [], broken: [] };

interface ReadBlob extends ImportedBlob {
  /** Files that it named and that were found, used or not. */
  readonly parts: readonly SourceFile[];
  readonly diagnostics: readonly Diagnostic[];
  readonly isWaiting?: true;
  readonly isOther?: true;
}

const finderIn = perObject(async (place: readonly GivenBlob[]) => {
  const { besideIn } = await import('../files/imports.ts');
  return besideIn(place);
});

/** @param places where its parts are looked for, one after the other */
async function importOne(
  { path, blob }: GivenBlob,
  { imports, kind }: Format,
  places: readonly (readonly GivenBlob[])[],
): Promise<ReadBlob> {
  const source = sourceOf(path, blob.size);
  const broken = { files: [], broken: [{ kind, source }] };
  const parts: SourceFile[] = [];
  try {
    const finds = await Promise.all(places.map(finderIn));
    const read = await imports?.({
      fileName: source.name,
      bytes: new Uint8Array(await blob.arrayBuffer()),
      beside: async (relative) => {
        for (const find of finds) {
          const found = find(path, relative);
          const bytes = found && (await bytesOf(found));
          if (!bytes) continue;
          const part = sourceOf(found.path, bytes.length);
          parts.push(part);
          return { bytes, source: part };
        }
        return undefined;
      },
      near: (extension) => {
        // Of its folder, or of any: files picked one by one have none. Those given now come first.
        for (const place of places) {
          const found = place.filter(({ path: other }) => other.toLowerCase().endsWith(`.${extension}`));
          const own = found.filter(({ path: other }) => folderOf(sourceOf(other, 0)) === folderOf(source));
          if (found.length > 0) return (own.length > 0 ? own : found).map(({ path: other }) => baseName(other));
        }
        return [];
      },
    });
    const { diagnostics = [], beside = [], isWaiting, isOther } = read ?? {};
    if (isOther) return { files: [], broken: [], parts: [], diagnostics, isOther };
    const value = read?.value && withCharacters(read.value, settledTakes);
    const tooLarge = value && tooLargeToPost(source, passageOf(value).transfer);
    const told = tooLarge ? [...diagnostics, tooLarge] : diagnostics;
    if (isWaiting) return { files: [], broken: [], parts: [], diagnostics: told, isWaiting };
    if (!value || tooLarge) return { ...broken, parts, diagnostics: told };
    return { files: [{ ...value, source, beside }], broken: [], parts, diagnostics: told };
  } catch (error) {
    return { ...broken, parts, diagnostics: [unreadable(source, error)] };
  }
}

/** Undefined if the file was changed, moved or deleted since it was given. */
async function bytesOf({ blob }: GivenBlob): Promise<Uint8Array<ArrayBuffer> | undefined> {
  try {
    return new Uint8Array(await blob.arrayBuffer());
  } catch {
    return undefined;
  }
}

function withEarlier(name: string, parts: readonly SourceFile[]): Diagnostic {
  const names = parts.map((part) => part.name).join(', ');
  return withoutPlace('info', 'part-given-before', `Read with ${names}, given before.`, name);
}

/** What is told of a buffer that no file names yet. */
export function waitingBuffer({ name }: SourceFile): Diagnostic {
  const message = 'No open .gltf file uses it as a buffer. Drop that file too.';
  return withoutPlace('info', 'file-unused', message, name, 'kept for a matching file');
}
