/**
 * Finds the DOFs that bring a joint's own matrix J(φ) as close to a wanted one as its type and limits allow:
 *
 *     minimise  |A(φ) − A|² + |t(φ) − t|² / size²        A: the 3×3 part, t: the pivot's position
 *
 * by Levenberg–Marquardt with the joint's derivatives (damping by Nielsen's rule, 1999), holding DOFs at limits that
 * they push against. From several starting values, since angles have several local minima.
 */
import type { JointMotion } from '../../evaluate/motions/motion.ts';

const MAX_STEPS = 60;
const DONE = 1e-28;
const MAX_DAMPING = 1e12;
/** A result must be better by this fraction; otherwise the earlier one is kept. */
const BETTER = 1e-9;

/** The matrix that a joint should have, and the values that its DOFs may take. */
export interface LocalFit {
  readonly motion: JointMotion;
  /** Index into `dofs`. */
  readonly first: number;
  readonly count: number;
  /** The wanted J, 16 numbers. */
  readonly wanted: Float64Array;
  /** One per DOF; infinite without limits, and equal for a fixed DOF. */
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** Unit for lengths. */
  readonly size: number;
}

/**
 * Writes the joint's DOFs to `dofs`.
 * @param beginnings starting values, one per DOF each, at least one set; clamped to the limits first
 * @returns the remaining sum of squares
 */
export function fitLocal(fit: LocalFit, beginnings: readonly ArrayLike<number>[], dofs: Float64Array): number {
  const { first, count, lower, upper } = fit;
  let best = Infinity;
  let values: number[] = [];
  for (const beginning of beginnings) {
    for (let d = 0; d < count; d++) dofs[first + d] = Math.min(upper[d], Math.max(lower[d], beginning[d]));
    const error = descend(fit, dofs);
    if (error < best - BETTER * Math.max(best, DONE) || values.length === 0) {
      best = error;
      values = Array.from(dofs.subarray(first, first + count));
    }
    if (best <= DONE) break;
  }
  dofs.set(values, first);
  return best;
}

/** Scratch; never escapes. */
const matrix = new Float64Array(16);
const ROWS = 12;

function errorsAt({ motion, first, wanted, size }: LocalFit, dofs: Float64Array, out: Float64Array): number {
  motion.write(dofs, first, matrix, 0);
  let sum = 0;
  for (let row = 0; row < ROWS; row++) {
    const at = row + Math.floor(row / 3);
    const e = (matrix[at] - wanted[at]) / (row < 9 ? 1 : size);
    out[row] = e;
    sum += e * e;
  }
  return sum;
}

function descend(fit: LocalFit, dofs: Float64Array): number {
  const { motion, first, count, lower, upper, size } = fit;
  const errors = new Float64Array(ROWS);
  const tried = new Float64Array(ROWS);
  const jacobian = new Float64Array(ROWS * count);
  const gradient = new Float64Array(count);
  const before = new Float64Array(count);
  const normal = new Float64Array(count * count);
  const step = new Float64Array(count);
  let error = errorsAt(fit, dofs, errors);
  let damping = 1e-3;
  let growth = 2;
  for (let n = 0; n < MAX_STEPS && error > DONE && damping < MAX_DAMPING; n++) {
    for (let d = 0; d < count; d++) {
      motion.writeDerivative(dofs, first, d, matrix, 0);
      gradient[d] = 0;
      for (let row = 0; row < ROWS; row++) {
        const slope = matrix[row + Math.floor(row / 3)] / (row < 9 ? 1 : size);
        jacobian[row * count + d] = slope;
        gradient[d] += slope * errors[row];
      }
    }
    const isFree = (d: number) => {
      const value = dofs[first + d];
      if (lower[d] >= upper[d]) return false;
      return !((value <= lower[d] && gradient[d] > 0) || (value >= upper[d] && gradient[d] < 0));
    };
    const free = Array.from({ length: count }, (_, d) => d).filter(isFree);
    // Down to the limit of precision, so that a pose mirrored twice is unchanged.
    if (free.every((d) => Math.abs(gradient[d]) < 1e-17)) break;
    for (let d = 0; d < count; d++) before[d] = dofs[first + d];
    let isLower = false;
    while (!isLower && damping < MAX_DAMPING) {
      const predicted = solve(jacobian, gradient, free, count, damping, normal, step);
      free.forEach((d, i) => {
        dofs[first + d] = Math.min(upper[d], Math.max(lower[d], before[d] + step[i]));
      });
      const next = errorsAt(fit, dofs, tried);
      if (next < error) {
        const gain = (error - next) / (predicted || 1);
        damping = Math.max(1e-15, damping * Math.max(0.1, 1 - (2 * gain - 1) ** 3));
        growth = 2;
        error = next;
        errors.set(tried);
        isLower = true;
      } else {
        for (let d = 0; d < count; d++) dofs[first + d] = before[d];
        damping *= growth;
        growth *= 2;
      }
    }
    if (!isLower) break;
  }
  return error;
}

/** h = −(JᵀJ + λI)⁻¹·g over the free DOFs, by Cholesky. @returns the predicted decrease */
function solve(
  jacobian: Float64Array,
  gradient: Float64Array,
  free: readonly number[],
  count: number,
  damping: number,
  l: Float64Array,
  step: Float64Array,
): number {
  const n = free.length;
  for (let i = 0; i < n; i++) {
    for (let k = 0; k <= i; k++) {
      let sum = i === k ? damping : 0;
      for (let row = 0; row < ROWS; row++) sum += jacobian[row * count + free[i]] * jacobian[row * count + free[k]];
      for (let m = 0; m < k; m++) sum -= l[i * n + m] * l[k * n + m];
      l[i * n + k] = i === k ? Math.sqrt(Math.max(sum, Number.MIN_VALUE)) : sum / l[k * n + k];
    }
  }
  for (let i = 0; i < n; i++) {
    let sum = -gradient[free[i]];
    for (let m = 0; m < i; m++) sum -= l[i * n + m] * step[m];
    step[i] = sum / l[i * n + i];
  }
  for (let i = n - 1; i >= 0; i--) {
    let sum = step[i];
    for (let m = i + 1; m < n; m++) sum -= l[m * n + i] * step[m];
    step[i] = sum / l[i * n + i];
  }
  let promised = 0;
  for (let i = 0; i < n; i++) promised += step[i] * (damping * step[i] - gradient[free[i]]);
  return promised;
}
