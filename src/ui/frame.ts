/**
 * Work put off to the next frame: however often it is asked for, it is done once. Everything that follows playback
 * goes through here.
 */
export function oncePerFrame(work: () => void): () => void {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      work();
    });
  };
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
