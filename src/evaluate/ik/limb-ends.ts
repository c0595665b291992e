/**
 * Which joint is posed by dragging another one: hands, feet and heads with all that is on them, and what ends any other
 * limb, such as an insect's legs and a tail.
 */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { compileSkeleton } from '../kinematics.ts';
import { LIMB_SIDES, partsOf, type Role } from '../retarget/roles.ts';
import { limbOf } from './limb.ts';

const ENDS: readonly Role[] = ['head', ...LIMB_SIDES.flatMap((side) => [`${side} hand`, `${side} foot`] as const)];

/**
 * For each joint the end that it belongs to; -1 for those between ends, such as a chest or a shin. Fingers belong to
 * their hand, and ears to their head.
 *
 * @param up by which parts of the body are recognised without names; default y
 */
export function limbEnds(skeleton: Skeleton, up?: Space['up']): Int32Array {
  const { subtreeEnd, jointCount } = compileSkeleton(skeleton);
  const ends = new Int32Array(jointCount).fill(-1);
  const { single } = partsOf(skeleton, up);
  for (const role of ENDS) {
    const end = single.get(role);
    if (end !== undefined && limbOf(skeleton, end) !== 'body') ends.fill(end, end, subtreeEnd[end]);
  }
  for (let j = 0; j < jointCount; j++) {
    const isTip = subtreeEnd[j] === j + 1;
    if (isTip && ends[j] < 0 && limbOf(skeleton, j) !== 'body') ends[j] = j;
  }
  return ends;
}
