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
import { hermiteCubic } from '../math/hermite.ts';
import { lastNotAbove } from '../math/search.ts';
import {
  type Channel,
  type ChannelClip,
  EXTRAPOLATIONS,
  type Extrapolation,
  FIXED,
  FLAT,
  LINEAR as LINEAR_TANGENT,
  SMOOTH,
  type Tangents,
} from '../model/clip.ts';

/**
 * A clip ready to be evaluated. Its keys are those of the channels, one after the other; a channel that stands at a
 * value without keys has one here.
 */
export interface CompiledClip {
  readonly channelCount: number;
  /** One more than there are channels: channel c has the keys `firstKey[c]` up to (not including) `firstKey[c + 1]`. */
  readonly firstKey: Int32Array;
  /** Seconds, a key. */
  readonly times: Float64Array;
  /** Four a key: a, b, c, d of `math/hermite.ts`, in the time since the key. `a` is the key's value. */
  readonly cubics: Float64Array;
  /** Two a channel: what holds before and after its keys, as an index into EXTRAPOLATIONS. */
  readonly extrapolations: Uint8Array;
  /** Four a channel: the period in seconds, how far the value gets in one, slope before and slope after the keys. */
  readonly beyond: Float64Array;
}

const CONSTANT = EXTRAPOLATIONS.indexOf('constant');
const LINEAR = EXTRAPOLATIONS.indexOf('linear');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');

/**
 * Compiled forms live as long as someone plays them, not as long as their clip: the history keeps clips by the hundred,
 * each of which would hold on to megabytes for the sake of the one channel that its step changed.
 */
const compiled = new WeakMap<ChannelClip, WeakRef<CompiledClip>>();
/** Where a channel was compiled last: an edit of one channel copies all others from there. */
const homes = new WeakMap<Channel, { readonly clip: WeakRef<CompiledClip>; readonly index: number }>();

/** The clip compiled last, which may be the one before an edit. */
let latest: WeakRef<ChannelClip> | undefined;

/** The clip's compiled form, made anew only where nobody holds it any more. */
export function compileClip(clip: ChannelClip): CompiledClip {
  const known = compiled.get(clip)?.deref();
  if (known) return known;
  const made = pack(clip.channels, latest?.deref()?.channels);
  const reference = new WeakRef(made);
  compiled.set(clip, reference);
  latest = new WeakRef(clip);
  clip.channels.forEach((channel, index) => {
    homes.set(channel, { clip: reference, index });
  });
  return made;
}

/** Compiles channels that belong to no clip (not cached). */
export function compileChannels(channels: readonly Channel[]): CompiledClip {
  return pack(channels);
}

/** @param before the channels of a clip of which these may be an edit */
function pack(channels: readonly Channel[], before?: readonly Channel[]): CompiledClip {
  const keyCount = channels.reduce((sum, c) => sum + compiledKeyCount(c), 0);
  const made: CompiledClip = {
    channelCount: channels.length,
    firstKey: new Int32Array(channels.length + 1),
    times: new Float64Array(keyCount),
    cubics: new Float64Array(4 * keyCount),
    extrapolations: new Uint8Array(2 * channels.length),
    beyond: new Float64Array(4 * channels.length),
  };
  let next = 0;
  channels.forEach((channel, index) => {
    made.firstKey[index] = next;
    const home = homes.get(channel);
    const from = home?.clip.deref();
    if (home && from) copyChannel(from, home.index, made, index);
    else compileChannel(channel, made, index, before?.[index]);
    next += compiledKeyCount(channel);
  });
  made.firstKey[channels.length] = next;
  return made;
}

function compiledKeyCount({ times, rest }: Channel): number {
  return times.length === 0 && rest !== undefined ? 1 : times.length;
}

/**
 * Compiles one channel into its place, which begins at `firstKey[index]`.
 * @param before what may have been edited into this channel: spans that are the same in both are copied
 */
function compileChannel(channel: Channel, to: CompiledClip, index: number, before?: Channel): void {
  const { cubics, extrapolations, beyond } = to;
  const next = to.firstKey[index];
  const { times, values } = channel;
  const last = times.length - 1;
  if (last < 0) {
    // Constant on both sides of a key at 0 s, as all is that was not set.
    if (channel.rest !== undefined) cubics[4 * next] = channel.rest;
    return;
  }
  to.times.set(times, next);
  const [from, end] = before ? copySameSpans(channel, before, to, next) : [0, last];
  for (let k = from; k < end; k++) {
    const h = times[k + 1] - times[k];
    const m0 = slope(channel, k, channel.tangentsOut);
    const m1 = slope(channel, k + 1, channel.tangentsIn);
    hermiteCubic(values[k], m0, values[k + 1], m1, h, cubics, 4 * (next + k));
  }
  cubics[4 * (next + last)] = values[last];
  const period = times[last] - times[0];
  extrapolations[2 * index] = extrapolationCode(channel.extrapolateIn, period);
  extrapolations[2 * index + 1] = extrapolationCode(channel.extrapolateOut, period);
  beyond[4 * index] = period;
  beyond[4 * index + 1] = values[last] - values[0];
  beyond[4 * index + 2] = slope(channel, 0, channel.tangentsIn);
  beyond[4 * index + 3] = slope(channel, last, channel.tangentsOut);
}

/** Shorter channels are compiled sooner than compared. */
const LONG_CHANNEL = 512;

/**
 * Copies the cubics of the spans around which nothing changed; a span depends on its two keys and their two neighbours.
 *
 *     keys      the same: head      others      the same: tail
 *     spans     0 … head − 3      [from, end)      count − tail + 1 … last − 1
 *
 * @returns from which span up to (not including) which the rest has to be compiled
 */
