/**
 * Levenberg–Marquardt (Levenberg 1944, Marquardt 1963): damped Gauss–Newton steps,
 *
 *     h = −(JᵀJ + λI)⁻¹·Jᵀe        λ = boost · (|e|² + 1e-6)
 *
 * With the error in the damping, steps are bold near the end and careful far from it (Sugihara 2011 also damps by the
 * error). The boost follows the gain ratio, actual over predicted decrease (Nielsen 1999): halved if the prediction was
 * right, doubled if not; a step that doesn't lower the error is undone. Of all steps with the same gain a damped one is
 * the shortest, so the pose changes little in directions that the pins leave free.
 *
 * Limits: a DOF at a limit whose gradient points outward is frozen for the step. One that would cross its limit moves
 * up to it, and the step is solved again for the others (an active set, as Baerlocher and Boulic 2004 do with
 * priorities). All evaluated poses are within the limits.
 */
import { evaluatePose, isThere } from './forward.ts';
import { writeJacobian } from './jacobian.ts';
import { solveDamped, solveThree, writeNormal } from './normal.ts';
import type { IkProblem } from './state.ts';

/** Largest rotation of a joint per step, in radians, and largest slide in reaches. */
const LONGEST_STEP = 1;
/** Maximum number of solves per step because of limits. */
const MAX_ROUNDS = 4;
/** The boost of the damping with which a descent starts. */
export const FIRST_BOOST = 0.1;
const MIN_BOOST = 1e-4;
/** Beyond this no step lowers the error, however short. */
const MAX_BOOST = 1e12;

/** The outcome of one descent, without unit. */
export interface Descent {
  /** Steps tried, including undone ones. */
  iterations: number;
  /** The sum of the squared errors. */
  error: number;
  isThere: boolean;
  /** It ended because no step predicted a gain; the Jacobian belongs to that pose. */
  isFlat: boolean;
}

/** When a descent ends. */
export interface DescentOptions {
  /** Fraction of the reach. */
  readonly aim: number;
  readonly iterations: number;
  /** Stops after three steps in a row that lower the error by less than this fraction. */
  readonly leastGain: number;
}

/**
 * Descends from the pose in `dofs`, in place; it must be within the limits. Afterwards the whole problem state belongs
 * to the pose in `dofs`.
 */
export function descend(problem: IkProblem, dofs: Float64Array, options: DescentOptions, out: Descent): void {
  descendFrom(problem, dofs, evaluatePose(problem, dofs), options, out);
}

/**
 * Descends like `descend`, from a pose that was already evaluated.
 * @param error the sum of its squared errors
 */
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
    // To first order, nothing is left to gain.
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

/** Marks the variables at a limit whose gradient points outward. */
export function freezeAtLimits(
  { variables, scratch, errors, jacobian, rows }: IkProblem,
  dofs: Float64Array,
  near = 0,
): void {
  const { count: n, dof, lower, upper, isLimited } = variables;
  const { held } = scratch;
  held.fill(0);
  if (!isLimited) return;
  for (let v = 0; v < n; v++) {
    const value = dofs[dof[v]];
    if (value > lower[v] + near && value < upper[v] - near) continue;
    let gradient = 0;
    for (let r = 0; r < rows; r++) gradient += jacobian[r * n + v] * errors[r];
    if (value <= lower[v] + near ? gradient > 0 : gradient < 0) held[v] = 1;
  }
}

/**
 * Writes the step at that damping to `scratch.step`, and the predicted errors to `scratch.expected`.
 * @param errors those to be removed; the Jacobian, `scratch.held` and `scratch.before` belong to the same pose
 * @param isFresh whether the Jacobian has changed since the last call
 * @returns the predicted sum of squared errors; NaN if there is no step at that damping
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
      // With limits, the last system may have had fewer columns.
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
  // No step; NaN asks for more damping.
  return isSolved ? promised : Number.NaN;
}

/** Shortens a step to the allowed maximum. @returns the fraction kept, 1 for all of it */
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

/** The columns of the variables that are not fixed, and 0 for the others, which then get no step. */
function withoutFixed(from: Float64Array, rows: number, n: number, fixed: Uint8Array, out: Float64Array): Float64Array {
  for (let r = 0; r < rows; r++) for (let v = 0; v < n; v++) out[r * n + v] = fixed[v] === 1 ? 0 : from[r * n + v];
  return out;
}

/** From the previous values of the variables, clamped to the limits against rounding. */
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
