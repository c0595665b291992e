/**
 * Which pixels of the scrubber have a key. The cost depends on the scrubber's width, not on the take: a channel with
 * far more visible keys than pixels is searched from one pixel's edge to the next instead of walked.
 */
import { firstNotBelow } from '../../math/search.ts';
import type { ShownChannel } from './shown-keys.ts';

/** Mark of a pixel without a key. */
export const NO_KEY = 0;
/** Mark of a pixel with keys, none of them on the channels in question. */
export const OTHER_KEY = 1;
/** Mark of a pixel with a key on the channels in question. */
export const MEANT_KEY = 2;

/** Keys per pixel above which a channel is searched. */
const DENSE = 8;

/**
 * Marks the pixels that have keys.
 * @param from transport time at the left edge of pixel 0, seconds
 * @param secondsPerPixel greater than 0
 * @param out one entry per pixel; set to NO_KEY, OTHER_KEY or MEANT_KEY
 */
export function bucketKeys(
  channels: readonly ShownChannel[],
  from: number,
  secondsPerPixel: number,
  out: Uint8Array,
): void {
  out.fill(NO_KEY);
  const pixels = out.length;
  for (const { times, offsetSeconds, meant } of channels) {
    const mark = meant ? MEANT_KEY : OTHER_KEY;
    const start = from + offsetSeconds;
    let index = firstNotBelow(times, start);
    const end = firstNotBelow(times, start + pixels * secondsPerPixel);
    const dense = end - index > DENSE * pixels;
    while (index < end) {
      const pixel = Math.min(pixels - 1, Math.floor((times[index] - start) / secondsPerPixel));
      if (out[pixel] < mark) out[pixel] = mark;
      if (!dense) {
        index++;
        continue;
      }
      // Always advances, even if rounding puts the next edge at this key.
      index = Math.max(index + 1, firstNotBelow(times, start + (pixel + 1) * secondsPerPixel, index, end));
    }
  }
}
