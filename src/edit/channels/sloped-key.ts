/**
 * Keys with their resolved slopes: `smooth` and `linear` depend on the neighbours, and when those change, a key keeps
 * its shape only as numbers.
 */
import type { Slopes } from '../../evaluate/slopes.ts';
import { autoSlope, crossesSeam } from '../../model/takes/auto-slope.ts';
import type { KeyedChannel } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT } from '../../model/takes/tangent-kinds.ts';
import { type Key, keyAt, type Tangent, tangent } from '../keys/columns.ts';
import { withTangents } from '../keys/tangents.ts';

/** A key with the slopes that its tangents have among its neighbours, in value per second. */
export interface Sloped extends Key {
  readonly slopeIn: number;
  readonly slopeOut: number;
}

/**
 * A key of a channel with its resolved slopes.
 * @param slopes the channel's, from `resolvedSlopes`
 */
export function slopedKey(channel: KeyedChannel, slopes: Slopes, k: number): Sloped {
  return { ...keyAt(channel, k), slopeIn: slopes.in[k], slopeOut: slopes.out[k] };
}

/** The key with tangents that don't depend on neighbours. */
export function frozen(key: Sloped): Sloped {
  return { ...key, in: frozenTangent(key.in, key.slopeIn), out: frozenTangent(key.out, key.slopeOut) };
}

/** As a number, unless it is flat, which is one already. */
export function frozenTangent({ kind }: Tangent, slope: number): Tangent {
  return kind === FLAT ? tangent(FLAT) : tangent(FIXED_TANGENT, slope);
}

/**
 * The channel with `auto` tangents of its end keys as numbers if they depend on each other across the seam of a loop,
 * for edits after which the channel may not loop; the same object if they don't.
 */
export function withSeamFrozen(channel: KeyedChannel): KeyedChannel {
  if (!crossesSeam(channel)) return channel;
  return withTangents(channel, [0, channel.times.length - 1], (k, side) => {
    const { kinds } = side === 'in' ? channel.tangentsIn : channel.tangentsOut;
    return kinds[k] === AUTO_TANGENT ? tangent(FIXED_TANGENT, autoSlope(channel, k)) : undefined;
  });
}

/** Whether values are equal up to rounding, so that there is no step. */
export function meets(a: number, b: number): boolean {
  return Math.abs(a - b) <= 1e-12 * Math.max(Math.abs(a), Math.abs(b));
}
