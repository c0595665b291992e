/** Names of joints in Acclaim files, in which they are single words and tell bones apart. */
import { oneToken } from '../../model/names/written-names.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import { ROOT } from './bones.ts';

/** The name of each joint in files, in the skeleton's order: of the first `root`. Cached. */
export const boneNames = perSkeleton(({ joints }): readonly string[] => {
  const taken = new Map([[ROOT, 1]]);
  return joints.map(({ name }, j) => (j === 0 ? ROOT : freeName(fileName(name) || `joint${j}`, taken)));
});

/**
 * A name as a word of a file, without the signs that mean something there; a number would be that of a frame, `end` the
 * end of the hierarchy.
 */
export function fileName(name: string): string {
  const word = oneToken(name).replace(/[#(),]|^:/g, '_');
  return /^(\d+|begin|end)$/i.test(word) ? `_${word}` : word;
}

/**
 * The name, with a number behind it if it is taken; it is taken then.
 * @param taken names with the last number that was tried for each
 */
export function freeName(name: string, taken: Map<string, number>): string {
  let free = name;
  let number = taken.get(name) ?? 1;
  while (taken.has(free) || free.toLowerCase() === ROOT) free = `${name}_${++number}`;
  if (free !== name) taken.set(name, number);
  taken.set(free, 1);
  return free;
}
