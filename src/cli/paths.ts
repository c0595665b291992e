/**
 * Files named on a command line: relative to the caller's folder; a folder means all files in it. Shared by the command
 * and `npm start -- a.skel a.skin`.
 */
import { readdirSync, statSync } from 'node:fs';
import { dirname, join, relative, resolve, sep } from 'node:path';

export interface GivenPath {
  /** Relative to the caller's folder, `/` between folders: decides which files belong together. */
  readonly path: string;
  readonly absolute: string;
  /** Of a file in an archive; absent: on disk. */
  readonly bytes?: Uint8Array;
}

export interface GivenPaths {
  /** Each file once, in the order given. */
  readonly files: readonly GivenPath[];
  /** Arguments that match no file, as written. */
  readonly missing: readonly string[];
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

/** Resolves each argument to files, without reading them. */
export function findGiven(args: readonly string[], folder: string): GivenPaths {
  const files = new Map<string, GivenPath>();
  const missing: string[] = [];
  for (const arg of args) {
    const absolute = resolve(folder, arg);
    const stats = statSync(absolute, { throwIfNoEntry: false });
    if (!stats) missing.push(arg);
    for (const file of stats?.isDirectory() ? filesIn(absolute) : stats ? [absolute] : []) {
      files.set(file, { path: relative(folder, file).split(sep).join('/'), absolute: file });
    }
  }
  return { files: [...files.values()], missing };
}

/** All files below a folder, in natural order, without hidden ones. Links to folders are not followed. */
function filesIn(folder: string): string[] {
  const entries = readdirSync(folder, { withFileTypes: true }).filter((entry) => !entry.name.startsWith('.'));
  entries.sort((a, b) => byName.compare(a.name, b.name));
  return entries.flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return filesIn(path);
    return statSync(path, { throwIfNoEntry: false })?.isFile() ? [path] : [];
  });
}
