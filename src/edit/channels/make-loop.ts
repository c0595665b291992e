/**
 * Makes a channel loop without a seam, in value and slope.
 *
 *     v_last := v_first        m := slope at the seam, both into the last key and out of the first
 *
 * m is what `smooth` would be if the keys continued across the seam,
 *
 *     m = ((v[1] − v[0]) + (v[n−1] − v[n−2])) / ((t[1] − t[0]) + (t[n−1] − t[n−2]))
 *
 * since `smooth` and `linear` at the ends see only one neighbour, so that loops made of them stutter. A slope set by
 * hand, flat or a number, on either side of the seam is used for both; of two, the mean. (The mean of all slopes,
 * whatever their kind, would only be right for evenly spaced keys.)
 */

import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { autoSlope } from '../../model/takes/auto-slope.ts';
import type { KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT } from '../../model/takes/tangent-kinds.ts';

/** A channel made to loop, and what that changed, in the channel's unit. */
export interface Looped {
  readonly channel: KeyedChannel;
  /** Change of the last key's value; 0 if an offset is kept. */
  readonly moved: number;
  /** Value per second, on both sides of the seam. */
  readonly slope: number;
}

/**
 * The channel as a loop, `cycle` on both sides. With `keepsOffset` the last value is kept and each repetition continues
 * from it (`cycle_offset`), for a root that moves. The same object if it is that loop already, or if its keys span no
 * time.
 */
export function withLoop(channel: KeyedChannel, keepsOffset = false): Looped {
  const { times } = channel;
  const last = times.length - 1;
  if (!(times[last] > times[0])) return { channel, moved: 0, slope: 0 };
  // Of keys at the same time only the innermost borders on the curve.
  let first = 0;
  while (first < last && times[first + 1] === times[0]) first++;
  let end = last;
  while (end > first && times[end - 1] === times[last]) end--;

  const target = keepsOffset ? channel.values[end] : channel.values[first];
  const values = channel.values.slice().fill(channel.values[first], 0, first).fill(target, end);
  const goesOn = keepsOffset ? 'cycle_offset' : 'cycle';
  // `auto` knows the seam itself.
  const isAuto = channel.tangentsOut.kinds[first] === AUTO_TANGENT && channel.tangentsIn.kinds[end] === AUTO_TANGENT;
  const slope = isAuto
    ? autoSlope({ ...channel, values, extrapolateIn: goesOn, extrapolateOut: goesOn }, 0)
    : seamSlope({ ...channel, values }, first, end);
  const kind = isAuto ? AUTO_TANGENT : slope === 0 ? FLAT : FIXED_TANGENT;
  const sloped = (side: Tangents): Tangents => {
    const made = { kinds: side.kinds.slice(), slopes: side.slopes.slice() };
    for (let k = 0; k <= last; k++) {
      if (k > first && k < end) continue;
      made.kinds[k] = kind;
      made.slopes[k] = isAuto ? 0 : slope;
    }
    return made;
  };
  const looped: KeyedChannel = {
    ...channel,
    values,
    tangentsIn: sloped(channel.tangentsIn),
    tangentsOut: sloped(channel.tangentsOut),
    extrapolateIn: goesOn,
    extrapolateOut: goesOn,
  };
  return { channel: isSame(looped, channel) ? channel : looped, moved: target - channel.values[end], slope };
}

/**
 * Whether a length goes from one place to another instead of back and forth: its last value is farther from its first
 * than half of what it covers. Repeated without an offset, a walk would jump back to its start.
 */
export function travels({ values }: KeyedChannel): boolean {
  let [min, max] = [Infinity, -Infinity];
  for (const value of values) {
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  return Math.abs(values[values.length - 1] - values[0]) > (max - min) / 2;
}

/**
 * Whether a channel keeps its offset unless told otherwise: one that continues with it already, or a length that
 * travels.
 */
export function keepsOffset(channel: KeyedChannel, isLength: boolean): boolean {
  const goesOn = channel.extrapolateIn === 'cycle_offset' || channel.extrapolateOut === 'cycle_offset';
  return goesOn || (isLength && travels(channel));
}

/** Looping again must change nothing. */
function isSame(a: KeyedChannel, b: KeyedChannel): boolean {
  const columns = ({ values, tangentsIn, tangentsOut }: KeyedChannel) => [
    values,
    tangentsIn.kinds,
    tangentsIn.slopes,
    tangentsOut.kinds,
    tangentsOut.slopes,
  ];
  const others = columns(b);
  return (
    a.extrapolateIn === b.extrapolateIn &&
    a.extrapolateOut === b.extrapolateOut &&
    columns(a).every((column, c) => column.every((x, k) => x === others[c][k]))
  );
}

function seamSlope(channel: KeyedChannel, first: number, end: number): number {
  const { times, values, tangentsIn, tangentsOut } = channel;
  const slopes = resolvedSlopes(channel);
  const byHand: number[] = [];
  const isByHand = (kind: number) => kind === FLAT || kind === FIXED_TANGENT;
  if (isByHand(tangentsOut.kinds[first])) byHand.push(slopes.out[first]);
  if (isByHand(tangentsIn.kinds[end])) byHand.push(slopes.in[end]);
  if (byHand.length > 0) return byHand.reduce((sum, s) => sum + s, 0) / byHand.length;
  const rise = values[first + 1] - values[first] + (values[end] - values[end - 1]);
  const run = times[first + 1] - times[first] + (times[end] - times[end - 1]);
  const slope = rise / run;
  return Number.isFinite(slope) ? slope : 0;
}
