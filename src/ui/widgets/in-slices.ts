/**
 * Runs work in steps (`edit/samples/steps.ts`), a slice at a time between frames: short work finishes at once, and long
 * work neither blocks the page nor prevents cancelling.
 */

/** Milliseconds per slice. */
const SLICE_MS = 12;

export interface Slices<T> {
  /** Whether it was cancelled; checked before each slice. */
  isOver(): boolean;
  /** After each slice but the last, with the fraction done. */
  progress(part: number): void;
  done(value: T): void;
  /** An error thrown by the work or by `done`. */
  failed(error: unknown): void;
}

/** Runs the first slice synchronously. */
export function inSlices<T>(steps: Generator<number, T>, slices: Slices<T>): void {
  slice(slices, () => {
    const until = performance.now() + SLICE_MS;
    let step = steps.next();
    while (!step.done && performance.now() < until) step = steps.next();
    if (!step.done) {
      slices.progress(step.value);
      setTimeout(() => inSlices(steps, slices));
      return;
    }
    const { value } = step;
    // Handling the result takes time too: don't exceed the slice.
    if (performance.now() < until) slices.done(value);
    else setTimeout(() => slice(slices, () => slices.done(value)));
  });
}

function slice<T>(slices: Slices<T>, work: () => void): void {
  if (slices.isOver()) return;
  try {
    work();
  } catch (error) {
    slices.failed(error);
  }
}
