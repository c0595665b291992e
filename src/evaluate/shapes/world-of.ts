/** Where a skeleton's joints are in a pose. */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../kinematics.ts';

/**
 * 16 numbers per joint.
 * @param values one per DOF; missing ones are 0
 */
export function worldOf(skeleton: Skeleton, values: ArrayLike<number>, clamps: boolean): Float64Array {
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(Math.max(values.length, compiled.firstDof[compiled.jointCount]));
  dofs.set(values);
  applyConstraints(compiled, dofs, clamps);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return world;
}
