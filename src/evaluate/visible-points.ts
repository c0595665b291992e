/** Which points of a capture are there. */
import type { CompiledSkeleton } from './kinematics.ts';

/**
 * Whether a point is there in a pose; between a frame where it is and one where it isn't, it isn't.
 * @param point index of its joint, one whose type is that of points
 */
export function isVisible({ firstDof }: CompiledSkeleton, point: number, dofs: ArrayLike<number>): boolean {
  return dofs[firstDof[point + 1] - 1] >= 1;
}
