/**
 * Compiles takes for evaluation: all channels packed into a few typed arrays, each span as a cubic.
 *
 * An edit makes a new take of mostly the same channels, and a new channel of mostly the same keys; where takes are
 * edited, `recompiled-take.ts` copies unchanged compiled data.
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

/** Copies of a take that was compiled before. */
export interface Reuse {
  /** Copies a channel that was compiled before, as it is; false if it wasn't. */
  channel(channel: KeyedChannel, to: CompiledTake, index: number): boolean;
  /** Copies cubics that an edit left as they were. Returns the range of spans, end excluded, that has to be compiled. */
  spans(channel: KeyedChannel, to: CompiledTake, index: number): readonly [from: number, end: number];
  /** Notes what can be copied from now on. */
  note(take: Motion, reference: WeakRef<CompiledTake>): void;
}

let reuse: Reuse | undefined;

/** Makes compiling copy; see `recompiled-take.ts`. */
export function provideReuse(code: Reuse): void {
  reuse = code;
}

/** The compiled form of a take's own channels, without its layers; compiled again only after it was collected. */
export function compileTake(take: Take | Motion): CompiledTake {
  const known = compiled.get(take)?.deref();
  if (known) return known;
  const made = pack(take, true);
  const reference = new WeakRef(made);
  compiled.set(take, reference);
  reuse?.note(take, reference);
  return made;
}

/** Compiles channels that belong to no take (not cached). */
export function compileChannels(channels: readonly Channel[]): CompiledTake {
  return pack({ channels }, false);
}

/** @param isEdit it may be one of the take that was compiled last */
function pack(take: Motion, isEdit: boolean): CompiledTake {
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
    if (channel.kind === 'keys') {
      if (!reuse?.channel(channel, made, index)) compileChannel(channel, made, index, isEdit);
    }
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

/** Compiles one channel into its place, from `firstKey[index]`. */
function compileChannel(channel: KeyedChannel, to: CompiledTake, index: number, isEdit: boolean): void {
  const { cubics, extrapolations, beyond } = to;
  const next = to.firstKey[index];
  const { times, values } = channel;
  const last = times.length - 1;
  to.times.set(times, next);
  const [from, end] = (isEdit && reuse?.spans(channel, to, index)) || [0, last];
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

/** Cycles need a period; without one the channel is constant. */
function extrapolationCode(extrapolation: Extrapolation, period: number): number {
  if (extrapolation !== 'linear' && !(period > 0 && Number.isFinite(period))) return CONSTANT;
  return EXTRAPOLATIONS.indexOf(extrapolation);
}
