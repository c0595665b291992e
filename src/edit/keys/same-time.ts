/**
 * When two keys are at one time. Times that come from frames, drags and typed numbers differ in their last digits, and
 * keys a billionth of a second apart are no curve that anybody meant.
 */
import { lastNotAbove } from '../../math/search.ts';
import type { KeyedChannel } from '../../model/clip.ts';

/** Seconds; of times above a second, relative to them. */
const WITHIN = 1e-9;

export function sameTime(a: number, b: number): boolean {
  return Math.abs(a - b) <= WITHIN * Math.max(1, Math.abs(a), Math.abs(b));
}

/** Index of the key at this time, of a step the one that holds from then on; -1 where there is none. O(log keys). */
export function findKey({ times }: KeyedChannel, time: number): number {
  if (times.length === 0) return -1;
  const k = lastNotAbove(times, 0, times.length, time + WITHIN * Math.max(1, Math.abs(time)));
  return sameTime(times[k], time) ? k : -1;
}

/** How many of the keys are at or before the time: where a key at that time goes. O(log keys). */
export function countNotAbove(times: Float64Array, time: number): number {
  if (times.length === 0 || times[0] > time) return 0;
  return lastNotAbove(times, 0, times.length, time) + 1;
}
