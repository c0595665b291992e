/**
 * What a press takes in the scrubber: its upper part, the ruler, is the time's; below, the ends of the playback range
 * have handles outside of it, so that the range's first and last pixel are times too.
 */
import { HANDLE_WIDTH, RULER_HEIGHT } from './scrubber-picture.ts';

export type RangeEnd = 'in' | 'out';

/**
 * The handle at a point, if there is one.
 *
 * @param x CSS pixels, as `y` from the scrubber's top left corner
 * @param range x of its first and last time
 */
export function rangeHandleAt(x: number, y: number, [first, last]: readonly [number, number]): RangeEnd | undefined {
  if (y < RULER_HEIGHT) return undefined;
  if (x < first && x >= first - HANDLE_WIDTH) return 'in';
  return x > last && x <= last + HANDLE_WIDTH ? 'out' : undefined;
}
