/**
 * The slope of an `auto` tangent: the same on either side of a key, and never so steep that the curve leaves the values
 * of the two keys around it (a monotone cubic after Fritsch and Carlson, 1980, limited to three times the lesser
 * secant).
 *
 *     d₀, d₁     secants to the key before and after
 *     s          (vᵢ₊₁ − vᵢ₋₁) / (tᵢ₊₁ − tᵢ₋₁)
 *     slope      0 where d₀ and d₁ differ in sign or one is 0; else s, its size at most 3 · min(|d₀|, |d₁|)
 *
 * Files say it as a number, so it is here, where readers, writers and the evaluator find it.
 */
import type { KeyedChannel, KeyedCurve } from './take.ts';
import { AUTO_TANGENT, FIXED_TANGENT } from './tangent-kinds.ts';

/** Relative difference up to which a number in a file is the formula's. */
const SAME_NUMBER = 1e-12;

/** The slope of an `auto` tangent at a key, in value per second. O(1). */
export function autoSlope(curve: KeyedCurve, key: number): number {
  const { times, values } = curve;
  const last = times.length - 1;
  if (key > 0 && key < last) return limited(times, values, key - 1, key, key, key + 1);
  return crossesSeam(curve) ? limited(times, values, last - 1, last, 0, 1) : 0;
}

/**
 * The number by which a file says an `auto` tangent: with the digits it was read with while they are still the
 * formula's within rounding, so that a file that is saved again keeps them.
 * @param read the slope beside its kind; 0 for none
 */
export function autoNumber(curve: KeyedCurve, key: number, read: number): number {
  const formula = autoSlope(curve, key);
  return !Object.is(read, 0) && isAutoSlope(read, formula) ? read : formula;
}

/**
 * Whether the first and last key are each other's neighbours: the keys repeat in both directions, and a repetition
 * begins where the one before it ends.
 */
export function crossesSeam({ times, values, extrapolateIn, extrapolateOut }: KeyedCurve): boolean {
  const last = times.length - 1;
  if (last < 1 || !(times[last] > times[0])) return false;
  const isOffset = extrapolateIn === 'cycle_offset' && extrapolateOut === 'cycle_offset';
  if (isOffset) return true;
  const goesOn = (way: string) => way === 'cycle' || way === 'cycle_offset';
  return goesOn(extrapolateIn) && goesOn(extrapolateOut) && values[0] === values[last];
}

/** Of the segments from key `a` to `b` and from `c` to `d`, which meet. */
function limited(times: Float64Array, values: Float64Array, a: number, b: number, c: number, d: number): number {
  const [before, after] = [times[b] - times[a], times[d] - times[c]];
  // Keys at one time are no neighbours.
  if (!(before > 0 && after > 0)) return 0;
  const d0 = (values[b] - values[a]) / before;
  const d1 = (values[d] - values[c]) / after;
  if (d0 === 0 || d1 === 0 || d0 > 0 !== d1 > 0) return 0;
  const isInside = b === c;
  const rise = isInside ? values[d] - values[a] : values[b] - values[a] + (values[d] - values[c]);
  const s = rise / (isInside ? times[d] - times[a] : before + after);
  const most = 3 * Math.min(Math.abs(d0), Math.abs(d1));
  const slope = Math.abs(s) > most ? Math.sign(s) * most : s;
  return Number.isFinite(slope) ? slope : 0;
}

/**
 * The channel as read from a file, where `auto` is a number: numeric tangents that are the formula's become `auto`. One
 * of 0 does so only if another that isn't 0 does, or if all numbers of the channel are the formula's: zeros are written
 * for many reasons. Digits that are not the formula's own stay beside the kind (`autoNumber`). The same object if none
 * changes.
 */
export function withAutoRecognised(channel: KeyedChannel): KeyedChannel {
  const { times, tangentsIn, tangentsOut } = channel;
  let isAny = false;
  let areAll = true;
  let isSloped = false;
  const sides = [tangentsIn, tangentsOut];
  for (let k = 0; k < times.length; k++) {
    for (const { kinds, slopes } of sides) {
      if (kinds[k] !== FIXED_TANGENT) continue;
      const is = isAutoSlope(slopes[k], autoSlope(channel, k));
      isAny ||= is;
      areAll &&= is;
      isSloped ||= is && slopes[k] !== 0;
    }
  }
  if (!isAny) return channel;
  const recognised = ({ kinds, slopes }: KeyedChannel['tangentsIn']) => {
    const made = { kinds: kinds.slice(), slopes: slopes.slice() };
    for (let k = 0; k < kinds.length; k++) {
      if (kinds[k] !== FIXED_TANGENT || !isAutoSlope(slopes[k], autoSlope(channel, k))) continue;
      if (slopes[k] === 0 && !isSloped && !areAll) continue;
      made.kinds[k] = AUTO_TANGENT;
      made.slopes[k] = Object.is(slopes[k], autoSlope(channel, k)) ? 0 : slopes[k];
    }
    return made;
  };
  return { ...channel, tangentsIn: recognised(tangentsIn), tangentsOut: recognised(tangentsOut) };
}

function isAutoSlope(x: number, formula: number): boolean {
  return Math.abs(x - formula) <= SAME_NUMBER * Math.max(Math.abs(x), Math.abs(formula));
}
