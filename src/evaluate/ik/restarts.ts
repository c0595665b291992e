/**
 * Remedies for what a descent can't solve.
 *
 * A straight chain compressed along itself has no gradient: to first order, bending it in any direction does not change
 * its length. It is SHAKEN once, a little, and the result is kept only if it helps.
 *
 * Several pins have local minima, with one limb on the wrong side of another. RESTARTS from increasingly distant poses
 * find a way around. They make the pose jump, so they are for clicks and releases, never during a drag.
 *
 * Both are deterministic: the pseudo-random numbers come from a Weyl sequence.
 */
import { length3 } from '../../math/vec3.ts';
import { aimDistance, evaluatePose, isThere } from './forward.ts';
import type { Descent, DescentOptions } from './levenberg.ts';
import { descend } from './levenberg.ts';
import type { IkProblem } from './state.ts';

/** Radians, reaches, factors. */
const SHAKE = 0.02;
/** A pin's slope relative to what it would be if all its columns pointed along its error. */
const NO_SLOPE = 1e-3;
/** A restart that doesn't solve the problem must reduce the error to this fraction to be worth a jump. */
const WORTH_A_JUMP = 0.8;

/** The fractional part of a multiple of the golden ratio: from 0 to 1, spread as evenly as possible. */
function thrown(index: number): number {
  const value = (index + 1) * 0.6180339887498949;
  return value - Math.floor(value);
}

/** Whether a pin is off its aim and no variable brings it nearer. The Jacobian must be that of the pose. */
export function isStraight({ pins, variables, jacobian, errors, reach }: IkProblem, aim: number): boolean {
  const n = variables.count;
  for (let p = 0; p < pins.count; p++) {
    if (aimDistance(pins, p) <= aim * reach) continue;
    const r = pins.row[p];
    const size = length3(errors[r], errors[r + 1], errors[r + 2]);
    let slope = 0;
    let most = 0;
    for (let v = 0; v < n; v++) {
      const a = jacobian[r * n + v];
      const b = jacobian[(r + 1) * n + v];
      const c = jacobian[(r + 2) * n + v];
      const along = (a * errors[r] + b * errors[r + 1] + c * errors[r + 2]) / size;
      slope += along * along;
      most += a * a + b * b + c * c;
    }
    if (most > 0 && slope <= NO_SLOPE * NO_SLOPE * most) return true;
  }
  return false;
}

/** Descends from a pose near the one in `dofs`, and keeps the result if it is nearer. */
export function shake(problem: IkProblem, dofs: Float64Array, options: DescentOptions, descent: Descent): void {
  const { variables, scratch } = problem;
  const { count, dof, scale, lower, upper } = variables;
  const { bestPose } = scratch;
  bestPose.set(dofs);
  const { error, iterations } = descent;
  for (let v = 0; v < count; v++) {
    const sign = thrown(v) < 0.5 ? -1 : 1;
    dofs[dof[v]] = within(dofs[dof[v]] + sign * SHAKE * scale[v], lower[v], upper[v]);
  }
  descend(problem, dofs, options, descent);
  descent.iterations += iterations;
  if (descent.isThere || descent.error < WORTH_A_JUMP * error) return;
  goBack(problem, dofs, options, descent);
}

/** Tries increasingly distant poses until one solves the problem; otherwise keeps the best. */
export function restart(
  problem: IkProblem,
  dofs: Float64Array,
  options: DescentOptions,
  restarts: number,
  descent: Descent,
): void {
  const { variables, scratch } = problem;
  const { count, dof } = variables;
  const { bestPose, startPose } = scratch;
  let best = descent.error;
  let iterations = descent.iterations;
  bestPose.set(dofs);
  for (let i = 0; i < restarts; i++) {
    dofs.set(startPose);
    const far = Math.min(1, (i + 1) / 8);
    for (let v = 0; v < count; v++) dofs[dof[v]] = throwNear(problem, v, dofs[dof[v]], far, i * count + v);
    descend(problem, dofs, options, descent);
    iterations += descent.iterations;
    descent.iterations = iterations;
    if (descent.isThere) return;
    if (descent.error < WORTH_A_JUMP * best) {
      best = descent.error;
      bestPose.set(dofs);
    }
  }
  goBack(problem, dofs, options, descent);
}

/**
 * A pseudo-random value within half a turn (or π reaches or factors) of the current one and within the limits; `far`
 * scales the distance.
 */
function throwNear({ variables }: IkProblem, v: number, value: number, far: number, index: number): number {
  const { lower, upper, scale } = variables;
  const width = Math.PI * scale[v];
  const low = Math.max(lower[v], value - width);
  const high = Math.min(upper[v], value + width);
  return within(value + far * (low + thrown(index) * (high - low) - value), lower[v], upper[v]);
}

/** Back to the best pose so far. */
function goBack(problem: IkProblem, dofs: Float64Array, { aim }: DescentOptions, descent: Descent): void {
  dofs.set(problem.scratch.bestPose);
  descent.error = evaluatePose(problem, dofs);
  descent.isThere = isThere(problem, aim);
}

function within(value: number, low: number, high: number): number {
  return value < low ? low : value > high ? high : value;
}
