/**
 * The frames of the page. All that follows time shares a single request of the browser's, and runs in this order:
 *
 *     advance   the clock decides the time of the frame
 *     show      panels show it: scrubber, curves, dope sheet
 *     number    in one of ten frames: numbers that follow what plays (`state/follow-time.ts`)
 *     draw      the picture of the viewport is drawn
 *
 * So one frame never shows two times. (With a request each, their order was that of the requests: a clock that ran
 * between two of them showed the old time in one and the new time in the other.) For the same reason no picture goes by
 * the clock of the wall: it shows the time of every frame. Numbers can't be read that fast, and each costs the browser
 * a layout and a paint: they change together, so that the frames between have neither.
 */
export type FramePhase = 'advance' | 'show' | 'number' | 'draw';

type Work = (nowMs: number) => void;

const PHASES: readonly FramePhase[] = ['advance', 'show', 'number', 'draw'];
const WAITING: Record<FramePhase, Work[]> = { advance: [], show: [], number: [], draw: [] };
/** Numbers change at most this often: ten times a second, and in one of ten frames; where frames are slow, each second. */
const NUMBERS_MS = 100;
const NUMBERS_FRAMES = 10;
const NUMBERS_LATE_MS = 1000;
let isAsked = false;
let isRunning = false;
/** Since numbers have changed. */
let frames = Number.POSITIVE_INFINITY;
let numbersMs = Number.NEGATIVE_INFINITY;

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
  frames++;
  try {
    for (const phase of PHASES) if (phase !== 'number' || isTimeForNumbers(nowMs)) runPhase(phase, nowMs);
  } finally {
    isRunning = false;
    // Requested for a phase that was over, or left by one that threw.
    if (PHASES.some((phase) => WAITING[phase].length > 0)) ask();
  }
}

function isTimeForNumbers(nowMs: number): boolean {
  // Also if the clock was set back.
  const elapsedMs = Math.abs(nowMs - numbersMs);
  const isDue = elapsedMs >= NUMBERS_LATE_MS || (elapsedMs >= NUMBERS_MS && frames >= NUMBERS_FRAMES);
  if (WAITING.number.length === 0 || !isDue) return false;
  frames = 0;
  numbersMs = nowMs;
  return true;
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
