/** Names of joints in Acclaim files, in which they are single words and tell bones apart. */
import { oneToken } from '../../model/names/written-names.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import { ROOT } from './bones.ts';

/** The name of each joint in files, in the skeleton's order: of the first `root`. Cached. */
export const boneNames = perSkeleton(({ joints }): readonly string[] => {
  const taken = new Set([ROOT]);
  return joints.map(({ name }, j) => (j === 0 ? ROOT : freeName(fileName(name) || `joint${j}`, taken)));
});

/** A name as a word of a file, without the signs that mean something there; a number would be that of a frame. */
export function fileName(name: string): string {
  const word = oneToken(name).replace(/[#(),]|^:/g, '_');
  return /^\d+$/.test(word) ? `_${word}` : word;
}

/** The name, with a number behind it if it is taken; it is taken then. */
export function freeName(name: string, taken: Set<string>): string {
  let free = name;
  for (let i = 2; taken.has(free) || free.toLowerCase() === ROOT; i++) free = `${name}_${i}`;
  taken.add(free);
  return free;
}
