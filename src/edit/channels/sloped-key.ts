/**
 * Keys with the slopes that their tangents come to: `smooth` and `linear` ask the neighbours, and where those change,
 * a key keeps its shape only as numbers.
 */
import type { Slopes } from '../../evaluate/slopes.ts';
import { FIXED_TANGENT, FLAT, type KeyedChannel } from '../../model/clip.ts';
import { type Key, keyAt, type Tangent, tangent } from '../keys/columns.ts';

export interface Sloped extends Key {
  readonly slopeIn: number;
  readonly slopeOut: number;
}

/** @param slopes the channel's, from `resolvedSlopes` */
export function slopedKey(channel: KeyedChannel, slopes: Slopes, k: number): Sloped {
  return { ...keyAt(channel, k), slopeIn: slopes.in[k], slopeOut: slopes.out[k] };
}

/** The key with tangents that ask no neighbour. */
export function frozen(key: Sloped): Sloped {
  return { ...key, in: frozenTangent(key.in, key.slopeIn), out: frozenTangent(key.out, key.slopeOut) };
}

/** As a number, unless it is flat: that is one already. */
export function frozenTangent({ kind }: Tangent, slope: number): Tangent {
  return kind === FLAT ? tangent(FLAT) : tangent(FIXED_TANGENT, slope);
}

/** Values that differ by no more than rounding: no step. */
export function meets(a: number, b: number): boolean {
  return Math.abs(a - b) <= 1e-12 * Math.max(Math.abs(a), Math.abs(b));
}
