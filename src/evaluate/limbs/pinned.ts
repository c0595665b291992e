/**
 * A limb of other joints, or one that meets its limits, by the solver of pins (`ik/`): its joints move, all others are
 * locked, within the limits.
 */
import { quaternionOfRotation } from '../../math/quaternion.ts';
import type { Limb } from '../../model/limbs.ts';
import { restPose } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { ikStiffness } from '../ik/pins.ts';
import { ikProblem, movePin, turnPin } from '../ik/problem.ts';
import { solve } from '../ik/solve.ts';
import type { IkProblem } from '../ik/state.ts';
import { compileSkeleton } from '../kinematics.ts';

/** The IK problem of a limb, for any pose and time: it depends on the skeleton only. */
export interface PinnedLimb {
  readonly problem: IkProblem;
  /** Scratch for the DOFs of the skeleton: a pose may have more, of morphs. */
  readonly pose: Float64Array;
}

/** Makes the IK problem of a limb. */
export function pinnedLimb({ joints, tip, orient }: Limb, skeleton: Skeleton, clamps: boolean): PinnedLimb {
  const { firstDof } = compileSkeleton(skeleton);
  const stiffness = new Float64Array(firstDof[skeleton.joints.length]).fill(Infinity);
  const free = ikStiffness(skeleton, true);
  for (const joint of joints) {
    for (let dof = firstDof[joint]; dof < firstDof[joint + 1]; dof++) stiffness[dof] = free[dof];
  }
  const pin = { joint: joints[joints.length - 1], point: tip, target: [0, 0, 0] as const };
  const pins = [orient ? { ...pin, orientation: [0, 0, 0, 1] as const } : pin];
  const pose = Float64Array.from(restPose(skeleton, 0));
  return { problem: ikProblem(skeleton, pins, pose, { clamps, stiffness }), pose };
}

/** Scratch; never escapes. */
const quaternion = new Float64Array(4);

/**
 * Moves the limb's DOFs from the pose given to the target, or as near as possible.
 * @param turn the last joint's rotation, 9 numbers; used if the limb takes it
 * @param restarts whether other starts are tried if this one leads to no solution
 */
export function solvePinned(
  { problem, pose }: PinnedLimb,
  point: Float64Array,
  turn: Float64Array,
  dofs: Float64Array,
  restarts: boolean,
): void {
  movePin(problem, 0, point[0], point[1], point[2]);
  quaternionOfRotation(turn, 0, quaternion);
  turnPin(problem, 0, quaternion);
  for (let d = 0; d < pose.length; d++) pose[d] = dofs[d];
  const { isSolved } = solve(problem, pose, 'rest');
  if (!isSolved && restarts) solve(problem, pose, 'settle');
  solve(problem, pose, 'exact');
  for (let d = 0; d < pose.length; d++) dofs[d] = pose[d];
}
