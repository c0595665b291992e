/**
 * Work in steps (`edit/samples/steps.ts`), done a slice at a time between the page's frames: what is short is done at
 * once, and what is long keeps nobody from looking on, or from stopping it.
 */

/** What a slice may take of a frame. */
const SLICE_MS = 12;

export interface Slices<T> {
  /** Whether nobody wants it any more; asked before each slice. */
  isOver(): boolean;
  /** After each slice but the last, with the part that is done. */
  progress(part: number): void;
  done(value: T): void;
  /** What the work threw, or `done`. */
  failed(error: unknown): void;
}

/** Does the first slice now. */
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
    // What is done with a result takes its time too, and the slice may be used up.
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
