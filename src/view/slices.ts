/** Runs long work on the main thread in slices of a few milliseconds, so that the page stays responsive. */
import type { Steps } from '../evaluate/steps.ts';

/** Milliseconds per slice: half a frame at 60 Hz, so that no delay is felt. */
const BUDGET_MS = 8;

/** Runs `work` in slices. Resolves to undefined when `signal` aborts it. */
export async function runInSlices<T>(
  work: Steps<T>,
  signal: AbortSignal,
  onProgress?: (done: number) => void,
): Promise<T | undefined> {
  for (;;) {
    // Also before the first slice: the caller has often just done some work.
    await breathe();
    const until = performance.now() + BUDGET_MS;
    let at = 0;
    while (performance.now() < until) {
      if (signal.aborted) return undefined;
      const step = work.next();
      if (step.done) return step.value;
      at = step.value;
    }
    onProgress?.(at);
  }
}

/**
 * Yields to events and drawing. By a message, which returns soonest: a timer waits four milliseconds, or a second in a
 * background tab.
 */
export function breathe(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(undefined);
  });
}

/** The next frame, or soon if none are drawn: in a background tab, or in Node. */
export function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    if (typeof requestAnimationFrame === 'undefined') {
      setTimeout(resolve, 0);
      return;
    }
    const late = setTimeout(resolve, 100);
    requestAnimationFrame(() => {
      clearTimeout(late);
      resolve();
    });
  });
}
