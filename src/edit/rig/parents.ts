/** Valid parents of joints. */
import type { Joint } from '../../model/skeleton/skeleton.ts';

/** One past the last joint of this joint's hierarchy, which is contiguous in pre-order. */
export function branchEnd(joints: readonly Pick<Joint, 'parent'>[], joint: number): number {
  let end = joint + 1;
  while (end < joints.length && joints[end].parent >= joint) end++;
  return end;
}

/** Whether a joint can be reparented to another: not to itself or a descendant, and never the root. */
export function canHangOn(joints: readonly Pick<Joint, 'parent'>[], joint: number, parent: number): boolean {
  if (joint <= 0 || parent < 0 || joint >= joints.length || parent >= joints.length) return false;
  return parent < joint || parent >= branchEnd(joints, joint);
}

/** All possible parents, in joint order. */
export function possibleParents(joints: readonly Pick<Joint, 'parent'>[], joint: number): number[] {
  return [...joints.keys()].filter((parent) => canHangOn(joints, joint, parent));
}
