/**
 * What a drag knows from its last step: how far the errors came out beside the straight line that the Jacobian drew.
 * A hand goes on much as it went, and that miss is of the second order in the step, so the next step is told of it
 * beforehand and takes it away with the rest:
 *
 *     e(φ + h) ≈ e + J·h + k²·bend        k: how long this error is along the last one, beside that one
 *
 * That is the tensor term of Schnabel and Frank (Tensor methods for nonlinear equations, 1984), of one step back and
 * with what it is multiplied by read off the errors. It costs nothing, and most steps of a drag then take one iteration.
 * Where the last solution didn't come there, because of limits or pins that hold, the errors are mostly such as no step
 * takes away, and say nothing of the hand: nothing is foreseen then.
 */
import { evaluatePose } from './forward.ts';
import { writeJacobian } from './jacobian.ts';
import { FIRST_BOOST, freezeAtLimits, takeStep, writeStep } from './levenberg.ts';
import type { IkProblem } from './state.ts';

/** A step that much longer than the last is foreseen no more: the miss grows with the square. */
const MAX_STRETCH = 2;
/** The cosine of the angle between two steps up to which the second goes on as the first; straight back does too. */
const MIN_ALONG = 0.7;

/**
 * The first step of a drag, from the pose last looked at; nothing is changed where it would not lower the error.
 * @param error the sum of the squared errors of the pose
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
  // What is undone teaches nothing; beside no last errors the bend, too, counts for nothing.
  for (let r = 0; r < rows; r++) last[r] = 0;
  for (let v = 0; v < count; v++) dofs[dof[v]] = before[v];
  return evaluatePose(problem, dofs);
}

/** How long the errors are along the last ones, beside those, squared; 0 where nothing is foreseen. */
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
