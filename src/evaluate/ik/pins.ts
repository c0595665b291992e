/**
 * What inverse kinematics is asked for: points of joints that are to be somewhere, and which DOFs may move for it.
 * What is given by people is checked here, once; the solver trusts its numbers.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { dofsOf, positionsOf } from '../../model/joint-types.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { type CompiledSkeleton, compileSkeleton } from '../kinematics.ts';

/** A unit quaternion, x y z w. */
export type Turn = readonly [number, number, number, number];

export interface IkPin {
  /** Index of the joint. */
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** Where it should be, in the space of the world matrices. */
  readonly target: Vec3;
  /** How the joint's axes should stand there (`orientationAt`); of any length but 0. Absent where they are free. */
  readonly orientation?: Turn;
  /** How much its error counts beside the others', 1 if absent; more than 0. */
  readonly weight?: number;
  /** It stays while another is dragged: what can't be had both is lost by the one that is dragged. */
  readonly holds?: boolean;
}

export interface IkOptions {
  /** Whether joint limits hold; they do if absent. Couples always do. */
  readonly clamps?: boolean;
  /** How unwilling each of the character's DOFs is to move (`ikStiffness`, which is what holds if absent). */
  readonly stiffness?: ArrayLike<number>;
}

/** Weighs the error of a pin that holds beside that of one that is dragged. */
export const HOLDING_WEIGHT = 10;

/** What pins can't be: said for programs, since people can't give a pin without having seen where it is. */
export class IkError extends Error {
  override readonly name = 'IkError';
}

/**
 * How unwilling each DOF is to move: 1 as usual, 4 half as far for the same need, Infinity never. A value for each of
 * the character's DOFs but the morphs'.
 *
 * Never, by itself: what carries the character, unless it may (`freeRoot`), and the positions of BVH joints, which are
 * the lengths of bones. A caller locks or stiffens more by writing to the result.
 */
export function ikStiffness(skeleton: Skeleton, freeRoot: boolean): Float64Array {
  const { firstDof, travel, jointCount } = compileSkeleton(skeleton);
  const stiffness = new Float64Array(firstDof[jointCount]).fill(1);
  skeleton.joints.forEach(({ motion }, j) => {
    if (!positionsOf(motion)) return;
    dofsOf(motion).forEach(({ unit }, k) => {
      if (unit === 'length') stiffness[firstDof[j] + k] = Infinity;
    });
  });
  for (const dof of travel) stiffness[dof] = freeRoot ? 1 : Infinity;
  return stiffness;
}

/** @throws IkError */
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
