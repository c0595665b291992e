/**
 * Work that may take longer than a moment, in steps: a generator that pauses every few milliseconds with the part that
 * is done. A page does it between its frames and can stop it; a command and a test do it in one go.
 */

/** Pauses with the part that is done, from 0 to 1. */
export type Steps<T> = Generator<number, T>;

/** Values that are copied or added to between two pauses: about a millisecond's. */
export const STEP_VALUES: number = 1 << 17;

/** All of it now. */
export function finished<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** Steps that are a part of others': what is done goes on from `from` to `to`. */
export function* within<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}
