/**
 * Defers work to the next frame, once however often it is requested. Everything that follows playback uses this, with a
 * single request of the browser's: five of them per frame were measurable.
 */
export function oncePerFrame(work: () => void): () => void {
  let asked = false;
  const run = () => {
    asked = false;
    work();
  };
  return () => {
    if (asked) return;
    asked = true;
    if (waiting.push(run) === 1) requestAnimationFrame(runAll);
  };
}

/** In the order of their requests. */
let waiting: (() => void)[] = [];
/** Running now; what they request runs in the next frame. */
let running: (() => void)[] = [];

function runAll(): void {
  [running, waiting] = [waiting, running];
  let done = 0;
  try {
    while (done < running.length) running[done++]();
  } finally {
    // If one throws, the others still run.
    if (done < running.length) {
      waiting.unshift(...running.slice(done));
      requestAnimationFrame(runAll);
    }
    running.length = 0;
  }
}

/** The same, at most every `intervalMs`, and always once more after the last request. */
export function atMostEvery(intervalMs: number, work: () => void): () => void {
  let last = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const run = () => {
    timer = undefined;
    last = performance.now();
    work();
  };
  return () => {
    if (timer === undefined) timer = setTimeout(run, Math.max(0, last + intervalMs - performance.now()));
  };
}

/**
 * For numbers shown while playing: one that changes sixty times a second can't be read. Returns true if the interval
 * has passed since the last true.
 *
 * @param now milliseconds
 */
export function isTimeAgain(intervalMs: number, now: () => number = () => performance.now()): () => boolean {
  let last = -Infinity;
  return () => {
    const time = now();
    if (time - last < intervalMs) return false;
    last = time;
    return true;
  };
}
