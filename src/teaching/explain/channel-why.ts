/**
 * Why a channel has its value at a time:
 *
 *     extrapolation   outside the keys: the period, the time folded into the keys, what is added
 *     segment         the two keys, their slopes m, and so the four Hermite inputs p₀, p₁, h·m₀, h·m₁
 *     cubic           p(u) = a·u³ + b·u² + c·u + d, u = (t − t₀) / h
 *
 * Evaluation has the same cubic in seconds since the key, τ = u·h, with coefficients in the other order
 * (`math/hermite.ts`). The value is that of `evaluateChannel`, to the last bit.
 */
import { compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel, repetitionAt } from '../../evaluate/curves.ts';
import { frameAt } from '../../evaluate/samples/sampling.ts';
import { lastNotAbove } from '../../math/search.ts';
import type { Interpolation } from '../../model/takes/samples.ts';
import { type Extrapolation, type KeyedChannel, repeats, type Take } from '../../model/takes/take.ts';
import { type TangentWhy, whyTangent } from './tangent-why.ts';

/** One segment, and how far into it. */
export interface SegmentWhy {
  /** Index of its first key; the second is the next. */
  readonly key: number;
  /** Length in seconds. */
  readonly h: number;
  /** Slopes at its ends. */
  readonly tangents: readonly [out: TangentWhy, into: TangentWhy];
  /** p₀, p₁, h·m₀, h·m₁. */
  readonly inputs: readonly [number, number, number, number];
  /** a, b, c, d in u. */
  readonly inU: readonly [number, number, number, number];
  /** In seconds since the key: of τ³, τ², τ and 1, as evaluated. */
  readonly inSeconds: readonly [number, number, number, number];
  readonly u: number;
  /** Seconds since the key. */
  readonly tau: number;
  /** Too steep or too short for a cubic in doubles: evaluated as a line, or as a step. */
  readonly isDegenerate: boolean;
  readonly value: number;
}

/** Why a channel has its value before its first or after its last key, told by `kind`; key indices from 0. */
export type OutsideWhy =
  | { readonly kind: 'constant'; readonly side: 'before' | 'after'; readonly key: number }
  | {
      readonly kind: 'linear';
      readonly side: 'before' | 'after';
      readonly key: number;
      readonly tangent: TangentWhy;
      /** Seconds from the key, negative before it. */
      readonly seconds: number;
    }
  | {
      readonly kind: 'cycle' | 'cycle_offset' | 'bounce';
      readonly side: 'before' | 'after';
      /** 0 is that of the keys. */
      readonly period: number;
      /** Length of a period, seconds. */
      readonly length: number;
      /** Seconds since the start of the period. */
      readonly since: number;
      readonly isMirrored: boolean;
      /** Time among the keys. */
      readonly folded: number;
      /** Last value minus first. */
      readonly change: number;
      /** Added to the value there. */
      readonly added: number;
    };

/** Why a channel has its value at a time, told by `kind`; values are in the DOF's unit. */
export type ChannelWhy =
  | { readonly kind: 'rest'; readonly value: number }
  | {
      readonly kind: 'samples';
      readonly interpolation: Interpolation;
      /** With the fraction of the way to the next. */
      readonly frame: number;
      readonly frameCount: number;
      readonly value: number;
    }
  | {
      readonly kind: 'keys';
      /** Seconds of the take. */
      readonly time: number;
      /** Outside the keys. */
      readonly outside?: OutsideWhy;
      /** The segment that the time is folded into. */
      readonly segment?: SegmentWhy;
      /** The key that gives the value itself: at its very time, or beyond which it holds. */
      readonly at?: number;
      readonly value: number;
    };

