/**
 * Channels are columns; edits are easier key by key. All code that builds a channel from keys uses this, so that
 * columns always have the same length and only fixed tangents have a slope.
 */
import type { Channel, KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';

/** The tangent on one side. */
export interface Tangent {
  /** Index into TANGENT_KINDS. */
  readonly kind: number;
  /** Value per second if the kind is FIXED; else 0. */
  readonly slope: number;
}

/** One key as an object, in the channel's unit. */
export interface Key {
  /** Seconds of the take. */
  readonly time: number;
  readonly value: number;
  readonly in: Tangent;
  readonly out: Tangent;
}

/** A tangent of a kind (an index into `TANGENT_KINDS`); the slope only counts for fixed ones. */
export function tangent(kind: number, slope = 0): Tangent {
  return { kind, slope: kind === FIXED_TANGENT ? slope : 0 };
}

/** The key at an index of a channel, as an object; the index must exist. */
export function keyAt(channel: KeyedChannel, index: number): Key {
  return {
    time: channel.times[index],
    value: channel.values[index],
    in: { kind: channel.tangentsIn.kinds[index], slope: channel.tangentsIn.slopes[index] },
    out: { kind: channel.tangentsOut.kinds[index], slope: channel.tangentsOut.slopes[index] },
  };
}

/** A channel with these keys, in order of time, and the extrapolation of `channel`. */
export function withKeyList({ extrapolateIn, extrapolateOut }: Channel, keys: readonly Key[]): KeyedChannel {
  return {
    kind: 'keys',
    extrapolateIn,
    extrapolateOut,
    times: Float64Array.from(keys, (k) => k.time),
    values: Float64Array.from(keys, (k) => k.value),
    tangentsIn: tangentColumns(keys.map((k) => k.in)),
    tangentsOut: tangentColumns(keys.map((k) => k.out)),
  };
}

/** The channel with only these keys, in the given order: a subset or a permutation. */
export function takeKeys(channel: KeyedChannel, indices: ArrayLike<number>): KeyedChannel {
  const count = indices.length;
  const times = new Float64Array(count);
  const values = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    times[i] = channel.times[indices[i]];
    values[i] = channel.values[indices[i]];
  }
  return {
    ...channel,
    times,
    values,
    tangentsIn: takeTangents(channel.tangentsIn, indices),
    tangentsOut: takeTangents(channel.tangentsOut, indices),
  };
}

function takeTangents({ kinds, slopes }: Tangents, indices: ArrayLike<number>): Tangents {
  const taken = { kinds: new Uint8Array(indices.length), slopes: new Float64Array(indices.length) };
  for (let i = 0; i < indices.length; i++) {
    taken.kinds[i] = kinds[indices[i]];
    taken.slopes[i] = slopes[indices[i]];
  }
  return taken;
}

function tangentColumns(tangents: readonly Tangent[]): Tangents {
  return {
    kinds: Uint8Array.from(tangents, (t) => t.kind),
    slopes: Float64Array.from(tangents, (t) => (t.kind === FIXED_TANGENT ? t.slope : 0)),
  };
}
