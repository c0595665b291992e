/**
 * Matches joints when a skeleton is loaded again from a changed file, or a pose is applied to another skeleton. Names
 * come first: the first of a name matches the first, the second the second; if no name is identical, case and prefixes
 * are ignored. Unnamed and renamed joints are matched by position.
 */
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { plainName } from './sides.ts';

interface Named {
  readonly name: string;
}

/**
 * For each of the first list the index in the second, by name only, or -1; each used once. Unnamed ones have no match.
 */
export function sameNames(from: readonly Named[], into: readonly Named[]): Int32Array {
  const targets = new Int32Array(from.length).fill(-1);
  const taken = new Set<number>();
  for (const key of [(name: string) => name, plainName]) {
    const free = new Map<string, number[]>();
    into.forEach(({ name }, j) => {
      if (taken.has(j) || key(name) === '') return;
      const list = free.get(key(name));
      if (list) list.push(j);
      else free.set(key(name), [j]);
    });
    from.forEach(({ name }, i) => {
      if (targets[i] >= 0) return;
      const joint = free.get(key(name))?.shift();
      if (joint === undefined) return;
      targets[i] = joint;
      taken.add(joint);
    });
  }
  return targets;
}

/** Whether all names are the same, in order. */
export function haveSameNames(a: readonly Named[], b: readonly Named[]): boolean {
  return a.length === b.length && a.every(({ name }, j) => name === b[j].name);
}

/**
 * For each old joint its new index; -1 if removed. Joints without a match by name are matched below the same parent by
 * equal DOFs and offset, and then by number among the children.
 */
export function sameJoints({ joints: before }: Skeleton, { joints: after }: Skeleton): Int32Array {
  if (haveSameNames(before, after)) return Int32Array.from(before, (_, j) => j);
  const to = sameNames(before, after);
  const taken = new Set(to);
  const [childrenBefore, childrenAfter] = [childrenOf(before), childrenOf(after)];
  const match = (above: number, isAlike: (a: number, b: number) => boolean) => {
    const parent = above < 0 ? -1 : to[above];
    if (above >= 0 && parent < 0) return;
    for (const own of childrenBefore[above + 1]) {
      if (to[own] >= 0) continue;
      const found = childrenAfter[parent + 1].find(
        (other) => !taken.has(other) && sameDofs(before[own], after[other]) && isAlike(own, other),
      );
      if (found === undefined) continue;
      to[own] = found;
      taken.add(found);
    }
  };
  // A joint comes after its parent, which is matched by then.
  for (let above = -1; above < before.length; above++) {
    match(above, (a, b) => before[a].offset.every((value, k) => value === after[b].offset[k]));
    match(above, (a, b) => numberOf(a, before, childrenBefore) === numberOf(b, after, childrenAfter));
  }
  return to;
}

type Joints = Skeleton['joints'];

/** Indexed by parent plus one: roots come first. */
function childrenOf(joints: Joints): readonly (readonly number[])[] {
  const children: number[][] = Array.from({ length: joints.length + 1 }, () => []);
  joints.forEach(({ parent }, j) => {
    children[parent + 1].push(j);
  });
  return children;
}

function numberOf(joint: number, joints: Joints, children: readonly (readonly number[])[]): number {
  return children[joints[joint].parent + 1].indexOf(joint);
}

function sameDofs(a: Joints[number], b: Joints[number]): boolean {
  return haveSameNames(dofsOf(a.motion), dofsOf(b.motion));
}
