import { coupleOf } from '../../../model/skeleton/couples.ts';
import type { DofValue } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';

/** The DOFs that a solve has changed, without morphs and linked DOFs, whose values follow from others. */
export function changedValues(skeleton: Skeleton, before: Float64Array, now: Float64Array): DofValue[] {
  const { firstDof, jointCount } = compileSkeleton(skeleton);
  const changed: DofValue[] = [];
  const count = Math.min(firstDof[jointCount], now.length);
  for (let index = 0; index < count; index++) {
    if (now[index] !== before[index] && !coupleOf(skeleton, index)) changed.push({ index, value: now[index] });
  }
  return changed;
}
