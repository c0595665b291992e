/** Joints that take any rotation, by three Euler angles or a quaternion: the DOFs that give one, nearest to others. */
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { EulerOrder, Skeleton } from '../../model/skeleton/skeleton.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import { eulerDofs } from '../rotations/euler-dofs.ts';
import { writeAnglesNear } from '../rotations/euler-orders.ts';

/** A joint of the form T(t)·R with any rotation R. */
export interface TurnedJoint {
  /** Absent of quaternions. */
  readonly order: EulerOrder | undefined;
  /** The DOFs of the angles about x, y and z, or of the quaternion's x y z w. */
  readonly dofs: Int32Array;
}

/** The joint as one that takes any rotation; undefined if it doesn't. */
export function turnedJoint(skeleton: Skeleton, compiled: CompiledSkeleton, j: number): TurnedJoint | undefined {
  const { motion } = skeleton.joints[j];
  const first = compiled.firstDof[j];
  const parts = quaternionDofs(motion);
  if (parts.length === 4) return { order: undefined, dofs: Int32Array.from(parts, (dof) => first + dof) };
  const euler = eulerDofs(motion);
  if (!euler || compiled.turns[3 * j] < 0) return undefined;
  return { order: euler.order, dofs: Int32Array.of(first + euler.x, first + euler.y, first + euler.z) };
}

/** Scratch; never escapes. */
const quaternion = new Float64Array(4);
const angles = new Float64Array(3);

/** Replaces the joint's DOFs by the nearest ones that give a rotation of 9 numbers, column-major. */
export function turnJoint({ order, dofs }: TurnedJoint, rotation: Float64Array, pose: Float64Array): void {
  quaternionOfRotation(rotation, 0, quaternion);
  if (order) {
    for (let k = 0; k < 3; k++) angles[k] = pose[dofs[k]];
    writeAnglesNear(order, quaternion, angles);
    for (let k = 0; k < 3; k++) pose[dofs[k]] = angles[k];
    return;
  }
  let along = 0;
  for (let k = 0; k < 4; k++) along += quaternion[k] * pose[dofs[k]];
  // Both signs are the same rotation.
  const sign = along < 0 ? -1 : 1;
  for (let k = 0; k < 4; k++) pose[dofs[k]] = sign * quaternion[k];
}
