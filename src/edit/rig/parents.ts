/** Which joints may hang on which. */
import type { Joint } from '../../model/skeleton.ts';

/** One past the last joint of the branch that begins with this one: pre-order keeps it in one piece. */
export function branchEnd(joints: readonly Pick<Joint, 'parent'>[], joint: number): number {
  let end = joint + 1;
  while (end < joints.length && joints[end].parent >= joint) end++;
  return end;
}

/** Whether a joint can hang on another: not on itself or what hangs on it, and the root on nothing. */
export function canHangOn(joints: readonly Pick<Joint, 'parent'>[], joint: number, parent: number): boolean {
  if (joint <= 0 || parent < 0 || joint >= joints.length || parent >= joints.length) return false;
  return parent < joint || parent >= branchEnd(joints, joint);
}

/** All that it can, in their order. */
export function possibleParents(joints: readonly Pick<Joint, 'parent'>[], joint: number): number[] {
  return [...joints.keys()].filter((parent) => canHangOn(joints, joint, parent));
}
