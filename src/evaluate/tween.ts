/**
 * The keys on either side of a time, which a tween goes between. A key at the time itself is neither; of a step the
 * value that faces the time counts. Where the first and last key are neighbours across the seam of a loop, a time at
 * one of them has the neighbour beyond it.
 */
import { firstNotBelow } from '../math/search.ts';
import { crossesSeam } from '../model/takes/auto-slope.ts';
import type { KeyedCurve } from '../model/takes/take.ts';

/** Seconds within which a key is at a time. */
const AT_KEY = 1e-6;

/** The keys before and after a time. */
export interface Neighbours {
  /** Seconds of the take; across a seam before the first or after the last key. */
  readonly timeBefore: number;
  readonly timeAfter: number;
  /** In the channel's unit. */
  readonly valueBefore: number;
  readonly valueAfter: number;
}

/** The neighbours of a time of the take; undefined without a key on both sides. O(log keys). */
export function neighboursAt(curve: KeyedCurve, time: number): Neighbours | undefined {
  const { times, values } = curve;
  const last = times.length - 1;
  let before = firstNotBelow(times, time - AT_KEY) - 1;
  let after = firstNotBelow(times, time + AT_KEY);
  while (after <= last && times[after] - time <= AT_KEY) after++;
  while (before >= 0 && time - times[before] <= AT_KEY) before--;
  const isAtKey = after - before > 1;
  const [seconds, rise] = isAtKey && crossesSeam(curve) ? [times[last] - times[0], values[last] - values[0]] : [0, 0];
  let [shiftBefore, shiftAfter] = [0, 0];
  if (seconds > 0 && before < 0) {
    before = firstNotBelow(times, times[last] - AT_KEY) - 1;
    shiftBefore = -1;
  }
  if (seconds > 0 && after > last) {
    after = firstNotBelow(times, times[0] + AT_KEY);
    while (times[after] - times[0] <= AT_KEY) after++;
    shiftAfter = 1;
  }
  if (before < 0 || after > last) return undefined;
  return {
    timeBefore: times[before] + shiftBefore * seconds,
    timeAfter: times[after] + shiftAfter * seconds,
    valueBefore: values[before] + shiftBefore * rise,
    valueAfter: values[after] + shiftAfter * rise,
  };
}

/** The value a share of the way from the key before to the key after: 0 is that before, 1 that after; any number. */
export function tweened({ valueBefore, valueAfter }: Neighbours, share: number): number {
  return valueBefore + share * (valueAfter - valueBefore);
}

/** The value at a time on the straight line between both keys. */
export function onLine(near: Neighbours, time: number): number {
  return tweened(near, (time - near.timeBefore) / (near.timeAfter - near.timeBefore));
}
