/**
 * Files named on a command line: relative to the caller's folder; a folder means all files in it. Shared by the command
 * and `npm start -- a.skel a.skin`.
 */
import { type Dirent, readdirSync, type Stats, statSync } from 'node:fs';
import { dirname, join, relative, resolve, sep } from 'node:path';
import { isOfSystem, reasonOf } from './reason.ts';

export interface GivenPath {
  /** Relative to the caller's folder, `/` between folders: decides which files belong together. */
  readonly path: string;
  readonly absolute: string;
  /** Bytes of a file in an archive; absent: on disk. */
  readonly bytes?: Uint8Array;
  /** The archive, absolute. */
  readonly zip?: string;
}

export interface GivenPaths {
  /** Each file once, in the order given. */
  readonly files: readonly GivenPath[];
  /** Arguments that match no file, and folders that can't be read. */
  readonly missing: readonly MissingPath[];
}

export interface MissingPath {
  /** As written; of a folder in a folder as that of a file. */
  readonly path: string;
  readonly code: 'file-missing' | 'file-unreadable';
  /** A sentence. */
  readonly why: string;
}

/** Natural order: `head2.morph` before `head10.morph`. */
const byName = new Intl.Collator('en', { numeric: true });

/**
 * The folder that paths are relative to: npm runs scripts in the package's folder and passes the caller's as INIT_CWD.
 * Used only if npm started this very script, since child processes inherit INIT_CWD.
 */
export function callersFolder(script: string): string {
  const { INIT_CWD, npm_lifecycle_event, npm_package_json } = process.env;
  const byNpm = npm_lifecycle_event === script && npm_package_json && dirname(npm_package_json) === process.cwd();
  return (byNpm && INIT_CWD) || process.cwd();
}

/** Absolute paths of what arguments name themselves: of a folder not what is in it. */
export function namedPaths(args: readonly string[], folder: string): ReadonlySet<string> {
  return new Set(args.map((arg) => resolve(folder, arg)));
}

/** Resolves each argument to files, without reading them. */
export function findGiven(args: readonly string[], folder: string): GivenPaths {
  const files = new Map<string, GivenPath>();
  const missing: MissingPath[] = [];
  const shown = (absolute: string) => relative(folder, absolute).split(sep).join('/');
  for (const arg of args) {
    const absolute = resolve(folder, arg);
    const stats = statsOf(absolute);
    if (!stats) {
      missing.push({ path: arg, code: 'file-missing', why: `There is no such file in ${folder}.` });
    } else if ('failure' in stats) {
      missing.push({ path: arg, code: 'file-unreadable', why: `The file could not be read: ${stats.failure}.` });
    } else if (stats.isDirectory()) {
      const unreadable = (below: string, reason: string) => {
        const path = below === absolute ? arg : shown(below);
        missing.push({ path, code: 'file-unreadable', why: `The folder could not be read: ${reason}.` });
      };
      for (const file of filesIn(absolute, unreadable)) files.set(file, { path: shown(file), absolute: file });
    } else files.set(absolute, { path: shown(absolute), absolute });
  }
  return { files: [...files.values()], missing };
}

/**
 * All files below a folder, in natural order, without hidden ones. Links to folders are not followed; those that lead
 * nowhere are files that can't be read.
 */
function filesIn(folder: string, unreadable: (folder: string, reason: string) => void): string[] {
  let entries: Dirent[];
  try {
    entries = readdirSync(folder, { withFileTypes: true }).filter((entry) => !entry.name.startsWith('.'));
  } catch (error) {
    unreadable(folder, reasonOf(error));
    return [];
  }
  entries.sort((a, b) => byName.compare(a.name, b.name));
  return entries.flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return filesIn(path, unreadable);
    const stats = statsOf(path);
    return !stats || 'failure' in stats || stats.isFile() ? [path] : [];
  });
}

/** Undefined if there is nothing of this name. */
function statsOf(path: string): Stats | { readonly failure: string } | undefined {
  try {
    return statSync(path);
  } catch (error) {
    const isAbsent = isOfSystem(error) && error.code === 'ENOENT';
    return isAbsent ? undefined : { failure: reasonOf(error) };
  }
}

/** Whether it is a folder that can be seen. */
export function isFolder(path: string): boolean {
  const stats = statsOf(path);
  return stats !== undefined && !('failure' in stats) && stats.isDirectory();
}

/** Whether it is a file that can be seen. */
export function isFile(path: string): boolean {
  const stats = statsOf(path);
  return stats !== undefined && !('failure' in stats) && stats.isFile();
}
