/**
 * Simplifies a curve to fewer keys within a tolerance: a recording with a key per frame becomes editable.
 *
 * Keys are removed; the remaining ones keep their time and value, and get new slopes where a neighbour was removed (see
 * `fit.ts`). The result is measured exactly (`difference.ts`) against the original.
 *
 * These are kept, with an independent slope on either side:
 * - the first and last key, so that the period, the step of cycle_offset, and held values don't change. Their outward
 *   tangents keep their slopes, for `linear` extrapolation;
 * - steps (keys at the same time);
 * - corners: keys at which the slope breaks far more than at their neighbours, and more than the tolerance could hide;
 * - keys outside the range, if one is given, and the first and last inside, so that the curve outside is unchanged.
 *
 * If the keys repeat and the seam was smooth, both its sides get the same slope, so that it stays smooth.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { resolvedSlopes, type Slopes } from '../../evaluate/slopes.ts';
import type { KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, LINEAR, SMOOTH, TANGENTS } from '../../model/takes/tangent-kinds.ts';
import { takeKeys } from '../keys/columns.ts';
import { type Difference, largestDifference } from './difference.ts';
import { agrees, type Curve, FREE_SLOPE, fitStretch, type Knots, reaches } from './fit.ts';

/** The result of simplifying; `largestError` is measured, and never above the tolerance. */
export interface Simplified extends Difference {
  /** The same object if no key could be removed. */
  readonly channel: KeyedChannel;
  readonly keysBefore: number;
  readonly keysAfter: number;
}

/** A corner's slope breaks by this factor more than at its neighbours. */
const CORNER = 4;

/**
 * Removes keys as long as the curve stays within the tolerance.
 * @param tolerance in the channel's unit (radians for an angle); greater than 0
 * @param range seconds of the take: only keys inside may be removed
 */
export function simplifyChannel(
  channel: KeyedChannel,
  tolerance: number,
  range: readonly [number, number] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY],
): Simplified {
  const count = channel.times.length;
  const same = { channel, keysBefore: count, keysAfter: count, largestError: 0, atSeconds: channel.times[0] ?? 0 };
  if (count < 3) return same;
  const slopes = resolvedSlopes(channel);
  const curve: Curve = {
    times: channel.times,
    values: channel.values,
    cubics: compileChannels([channel]).cubics,
    slopesIn: slopes.in,
    slopesOut: slopes.out,
    // Slightly less, since the final measurement rounds differently.
    tolerance: tolerance * (1 - 1e-9),
  };
  const knots = fitAll(channel, curve, range);
  if (knots.indices.length === count) return same;
  leaveUntouched(curve, knots);
  const simplified = withKnots(channel, slopes, knots);
  const difference = largestDifference(channel, simplified);
  // A tolerance finer than double precision can't be met.
  if (!(difference.largestError <= tolerance)) return same;
  return { channel: simplified, keysBefore: count, keysAfter: knots.indices.length, ...difference };
}

function fitAll(channel: KeyedChannel, curve: Curve, range: readonly [number, number]): Knots {
  const { slopesIn, slopesOut } = curve;
  const last = channel.times.length - 1;
  const [atFirst, atLast] = endSlopes(channel, curve);
  const border = (k: number) => (agrees(slopesIn[k], slopesOut[k]) && !isStep(curve, k) ? slopesIn[k] : FREE_SLOPE);
  const knots: Knots = { indices: [0], slopesIn: [slopesIn[0]], slopesOut: [slopesOut[0]] };
  let lo = 0;
  for (let hi = 1; hi <= last; hi++) {
    if (!stays(curve, hi, range)) continue;
    if (hi === lo + 1) {
      knots.indices.push(hi);
      knots.slopesIn.push(slopesIn[hi]);
      knots.slopesOut.push(slopesOut[hi]);
    } else {
      fitStretch(curve, lo, hi, lo === 0 ? atFirst : border(lo), hi === last ? atLast : border(hi), knots);
      knots.slopesOut[knots.slopesOut.length - 1] = slopesOut[hi];
    }
    lo = hi;
  }
  return knots;
}

/** Whether key `k` must be kept. (Not called for the first key; the last is kept because none follows.) */
function stays(curve: Curve, k: number, [from, to]: readonly [number, number]): boolean {
  const { times } = curve;
  if (k === times.length - 1 || isStep(curve, k)) return true;
  if (!(times[k] >= from && times[k] <= to) || !(times[k - 1] >= from) || !(times[k + 1] <= to)) return true;
  return isCorner(curve, k);
}

