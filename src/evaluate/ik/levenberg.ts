/**
 * Levenberg–Marquardt (Levenberg 1944, Marquardt 1963): damped Gauss–Newton steps,
 *
 *     h = −(JᵀJ + λI)⁻¹·Jᵀe        λ = boost · (|e|² + 1e-6)
 *
 * The error itself in the damping makes steps bold near the end and careful far from it (Sugihara 2011 damps by the
 * error too). The boost follows the gain ratio, what a step won beside what it promised (Nielsen 1999): halved where
 * the promise was kept, doubled where it was not; a step that doesn't lower the error is undone. Of all steps that win
 * as much, a damped one is the shortest, so the pose stays near where it was in what the pins leave free.
 *
 * Limits: a DOF at its limit whose gradient pushes outward is frozen for the step; one that would cross its limit goes
 * as far as that, and the step is solved again for the others (an active set; Baerlocher and Boulic 2004 do so with
 * priorities). No pose that is looked at is outside the limits.
 */
import { evaluatePose, isThere } from './forward.ts';
import { writeJacobian } from './jacobian.ts';
import { solveDamped, solveThree, writeNormal } from './normal.ts';
import type { IkProblem } from './state.ts';

/** No step turns a joint further: radians, and as many reaches. */
const LONGEST_STEP = 1;
/** How often a step is solved again because of limits that it would cross. */
const MAX_ROUNDS = 4;
export const FIRST_BOOST = 0.1;
const MIN_BOOST = 1e-4;
/** Past that, no step however short lowers the error. */
const MAX_BOOST = 1e12;

export interface Descent {
  /** Steps tried, those undone too. */
  iterations: number;
  /** The sum of the squared errors. */
  error: number;
  isThere: boolean;
  /** It ended where no step promised anything: the Jacobian is of that pose. */
  isFlat: boolean;
}

export interface DescentOptions {
  /** Part of the reach. */
  readonly aim: number;
  readonly iterations: number;
  /** Ends where steps lower the error by less than that part, three times in a row. */
  readonly leastGain: number;
}

/**
 * Goes down from the pose in `dofs`, in place; it must be within the limits. Afterwards everything of the problem is of
 * the pose left in `dofs`.
 */
export function descend(problem: IkProblem, dofs: Float64Array, options: DescentOptions, out: Descent): void {
  descendFrom(problem, dofs, evaluatePose(problem, dofs), options, out);
}

/** The same where the pose was looked at already. @param error the sum of its squared errors */
export function descendFrom(
  problem: IkProblem,
  dofs: Float64Array,
  error: number,
  options: DescentOptions,
  out: Descent,
): void {
  const { variables, scratch, errors, rows } = problem;
  const { before, errorsBefore } = scratch;
  const n = variables.count;
  let boost = FIRST_BOOST;
  let idle = 0;
  let isFresh = true;
  out.iterations = 0;
  out.isFlat = false;
  out.isThere = isThere(problem, options.aim);
  while (!out.isThere && out.iterations < options.iterations && n > 0) {
    if (isFresh) {
      writeJacobian(problem, dofs);
      freezeAtLimits(problem, dofs);
      for (let v = 0; v < n; v++) before[v] = dofs[variables.dof[v]];
      for (let r = 0; r < rows; r++) errorsBefore[r] = errors[r];
    }
    const promised = writeStep(problem, errorsBefore, boost * (error + 1e-6), isFresh);
    // Nothing left to gain, as far as the slope can tell.
    if (error - promised <= 1e-12 * error) {
      out.isFlat = true;
      break;
    }
    takeStep(problem, dofs);
    const next = evaluatePose(problem, dofs);
    out.iterations++;
    if (next < error) {
      const gain = (error - next) / (error - promised);
      if (gain > 0.75) boost = Math.max(MIN_BOOST, boost / 2);
      else if (gain < 0.25) boost *= 2;
      idle = error - next < options.leastGain * error ? idle + 1 : 0;
      error = next;
      isFresh = true;
      out.isThere = isThere(problem, options.aim);
      if (idle >= 3) break;
    } else {
      for (let v = 0; v < n; v++) dofs[variables.dof[v]] = before[v];
      for (let r = 0; r < rows; r++) errors[r] = errorsBefore[r];
      boost *= 4;
      isFresh = false;
      if (!(boost < MAX_BOOST)) break;
    }
  }
  if (!isFresh) error = evaluatePose(problem, dofs);
  out.error = error;
}

/** Marks the unknowns that stand at a limit and would go on outward. */
export function freezeAtLimits({ variables, scratch, errors, jacobian, rows }: IkProblem, dofs: Float64Array): void {
  const { count: n, dof, lower, upper, isLimited } = variables;
  const { held } = scratch;
  held.fill(0);
  if (!isLimited) return;
  for (let v = 0; v < n; v++) {
    const value = dofs[dof[v]];
    if (value > lower[v] && value < upper[v]) continue;
    let gradient = 0;
    for (let r = 0; r < rows; r++) gradient += jacobian[r * n + v] * errors[r];
    if (value <= lower[v] ? gradient > 0 : gradient < 0) held[v] = 1;
  }
}

