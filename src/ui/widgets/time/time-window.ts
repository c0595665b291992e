/**
 * The time range that ruler and plots show: larger than the playback range, and free to be zoomed and panned beyond it.
 */
export interface TimeWindow {
  readonly from: number;
  readonly to: number;
}

/** What shows the times of a window over its width: the ruler, and each plot below it. */
export interface TimeStrip {
  readonly window: TimeWindow;
  /** CSS pixels. */
  readonly width: number;
}

/** Pixels from the left edge. */
export function timeX(strip: TimeStrip, seconds: number): number {
  return (seconds - strip.window.from) * pixelsPerSecond(strip);
}

/** The time at a distance in pixels from the left edge. */
export function timeAt(strip: TimeStrip, x: number): number {
  return strip.window.from + x / pixelsPerSecond(strip);
}

export function pixelsPerSecond({ window, width }: TimeStrip): number {
  return width / (window.to - window.from);
}

export function secondsPerPixel({ window, width }: TimeStrip): number {
  return (window.to - window.from) / Math.max(1, width);
}

/** Pixels on both sides of a fitted range: room for the labels of values, and for the names of curves. */
export const GUTTER = 48;
/** Of a narrow strip, at most this part. */
const MAX_GUTTER = 0.2;
const SHORTEST_SECONDS = 1e-3;
const LONGEST_SECONDS = 1e6;
/** Beyond, the length of a window may not be finite. */
export const FARTHEST = 1e307;
/** Of a time: a shorter window there would begin and end at one number. */
const ROUNDING = 1e-12;

/** The shortest window about a time, or axis about a value, in which pixels are still told apart. */
export function shortestAt(seconds: number): number {
  return Math.abs(seconds) * ROUNDING;
}

/**
 * The range with a gutter on both sides. An empty range gets a second.
 *
 * @param width of what shows it, CSS pixels
 */
export function fitWindow(range: readonly [number, number], width: number): TimeWindow {
  const from = Math.max(-FARTHEST, range[0]);
  const to = Math.min(FARTHEST, range[1]);
  const least = shortestAt(Math.max(Math.abs(from), Math.abs(to)));
  if (!(to > from && to - from >= least)) return { from: from - Math.max(0.1, least), to: to + Math.max(1, least) };
  const part = Math.min(MAX_GUTTER, GUTTER / Math.max(1, width));
  const margin = ((to - from) * part) / (1 - 2 * part);
  return { from: from - margin, to: to + margin };
}

/** Zooms about a fixed time; `factor` above 1 zooms out. */
export function zoomWindow(window: TimeWindow, about: number, factor: number): TimeWindow {
  const size = window.to - window.from;
  const shortest = Math.max(SHORTEST_SECONDS, shortestAt(about));
  // A range that is longer is shown whole, and zoomed from there.
  const longest = Math.max(LONGEST_SECONDS, shortest, size);
  const next = Math.min(longest, Math.max(shortest, size * factor));
  const part = size > 0 ? (about - window.from) / size : 0;
  return { from: about - part * next, to: about + (1 - part) * next };
}

/**
 * Two fingers: the window grows by how far they were apart, and the time between them stays there.
 *
 * @param window when they came down; `from` and `to`: x of each then and now, in pixels of `width`
 */
export function pinchWindow(
  window: TimeWindow,
  width: number,
  from: readonly [number, number],
  to: readonly [number, number],
): TimeWindow {
  const apart = ([a, b]: readonly [number, number]) => Math.max(MIN_APART, Math.abs(b - a));
  const middle = ([a, b]: readonly [number, number]) => (a + b) / 2 / width;
  const about = window.from + middle(from) * (window.to - window.from);
  const zoomed = zoomWindow(window, about, apart(from) / apart(to));
  return panWindow(zoomed, (middle(from) - middle(to)) * (zoomed.to - zoomed.from));
}

/** Fingers above each other zoom no further; pixels. */
const MIN_APART = 24;

export function panWindow(window: TimeWindow, seconds: number): TimeWindow {
  return { from: window.from + seconds, to: window.to + seconds };
}

/** Moves the window by the least amount that shows a time. */
export function revealTime(window: TimeWindow, timeSeconds: number): TimeWindow {
  if (timeSeconds < window.from) return panWindow(window, timeSeconds - window.from);
  return timeSeconds > window.to ? panWindow(window, timeSeconds - window.to) : window;
}

/**
 * A scrubbed time as a short decimal: rounded to the power of ten below a pixel, so that what is shown is exact. With a
 * frame rate, to a whole frame.
 */
export function snapTime(timeSeconds: number, secondsPerPixel: number, framesPerSecond?: number): number {
  if (framesPerSecond) {
    const frame = Math.round(timeSeconds * framesPerSecond);
    // So far from 0 that every time is on one.
    return Number.isFinite(frame) ? frame / framesPerSecond : timeSeconds;
  }
  const decimals = Math.min(12, Math.max(0, Math.ceil(-Math.log10(secondsPerPixel) - 1e-9)));
  return Number(timeSeconds.toFixed(decimals));
}
