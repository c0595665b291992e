/**
 * The frames of the page. All that follows time shares a single request of the browser's, and runs in this order:
 *
 *     advance   the clock decides the time of the frame
 *     show      panels show it: fields, scrubber, curves, dope sheet
 *     draw      the picture of the viewport is drawn
 *
 * So one frame never shows two times. (With a request each, their order was that of the requests: a clock that ran
 * between two of them showed the old time in one and the new time in the other.) For the same reason nothing here goes
 * by the clock of the wall: what shows time does so in every frame in which it changes.
 */
export type FramePhase = 'advance' | 'show' | 'draw';

type Work = (nowMs: number) => void;

const PHASES: readonly FramePhase[] = ['advance', 'show', 'draw'];
const WAITING: Record<FramePhase, Work[]> = { advance: [], show: [], draw: [] };
let isAsked = false;
let isRunning = false;

/**
 * Defers work to the next frame, once however often it is requested. Work that a frame requests for one of its later
 * phases still runs in that frame.
 *
 * @param work takes the frame's time, in milliseconds
 */
export function oncePerFrame(work: Work, phase: FramePhase = 'show'): () => void {
  let waits = false;
  const run = (nowMs: number) => {
    waits = false;
    work(nowMs);
  };
  return () => {
    if (waits) return;
    waits = true;
    WAITING[phase].push(run);
    if (!isRunning) ask();
  };
}

function ask(): void {
  if (isAsked) return;
  isAsked = true;
  requestAnimationFrame(runAll);
}

function runAll(nowMs: number): void {
  isAsked = false;
  isRunning = true;
  try {
    for (const phase of PHASES) runPhase(phase, nowMs);
  } finally {
    isRunning = false;
    // Requested for a phase that was over, or left by one that threw.
    if (PHASES.some((phase) => WAITING[phase].length > 0)) ask();
  }
}

/** Running now; what they request for their own phase runs in the next frame. */
let running: Work[] = [];

function runPhase(phase: FramePhase, nowMs: number): void {
  [running, WAITING[phase]] = [WAITING[phase], running];
  let done = 0;
  try {
    while (done < running.length) running[done++](nowMs);
  } finally {
    // If one throws, the others still run.
    if (done < running.length) WAITING[phase].unshift(...running.slice(done));
    running.length = 0;
  }
}

/** At most every `intervalMs`, and always once more after the last request; for what is costly and shows no time. */
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
