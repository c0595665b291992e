/** Lines through values at evenly spaced frames, on a canvas. */
import { type TimeWindow, timeX } from '../../widgets/time/time-window.ts';
import type { TimeView } from './time-ground.ts';

/** Frame f is at `startSeconds + f · frameSeconds` of the transport. */
export interface FrameRow {
  readonly startSeconds: number;
  readonly frameSeconds: number;
  readonly frameCount: number;
}

/** First and end (exclusive) of the frames in a time window, plus one on each side. */
export function framesIn({ startSeconds, frameSeconds, frameCount }: FrameRow, { from, to }: TimeWindow) {
  const first = Math.max(0, Math.floor((from - startSeconds) / frameSeconds));
  const end = Math.min(frameCount, Math.ceil((to - startSeconds) / frameSeconds) + 1);
  return [first, Math.max(first, end)] as const;
}

/**
 * Adds a line to the path, through the values at their times. One with more frames than pixels goes through the first,
 * the least and the largest value of each column of pixels, so that no peak is lost at any zoom. It has gaps where
 * values are NaN.
 * @param y of a value, in pixels
 */
export function traceFrames(
  g: Pick<CanvasRenderingContext2D, 'moveTo' | 'lineTo' | 'arc'>,
  view: TimeView,
  frames: FrameRow,
  values: ArrayLike<number>,
  y: (value: number) => number,
): void {
  const { startSeconds, frameSeconds } = frames;
  const [first, end] = framesIn(frames, view.window);
  const perPixel = (view.window.to - view.window.from) / view.width / frameSeconds;
  const x = (f: number) => timeX(view, startSeconds + f * frameSeconds);
  let isGap = false;
  const to = (f: number) => {
    const isMissing = Number.isNaN(values[f]);
    if (!isMissing && isGap) g.moveTo(x(f), y(values[f]));
    else if (!isMissing) g.lineTo(x(f), y(values[f]));
    isGap = isMissing;
  };
  if (perPixel <= 2) {
    for (let f = first; f < end; f++) to(f);
    // A take of one frame is a point.
    if (end - first === 1) g.arc(x(first), y(values[first]), 1, 0, 7);
    return;
  }
  let f = first;
  while (f < end) {
    const past = Math.min(end, Math.max(f + 1, Math.floor(f + perPixel)));
    let least = f;
    let most = f;
    for (let i = f + 1; i < past; i++) {
      // The first of them may be missing.
      if (values[i] < values[least] || Number.isNaN(values[least])) least = i;
      if (values[i] > values[most] || Number.isNaN(values[most])) most = i;
    }
    to(f);
    const [before, after] = least < most ? [least, most] : [most, least];
    if (before > f) to(before);
    if (after > before) to(after);
    f = past;
  }
  if (end > first) to(end - 1);
}
