/**
 * Prediction that a drag learns from its last step: how far the errors deviated from the Jacobian's linear prediction.
 * Since a hand moves much as before, and the deviation is of second order in the step, the next step anticipates and
 * removes it:
 *
 *     e(φ + h) ≈ e + J·h + k²·bend        k: length of this error along the last one, relative to that one
 *
 * This is the tensor term of Schnabel and Frank (Tensor methods for nonlinear equations, 1984), for one previous step,
 * with its factor read from the errors. It costs nothing, and most steps of a drag then take one iteration. If the last
 * solve did not converge because of limits or pins, the errors are mostly irreducible and say nothing about the hand:
 * then nothing is anticipated.
 */
import { evaluatePose } from './forward.ts';
import { writeJacobian } from './jacobian.ts';
import { FIRST_BOOST, freezeAtLimits, takeStep, writeStep } from './levenberg.ts';
import type { IkProblem } from './state.ts';

/**
 * Steps that are longer than the last by more than this factor are not anticipated: the deviation grows with the
 * square.
 */
const MAX_STRETCH = 2;
/** Minimum cosine of the angle between two steps that count as the same direction; reversals count too. */
const MIN_ALONG = 0.7;

/**
 * The first step of a drag, from the pose last evaluated; changes nothing if it would not lower the error.
 * @param error sum of the squared errors of the pose
 * @returns that of the pose left in `dofs`
 */
export function stepForeseen(problem: IkProblem, dofs: Float64Array, error: number): number {
  const { foresight, errors, rows, variables, scratch } = problem;
  const { last, bend, foreseen } = foresight;
  const { before, expected } = scratch;
  const { count, dof } = variables;
  const part = stretchSquared(problem, error);
  for (let r = 0; r < rows; r++) {
    last[r] = errors[r];
    foreseen[r] = errors[r] + part * bend[r];
  }
  writeJacobian(problem, dofs);
  freezeAtLimits(problem, dofs);
  for (let v = 0; v < count; v++) before[v] = dofs[dof[v]];
  writeStep(problem, foreseen, FIRST_BOOST * (error + 1e-6), true);
  takeStep(problem, dofs);
  const next = evaluatePose(problem, dofs);
  if (next < error) {
    for (let r = 0; r < rows; r++) bend[r] = errors[r] - expected[r] + part * bend[r];
    return next;
  }
  // An undone step teaches nothing; clearing the last errors also disables the bend.
  for (let r = 0; r < rows; r++) last[r] = 0;
  for (let v = 0; v < count; v++) dofs[dof[v]] = before[v];
  return evaluatePose(problem, dofs);
}

/** Squared length of the errors along the last ones, relative to those; 0 if nothing is anticipated. */
function stretchSquared({ foresight, errors, rows }: IkProblem, error: number): number {
  const { last } = foresight;
  let along = 0;
  let square = 0;
  for (let r = 0; r < rows; r++) {
    along += errors[r] * last[r];
    square += last[r] * last[r];
  }
  if (!(along * along > MIN_ALONG * MIN_ALONG * square * error)) return 0;
  const stretch = along / square;
  return stretch * stretch <= MAX_STRETCH * MAX_STRETCH ? stretch * stretch : 0;
}
