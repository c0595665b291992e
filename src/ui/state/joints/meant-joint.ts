import { compileSkeleton } from '../../../evaluate/kinematics.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';

/**
 * The joint that a click means where a point of one is lit up: what was hit, if that hangs on it, such as a finger on a
 * hand; else that one: the skin at an ankle is the shin's, and who sees the foot light up means the foot.
 */
export function meantJoint(skeleton: Skeleton, lit: number, hit: number): number {
  return hit >= lit && hit < compileSkeleton(skeleton).subtreeEnd[lit] ? hit : lit;
}
