/** Lines through values at evenly spaced frames, on a canvas. */
import type { TimeWindow } from '../../kit/time-window.ts';
import { type TimeView, timeX } from './time-ruler.ts';

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
 * Adds a line to the path. One with more frames than pixels is the range of each column of pixels, so that no peak is
 * lost at any zoom.
 * @param y of a value, in pixels
 */
export function traceFrames(
  g: CanvasRenderingContext2D,
  view: TimeView,
  frames: FrameRow,
  values: ArrayLike<number>,
  y: (value: number) => number,
): void {
  const { startSeconds, frameSeconds } = frames;
  const [first, end] = framesIn(frames, view.window);
  const perPixel = (view.window.to - view.window.from) / view.width / frameSeconds;
  if (perPixel <= 2) {
    for (let f = first; f < end; f++) {
      g.lineTo(timeX(view, startSeconds + f * frameSeconds), y(values[f]));
    }
    // A take of one frame is a point.
    if (end - first === 1) g.arc(timeX(view, startSeconds + first * frameSeconds), y(values[first]), 1, 0, 7);
    return;
  }
  let f = first;
  while (f < end) {
    const x = Math.floor(timeX(view, startSeconds + f * frameSeconds));
    const past = Math.min(end, Math.max(f + 1, Math.floor(f + perPixel)));
    let least = values[f];
    let most = least;
    for (let i = f + 1; i < past; i++) {
      const value = values[i];
      if (value < least) least = value;
      else if (value > most) most = value;
    }
    g.lineTo(x + 0.5, y(values[f]));
    g.lineTo(x + 0.5, y(least));
    g.lineTo(x + 0.5, y(most));
    g.lineTo(x + 0.5, y(values[past - 1]));
    f = past;
  }
}
