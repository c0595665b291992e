/**
 * Compiles takes for evaluation: all channels packed into a few typed arrays, each span as a cubic.
 *
 * An edit makes a new take of mostly the same channels, and a new channel of mostly the same keys; unchanged compiled
 * data is copied.
 */
import { hermiteCubic } from '../math/hermite.ts';
import { columnOf, type Samples } from '../model/takes/samples.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type KeyedChannel,
  type Motion,
  type Take,
} from '../model/takes/take.ts';
import { slope } from './slopes.ts';

/**
 * A take ready for evaluation. It contains the keys of all channels in order; a channel at rest at a value other than 0
 * has one key here.
 */
export interface CompiledTake {
  readonly channelCount: number;
  /** One more than the number of channels: channel c has the keys `firstKey[c]` up to (excluding) `firstKey[c + 1]`. */
  readonly firstKey: Int32Array;
  /** Seconds, one per key. */
  readonly times: Float64Array;
  /** Four per key: a, b, c, d of `math/hermite.ts`, in the time since the key. `a` is the key's value. */
  readonly cubics: Float64Array;
  /** Two per channel: extrapolation before and after its keys, as indices into EXTRAPOLATIONS. */
  readonly extrapolations: Uint8Array;
  /**
   * Four per channel: the period in seconds, the value's change over one period, slope before and slope after the keys.
   */
  readonly beyond: Float64Array;
  /** The source of the sampled channels. */
  readonly samples: Samples | undefined;
  /** The column of each channel; -1 for channels that are not sampled. */
  readonly columns: Int32Array;
}

const CONSTANT = EXTRAPOLATIONS.indexOf('constant');

/**
 * Held weakly, so that compiled forms live only while in use, not as long as their takes: the history keeps hundreds of
 * takes, each of which would retain megabytes for one changed channel.
 */
const compiled = new WeakMap<Motion, WeakRef<CompiledTake>>();
/** Where a channel was last compiled; after an edit of one channel all others are copied from there. */
const homes = new WeakMap<KeyedChannel, { readonly take: WeakRef<CompiledTake>; readonly index: number }>();

/** The take compiled last, possibly the one before an edit. */
let latest: WeakRef<Motion> | undefined;

/** The compiled form of a take's own channels, without its layers; compiled again only after it was collected. */
export function compileTake(take: Take | Motion): CompiledTake {
  const known = compiled.get(take)?.deref();
  if (known) return known;
  const made = pack(take, latest?.deref()?.channels);
  const reference = new WeakRef(made);
  compiled.set(take, reference);
  latest = new WeakRef(take);
  take.channels.forEach((channel, index) => {
    if (channel.kind === 'keys') homes.set(channel, { take: reference, index });
  });
  return made;
}

/** Compiles channels that belong to no take (not cached). */
export function compileChannels(channels: readonly Channel[]): CompiledTake {
  return pack({ channels });
}

/** @param before the channels of a take of which these may be an edit */
function pack(take: Motion, before?: readonly Channel[]): CompiledTake {
  const { channels, samples } = take;
  const keyCount = channels.reduce((sum, c) => sum + compiledKeyCount(c), 0);
  const made: CompiledTake = {
    channelCount: channels.length,
    firstKey: new Int32Array(channels.length + 1),
    times: new Float64Array(keyCount),
    cubics: new Float64Array(4 * keyCount),
    extrapolations: new Uint8Array(2 * channels.length),
    beyond: new Float64Array(4 * channels.length),
    samples,
    columns: Int32Array.from(channels, ({ kind }, c) => (kind === 'samples' ? columnOf(samples, c) : -1)),
  };
  let next = 0;
  channels.forEach((channel, index) => {
    made.firstKey[index] = next;
    if (channel.kind === 'keys') compileOrCopy(channel, made, index, before?.[index]);
    // Constant on both sides of a key at 0 s, like everything unset.
    else if (compiledKeyCount(channel) > 0) made.cubics[4 * next] = channel.kind === 'rest' ? channel.value : 0;
    next += compiledKeyCount(channel);
  });
  made.firstKey[channels.length] = next;
  return made;
}

function compiledKeyCount(channel: Channel): number {
  if (channel.kind === 'keys') return channel.times.length;
  return channel.kind === 'rest' && channel.value !== 0 ? 1 : 0;
}

