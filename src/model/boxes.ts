/**
 * Which joints have boxes. The formats of skeletons give every joint one; in BVH and the axis-angle form there is no such
 * thing, and joints read from them carry a stand-in that nobody meant: they are drawn as bones, and no size is measured
 * by it. A joint with a bone of its own has a box only where someone set one.
 */
import { hasOwnBox } from './axis-angle.ts';
import { isOfBvh } from './joint-types.ts';
import type { Joint, Skeleton } from './skeleton.ts';

export function hasBox(joint: Joint): boolean {
  if (joint.length !== undefined && !hasOwnBox(joint)) return false;
  return !isOfBvh(joint.motion);
}

/** Whether every joint has one: what has none is seen as a bone only. */
export function hasAllBoxes({ joints }: Skeleton): boolean {
  return joints.every(hasBox);
}

/**
 * Whether most boxes are the small cubes that stand for none: those of joints that were just made, and of files that say
 * nothing of boxes. They show where joints are, and not what hangs on what.
 */
export function areBoxesPlain({ joints }: Skeleton): boolean {
  const plain = joints.filter((joint) => !hasOwnBox(joint)).length;
  return joints.length > 1 && 2 * plain > joints.length;
}

export function hasBoxes({ joints }: Skeleton): boolean {
  return joints.some(hasBox);
}