/**
 * The step at that damping, to `scratch.step`, and the errors that it should come to, to `scratch.expected`.
 * @param errors those that it should take away; the Jacobian, `scratch.held` and `scratch.before` are of the same pose
 * @param isFresh whether the Jacobian is another than the last time
 * @returns the sum of squared errors that it promises; NaN where there is no step at that damping
 */
export function writeStep(problem: IkProblem, errors: Float64Array, damping: number, isFresh: boolean): number {
  const { variables, scratch, shape, jacobian, rows } = problem;
  const { held, fixed, fixedStep, freeColumns, rest, normal, factor, solution, step, expected, before } = scratch;
  const { count: n, lower, upper, scale, relative, isLimited } = variables;
  let columns = jacobian;
  for (let r = 0; r < rows; r++) rest[r] = errors[r];
  if (isLimited) {
    let count = 0;
    for (let v = 0; v < n; v++) {
      fixed[v] = held[v];
      fixedStep[v] = 0;
      count += held[v];
    }
    if (count > 0) columns = withoutFixed(jacobian, rows, n, fixed, freeColumns);
  }
  let isSolved = false;
  for (let round = 1; ; round++) {
    if (rows === 3 && n >= 3) isSolved = solveThree(columns, n, rest, damping, solution, step);
    else {
      // With limits the last one may have been of fewer.
      if (isFresh || isLimited) writeNormal(columns, rows, n, shape, normal);
      isSolved = solveDamped(columns, rows, n, shape, rest, normal, damping, factor, solution, step);
    }
    if (!isSolved) step.fill(0);
    if (!isLimited) break;
    let shortest = 1;
    for (let v = 0; v < n; v++) shortest = Math.min(shortest, LONGEST_STEP / Math.abs(step[v] * relative[v]));
    let crossed = 0;
    for (let v = 0; v < n && round < MAX_ROUNDS; v++) {
      if (fixed[v] === 1) continue;
      const value = before[v] + shortest * step[v] * scale[v];
      if (value >= lower[v] && value <= upper[v]) continue;
      crossed++;
      fixed[v] = 1;
      fixedStep[v] = ((value < lower[v] ? lower[v] : upper[v]) - before[v]) / scale[v];
      for (let r = 0; r < rows; r++) rest[r] += jacobian[r * n + v] * fixedStep[v];
    }
    if (crossed === 0) break;
    columns = withoutFixed(jacobian, rows, n, fixed, freeColumns);
  }
  if (columns !== jacobian) for (let v = 0; v < n; v++) if (fixed[v] === 1) step[v] = fixedStep[v];
  const part = shorten(problem);
  const isPlain = isSolved && columns === jacobian && rows <= n;
  let promised = 0;
  for (let r = 0; r < rows; r++) {
    let e = errors[r];
    // e + J·h is λ·z.
    if (isPlain) e += part * (damping * solution[r] - e);
    else for (let v = 0; v < n; v++) e += jacobian[r * n + v] * step[v];
    expected[r] = e;
    promised += e * e;
  }
  // No step, which promises nothing but a try with more damping.
  return isSolved ? promised : Number.NaN;
}

/** Makes a step none of whose parts is longer than is allowed. @returns the part of it that is left, 1 for all */
function shorten({ variables, scratch }: IkProblem): number {
  const { count, relative } = variables;
  const { step } = scratch;
  let longest = 0;
  for (let v = 0; v < count; v++) {
    const size = Math.abs(step[v] * relative[v]);
    if (size > longest) longest = size;
  }
  if (!(longest > LONGEST_STEP)) return 1;
  const part = LONGEST_STEP / longest;
  for (let v = 0; v < count; v++) step[v] *= part;
  return part;
}

/** The columns of the unknowns that are not fixed, and 0 for the others: those then have no step. */
function withoutFixed(from: Float64Array, rows: number, n: number, fixed: Uint8Array, out: Float64Array): Float64Array {
  for (let r = 0; r < rows; r++) for (let v = 0; v < n; v++) out[r * n + v] = fixed[v] === 1 ? 0 : from[r * n + v];
  return out;
}

/** From where the unknowns were, within the limits whatever rounding does. */
export function takeStep({ variables, scratch }: IkProblem, dofs: Float64Array): void {
  const { count, dof, scale, lower, upper, hasLimits } = variables;
  const { before, step } = scratch;
  if (!hasLimits) {
    for (let v = 0; v < count; v++) dofs[dof[v]] = before[v] + step[v] * scale[v];
    return;
  }
  for (let v = 0; v < count; v++) {
    const value = before[v] + step[v] * scale[v];
    dofs[dof[v]] = value < lower[v] ? lower[v] : value > upper[v] ? upper[v] : value;
  }
}