/** Undefined if the take has no such channel. @param time in seconds of the take */
export function whyValue(take: Take, channel: number, time: number): ChannelWhy | undefined {
  const own = take.channels[channel];
  if (!own) return undefined;
  const value = evaluateChannel(compileTake(take), channel, time);
  if (own.kind === 'rest') return { kind: 'rest', value };
  if (own.kind === 'samples') {
    const { samples } = take;
    if (!samples) return { kind: 'rest', value };
    const { interpolation, frameCount } = samples;
    return { kind: 'samples', interpolation, frame: frameAt(samples, time), frameCount, value };
  }
  const { times, values } = own;
  const last = times.length - 1;
  // NaN too, as in evaluation.
  const isBefore = !(time >= times[0]);
  if (!isBefore && time <= times[last]) return { kind: 'keys', time, ...among(take, channel, own, time), value };
  const outside = whyOutside(own, time, isBefore, values[last] - values[0]);
  const place = 'folded' in outside ? among(take, channel, own, outside.folded) : { at: outside.key };
  return { kind: 'keys', time, outside, ...place, value };
}

/** The value as the chain gives it: that of the segment or key, and what extrapolation makes of it. */
export function valueOfChain(keys: KeyedChannel, { outside, segment, at }: Extract<ChannelWhy, { kind: 'keys' }>) {
  const inside = segment?.value ?? keys.values[at ?? 0];
  if (outside?.kind === 'linear') return inside + outside.tangent.slope * outside.seconds;
  return outside?.kind === 'cycle_offset' ? inside + outside.added : inside;
}

function whyOutside(keys: KeyedChannel, time: number, isBefore: boolean, change: number): OutsideWhy {
  const { times } = keys;
  const last = times.length - 1;
  const side = isBefore ? 'before' : 'after';
  const key = isBefore ? 0 : last;
  const kind: Extrapolation = isBefore ? keys.extrapolateIn : keys.extrapolateOut;
  const length = times[last] - times[0];
  const isEndless = !Number.isFinite(time) || !Number.isFinite(length);
  if (kind === 'constant' || isEndless || (repeats(kind) && !(length > 0))) return { kind: 'constant', side, key };
  if (kind === 'linear') {
    const tangent = whyTangent(keys, key, isBefore ? 'in' : 'out');
    return { kind, side, key, tangent, seconds: time - times[key] };
  }
  const { period, since } = repetitionAt(times[0], times[last], time);
  const isMirrored = kind === 'bounce' && period % 2 !== 0;
  const folded = isMirrored ? Math.max(times[0], times[last] - since) : Math.min(times[last], times[0] + since);
  const added = kind === 'cycle_offset' ? period * change : 0;
  return { kind, side, period, length, since, isMirrored, folded, change, added };
}

/** Where a time is from the first to the last key. */
function among(
  take: Take,
  channel: number,
  keys: KeyedChannel,
  time: number,
): { readonly segment?: SegmentWhy; readonly at?: number } {
  const { times, values } = keys;
  const key = lastNotAbove(times, 0, times.length, time);
  const tau = time - times[key];
  if (tau === 0 || key === times.length - 1) return { at: key };
  return { segment: segmentOf(take, channel, keys, key, tau, values) };
}

function segmentOf(
  take: Take,
  channel: number,
  keys: KeyedChannel,
  key: number,
  tau: number,
  values: Float64Array,
): SegmentWhy {
  const { firstKey, cubics } = compileTake(take);
  const o = 4 * (firstKey[channel] + key);
  const [d, c, b, a] = cubics.subarray(o, o + 4);
  const h = keys.times[key + 1] - keys.times[key];
  const tangents = [whyTangent(keys, key, 'out'), whyTangent(keys, key + 1, 'in')] as const;
  const [p0, p1] = [values[key], values[key + 1]];
  const [m0, m1] = [h * tangents[0].slope, h * tangents[1].slope];
  return {
    key,
    h,
    tangents,
    inputs: [p0, p1, m0, m1],
    inU: [2 * p0 - 2 * p1 + m0 + m1, -3 * p0 + 3 * p1 - 2 * m0 - m1, m0, p0],
    inSeconds: [a, b, c, d],
    u: tau / h,
    tau,
    isDegenerate: c !== tangents[0].slope,
    value: ((a * tau + b) * tau + c) * tau + d,
  };
}

/** The segment of a channel between a key and the next, at its first key; undefined past the last. */
export function whySegment(take: Take, channel: number, key: number): SegmentWhy | undefined {
  const keys = take.channels[channel];
  if (keys?.kind !== 'keys' || key < 0 || key + 1 >= keys.times.length) return undefined;
  return segmentOf(take, channel, keys, key, 0, keys.values);
}
