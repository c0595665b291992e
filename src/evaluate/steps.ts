/**
 * Long work as a generator that pauses every few milliseconds. A page runs it between its frames and can stop it; a
 * command or a test runs it to its end at once.
 */

/** Yields the fraction done, from 0 to 1. */
export type Steps<T> = Generator<number, T>;

/** Values copied or added between two pauses: about a millisecond's work. */
export const STEP_VALUES: number = 1 << 17;

/** Runs all steps now. */
export function runToEnd<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** Steps as a part of longer work, whose progress they take from `from` to `to`. */
export function* within<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}
