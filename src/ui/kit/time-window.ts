/**
 * The stretch of time that the scrubber shows: more than the played range, and free to be zoomed and moved beyond it.
 */
export interface TimeWindow {
  readonly from: number;
  readonly to: number;
}

/** Room on both sides of the range, as a part of it. */
const MARGIN = 0.04;
const SHORTEST_SECONDS = 1e-3;
const LONGEST_SECONDS = 1e6;

/** The range with some room beside it, and with `include` if that lies outside. A range of no length gets a second. */
export function fitWindow(range: readonly [number, number], include = range[0]): TimeWindow {
  const from = Math.min(range[0], include);
  const to = Math.max(range[1], include);
  if (!(to > from)) return { from: from - 0.1, to: from + 1 };
  const margin = (to - from) * MARGIN;
  return { from: from - margin, to: to + margin };
}

/** Zooms about a time, which stays where it is; `factor` above 1 shows more. */
export function zoomWindow(window: TimeWindow, about: number, factor: number): TimeWindow {
  const size = window.to - window.from;
  const next = Math.min(LONGEST_SECONDS, Math.max(SHORTEST_SECONDS, size * factor));
  const part = (about - window.from) / size;
  return { from: about - part * next, to: about + (1 - part) * next };
}

export function panWindow(window: TimeWindow, seconds: number): TimeWindow {
  return { from: window.from + seconds, to: window.to + seconds };
}

/** The window moved as little as it takes to show a time. */
export function revealTime(window: TimeWindow, timeSeconds: number): TimeWindow {
  if (timeSeconds < window.from) return panWindow(window, timeSeconds - window.from);
  return timeSeconds > window.to ? panWindow(window, timeSeconds - window.to) : window;
}

/**
 * A scrubbed time as a short decimal: rounded to the power of ten below a pixel's worth, so that what is shown is what
 * it is. In frames, to a whole one.
 */
export function snapTime(timeSeconds: number, secondsPerPixel: number, framesPerSecond?: number): number {
  if (framesPerSecond) return Math.round(timeSeconds * framesPerSecond) / framesPerSecond;
  const decimals = Math.min(12, Math.max(0, Math.ceil(-Math.log10(secondsPerPixel) - 1e-9)));
  return Number(timeSeconds.toFixed(decimals));
}