function copySameSpans(channel: Channel, before: Channel, to: CompiledClip, next: number): readonly [number, number] {
  const count = channel.times.length;
  const all = [0, count - 1] as const;
  if (count < LONG_CHANNEL || before.times.length < LONG_CHANNEL) return all;
  const home = homes.get(before);
  const source = home?.clip.deref();
  if (!home || !source) return all;
  const columns = columnsOf(channel);
  const others = columnsOf(before);
  const most = Math.min(count, before.times.length);
  let head = most;
  let tail = most;
  columns.forEach((column, c) => {
    head = sameHead(column, others[c], head);
    tail = sameTail(column, others[c], tail);
  });
  const from = Math.max(0, head - 2);
  const end = Math.max(from, count - tail + 1);
  const first = source.firstKey[home.index];
  to.cubics.set(source.cubics.subarray(4 * first, 4 * (first + from)), 4 * next);
  if (end >= count - 1) return [from, count - 1];
  const shift = before.times.length - count;
  const rest = source.cubics.subarray(4 * (first + end + shift), 4 * (first + count - 1 + shift));
  to.cubics.set(rest, 4 * (next + end));
  return [from, end];
}

type Column = Float64Array | Uint8Array;

function columnsOf({ times, values, tangentsIn, tangentsOut }: Channel): readonly Column[] {
  return [times, values, tangentsIn.kinds, tangentsIn.slopes, tangentsOut.kinds, tangentsOut.slopes];
}

/** How many elements, at most `most`, are the same from the beginning. */
function sameHead(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[same] === b[same]) same++;
  return same;
}

/** How many, at most `most`, are the same from the end. */
function sameTail(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[a.length - 1 - same] === b[b.length - 1 - same]) same++;
  return same;
}

function copyChannel(from: CompiledClip, channel: number, to: CompiledClip, index: number): void {
  const first = from.firstKey[channel];
  const end = from.firstKey[channel + 1];
  const next = to.firstKey[index];
  to.times.set(from.times.subarray(first, end), next);
  to.cubics.set(from.cubics.subarray(4 * first, 4 * end), 4 * next);
  to.extrapolations.set(from.extrapolations.subarray(2 * channel, 2 * channel + 2), 2 * index);
  to.beyond.set(from.beyond.subarray(4 * channel, 4 * channel + 4), 4 * index);
}

/** Without a period nothing can repeat. */
function extrapolationCode(extrapolation: Extrapolation, period: number): number {
  if (extrapolation !== 'linear' && !(period > 0 && Number.isFinite(period))) return CONSTANT;
  return EXTRAPOLATIONS.indexOf(extrapolation);
}

/** The slopes that a channel's tangents come to, in value per second, one a key. */
export interface Slopes {
  readonly in: Float64Array;
  readonly out: Float64Array;
}

/** What each key's tangents are as slopes: for handles, and for a key put on the curve. */
export function resolvedSlopes(channel: Channel): Slopes {
  const slopes = { in: new Float64Array(channel.times.length), out: new Float64Array(channel.times.length) };
  for (let k = 0; k < channel.times.length; k++) {
    slopes.in[k] = slope(channel, k, channel.tangentsIn);
    slopes.out[k] = slope(channel, k, channel.tangentsOut);
  }
  return slopes;
}

/** The slope that one side of a key's tangents comes to, in value per second. */
export function keySlope(channel: Channel, key: number, side: 'in' | 'out'): number {
  return slope(channel, key, side === 'in' ? channel.tangentsIn : channel.tangentsOut);
}

/** Slope of key `k` on the side whose tangents are given. */
function slope(channel: Channel, k: number, side: Tangents): number {
  const last = channel.times.length - 1;
  const kind = side.kinds[k];
  if (kind === FLAT) return 0;
  if (kind === FIXED) return side.slopes[k];
  // The ends have one neighbour, so there both kinds and both sides mean the same segment.
  if (k === 0) return secant(channel, 0, Math.min(1, last));
  if (k === last) return secant(channel, last - 1, last);
  if (kind === SMOOTH) return secant(channel, k - 1, k + 1);
  return kind === LINEAR_TANGENT && side === channel.tangentsIn ? secant(channel, k - 1, k) : secant(channel, k, k + 1);
}

/** 0 between keys at one time, and where the slope is no number that doubles hold. */
function secant(channel: Channel, from: number, to: number): number {
  const s = (channel.values[to] - channel.values[from]) / (channel.times[to] - channel.times[from]);
  return Number.isFinite(s) ? s : 0;
}

/** A channel's value at a time; 0 where it has neither keys nor a rest. O(log keys), without allocating. */
export function evaluateChannel(clip: CompiledClip, channel: number, timeSeconds: number): number {
  const { firstKey, times } = clip;
  const first = firstKey[channel];
  const end = firstKey[channel + 1];
  if (first === end) return 0;
  const key = lastNotAbove(times, first, end, timeSeconds);
  const since = timeSeconds - times[key];
  // Before the first key it is negative, for NaN neither; after the last key it is more than 0 there.
  if (since >= 0 && (since === 0 || key + 1 < end)) return cubic(clip.cubics, key, since);
  return outside(clip, channel, first, end, timeSeconds);
}

/**
 * The first `count` channels at a time: `out[c]` for channel c. The same as `evaluateChannel` for each, written out so
 * that arrays are looked up once: a pose is mostly short channels, whose search is over in two steps.
 */
export function evaluateClip(
  clip: CompiledClip,
  timeSeconds: number,
  out: Float64Array,
  count: number = clip.channelCount,
): void {
  const { firstKey, times, cubics } = clip;
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
  const { firstKey, times, beyond } = clip;
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
