/**
 * Bakes a channel's extrapolation to keys.
 *
 *     keys            ╱│               P = t_last − t_first
 *     cycle        ╱│╱│╱│╱             copies; where the value jumps, two keys at one time
 *     cycle_offset   … each higher by v_last − v_first
 *     bounce       ╲╱╲╱                every other copy mirrored in time: in and out tangents are swapped and negated
 *     linear       one key, at the end
 *     constant     none needed
 *
 * A copied key keeps its kinds of tangents, since its neighbours are copies too. Only keys with other neighbours (at a
 * seam, and next to a cut) have `smooth` and `linear` replaced by the resulting slopes. An end inside a copy gets a key
 * on the curve; an end on a seam ends the period before it, as t_last does.
 *
 * The time before the keys is handled as that after them, for the channel mirrored in time.
 */
import { resolvedSlopes, type Slopes } from '../../evaluate/slopes.ts';
import { hermiteCubic } from '../../math/hermite.ts';
import { type Extrapolation, type KeyedChannel, repeats } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import { type Key, keyAt, type Tangent, tangent, withKeyList } from '../keys/columns.ts';
import { frozen, frozenTangent, meets, type Sloped, slopedKey, withSeamFrozen } from './sloped-key.ts';

/** A channel whose extrapolation is baked, with the numbers of its keys. */
export interface Baked {
  readonly channel: KeyedChannel;
  readonly keysBefore: number;
  readonly keysAfter: number;
  /** Whether a side that was not baked still repeats the keys: since they changed, it now looks different. */
  readonly periodChanged: boolean;
}

/** A short period over a long time could require any number of keys. */
const MAX_KEYS = 1_000_000;

/**
 * The channel with keys for its extrapolation from `from` to `to` (seconds of the take), where it looks as before. A
 * side within the keys, or constant, is not changed; the same object if neither changes.
 *
 * Beyond its new keys, a baked side stays `linear`, but repetitions become `constant`, since they would now repeat all
 * the keys. Throws a `CommandError` if it would take more than a million keys.
 */
export function withExtrapolationBaked(channel: KeyedChannel, from: number, to: number): Baked {
  const baked = extended(channel, from, to, false);
  return {
    channel: baked,
    keysBefore: channel.times.length,
    keysAfter: baked.times.length,
    periodChanged: baked !== channel && (repeats(baked.extrapolateIn) || repeats(baked.extrapolateOut)),
  };
}

/**
 * The channel with baked extrapolation and a key at both ends even for constant extrapolation, so that all of `from` to
 * `to` lies between keys.
 */
export function unrolled(channel: KeyedChannel, from: number, to: number): KeyedChannel {
  return extended(channel, from, to, true);
}

function extended(given: KeyedChannel, from: number, to: number, holds: boolean): KeyedChannel {
  const count = given.times.length;
  if (count === 0) return given;
  const channel = withSeamFrozen(given);
  const after = tail(channel, to, holds);
  const before = tail(mirrored(channel), -from, holds);
  if (!after && !before) return given;
  const keys: Key[] = before ? before.keys.map(mirroredKey).reverse() : [];
  const first = before ? count - before.index : 0;
  const end = after ? after.index : count;
  for (let k = first; k < end; k++) keys.push(keyAt(channel, k));
  after?.keys.forEach((key, i) => {
    // A single key already has the side before it; here is the side after it.
    if (i === 0 && first > end) keys.push({ ...key, in: keys.pop()?.in ?? key.in });
    else keys.push(key);
  });
  // A side that could not repeat for lack of a period must not start to now.
  const isStill = !(channel.times[count - 1] > channel.times[0]);
  const goesOn = (side: Extrapolation, isBaked: boolean) =>
    (isBaked || isStill) && side !== 'linear' ? 'constant' : side;
  return {
    ...withKeyList(channel, keys),
    extrapolateIn: goesOn(channel.extrapolateIn, before !== undefined),
    extrapolateOut: goesOn(channel.extrapolateOut, after !== undefined),
  };
}

/** Keys that replace a channel's from `index` on. */
interface Tail {
  readonly index: number;
  readonly keys: readonly Key[];
}

/** Keys for what follows up to `to`; undefined if none are needed. */
function tail(channel: KeyedChannel, to: number, holds: boolean): Tail | undefined {
  const last = channel.times.length - 1;
  const end = channel.times[last];
  if (!(to - end > roundingOf(channel, to))) return undefined;
  const slopes = resolvedSlopes(channel);
  const period = end - channel.times[0];
  const kind = channel.extrapolateOut;
  if (kind === 'linear') {
    const slope = slopes.out[last];
    const value = channel.values[last] + slope * (to - end);
    if (!Number.isFinite(value)) return undefined;
    const straight = tangent(FIXED_TANGENT, slope);
    const key = { ...frozen(slopedKey(channel, slopes, last)), out: straight };
    return { index: last, keys: [key, { time: to, value, in: straight, out: straight }] };
  }
  if (kind === 'constant' || !(period > 0 && Number.isFinite(period))) {
    if (!holds) return undefined;
    const flat = tangent(FLAT);
    const key = { ...frozen(slopedKey(channel, slopes, last)), out: flat };
    return { index: last, keys: [key, { time: to, value: key.value, in: flat, out: flat }] };
  }
  return repetitions(channel, slopes, period, to);
}

