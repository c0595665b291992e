/**
 * Inverse kinematics of a character: the pose in which its pins are at their targets, or as near as possible.
 *
 *     const problem = ikProblem(skeleton, pins, pose, { stiffness });
 *     movePin(problem, 0, x, y, z);
 *     solve(problem, dofs, 'drag');        whenever the hand moves, from the current pose
 *     solve(problem, dofs, 'rest');        where it stays: as exactly as possible, near the current pose
 *     solve(problem, dofs, 'exact');       once it is there: to the last digits
 *     solve(problem, dofs, 'settle');      on click or release: as exactly as possible, with restarts
 */
import { applyConstraints } from '../kinematics.ts';
import { stepForeseen } from './foresight.ts';
import { evaluatePose, isEvaluatedAt, isThere, orientationError, residual, writeErrors } from './forward.ts';
import { writeJacobian } from './jacobian.ts';
import { type Descent, type DescentOptions, descendFrom, freezeAtLimits } from './levenberg.ts';
import { aimPins } from './reach.ts';
import { isStraight, restart, shake } from './restarts.ts';
import type { IkProblem, IkResult } from './state.ts';

/** How thoroughly a problem is solved: while the hand moves, where it stays, to the last digits, or once with restarts. */
export type IkMode = 'drag' | 'rest' | 'exact' | 'settle';

interface ModeOptions extends DescentOptions {
  readonly restarts: number;
}

/** Radians, factors or lengths from a limit that count as at it. */
const ROUNDING = 1e-12;

/** Fraction of the reach: errors below this are not worth a restart and invisible on screen. */
const NEAR_ENOUGH = 1e-4;

const MODES: Readonly<Record<IkMode, ModeOptions>> = {
  // The next step continues where this one stops.
  drag: { aim: NEAR_ENOUGH, iterations: 24, leastGain: 1e-3, restarts: 0 },
  rest: { aim: NEAR_ENOUGH / 10, iterations: 60, leastGain: 1e-6, restarts: 0 },
  // What is nearly there takes a few steps more. A point that is dragged along an axis leaves it by less than one sees.
  exact: { aim: NEAR_ENOUGH / 1e5, iterations: 12, leastGain: 1e-1, restarts: 0 },
  settle: { aim: NEAR_ENOUGH / 10, iterations: 150, leastGain: 1e-5, restarts: 32 },
};

/** Scratch; never escapes. */
const descent: Descent = { iterations: 0, error: 0, isThere: false, isFlat: false };

/**
 * Moves the pose so that the pins are at their targets, or as near as possible.
 * @param dofs the character's DOFs, as many as in the problem's pose; free ones are moved in place, linked ones follow,
 * and if limits are enforced all are clamped first
 * @returns the problem's own result
 */
export function solve(problem: IkProblem, dofs: Float64Array, mode: IkMode): IkResult {
  const options = MODES[mode];
  applyConstraints(problem.skeleton, dofs, problem.clamps);
  if (!isEvaluatedAt(problem, dofs)) evaluatePose(problem, dofs);
  // The centres of the balls depend on the pose.
  aimPins(problem.balls, problem.pins, problem.slots);
  let error = writeErrors(problem);
  if (options.restarts > 0) {
    const { startPose } = problem.scratch;
    // Few numbers: faster than a call of `set`.
    for (let d = 0; d < startPose.length; d++) startPose[d] = dofs[d];
  }
  const { foresight } = problem;
  const foresees = mode === 'drag' && foresight.isMet && !isThere(problem, options.aim);
  if (foresees) error = stepForeseen(problem, dofs, error);
  descendFrom(problem, dofs, error, options, descent);
  if (foresees) descent.iterations++;
  if (!descent.isThere && descent.isFlat && isStraight(problem, options.aim)) shake(problem, dofs, options, descent);
  if (options.restarts > 0 && !isThere(problem, NEAR_ENOUGH))
    restart(problem, dofs, options, options.restarts, descent);
  foresight.isMet = descent.isThere && problem.variables.count > 0;
  // Linked DOFs outside the paths.
  if (problem.skeleton.couples.length > 0) applyConstraints(problem.skeleton, dofs, problem.clamps);
  return writeResult(problem, dofs, options.aim);
}

function writeResult(problem: IkProblem, dofs: Float64Array, aim: number): IkResult {
  const { pins, result, variables, reach } = problem;
  const { held } = problem.scratch;
  result.iterations = descent.iterations;
  result.isSolved = descent.isThere;
  for (let p = 0; p < pins.count; p++) {
    result.residuals[p] = residual(pins, p);
    result.turns[p] = pins.holdsOrientation[p] ? orientationError(pins, p) : 0;
    if (result.residuals[p] > aim * reach) result.isSolved = false;
  }
  result.bindingCount = 0;
  if (descent.isThere || !variables.isLimited) return result;
  writeJacobian(problem, dofs);
  // A step that ends at a limit may miss it by rounding.
  freezeAtLimits(problem, dofs, ROUNDING);
  for (let v = 0; v < variables.count; v++) if (held[v]) result.binding[result.bindingCount++] = variables.dof[v];
  return result;
}
