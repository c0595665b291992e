import { columnOf, rangeOfSamples, type Samples } from './samples.ts';

/**
 * A clip: what an animation file holds. Channels drive a character's DOFs, in the order of `dofs.ts`: the root's
 * translation, every DOF of every joint, the morph weights.
 *
 * A channel has keys, or follows its column of the samples, or stays at a value. So motion capture and keys live in one
 * clip: a channel converted to keys is one like any other, while those beside it are still sampled.
 */
export interface ChannelClip {
  readonly name: string;
  /** First and last second that are played; need not match the keys, and may be negative. */
  readonly range: readonly [number, number];
  readonly channels: readonly Channel[];
  /** Drives the sampled channels. A channel that has a column here is sampled or has keys, but is never at rest. */
  readonly samples?: Samples;
}

/** What drives one DOF, told by `kind`. */
export type Channel = KeyedChannel | SampledChannel | RestChannel;

/**
 * What holds outside a channel's keys. A channel without keys has it too, for the keys it may get and because its file
 * says so.
 */
interface Extrapolated {
  readonly extrapolateIn: Extrapolation;
  readonly extrapolateOut: Extrapolation;
}

/** Has at least one key. */
export interface KeyedChannel extends Extrapolated, Keys {
  readonly kind: 'keys';
}

/** Columns, sorted by time. Two keys at one time are a step, the later one holding from that time on. */
export interface Keys {
  /** Seconds. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly tangentsIn: Tangents;
  readonly tangentsOut: Tangents;
}

/** Follows the column that the clip's samples have for it: `columnOf(samples, channel)`. */
export interface SampledChannel extends Extrapolated {
  readonly kind: 'samples';
}

/**
 * Stays at a value: what a channel without keys or samples does. Files have no such thing. A channel of no keys is read
 * as 0, and 0 is written as no keys; any other value is written as a lone key. In an editor, what has no keys stays where
 * it was put.
 */
export interface RestChannel extends Extrapolated {
  readonly kind: 'rest';
  readonly value: number;
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
export const FIXED_TANGENT = 3;

export const EXTRAPOLATIONS = ['constant', 'linear', 'cycle', 'cycle_offset', 'bounce'] as const;
export type Extrapolation = (typeof EXTRAPOLATIONS)[number];

const NO_EXTRAPOLATION = { extrapolateIn: 'constant', extrapolateOut: 'constant' } as const;

/** One object for all sampled channels as a capture has them: a message to the page with thousands of them holds it once. */
export const SAMPLED: SampledChannel = { kind: 'samples', ...NO_EXTRAPOLATION };

export function restChannel(value = 0): RestChannel {
  // Plus 0: −0 is 0.
  return { kind: 'rest', value: value + 0, ...NO_EXTRAPOLATION };
}

const NO_NUMBERS = new Float64Array(0);
const NO_TANGENTS: Tangents = { kinds: new Uint8Array(0), slopes: NO_NUMBERS };
export const NO_KEYS: Keys = {
  times: NO_NUMBERS,
  values: NO_NUMBERS,
  tangentsIn: NO_TANGENTS,
  tangentsOut: NO_TANGENTS,
};

/** The columns of a channel's keys: empty for a channel without keys, or none at all. */
export function keysOf(channel: Channel | undefined): Keys {
  return channel?.kind === 'keys' ? channel : NO_KEYS;
}

/** First to last key, or first to last frame, of one of the clip's channels; undefined where it is at rest. */
export function spanOfChannel(
  { channels, samples }: Pick<ChannelClip, 'channels' | 'samples'>,
  index: number,
): readonly [number, number] | undefined {
  const channel = channels[index];
  if (channel?.kind === 'keys') return [channel.times[0], channel.times[channel.times.length - 1]];
  return channel?.kind === 'samples' && samples ? rangeOfSamples(samples) : undefined;
}

/** The channels of a clip that has these samples: where one at rest has a column in them, it follows that. */
export function followingSamples(channels: readonly Channel[], samples: Samples | undefined): readonly Channel[] {
  const follows = ({ kind }: Channel, c: number) => kind === 'rest' && columnOf(samples, c) >= 0;
  if (!samples || !channels.some(follows)) return channels;
  return channels.map((channel, c): Channel => {
    if (!follows(channel, c)) return channel;
    const { extrapolateIn, extrapolateOut } = channel;
    return { ...SAMPLED, extrapolateIn, extrapolateOut };
  });
}
