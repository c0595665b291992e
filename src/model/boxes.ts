/**
 * Which joints have boxes. Skeleton formats give every joint one. BVH and the axis-angle form have no boxes, so their
 * joints carry a default box: they are drawn as bones, and the box is not used to measure size. A joint with a bone of
 * its own has a box only if someone set one.
 */
import { hasOwnBox } from './axis-angle.ts';
import { isOfBvh } from './joint-types.ts';
import type { Joint, Skeleton } from './skeleton.ts';

export function hasBox(joint: Joint): boolean {
  if (joint.length !== undefined && !hasOwnBox(joint)) return false;
  return !isOfBvh(joint.motion);
}

/** Whether every joint has a box; a joint without one is drawn only as a bone. */
export function hasAllBoxes({ joints }: Skeleton): boolean {
  return joints.every(hasBox);
}

/**
 * Whether most boxes are the small default cubes of newly made joints and of files without boxes. These show where
 * joints are, but not how they connect.
 */
export function areBoxesPlain({ joints }: Skeleton): boolean {
  const plain = joints.filter((joint) => !hasOwnBox(joint)).length;
  return joints.length > 1 && 2 * plain > joints.length;
}

export function hasBoxes({ joints }: Skeleton): boolean {
  return joints.some(hasBox);
}
