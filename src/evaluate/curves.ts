/**
 * Channels, compiled to cubics and evaluated at any time.
 *
 *     value
 *       │      extrapolate in   │ spans between keys │   extrapolate out
 *       │                     t_first             t_last
 *       │   … period −2, −1     │      period 0      │   period 1, 2 …
 *       └───────────────────────┴────────────────────┴────────────────── time
 *
 * A key's cubic holds from that key up to the next one; the last key's is its own value. All channels of a clip are
 * packed into a handful of typed arrays, so that a pose walks through memory once and allocates nothing, and one value
 * costs a binary search and a cubic. (A linked list of span objects costs a cache miss a step; a cursor that remembers
 * the last span makes playing cheaper by little, and scrubbing, many instances and exports dearer.)
 *
 * A time that is no finite number gives the value of the key at that end, NaN that of the first key.
 */
import { lastNotAbove } from '../math/search.ts';
import { EXTRAPOLATIONS } from '../model/clip.ts';
import type { CompiledClip } from './compiled-clip.ts';
import { columnSlope, sampleColumn } from './sampling.ts';

const CONSTANT = EXTRAPOLATIONS.indexOf('constant');
const LINEAR = EXTRAPOLATIONS.indexOf('linear');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');

/** A channel's value at a time; 0 where it has neither keys nor a rest. O(log keys), without allocating. */
export function evaluateChannel(clip: CompiledClip, channel: number, timeSeconds: number): number {
  const { firstKey, times } = clip;
  const first = firstKey[channel];
  const end = firstKey[channel + 1];
  if (clip.samples && clip.columns[channel] >= 0) return sampleColumn(clip.samples, clip.columns[channel], timeSeconds);
  if (first === end) return 0;
  const key = lastNotAbove(times, first, end, timeSeconds);
  const since = timeSeconds - times[key];
  // Before the first key it is negative, for NaN neither; after the last key it is more than 0 there.
  if (since >= 0 && (since === 0 || key + 1 < end)) return cubic(clip.cubics, key, since);
  return outside(clip, channel, first, end, timeSeconds);
}

/**
 * The first `count` channels at a time: `out[c]` for channel c. The same as `evaluateChannel` for each, written out so
 * that arrays are looked up once: a pose is mostly short channels, whose search is over in two steps. Those that follow
 * samples are 0: between frames their values depend on each other, and on the joints (`sampled-pose.ts`).
 */
export function evaluateClip(
  clip: CompiledClip,
  timeSeconds: number,
  out: Float64Array,
  count: number = clip.channelCount,
): void {
  const { firstKey, times, cubics } = clip;
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
    } else out[c] = outside(clip, c, first, end, timeSeconds);
  }
}

function cubic(cubics: Float64Array, key: number, t: number): number {
  const o = 4 * key;
  return ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + cubics[o];
}

/** At a time between the first and the last key. */
function inside({ times, cubics }: CompiledClip, first: number, end: number, time: number): number {
  const key = lastNotAbove(times, first, end, time);
  return cubic(cubics, key, time - times[key]);
}

function outside(clip: CompiledClip, channel: number, first: number, end: number, time: number): number {
  const { times, cubics, beyond } = clip;
  const before = !(time > times[end - 1]);
  const endKey = before ? first : end - 1;
  const code = clip.extrapolations[2 * channel + (before ? 0 : 1)];
  const endValue = cubics[4 * endKey];
  if (code === CONSTANT || !Number.isFinite(time)) return endValue;
  const value =
    code === LINEAR
      ? endValue + beyond[4 * channel + (before ? 2 : 3)] * (time - times[endKey])
      : repeated(clip, channel, code, first, end, time);
  return Number.isFinite(value) ? value : endValue;
}

/**
 * The value in a repetition of the keys: `period` says in which one, `since` how far into it.
 *
 *     time = t_first + period · P + since        0 ≤ since < P
 */
function repeated(clip: CompiledClip, channel: number, code: number, first: number, end: number, time: number): number {
  const { times, beyond } = clip;
  const start = times[first];
  const stop = times[end - 1];
  const period = locate(start, stop, beyond[4 * channel], time);
  if (code === BOUNCE) {
    const mirrored = period % 2 !== 0;
    return inside(
      clip,
      first,
      end,
      mirrored ? Math.max(start, stop - sinceStart[0]) : Math.min(stop, start + sinceStart[0]),
    );
  }
  const value = inside(clip, first, end, Math.min(stop, start + sinceStart[0]));
  return code === CYCLE_OFFSET ? value + period * beyond[4 * channel + 1] : value;
}

/** How far into its repetition a time is; scratch of `locate`. */
const sinceStart = new Float64Array(1);

/** In which repetition a time is, and in `sinceStart` how far into it. */
function locate(start: number, stop: number, length: number, time: number): number {
  let period = Math.floor((time - start) / length);
  let rest = time - start - period * length;
  // A boundary that rounding missed by a few units in the last place is that boundary: 10 frames are 10 frames.
  const rounding = 4 * Number.EPSILON * Math.max(Math.abs(time), Math.abs(start), Math.abs(stop));
  if (rest >= length - rounding) {
    period++;
    rest = 0;
  } else if (rest < rounding) rest = 0;
  sinceStart[0] = rest;
  return period;
}

/**
 * A channel's slope at a time, in value per second: the derivative of `evaluateChannel`. Where the curve has a corner
 * or a step, at a key or where a repetition begins, `side` says whether the one before or after it is meant.
 */
export function evaluateSlope(clip: CompiledClip, channel: number, timeSeconds: number, side: 'in' | 'out'): number {
  const { firstKey, times, beyond, samples, columns } = clip;
  if (samples && columns[channel] >= 0) return columnSlope(samples, columns[channel], timeSeconds, side);
  const first = firstKey[channel];
  const end = firstKey[channel + 1];
  if (first === end || !Number.isFinite(timeSeconds)) return 0;
  const start = times[first];
  const stop = times[end - 1];
  const isBefore = side === 'in' ? timeSeconds <= start : timeSeconds < start;
  const isAfter = side === 'in' ? timeSeconds > stop : timeSeconds >= stop;
  if (!isBefore && !isAfter) return slopeInside(clip, first, end, timeSeconds, side);
  const code = clip.extrapolations[2 * channel + (isBefore ? 0 : 1)];
  if (code === CONSTANT) return 0;
  if (code === LINEAR) return beyond[4 * channel + (isBefore ? 2 : 3)];
  const length = beyond[4 * channel];
  let period = locate(start, stop, length, timeSeconds);
  if (side === 'in' && sinceStart[0] === 0) {
    // Before a boundary is the end of the repetition that comes to it.
    period--;
    sinceStart[0] = length;
  }
  if (code === BOUNCE && period % 2 !== 0) {
    const mirrored = Math.min(stop, Math.max(start, stop - sinceStart[0]));
    return -slopeInside(clip, first, end, mirrored, side === 'in' ? 'out' : 'in');
  }
  return slopeInside(clip, first, end, Math.min(stop, start + sinceStart[0]), side);
}

/** At a time that has a segment on that side. */
function slopeInside(clip: CompiledClip, first: number, end: number, time: number, side: 'in' | 'out'): number {
  const { times, cubics } = clip;
  let key = lastNotAbove(times, first, end, time);
  if (side === 'in') while (key > first && times[key] >= time) key--;
  const o = 4 * key;
  const t = time - times[key];
  return (3 * cubics[o + 3] * t + 2 * cubics[o + 2]) * t + cubics[o + 1];
}
