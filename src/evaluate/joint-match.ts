/**
 * Which joint of one skeleton is which of another: those of the same name below joints that are each other's. Siblings
 * may stand in another order, as they do where two programs wrote one figure; of siblings with one name the first ones
 * go together, then the second ones.
 *
 * No guessing: `LeftArm` and `L_UpperArm` may be the same limb, but a distance between them would be that of two rigs,
 * not of two motions. That is retargeting's.
 */
import type { Skeleton } from '../model/skeleton.ts';

export interface JointMatch {
  /** Joints of the first skeleton that have another, ascending. */
  readonly first: readonly number[];
  /** Theirs in the second, one for each of `first`. */
  readonly second: readonly number[];
  /** Joints that the other skeleton has none for. */
  readonly onlyFirst: readonly number[];
  readonly onlySecond: readonly number[];
}

export function matchJoints(a: Skeleton, b: Skeleton): JointMatch {
  // Names may hold any character; a key made of one and a number is unique all the same, for the number comes first.
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
    // A parent without a partner leaves the whole limb without.
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

/** Whether both have the same joints, whatever their order. */
export function isSameSkeleton({ onlyFirst, onlySecond }: JointMatch): boolean {
  return onlyFirst.length === 0 && onlySecond.length === 0;
}
