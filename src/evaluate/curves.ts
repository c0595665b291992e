/**
 * Evaluates compiled channels at any time.
 *
 *     value
 *       │      extrapolate in   │ spans between keys │   extrapolate out
 *       │                     t_first             t_last
 *       │   … period −2, −1     │      period 0      │   period 1, 2 …
 *       └───────────────────────┴────────────────────┴────────────────── time
 *
 * A key's cubic applies up to the next key; the last key's is its value. All channels of a take are packed into a few
 * typed arrays, so that a pose reads memory once in order and allocates nothing; a value costs a binary search and a
 * cubic. (A linked list of spans costs a cache miss per step. A cursor that remembers the last span makes playback
 * slightly cheaper, but scrubbing, many instances and exports more expensive.)
 *
 * An infinite time gives the value of the key at that end; NaN that of the first key.
 */
import { lastNotAbove } from '../math/search.ts';
import { EXTRAPOLATIONS } from '../model/takes/take.ts';
import type { CompiledTake } from './compiled-take.ts';
import { columnSlope, sampleColumn } from './samples/sampling.ts';

const CONSTANT = EXTRAPOLATIONS.indexOf('constant');
const LINEAR = EXTRAPOLATIONS.indexOf('linear');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');

/** A channel's value at a time; 0 for a channel without keys or rest value. O(log keys), without allocating. */
export function evaluateChannel(take: CompiledTake, channel: number, timeSeconds: number): number {
  const { firstKey, times } = take;
  const first = firstKey[channel];
  const end = firstKey[channel + 1];
  if (take.samples && take.columns[channel] >= 0) return sampleColumn(take.samples, take.columns[channel], timeSeconds);
  if (first === end) return 0;
  const key = lastNotAbove(times, first, end, timeSeconds);
  const since = timeSeconds - times[key];
  // Negative before the first key, and false for NaN; greater than 0 after the last key.
  if (since >= 0 && (since === 0 || key + 1 < end)) return cubic(take.cubics, key, since);
  return outside(take, channel, first, end, timeSeconds);
}

/**
 * The first `count` channels at a time: `out[c]` for channel c. Same as `evaluateChannel` for each, but inlined so that
 * arrays are looked up once: most channels of a pose are short, with a search of two steps. Sampled channels get 0,
 * since their values between frames depend on each other and on the joints (`sampled-pose.ts`).
 */
export function evaluateTake(
  take: CompiledTake,
  timeSeconds: number,
  out: Float64Array,
  count: number = take.channelCount,
): void {
  const { firstKey, times, cubics } = take;
  if (times.length === 0) {
    out.fill(0, 0, count);
    return;
  }
  let end = 0;
  for (let c = 0; c < count; c++) {
    const first = end;
    end = firstKey[c + 1];
    let key = first;
    let left = end - first;
    while (left > 1) {
      const half = left >>> 1;
      if (times[key + half] <= timeSeconds) key += half;
      left -= half;
    }
    const since = timeSeconds - times[key];
    const o = 4 * key;
    if (first === end) out[c] = 0;
    else if (since >= 0 && (since === 0 || key + 1 < end)) {
      out[c] = ((cubics[o + 3] * since + cubics[o + 2]) * since + cubics[o + 1]) * since + cubics[o];
    } else out[c] = outside(take, c, first, end, timeSeconds);
  }
}

function cubic(cubics: Float64Array, key: number, t: number): number {
  const o = 4 * key;
  return ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
}

/** For times from the first to the last key. */
function inside({ times, cubics }: CompiledTake, first: number, end: number, time: number): number {
  const key = lastNotAbove(times, first, end, time);
  return cubic(cubics, key, time - times[key]);
}

function outside(take: CompiledTake, channel: number, first: number, end: number, time: number): number {
  const { times, cubics, beyond } = take;
  const before = !(time > times[end - 1]);
  const endKey = before ? first : end - 1;
  const code = take.extrapolations[2 * channel + (before ? 0 : 1)];
  const endValue = cubics[4 * endKey];
  if (code === CONSTANT || !Number.isFinite(time)) return endValue;
  const value =
    code === LINEAR
      ? endValue + beyond[4 * channel + (before ? 2 : 3)] * (time - times[endKey])
      : repeated(take, channel, code, first, end, time);
  return Number.isFinite(value) ? value : endValue;
}

