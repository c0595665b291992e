/**
 * The direction back to another pose that moves no pin: the part of the difference d that the pins leave free,
 *
 *     h = d − Jᵀ·(J·Jᵀ + λI)⁻¹·J·d
 *
 * the projection onto the null space of the Jacobian (Liégeois 1977), slightly damped. A DOF at a limit that h would
 * cross is removed and the rest is projected again. To first order this moves no pin; `solve` corrects the remainder.
 */
import { writeJacobian } from './jacobian.ts';
import { solveDamped, systemSize, writeNormal } from './normal.ts';
import type { IkProblem } from './state.ts';

/** Relative to the mean of the diagonal. With less, directions in which nothing can move would be divided by zero. */
const DAMPING = 1e-7;
/** Maximum number of projections because of limits. */
const MAX_ROUNDS = 3;

/**
 * Writes h to `problem.scratch.step`, in solver variables. `dofs` must be the pose last evaluated.
 * @param home the character's DOFs to approach
 * @returns the largest change of a variable: radians, factors, fractions of the reach; 0 if there is none
 */
export function writeWayHome(problem: IkProblem, dofs: Float64Array, home: ArrayLike<number>): number {
  const { variables, scratch, jacobian, rows } = problem;
  const { count: n, dof, scale, relative, lower, upper } = variables;
  const { step, held, fixedStep: way, freeColumns, rest, normal, factor, solution } = scratch;
  if (n === 0) return 0;
  writeJacobian(problem, dofs);
  held.fill(0);
  for (let round = 0; ; round++) {
    for (let v = 0; v < n; v++) way[v] = held[v] ? 0 : (home[dof[v]] - dofs[dof[v]]) / scale[v];
    for (let r = 0; r < rows; r++) {
      let sum = 0;
      for (let v = 0; v < n; v++) {
        const j = held[v] ? 0 : jacobian[r * n + v];
        freeColumns[r * n + v] = j;
        sum += j * way[v];
      }
      rest[r] = sum;
    }
    writeNormal(freeColumns, rows, n, problem.shape, normal);
    const size = systemSize(rows, n);
    let trace = 0;
    for (let i = 0; i < size; i++) trace += normal[i * size + i];
    const damping = DAMPING * (trace / Math.min(rows, n)) + 1e-300;
    // The step that cancels what d does to the pins.
    if (!solveDamped(freeColumns, rows, n, problem.shape, rest, normal, damping, factor, solution, step)) return 0;
    let isFree = true;
    for (let v = 0; v < n; v++) {
      step[v] += way[v];
      if (held[v]) {
        step[v] = 0;
        continue;
      }
      const value = dofs[dof[v]];
      const pressed = (value <= lower[v] && step[v] < 0) || (value >= upper[v] && step[v] > 0);
      if (!pressed || round >= MAX_ROUNDS) continue;
      held[v] = 1;
      isFree = false;
    }
    if (isFree) break;
  }
  let most = 0;
  for (let v = 0; v < n; v++) most = Math.max(most, Math.abs(step[v] * relative[v]));
  return most;
}

/** Applies that fraction of the step from `writeWayHome`, within the limits. */
export function stepHome({ variables, scratch }: IkProblem, dofs: Float64Array, part: number): void {
  const { count: n, dof, scale, lower, upper } = variables;
  for (let v = 0; v < n; v++) {
    const value = dofs[dof[v]] + part * scratch.step[v] * scale[v];
    dofs[dof[v]] = Math.min(upper[v], Math.max(lower[v], value));
  }
}
