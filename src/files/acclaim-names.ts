/** Which skeleton a motion of Acclaim belongs to, by their names. */
import { baseName } from '../model/files.ts';

/**
 * The `.asf` of an `.amc`: the one whose stem is the longest prefix of its stem; else one whose stem up to the first
 * `_` or `-` is the same (`07-walk.asf`, `07_05-walk.amc`); else the only one. Undefined if there is none.
 * @param skeletons names or paths of the `.asf` files that were given with it, or are in its folder
 */
export function skeletonNameFor(fileName: string, skeletons: readonly string[]): string | undefined {
  const stem = stemOf(fileName);
  let best: string | undefined;
  for (const name of skeletons) {
    const own = stemOf(name);
    if (stem.startsWith(own) && own.length > stemOf(best ?? '').length) best = name;
  }
  return (
    best ??
    skeletons.find((name) => headOf(stemOf(name)) === headOf(stem)) ??
    (skeletons.length === 1 ? skeletons[0] : undefined)
  );
}

/** In lower case, without folders. */
function stemOf(path: string): string {
  const name = baseName(path);
  const dot = name.lastIndexOf('.');
  return (dot > 0 ? name.slice(0, dot) : name).toLowerCase();
}

function headOf(stem: string): string {
  return /^[^_-]*/.exec(stem)?.[0] ?? '';
}
