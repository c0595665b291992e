/**
 * What was handed in: a submission is a folder of the class, or a zip, as a learning platform gives them out. A zip in
 * such a folder counts as a folder of its name.
 */
import { readdirSync } from 'node:fs';
import { join, relative, resolve, sep } from 'node:path';
import { unzip } from '../../formats/unzip.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { formatOf } from '../../project/readers.ts';
import { findGiven, type GivenPath, isFolder } from '../paths.ts';
import { fileBytes } from '../read-file.ts';
import { reasonOf } from '../reason.ts';

/** Natural order, as a teacher's list. */
const byName = new Intl.Collator('en', { numeric: true });

/** Of a submission's archives, packed and unpacked: many captures, and no more than a machine has. */
const MAX_ZIP_BYTES = 2 ** 28;

export interface ClassFolder {
  /** Absolute; folders and zips in natural order. */
  readonly submissions: readonly string[];
  /** Names of loose files, which belong to nobody. */
  readonly loose: readonly string[];
}

/**
 * @param reference absolute; it is no submission if it is in the class
 * @throws Error if the folder can't be read
 */
export function classIn(folder: string, reference: string): ClassFolder {
  const submissions: string[] = [];
  const loose: string[] = [];
  const names = readdirSync(folder).filter((name) => !isOfSystem(name));
  for (const name of names.sort(byName.compare)) {
    const path = join(folder, name);
    if (path === reference) continue;
    if (isFolder(path) || isZip(name)) submissions.push(path);
    else loose.push(name);
  }
  return { submissions, loose };
}

export interface HandedIn {
  readonly files: readonly GivenPath[];
  /** Of archives that can't be unpacked. */
  readonly problems: readonly Diagnostic[];
}

/**
 * @param submission a folder or a zip, absolute
 * @param folder the caller's, absolute, which paths are relative to
 */
export function filesOf(submission: string, folder: string): HandedIn {
  const { files: given, missing } = findGiven([submission], folder);
  const files: GivenPath[] = [];
  const problems = missing.map(({ path, code, why }) => withoutPlace('error', code, why, shown(path, folder)));
  let room = MAX_ZIP_BYTES;
  for (const file of given) {
    if (!isZip(file.path)) {
      files.push(file);
      continue;
    }
    try {
      const unpacked = entriesOf(file, room);
      for (const { bytes } of unpacked) room -= bytes?.length ?? 0;
      files.push(...unpacked);
    } catch (error) {
      const message = `The archive can't be unpacked: ${reasonOf(error)}.`;
      problems.push(withoutPlace('error', 'zip-unreadable', message, file.path));
    }
  }
  return { files, problems };
}

/** @param path absolute, or relative to the folder */
function shown(path: string, folder: string): string {
  return relative(folder, resolve(folder, path)).split(sep).join('/');
}

function entriesOf({ absolute, path }: GivenPath, room: number): readonly GivenPath[] {
  const isWanted = (name: string) => !name.split(/[/\\]/).some(isOfSystem) && formatOf(name) !== undefined;
  const { entries } = unzip(fileBytes(absolute, MAX_ZIP_BYTES), isWanted, room);
  return entries
    .map(({ path: inside, bytes }): GivenPath => {
      // Some programs of Windows write backslashes.
      const name = inside.replaceAll('\\', '/').replace(/^\/+/, '');
      return { path: `${path}/${name}`, absolute: join(absolute, name), bytes };
    })
    .sort((a, b) => byName.compare(a.path, b.path));
}

/** Hidden files, and what macOS adds to archives. */
function isOfSystem(name: string): boolean {
  return name.startsWith('.') || name === '__MACOSX';
}

function isZip(name: string): boolean {
  return /\.zip$/i.test(name);
}
