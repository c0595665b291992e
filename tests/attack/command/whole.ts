/** Whether outputs are whole: what is in folders, and what may not be left there. */
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';

/** Hashes of all files below the folder, by their paths; empty if it is not there. Pipes and devices are left out. */
export function filesBelow(folder: string): ReadonlyMap<string, string> {
  const files = new Map<string, string>();
  if (!statSync(folder, { throwIfNoEntry: false })) return files;
  for (const entry of readdirSync(folder, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile()) continue;
    const path = join(entry.parentPath, entry.name);
    files.set(path.slice(folder.length + 1), createHash('sha256').update(readFileSync(path)).digest('hex'));
  }
  return files;
}

/** Unfinished files and folders of the command. */
export function leftovers(folder: string): string[] {
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((name) => /\.tmp$|(^|\/)\.marrow/.test(name))
    .map((name) => `${name} was left`);
}

/** Files that are neither as before nor as they should be after; `undefined` in a map is no file. */
export function torn(
  now: ReadonlyMap<string, string>,
  before: ReadonlyMap<string, string>,
  after: ReadonlyMap<string, string>,
): string[] {
  const isFinished = (name: string) => !/\.tmp$|(^|\/)\.marrow|manifest\./.test(name);
  return [...now]
    .filter(([name, hash]) => isFinished(name) && hash !== before.get(name) && hash !== after.get(name))
    .map(([name]) => `${name} is half written`);
}
