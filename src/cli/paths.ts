/**
 * Files named on a command line: relative to the caller's folder, a folder standing for all files in it. Shared by
 * the command and by `npm start -- a.skel a.skin`.
 */
import { readdirSync, statSync } from 'node:fs';
import { dirname, join, relative, resolve, sep } from 'node:path';

export interface GivenPath {
  /** From the caller's folder, `/` between folders: what files that belong together are told by. */
  readonly path: string;
  readonly absolute: string;
}

export interface GivenPaths {
  /** Each file once, in the order given. */
  readonly files: readonly GivenPath[];
  /** Arguments for which there is nothing, as they were written. */
  readonly missing: readonly string[];
}

/** By name, numbers by value: `head2.morph` before `head10.morph`. */
const byName = new Intl.Collator('en', { numeric: true });

/**
 * The folder that paths are relative to: npm runs scripts in the package's own folder, and says in INIT_CWD where the
 * caller was. Asked only when it was npm that started this very script, for what a script starts inherits INIT_CWD.
 */
export function callersFolder(script: string): string {
  const { INIT_CWD, npm_lifecycle_event, npm_package_json } = process.env;
  const byNpm = npm_lifecycle_event === script && npm_package_json && dirname(npm_package_json) === process.cwd();
  return (byNpm && INIT_CWD) || process.cwd();
}

/** Finds what each argument names, without reading it. */
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

/** All files below a folder, in natural order. Hidden ones are no one's character; links to folders are not followed. */
function filesIn(folder: string): string[] {
  const entries = readdirSync(folder, { withFileTypes: true }).filter((entry) => !entry.name.startsWith('.'));
  entries.sort((a, b) => byName.compare(a.name, b.name));
  return entries.flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return filesIn(path);
    return statSync(path, { throwIfNoEntry: false })?.isFile() ? [path] : [];
  });
}
