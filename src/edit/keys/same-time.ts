/**
 * When two keys are at the same time. Times from frames, drags and typed numbers differ in their last digits, and keys
 * a billionth of a second apart are never intended.
 */
import { lastNotAbove } from '../../math/search.ts';
import type { KeyedChannel } from '../../model/takes/take.ts';

/** Seconds; relative for times above one second. */
const WITHIN = 1e-9;

/** Whether two times differ by no more than a billionth, of a second or of themselves if that is more. */
export function sameTime(a: number, b: number): boolean {
  return Math.abs(a - b) <= WITHIN * Math.max(1, Math.abs(a), Math.abs(b));
}

/** Index of the key at this time, of a step the later one; -1 if there is none. O(log keys). */
export function findKey({ times }: KeyedChannel, time: number): number {
  if (times.length === 0) return -1;
  const k = lastNotAbove(times, 0, times.length, time + WITHIN * Math.max(1, Math.abs(time)));
  return sameTime(times[k], time) ? k : -1;
}

/** Number of keys at or before the time, which is the index to insert a key at. O(log keys). */
export function countNotAbove(times: Float64Array, time: number): number {
  if (times.length === 0 || times[0] > time) return 0;
  return lastNotAbove(times, 0, times.length, time) + 1;
}
