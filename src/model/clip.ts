import { columnOf, rangeOfSamples, type Samples } from './samples.ts';

/**
 * A clip: what an animation file holds. Channels drive a character's DOFs, in the order of `dofs.ts`: the root's
 * translation, every DOF of every joint, the morph weights.
 *
 * A channel has keys, or follows its column of the samples, or stands at a value. So motion capture and keys live in
 * one clip: a channel converted to keys is one like any other, while those beside it are still sampled.
 */
export interface ChannelClip {
  readonly name: string;
  /** First and last second that are played; need not match the keys, and may be negative. */
  readonly range: readonly [number, number];
  readonly channels: readonly Channel[];
  /** Drives the channels that have no keys. */
  readonly samples?: Samples;
}

/**
 * Keys in columns, sorted by time. Two keys at one time are a step, the later one holding from that time on.
 * A channel of no keys follows the clip's samples, or stands at its `rest`, or is 0.
 */
export interface Channel {
  /**
   * What a channel is while it has no keys; absent is 0. Files have no such thing: none is read with it, and it is
   * written as a lone key. In an editor, what is not keyed stays where it was put.
   */
  readonly rest?: number;
  readonly extrapolateIn: Extrapolation;
  readonly extrapolateOut: Extrapolation;
  /** Seconds. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly tangentsIn: Tangents;
  readonly tangentsOut: Tangents;
}

/** One side's tangents, a column for a channel's keys. */
export interface Tangents {
  /** Index into TANGENT_KINDS for each key. */
  readonly kinds: Uint8Array;
  /** Value per second, for keys whose kind is `fixed`; 0 elsewhere. */
  readonly slopes: Float64Array;
}

export const TANGENT_KINDS = ['flat', 'linear', 'smooth', 'fixed'] as const;
export type TangentKind = (typeof TANGENT_KINDS)[number];
export const FLAT = 0;
export const LINEAR = 1;
export const SMOOTH = 2;
/** A number in the file: the slope itself. */
export const FIXED = 3;

export const EXTRAPOLATIONS = ['constant', 'linear', 'cycle', 'cycle_offset', 'bounce'] as const;
export type Extrapolation = (typeof EXTRAPOLATIONS)[number];

/** Whether the samples are what a channel follows. */
export function isSampled({ channels, samples }: Pick<ChannelClip, 'channels' | 'samples'>, channel: number): boolean {
  return channels[channel]?.times.length === 0 && columnOf(samples, channel) >= 0;
}

/** First to last key of a channel, or first to last frame where it follows the samples; undefined where it stands. */
export function spanOfChannel(
  clip: Pick<ChannelClip, 'channels' | 'samples'>,
  channel: number,
): readonly [number, number] | undefined {
  const times = clip.channels[channel]?.times;
  if (times?.length) return [times[0], times[times.length - 1]];
  return clip.samples && isSampled(clip, channel) ? rangeOfSamples(clip.samples) : undefined;
}

/** A channel without keys that stands at a value. */
export function keylessChannel(rest = 0): Channel {
  return {
    ...(rest !== 0 && { rest }),
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    times: NO_NUMBERS,
    values: NO_NUMBERS,
    tangentsIn: NO_TANGENTS,
    tangentsOut: NO_TANGENTS,
  };
}

/** Shared by all channels without keys: a message to the page that has thousands of them then holds these once. */
const NO_NUMBERS = new Float64Array(0);
const NO_TANGENTS: Tangents = { kinds: new Uint8Array(0), slopes: NO_NUMBERS };
