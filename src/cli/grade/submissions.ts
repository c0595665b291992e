/**
 * What was handed in: a submission is a folder of the class, or a zip, as a learning platform gives them out. A zip in
 * such a folder counts as a folder of its name.
 */
import { readdirSync } from 'node:fs';
import { join, relative, resolve, sep } from 'node:path';
import { isZip } from '../../files/zip-content.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { findGiven, type GivenPath, isFolder } from '../paths.ts';
import { isOfSystem, withZipsUnpacked } from '../zips.ts';

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
  /** Problems with archives that can't be unpacked. */
  readonly problems: readonly Diagnostic[];
}

/**
 * @param submission a folder or a zip, absolute
 * @param folder the caller's, absolute, which paths are relative to
 */
export function filesOf(submission: string, folder: string): HandedIn {
  const { files, missing } = findGiven([submission], folder);
  const { files: unpacked, problems } = withZipsUnpacked(files, MAX_ZIP_BYTES);
  const shown = (path: string) => relative(folder, resolve(folder, path)).split(sep).join('/');
  const absent = missing.map(({ path, code, why }) => withoutPlace('error', code, why, shown(path)));
  return { files: unpacked, problems: [...absent, ...problems] };
}
