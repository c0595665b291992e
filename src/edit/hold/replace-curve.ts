/**
 * Replaces a stretch of a curve by values with a key each, keeping the curve on both sides:
 *
 *     before   ─────────╮     ╭──────
 *                        ╲___╱
 *     after    ────────k k k k k─────        the outer keys are on the curve, with its slopes as numbers
 *
 * Repetitions are first baked over the playback range, or all of them would change with the stretch.
 */
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { type Channel, type KeyedChannel, repeats } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, SMOOTH } from '../../model/takes/tangent-kinds.ts';
import { withExtrapolationBaked } from '../channels/bake-extrapolation.ts';
import { type Key, keyAt, type Tangent, tangent, withKeyList } from '../keys/columns.ts';
import { insertKey } from '../keys/insert.ts';
import { findKey, sameTime } from '../keys/same-time.ts';

/** The values that replace a stretch of a curve. */
export interface Stretch {
  /** Seconds of the take, strictly ascending; at least two. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  /** Indices of inner ones where the curve has different slopes on either side. */
  readonly corners: ReadonlySet<number>;
  /** Whether the first and last value are on the old curve, so that the curve continues smoothly. */
  readonly startsOnCurve: boolean;
  readonly endsOnCurve: boolean;
}

/**
 * Replaces a stretch of a channel's curve by keys.
 * @param played playback range of the take, which contains the stretch. If an end value is not on the curve, the curve
 * jumps there: before the start it is kept, and at the end a step leads back to it.
 */
export function replaceStretch(channel: Channel, stretch: Stretch, played: readonly [number, number]): KeyedChannel {
  const { times, values, corners, startsOnCurve, endsOnCurve } = stretch;
  const last = times.length - 1;
  const written =
    channel.kind === 'keys'
      ? withoutPeriods(withExtrapolationBaked(channel, played[0], played[1]).channel, played)
      : channel;
  const made = insertKey(insertKey(written, times[0]).channel, times[last]).channel;
  const slopes = resolvedSlopes(made);
  const from = findKey(made, times[0]);
  let to = findKey(made, times[last]);
  // Of a step at the end, the stretch ends at its first key.
  while (to - 1 > from && sameTime(made.times[to - 1], times[last])) to--;
  const own = (k: number): Key => ({ ...keyAt(made, k), in: number(slopes.in[k]), out: number(slopes.out[k]) });

  const keys: Key[] = [];
  for (let k = 0; k < from; k++) keys.push(keyAt(made, k));
  if (startsOnCurve) keys.push(own(from));
  else {
    if (from > 0) keys.push(own(from));
    const slope = number(slopeAtEnd(times, values, 0, 1));
    keys.push({ time: made.times[from], value: values[0], in: slope, out: slope });
  }
  for (let f = 1; f < last; f++) {
    const isCorner = corners.has(f);
    const side = (step: 1 | -1) => (isCorner ? number(slopeAtEnd(times, values, f, step)) : tangent(SMOOTH));
    keys.push({ time: times[f], value: values[f], in: side(-1), out: side(1) });
  }
  if (endsOnCurve) keys.push(own(to));
  else {
    const slope = number(slopeAtEnd(times, values, last, -1));
    keys.push({ time: made.times[to], value: values[last], in: slope, out: slope });
  }
  for (let k = to + 1; k < made.times.length; k++) keys.push(keyAt(made, k));
  return withKeyList(made, keys);
}

/** A cycle of keys at a single time is constant, and would not be with other keys beside them. */
function withoutPeriods(channel: KeyedChannel, [from, to]: readonly [number, number]): KeyedChannel {
  const { times, extrapolateIn, extrapolateOut } = channel;
  const endsBefore = repeats(extrapolateIn) && times[0] > from;
  const endsAfter = repeats(extrapolateOut) && times[times.length - 1] < to;
  if (!endsBefore && !endsAfter) return channel;
  return {
    ...channel,
    extrapolateIn: endsBefore ? 'constant' : extrapolateIn,
    extrapolateOut: endsAfter ? 'constant' : extrapolateOut,
  };
}

/** A slope that doesn't depend on neighbours. */
function number(slope: number): Tangent {
  return slope === 0 ? tangent(FLAT) : tangent(FIXED_TANGENT, slope);
}

/** Slope of the parabola through a value and the next two on one side, or the line through the next one. */
function slopeAtEnd(times: Float64Array, values: Float64Array, end: number, step: 1 | -1): number {
  const [a, b, c] = [end, end + step, end + 2 * step];
  const first = (values[b] - values[a]) / (times[b] - times[a]);
  if (c < 0 || c >= times.length) return first;
  const second = (values[c] - values[b]) / (times[c] - times[b]);
  return first - ((second - first) / (times[c] - times[a])) * (times[b] - times[a]);
}
