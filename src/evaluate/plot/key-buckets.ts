/**
 * Which pixels of the scrubber have a key. The answer is as long as the scrubber is wide, whatever the clip: a channel
 * with far more keys in view than there are pixels is not walked but jumped through, from one pixel's edge to the next.
 */
import { firstNotBelow } from '../../math/search.ts';
import type { ShownChannel } from './shown-keys.ts';

export const NO_KEY = 0;
export const OTHER_KEY = 1;
export const MEANT_KEY = 2;

/** A channel is jumped through when it has this many keys a pixel. */
const DENSE = 8;

/**
 * @param from transport's time at the left edge of pixel 0, seconds
 * @param secondsPerPixel above 0
 * @param out one entry a pixel; set to NO_KEY, OTHER_KEY or MEANT_KEY
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
      // Never stands still, though rounding may put the next edge at this very key.
      index = Math.max(index + 1, firstNotBelow(times, start + (pixel + 1) * secondsPerPixel, index, end));
    }
  }
}
