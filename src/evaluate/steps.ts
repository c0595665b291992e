/**
 * Long-running work as a generator that yields every few milliseconds. A page runs it between frames and can cancel it;
 * commands and tests run it to the end at once.
 */

/** Yields the fraction done, from 0 to 1. */
export type Steps<T> = Generator<number, T>;

/** Values copied or added between two yields: about a millisecond of work. */
export const STEP_VALUES: number = 1 << 17;

/** Runs all steps at once. */
export function runToEnd<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** Runs steps as part of longer work, mapping their progress to `from` … `to`. */
export function* within<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}