/** Copies of the keys after them, the last one cut at `to`. */
function repetitions(channel: KeyedChannel, slopes: Slopes, period: number, to: number): Tail {
  const last = channel.times.length - 1;
  const start = channel.times[0];
  const stop = channel.times[last];
  // Of several keys at one end only the innermost borders on a span.
  let first = 0;
  while (channel.times[first + 1] === start) first++;
  let end = last;
  while (channel.times[end - 1] === stop) end--;
  const count = Math.ceil((to - stop) / period);
  if (count * (end - first) > MAX_KEYS) {
    throw new CommandError(`That would take ${count} repetitions of ${end - first} keys, which is too many.`);
  }
  const offset = channel.extrapolateOut === 'cycle_offset' ? channel.values[last] - channel.values[0] : 0;
  const rounding = roundingOf(channel, to);

  const keys: Sloped[] = [frozen(slopedKey(channel, slopes, end))];
  for (let p = 1; p <= count; p++) {
    const turned = channel.extrapolateOut === 'bounce' && p % 2 === 1;
    for (let k = first; k <= end; k++) {
      const source = slopedKey(channel, slopes, turned ? end + first - k : k);
      let key = shiftedKey(turned ? turnedKey(source) : source, turned, period * p, offset * p, start, stop);
      if (k === first || k === end) key = frozen(key);
      const before = keys[keys.length - 1];
      if (k === first) {
        if (key.time > to - rounding) return { index: end, keys };
        if (meets(before.value, key.value)) {
          keys[keys.length - 1] = { ...before, out: key.out, slopeOut: key.slopeOut };
        } else keys.push({ ...key, time: before.time });
      } else if (key.time < to - rounding) {
        keys.push(key);
      } else if (key.time <= to + rounding) {
        keys.push(frozen(key));
        // The later keys of a step belong to it; a seam has none.
        if (k === end || nextTime(channel, turned, end + first - k, k) !== 0) return { index: end, keys };
      } else {
        if (before.time < to - rounding) {
          keys[keys.length - 1] = { ...before, ...beforeCut(before) };
          keys.push(keyBetween(before, key, to));
        }
        return { index: end, keys };
      }
    }
  }
  return { index: end, keys };
}

/** Times closer than this are the same, as in the evaluator. */
function roundingOf({ times }: KeyedChannel, time: number): number {
  return 4 * Number.EPSILON * Math.max(Math.abs(time), Math.abs(times[0]), Math.abs(times[times.length - 1]));
}

/** Seconds from a copied key to the next one of its copy. */
function nextTime({ times }: KeyedChannel, turned: boolean, mirror: number, k: number): number {
  return turned ? times[mirror] - times[mirror - 1] : times[k + 1] - times[k];
}

/** A key of repetition `p`; for mirrored ones the tangents are already mirrored, and the time is mirrored here. */
function shiftedKey(key: Sloped, turned: boolean, seconds: number, value: number, start: number, stop: number): Sloped {
  const time = turned ? start + (stop - key.time) : key.time;
  return { ...key, time: time + seconds, value: key.value + value };
}

/** The key mirrored in time: in and out swapped, slopes negated. */
function turnedKey(key: Sloped): Sloped {
  return {
    ...key,
    in: tangent(key.out.kind, 0 - key.out.slope),
    out: tangent(key.in.kind, 0 - key.in.slope),
    slopeIn: 0 - key.slopeOut,
    slopeOut: 0 - key.slopeIn,
  };
}

/** `linear` is kept towards an unchanged neighbour. */
function beforeCut(key: Sloped): { readonly in: Tangent; readonly out: Tangent } {
  return {
    in: key.in.kind === LINEAR ? key.in : frozenTangent(key.in, key.slopeIn),
    out: frozenTangent(key.out, key.slopeOut),
  };
}

/** A key at `time` on the curve between two others. */
function keyBetween(before: Sloped, after: Sloped, time: number): Sloped {
  const cubic = new Float64Array(4);
  hermiteCubic(before.value, before.slopeOut, after.value, after.slopeIn, after.time - before.time, cubic, 0);
  const t = time - before.time;
  const value = ((cubic[3] * t + cubic[2]) * t + cubic[1]) * t + cubic[0];
  const slope = (3 * cubic[3] * t + 2 * cubic[2]) * t + cubic[1];
  const side = tangent(FIXED_TANGENT, slope);
  return { time, value, in: side, out: side, slopeIn: slope, slopeOut: slope };
}

/** The channel mirrored in time. */
function mirrored(channel: KeyedChannel): KeyedChannel {
  const keys: Key[] = [];
  for (let k = channel.times.length - 1; k >= 0; k--) keys.push(mirroredKey(keyAt(channel, k)));
  return {
    ...withKeyList(channel, keys),
    extrapolateIn: channel.extrapolateOut,
    extrapolateOut: channel.extrapolateIn,
  };
}

function mirroredKey(key: Key): Key {
  return {
    time: 0 - key.time,
    value: key.value,
    in: tangent(key.out.kind, 0 - key.out.slope),
    out: tangent(key.in.kind, 0 - key.in.slope),
  };
}
