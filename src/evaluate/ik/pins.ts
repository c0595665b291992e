/**
 * The input of inverse kinematics: points of joints with targets, and the DOFs that may move. User input is validated
 * here, once; the solver trusts its numbers.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { dofsOf, isOfAcclaim, positionsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type CompiledSkeleton, compileSkeleton } from '../kinematics.ts';

/** A unit quaternion, x y z w. */
export type Turn = readonly [number, number, number, number];

/** A point of a joint, and its target. */
export interface IkPin {
  /** Index of the joint. */
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** Target position, in the space of the world matrices. */
  readonly target: Vec3;
  /** Target orientation of the joint's axes (`orientationAt`); of any length but 0. Absent if free. */
  readonly orientation?: Turn;
  /** Weight of its error relative to the others; greater than 0, default 1. */
  readonly weight?: number;
  /** Whether it holds while another pin is dragged: if both can't be satisfied, the dragged one gives way. */
  readonly holds?: boolean;
}

/** Options of an IK problem. */
export interface IkOptions {
  /** Whether joint limits are enforced, true by default. Linked DOFs always are. */
  readonly clamps?: boolean;
  /** Stiffness of each of the character's DOFs; default `ikStiffness`. */
  readonly stiffness?: ArrayLike<number>;
}

/** Weight of holding pins relative to dragged ones. */
export const HOLDING_WEIGHT = 10;

/** Invalid pins. The message is for programmers: users can only pin points that they see. */
export class IkError extends Error {
  override readonly name = 'IkError';
}

/**
 * The stiffness of each DOF: 1 by default, 4 moves half as far for the same error, Infinity never moves. A value for
 * each of the character's DOFs except morphs.
 *
 * By default locked: root translation, unless allowed (`freeRoot`), and the positions of captured joints, which are
 * bone lengths. Callers lock or stiffen more by writing to the result.
 */
export function ikStiffness(skeleton: Skeleton, freeRoot: boolean): Float64Array {
  const { firstDof, travel, jointCount } = compileSkeleton(skeleton);
  const stiffness = new Float64Array(firstDof[jointCount]).fill(1);
  skeleton.joints.forEach(({ motion }, j) => {
    if (!positionsOf(motion) && !isOfAcclaim(motion)) return;
    dofsOf(motion).forEach(({ unit }, k) => {
      if (unit === 'length') stiffness[firstDof[j] + k] = Infinity;
    });
  });
  for (const dof of travel) stiffness[dof] = freeRoot ? 1 : Infinity;
  return stiffness;
}

/**
 * Checks that the joints of pins exist, and that their numbers are valid.
 * @throws IkError
 */
export function checkPins(skeleton: CompiledSkeleton, pins: readonly IkPin[]): void {
  pins.forEach(({ joint, point, target, orientation, weight = 1 }, p) => {
    if (!(Number.isInteger(joint) && joint >= 0 && joint < skeleton.jointCount))
      throw new IkError(`Pin ${p} is on joint ${joint}; there are ${skeleton.jointCount} joints.`);
    if (!point.every(Number.isFinite)) throw new IkError(`Pin ${p} holds a point that is not finite: ${point}.`);
    if (!target.every(Number.isFinite)) throw new IkError(`Pin ${p} has a target that is not finite: ${target}.`);
    if (orientation && !(orientation.every(Number.isFinite) && orientation.some((part) => part !== 0)))
      throw new IkError(`Pin ${p} has an invalid orientation: ${orientation}.`);
    if (!(weight > 0 && weight < Infinity)) throw new IkError(`Pin ${p} has the weight ${weight}.`);
  });
}
