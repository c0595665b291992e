/**
 * Fewer keys for the same curve, within a tolerance: a recording with a key a frame becomes one that can be edited.
 *
 * Keys are taken away; those left stay where they are, in time and value, and get new slopes where a neighbour went
 * (`fit.ts` says how they are chosen). What comes out is measured, exactly (`difference.ts`), against what went in.
 *
 * These stay, with a slope of their own on either side:
 * - the first and the last key, so that the period, what is added by each cycle_offset, and the value that is held are
 *   the same. Their tangents outwards keep their slopes: `linear` goes on as it did;
 * - steps (keys at one time);
 * - corners: keys where the slope breaks far more than at the keys beside it, and more than the tolerance could hide;
 * - keys outside the range, if one is given, and the first and last inside, so that the curve outside stays.
 *
 * Where the keys repeat and the seam was smooth, both its sides get one slope, and it stays smooth.
 */
import { compileChannels } from '../../evaluate/compiled-clip.ts';
import { resolvedSlopes, type Slopes } from '../../evaluate/slopes.ts';
import { FIXED_TANGENT, FLAT, type KeyedChannel, LINEAR, SMOOTH, type Tangents } from '../../model/clip.ts';
import { takeKeys } from '../keys/columns.ts';
import { type Difference, largestDifference } from './difference.ts';
import { agrees, type Curve, FREE_SLOPE, fitStretch, type Knots, reaches } from './fit.ts';

/** What simplifying came to; `largestError` is measured, and never above the tolerance. */
export interface Simplified extends Difference {
  /** The very same where no key could go. */
  readonly channel: KeyedChannel;
  readonly keysBefore: number;
  readonly keysAfter: number;
}

/** How many times the break of the keys beside it a corner's break is. */
const CORNER = 4;

/**
 * @param tolerance in the channel's own unit (radians for an angle), above 0
 * @param range seconds of the clip: only keys inside may go
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
    // Measured once more afterwards, where rounding goes another way.
    tolerance: tolerance * (1 - 1e-9),
  };
  const knots = fitAll(channel, curve, range);
  if (knots.indices.length === count) return same;
  leaveUntouched(curve, knots);
  const simplified = withKnots(channel, slopes, knots);
  const difference = largestDifference(channel, simplified);
  // A tolerance finer than doubles tell apart can't be kept.
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

/** Whether key `k` can't go. (The first and last are not asked for here; the last stays because it has none after.) */
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
  // What rounding the corner off over the spans beside it would get wrong, at the least.
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
    kinds[k] === FLAT || kinds[k] === FIXED_TANGENT ? slope : FREE_SLOPE;
  return [own(channel.tangentsOut, 0, slopesOut[0]), own(channel.tangentsIn, last, slopesIn[last])];
}

/** A key of which no neighbour went has no reason to change. */
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

/** One side's tangents: of the kind they had where that still comes to the same slope, or else numbers. */
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
    // At the ends both sides mean the one span there is.
    const looksBack = side === channel.tangentsIn ? i > 0 : i === count - 1;
    const sameNeighbours = kind === SMOOTH ? hasPrevious && hasNext : looksBack ? hasPrevious : hasNext;
    if (slopes[i] === before[k] && (kind === FLAT || ((kind === SMOOTH || kind === LINEAR) && sameNeighbours))) {
      made.kinds[i] = kind;
    } else {
      made.kinds[i] = FIXED_TANGENT;
      made.slopes[i] = slopes[i];
    }
  }
  return made;
}
