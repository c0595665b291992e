/**
 * Which joints have boxes. The formats of skeletons give every joint one; in BVH there is no such thing, and joints read
 * from it carry a stand-in that nobody meant: they are drawn as bones, and no size is measured by it.
 */
import type { Joint, Skeleton } from './skeleton.ts';

export function hasBox({ motion }: Joint): boolean {
  return motion.kind !== 'bvh';
}

export function hasBoxes({ joints }: Skeleton): boolean {
  return joints.some(hasBox);
}