function isStep({ times }: Curve, k: number): boolean {
  return times[k] === times[k - 1] || times[k] === times[k + 1];
}

function isCorner({ times, slopesIn, slopesOut, tolerance }: Curve, k: number): boolean {
  const turn = Math.abs(slopesOut[k] - slopesIn[k]);
  // A lower bound of the error of rounding off the corner over the adjacent spans.
  if (turn * Math.min(times[k] - times[k - 1], times[k + 1] - times[k]) <= 8 * tolerance) return false;
  const before = k > 1 ? Math.abs(slopesOut[k - 1] - slopesIn[k - 1]) : 0;
  const after = k + 2 < times.length ? Math.abs(slopesOut[k + 1] - slopesIn[k + 1]) : 0;
  return turn > CORNER * Math.max(before, after);
}

/** The slopes out of the first key and into the last one, or FREE. */
function endSlopes(channel: KeyedChannel, { slopesIn, slopesOut }: Curve): readonly [number, number] {
  const last = channel.times.length - 1;
  const repeats = [channel.extrapolateIn, channel.extrapolateOut].some((e) => e === 'cycle' || e === 'cycle_offset');
  if (repeats) {
    const turn = Math.abs(slopesOut[0] - slopesIn[last]);
    const around = Math.max(
      Math.abs(slopesOut[1] - slopesIn[1]),
      Math.abs(slopesOut[last - 1] - slopesIn[last - 1]),
      1e-9 * Math.abs(slopesIn[last]),
    );
    const mean = (slopesOut[0] + slopesIn[last]) / 2;
    if (turn <= CORNER * around) return [mean, mean];
  }
  // Set by hand.
  const own = ({ kinds }: Tangents, k: number, slope: number) =>
    kinds[k] === SMOOTH || kinds[k] === LINEAR ? FREE_SLOPE : slope;
  return [own(channel.tangentsOut, 0, slopesOut[0]), own(channel.tangentsIn, last, slopesIn[last])];
}

/** Restores the slopes of keys whose neighbours were kept. */
function leaveUntouched(curve: Curve, { indices, slopesIn, slopesOut }: Knots): void {
  for (let i = 1; i + 1 < indices.length; i++) {
    const k = indices[i];
    if (indices[i - 1] !== k - 1 || indices[i + 1] !== k + 1 || isStep(curve, k)) continue;
    if (!reaches(curve, k - 1, k, slopesOut[i - 1], curve.slopesIn[k])) continue;
    if (!reaches(curve, k, k + 1, curve.slopesOut[k], slopesIn[i + 1])) continue;
    slopesIn[i] = curve.slopesIn[k];
    slopesOut[i] = curve.slopesOut[k];
  }
}

function withKnots(channel: KeyedChannel, slopes: Slopes, knots: Knots): KeyedChannel {
  const taken = takeKeys(channel, knots.indices);
  return {
    ...taken,
    tangentsIn: tangentsOf(channel, channel.tangentsIn, slopes.in, knots, knots.slopesIn),
    tangentsOut: tangentsOf(channel, channel.tangentsOut, slopes.out, knots, knots.slopesOut),
  };
}

/** Tangents of one side: of the previous kind if that still gives the same slope, otherwise numbers. */
function tangentsOf(
  channel: KeyedChannel,
  side: Tangents,
  before: Float64Array,
  { indices }: Knots,
  slopes: readonly number[],
): Tangents {
  const count = indices.length;
  const made = { kinds: new Uint8Array(count), slopes: new Float64Array(count) };
  for (let i = 0; i < count; i++) {
    const k = indices[i];
    const hasPrevious = i === 0 || indices[i - 1] === k - 1;
    const hasNext = i === count - 1 || indices[i + 1] === k + 1;
    const kind = side.kinds[k];
    // At the ends both sides refer to the only adjacent span.
    const looksBack = side === channel.tangentsIn ? i > 0 : i === count - 1;
    const sameNeighbours = kind !== LINEAR ? hasPrevious && hasNext : looksBack ? hasPrevious : hasNext;
    // Across the seam of a loop an end key has a neighbour that may be another one now.
    const isSame = kind === AUTO_TANGENT ? sameNeighbours && i > 0 && i < count - 1 : sameNeighbours;
    if (slopes[i] === before[k] && (kind === FLAT || (TANGENTS[kind].follows && isSame))) {
      made.kinds[i] = kind;
    } else {
      made.kinds[i] = FIXED_TANGENT;
      made.slopes[i] = slopes[i];
    }
  }
  return made;
}
