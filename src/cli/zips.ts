/** Zips among the files that a command is given. */
import { dirname, join, resolve } from 'node:path';
import { otherContent } from '../files/foreign.ts';
import { isBuffer } from '../files/kinds.ts';
import { formatOf } from '../files/readers.ts';
import { isZip, zipContent } from '../files/zip-content.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type GivenPath, isFile } from './paths.ts';
import { fileBytes } from './read-file.ts';
import { reasonOf } from './reason.ts';

/** Natural order, as in folders. */
const byPath = new Intl.Collator('en', { numeric: true });
/** Of all archives, packed and unpacked: many captures, and no more than a machine has. */
const MAX_BYTES = 2 ** 30;

export interface UnpackedPaths {
  readonly files: readonly GivenPath[];
  /** Problems with archives that can't be unpacked. */
  readonly problems: readonly Diagnostic[];
}

/** The files, with the readable ones of each zip in its place. */
export function withZipsUnpacked(given: readonly GivenPath[], maxBytes = MAX_BYTES): UnpackedPaths {
  const files: GivenPath[] = [];
  const problems: Diagnostic[] = [];
  let room = maxBytes;
  for (const file of given) {
    if (!isZip(file.path) || file.bytes) {
      files.push(file);
      continue;
    }
    try {
      const packed = fileBytes(file.absolute, room);
      const other = otherContent(file.path, 'zip', packed);
      if (other) {
        problems.push(other);
        continue;
      }
      const unpacked = contentOf(file, packed, room);
      for (const { bytes } of unpacked) room -= bytes?.length ?? 0;
      files.push(...unpacked);
      if (unpacked.length === 0) problems.push(nothingIn(file.path));
    } catch (error) {
      const message = `The archive can't be unpacked: ${reasonOf(error)}.`;
      problems.push(withoutPlace('error', 'zip-unreadable', message, file.path));
    }
  }
  return { files, problems };
}

/** Where a file would be if its archive had been unpacked next to it: `pack/hero.skel`. Of others where it is. */
export function unpackedPath({ absolute, zip }: GivenPath): string {
  return zip === undefined ? absolute : join(zip.slice(0, -'.zip'.length), absolute.slice(zip.length));
}

/** The archive that a path leads into, as in `takes/pack.zip/walk.bvh`; the path itself where it leads into none. */
export function zipOf(path: string, folder: string): string {
  for (let above = dirname(path); above !== dirname(above); above = dirname(above)) {
    if (isZip(above) && isFile(resolve(folder, above))) return above;
  }
  return path;
}

function contentOf({ absolute, path }: GivenPath, packed: Uint8Array, room: number): readonly GivenPath[] {
  const isWanted = (name: string) => !name.split(/[/\\]/).some(isOfSystem) && isRead(name);
  const { files } = zipContent(path, packed, isWanted, { maxBytes: room });
  return files
    .map((file): GivenPath => ({ ...file, absolute: join(absolute, file.path.slice(path.length)), zip: absolute }))
    .sort((a, b) => byPath.compare(a.path, b.path));
}

function isRead(name: string): boolean {
  return formatOf(name) !== undefined || isBuffer(name);
}

/** Hidden files, and what macOS adds to archives. */
export function isOfSystem(name: string): boolean {
  return name.startsWith('.') || name === '__MACOSX';
}

function nothingIn(path: string): Diagnostic {
  return withoutPlace('warning', 'zip-empty', 'It contains no file that Marrow reads.', path, 'skipped');
}
