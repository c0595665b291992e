/**
 * What a descent can't do by itself.
 *
 * A straight chain pulled along itself has no gradient: to bend it in any direction changes its length by nothing at
 * first. It is SHAKEN, once, a little, and what comes of it is kept only if it helps.
 *
 * Several pins have local minima, where a limb is on the wrong side of another. RESTARTS from poses further and further
 * from where it began find a way round. They jump, so they are for a click or a release, never for a drag.
 *
 * Both are the same for the same problem and pose: the numbers thrown come from a sequence (Weyl's), not from chance.
 */
import { length3 } from '../../math/vec3.ts';
import { aimDistance, evaluatePose, isThere } from './forward.ts';
import type { Descent, DescentOptions } from './levenberg.ts';
import { descend } from './levenberg.ts';
import type { IkProblem } from './state.ts';

/** Radians, reaches, factors. */
const SHAKE = 0.02;
/** A pin's slope beside what it would be if all its columns pointed along its error. */
const NO_SLOPE = 1e-3;
/** What does not solve it must leave so much less of the error to be worth a jump. */
const WORTH_A_JUMP = 0.8;

/** The fractional part of a multiple of the golden ratio: from 0 to 1, spread as evenly as can be. */
function thrown(index: number): number {
  const value = (index + 1) * 0.6180339887498949;
  return value - Math.floor(value);
}

/** Whether a pin is away from its aim and nothing that moves it brings it nearer. The Jacobian is that of the pose. */
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

/** Goes down from a pose near the one in `dofs`, and keeps what that comes to if it is nearer. */
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

/** Tries poses further and further away, until one leads there; else the best is kept. */
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

/** A value of an unknown's DOF up to half a turn, a reach or a half from its own, or anywhere between its limits. */
function throwNear({ variables }: IkProblem, v: number, value: number, far: number, index: number): number {
  const { lower, upper, scale } = variables;
  const width = Math.PI * scale[v];
  const low = Math.max(lower[v], value - width);
  const high = Math.min(upper[v], value + width);
  return within(value + far * (low + thrown(index) * (high - low) - value), lower[v], upper[v]);
}

/** To the best pose there was. */
function goBack(problem: IkProblem, dofs: Float64Array, { aim }: DescentOptions, descent: Descent): void {
  dofs.set(problem.scratch.bestPose);
  descent.error = evaluatePose(problem, dofs);
  descent.isThere = isThere(problem, aim);
}

function within(value: number, low: number, high: number): number {
  return value < low ? low : value > high ? high : value;
}