function compileOrCopy(channel: KeyedChannel, to: CompiledTake, index: number, before?: Channel): void {
  const home = homes.get(channel);
  const from = home?.take.deref();
  if (home && from) copyChannel(from, home.index, to, index);
  else compileChannel(channel, to, index, before);
}

/**
 * Compiles one channel into its place, from `firstKey[index]`.
 * @param before the channel this may be an edit of: spans that are the same in both are copied
 */
function compileChannel(channel: KeyedChannel, to: CompiledTake, index: number, before?: Channel): void {
  const { cubics, extrapolations, beyond } = to;
  const next = to.firstKey[index];
  const { times, values } = channel;
  const last = times.length - 1;
  to.times.set(times, next);
  const [from, end] = before?.kind === 'keys' ? copySameSpans(channel, before, to, next) : [0, last];
  const compileSpan = (k: number) => {
    const h = times[k + 1] - times[k];
    const m0 = slope(channel, k, channel.tangentsOut);
    const m1 = slope(channel, k + 1, channel.tangentsIn);
    hermiteCubic(values[k], m0, values[k + 1], m1, h, cubics, 4 * (next + k));
  };
  for (let k = from; k < end; k++) compileSpan(k);
  // Across the seam of a loop the end keys are neighbours: these spans may be others although their keys are the same.
  if (from > 0) compileSpan(0);
  if (end < last) compileSpan(last - 1);
  cubics[4 * (next + last)] = values[last];
  const period = times[last] - times[0];
  extrapolations[2 * index] = extrapolationCode(channel.extrapolateIn, period);
  extrapolations[2 * index + 1] = extrapolationCode(channel.extrapolateOut, period);
  beyond[4 * index] = period;
  beyond[4 * index + 1] = values[last] - values[0];
  beyond[4 * index + 2] = slope(channel, 0, channel.tangentsIn);
  beyond[4 * index + 3] = slope(channel, last, channel.tangentsOut);
}

/** Shorter channels are faster to compile than to compare. */
const LONG_CHANNEL = 512;

/**
 * Copies the cubics of spans that did not change; a span depends on its two keys and their two neighbours.
 *
 *     keys      the same: head      others      the same: tail
 *     spans     0 … head − 3      [from, end)      count − tail + 1 … last − 1
 *
 * @returns the range of spans, end excluded, that has to be compiled
 */
function copySameSpans(
  channel: KeyedChannel,
  before: KeyedChannel,
  to: CompiledTake,
  next: number,
): readonly [number, number] {
  const count = channel.times.length;
  const all = [0, count - 1] as const;
  if (count < LONG_CHANNEL || before.times.length < LONG_CHANNEL) return all;
  const home = homes.get(before);
  const source = home?.take.deref();
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

function columnsOf({ times, values, tangentsIn, tangentsOut }: KeyedChannel): readonly Column[] {
  return [times, values, tangentsIn.kinds, tangentsIn.slopes, tangentsOut.kinds, tangentsOut.slopes];
}

/** Number of equal elements at the beginning, at most `most`. */
function sameHead(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[same] === b[same]) same++;
  return same;
}

/** Number of equal elements at the end, at most `most`. */
function sameTail(a: Column, b: Column, most: number): number {
  if (a === b) return most;
  let same = 0;
  while (same < most && a[a.length - 1 - same] === b[b.length - 1 - same]) same++;
  return same;
}

function copyChannel(from: CompiledTake, channel: number, to: CompiledTake, index: number): void {
  const first = from.firstKey[channel];
  const end = from.firstKey[channel + 1];
  const next = to.firstKey[index];
  to.times.set(from.times.subarray(first, end), next);
  to.cubics.set(from.cubics.subarray(4 * first, 4 * end), 4 * next);
  to.extrapolations.set(from.extrapolations.subarray(2 * channel, 2 * channel + 2), 2 * index);
  to.beyond.set(from.beyond.subarray(4 * channel, 4 * channel + 4), 4 * index);
}

/** Cycles need a period; without one the channel is constant. */
function extrapolationCode(extrapolation: Extrapolation, period: number): number {
  if (extrapolation !== 'linear' && !(period > 0 && Number.isFinite(period))) return CONSTANT;
  return EXTRAPOLATIONS.indexOf(extrapolation);
}