/**
 * The value in a repetition of the keys: `period` says in which one, `since` how far into it.
 *
 *     time = t_first + period · P + since        0 ≤ since < P
 */
function repeated(take: CompiledTake, channel: number, code: number, first: number, end: number, time: number): number {
  const { times, beyond } = take;
  const start = times[first];
  const stop = times[end - 1];
  const period = locate(start, stop, beyond[4 * channel], time);
  if (code === BOUNCE) {
    const mirrored = period % 2 !== 0;
    return inside(
      take,
      first,
      end,
      mirrored ? Math.max(start, stop - sinceStart[0]) : Math.min(stop, start + sinceStart[0]),
    );
  }
  const value = inside(take, first, end, Math.min(stop, start + sinceStart[0]));
  return code === CYCLE_OFFSET ? value + period * beyond[4 * channel + 1] : value;
}

/** Scratch of `locate`: time since the start of the repetition. */
const sinceStart = new Float64Array(1);

/** The repetition that a time falls into; writes the time since its start to `sinceStart`. */
function locate(start: number, stop: number, length: number, time: number): number {
  let period = Math.floor((time - start) / length);
  let rest = time - start - period * length;
  // Snaps to a boundary that is missed only by rounding: 10 frames are 10 frames.
  const rounding = 4 * Number.EPSILON * Math.max(Math.abs(time), Math.abs(start), Math.abs(stop));
  if (rest >= length - rounding) {
    period++;
    rest = 0;
  } else if (rest < rounding) rest = 0;
  sinceStart[0] = rest;
  return period;
}

/** The repetition of keys from `start` to `stop` that a time falls into, and how many seconds into it. */
export function repetitionAt(
  start: number,
  stop: number,
  time: number,
): { readonly period: number; readonly since: number } {
  const period = locate(start, stop, stop - start, time);
  return { period, since: sinceStart[0] };
}

/**
 * A channel's slope at a time, in value per second: the derivative of `evaluateChannel`. At corners and steps, on a key
 * or where a repetition begins, `side` selects the slope before or after it.
 */
export function evaluateSlope(take: CompiledTake, channel: number, timeSeconds: number, side: 'in' | 'out'): number {
  const { firstKey, times, beyond, samples, columns } = take;
  if (samples && columns[channel] >= 0) return columnSlope(samples, columns[channel], timeSeconds, side);
  const first = firstKey[channel];
  const end = firstKey[channel + 1];
  if (first === end || !Number.isFinite(timeSeconds)) return 0;
  const start = times[first];
  const stop = times[end - 1];
  const isBefore = side === 'in' ? timeSeconds <= start : timeSeconds < start;
  const isAfter = side === 'in' ? timeSeconds > stop : timeSeconds >= stop;
  if (!isBefore && !isAfter) return slopeInside(take, first, end, timeSeconds, side);
  const code = take.extrapolations[2 * channel + (isBefore ? 0 : 1)];
  if (code === CONSTANT) return 0;
  if (code === LINEAR) return beyond[4 * channel + (isBefore ? 2 : 3)];
  const length = beyond[4 * channel];
  let period = locate(start, stop, length, timeSeconds);
  if (side === 'in' && sinceStart[0] === 0) {
    // Before a boundary is the end of the previous repetition.
    period--;
    sinceStart[0] = length;
  }
  if (code === BOUNCE && period % 2 !== 0) {
    const mirrored = Math.min(stop, Math.max(start, stop - sinceStart[0]));
    return -slopeInside(take, first, end, mirrored, side === 'in' ? 'out' : 'in');
  }
  return slopeInside(take, first, end, Math.min(stop, start + sinceStart[0]), side);
}

/** For a time that has a segment on that side. */
function slopeInside(take: CompiledTake, first: number, end: number, time: number, side: 'in' | 'out'): number {
  const { times, cubics } = take;
  let key = lastNotAbove(times, first, end, time);
  if (side === 'in') while (key > first && times[key] >= time) key--;
  const o = 4 * key;
  const t = time - times[key];
  return (3 * cubics[o + 3] * t + 2 * cubics[o + 2]) * t + cubics[o + 1];
}
