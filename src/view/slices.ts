/**
 * Long work on the main thread in slices of a few milliseconds, so that the page stays responsive.
 */
import type { Steps } from '../evaluate/steps.ts';

/** Milliseconds at a stretch: half of what a frame at 60 Hz has, and far from a task that is felt. */
const BUDGET_MS = 8;

/** Bit by bit. Gives undefined when `signal` aborts it. */
export async function runInSlices<T>(
  work: Steps<T>,
  signal: AbortSignal,
  onProgress?: (done: number) => void,
): Promise<T | undefined> {
  for (;;) {
    // First of all too: whoever asks for the work has often just done some.
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
 * Lets the page answer what has come meanwhile, and draw. By a message, which is as soon as can be: a timer waits for
 * four milliseconds, or for a second in a tab in the background.
 */
function breathe(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(undefined);
  });
}

/** The next frame, or soon where none are drawn: a tab in the background, Node. */
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
