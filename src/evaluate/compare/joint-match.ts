/**
 * Matches the joints of two skeletons: those with the same name whose parents match. Siblings may be in any order, as
 * in exports of one character by two programs; of siblings with the same name, the first match, then the second, and so
 * on.
 *
 * No guessing: `LeftArm` and `L_UpperArm` may be the same limb, but their distance would compare two rigs, not two
 * motions. That is left to retargeting.
 */
import { length3 } from '../../math/vec3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** Which joints of two skeletons correspond, by index. */
export interface JointMatch {
  /** Joints of the first skeleton that have a match, ascending. */
  readonly first: readonly number[];
  /** Their matches in the second, one for each of `first`. */
  readonly second: readonly number[];
  /** Joints without a match in the other skeleton. */
  readonly onlyFirst: readonly number[];
  readonly onlySecond: readonly number[];
}

/** Matches the joints of two skeletons by name and parent; a joint whose parent has no match has none. */
export function matchJoints(a: Skeleton, b: Skeleton): JointMatch {
  // Names may contain any character; the key is still unique, since the number comes first.
  const key = (parent: number, name: string) => `${parent} ${name}`;
  const free = new Map<string, number[]>();
  b.joints.forEach(({ parent, name }, j) => {
    const list = free.get(key(parent, name));
    if (list) list.push(j);
    else free.set(key(parent, name), [j]);
  });
  const partner = new Int32Array(a.joints.length).fill(-1);
  const taken = new Uint8Array(b.joints.length);
  const first: number[] = [];
  const second: number[] = [];
  a.joints.forEach(({ parent, name }, j) => {
    const above = parent < 0 ? -1 : partner[parent];
    // Without a match for the parent there is none for the limb.
    const found = parent >= 0 && above < 0 ? undefined : free.get(key(above, name))?.shift();
    if (found === undefined) return;
    partner[j] = found;
    taken[found] = 1;
    first.push(j);
    second.push(found);
  });
  return {
    first,
    second,
    onlyFirst: [...a.joints.keys()].filter((j) => partner[j] < 0),
    onlySecond: [...b.joints.keys()].filter((j) => !taken[j]),
  };
}

/** Whether both have the same joints, in any order. */
export function isSameSkeleton({ onlyFirst, onlySecond }: JointMatch): boolean {
  return onlyFirst.length === 0 && onlySecond.length === 0;
}

/** Bones of one actor differ less than this between files, as a part of their length. */
const SAME_SIZE = 0.05;

/**
 * Whether the matched bones are about as long in both skeletons, in the units of their files: takes of one actor in one
 * unit. Without bones to tell by, whether both have the same joints.
 */
export function isSameSize(a: Skeleton, b: Skeleton, match: JointMatch): boolean {
  const [own, other] = [bonesLength(a, match.first), bonesLength(b, match.second)];
  if (own === 0 && other === 0) return isSameSkeleton(match);
  return Math.abs(own - other) <= SAME_SIZE * Math.max(own, other);
}

/** Without roots: their offset may be a place, and is no bone. */
function bonesLength({ joints }: Skeleton, those: readonly number[]): number {
  return those.reduce((sum, j) => (joints[j].parent < 0 ? sum : sum + length3(...joints[j].offset)), 0);
}
