/**
 * Finds the takes of a list among files. A list names its files relative to where it was written: `takes/walk.bvh` on
 * the page, where a folder was dropped; `../lab/takes/walk.bvh` in a shell. Two paths mean one file if they are equal,
 * or if one ends with all of the other: names alone repeat in many folders.
 */
import type { ListedTake } from './list.ts';

export interface PathMatch<T> {
  /** What was found, by the path as given. */
  readonly found: ReadonlyMap<string, T>;
  /** Takes of the list that no file is. */
  readonly missing: readonly T[];
}

/**
 * @param paths with either kind of slash
 * @returns for each path the take with the longest path that means it; each take is found once, by the first file
 */
export function matchPaths<T extends Pick<ListedTake, 'path'>>(
  takes: readonly T[],
  paths: readonly string[],
): PathMatch<T> {
  const byName = new Map<string, { readonly take: T; readonly parts: readonly string[] }[]>();
  for (const take of takes) {
    const parts = partsOf(take.path);
    const name = parts.at(-1) ?? '';
    const same = byName.get(name);
    if (same) same.push({ take, parts });
    else byName.set(name, [{ take, parts }]);
  }
  const found = new Map<string, T>();
  const taken = new Set<T>();
  for (const path of paths) {
    const parts = partsOf(path);
    let best: T | undefined;
    let most = 0;
    for (const candidate of byName.get(parts.at(-1) ?? '') ?? []) {
      if (taken.has(candidate.take)) continue;
      const shared = sharedEnd(parts, candidate.parts);
      if (shared < Math.min(parts.length, candidate.parts.length) || shared <= most) continue;
      best = candidate.take;
      most = shared;
    }
    if (!best) continue;
    taken.add(best);
    found.set(path, best);
  }
  return { found, missing: takes.filter((take) => !taken.has(take)) };
}

/** Folders and name; `.` and `..` at the beginning say nothing about the file. */
function partsOf(path: string): readonly string[] {
  return path.split(/[\\/]/).filter((part) => part !== '' && part !== '.' && part !== '..');
}

function sharedEnd(a: readonly string[], b: readonly string[]): number {
  let shared = 0;
  while (shared < a.length && shared < b.length && a[a.length - 1 - shared] === b[b.length - 1 - shared]) shared++;
  return shared;
}
