/**
 * Work put off to the next frame: however often it is asked for, it is done once. Everything that follows playback
 * goes through here, and all of it is one request of the browser's: five of them, a frame, were felt.
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

/** In the order in which they were asked for. */
let waiting: (() => void)[] = [];
/** Those that run now; what they ask for is for the frame after. */
let running: (() => void)[] = [];

function runAll(): void {
  [running, waiting] = [waiting, running];
  let done = 0;
  try {
    while (done < running.length) running[done++]();
  } finally {
    // One that failed keeps none of the others from being done.
    if (done < running.length) {
      waiting.unshift(...running.slice(done));
      requestAnimationFrame(runAll);
    }
    running.length = 0;
  }
}

/** The same at most every `intervalMs`, and always once more after the last time it was asked for. */
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
 * For what is drawn while time runs, but is no movement that an eye follows: a number that changes sixty times a second
 * can't be read. Says whether so much time has gone by since it last said yes.
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
