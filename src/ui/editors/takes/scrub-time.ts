/** The time at a place of the chart of distances: within what is shown and measured, on a frame of the takes. */
import type { FrameTimes } from '../../../evaluate/compare/distance.ts';
import { snapTime, type TimeWindow } from '../../widgets/time/time-window.ts';

/**
 * @param x pixels from the left edge of the chart; beyond its edges as at them
 * @param frames absent: nothing is measured
 * @param snapsTo frames per second if nothing is measured; undefined: to no frame
 */
export function scrubbedTime(
  x: number,
  { window, width }: { readonly window: TimeWindow; readonly width: number },
  frames: FrameTimes | undefined,
  snapsTo: number | undefined,
): number {
  const perPixel = (window.to - window.from) / width;
  const time = window.from + Math.min(width, Math.max(0, x)) * perPixel;
  if (!frames) return snapTime(time, perPixel, snapsTo);
  const { startSeconds, frameSeconds, frameCount } = frames;
  const end = startSeconds + (frameCount - 1) * frameSeconds;
  const [least, most] = [Math.max(window.from, startSeconds), Math.min(window.to, end)];
  // Zoomed to where nothing is measured.
  if (least > most) return snapTime(time, perPixel, snapsTo);
  const within = Math.min(most, Math.max(least, time));
  if (snapsTo === undefined) return Math.min(end, Math.max(startSeconds, snapTime(within, perPixel)));
  return startSeconds + Math.round((within - startSeconds) / frameSeconds) * frameSeconds;
}
