/** What tangents come to: a slope on each side of a key, whatever kind of tangent says so. */
import { type Channel, FIXED, FLAT, LINEAR, SMOOTH, type Tangents } from '../model/clip.ts';

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
export function slope(channel: Channel, k: number, side: Tangents): number {
  const last = channel.times.length - 1;
  const kind = side.kinds[k];
  if (kind === FLAT) return 0;
  if (kind === FIXED) return side.slopes[k];
  // The ends have one neighbour, so there both kinds and both sides mean the same segment.
  if (k === 0) return secant(channel, 0, Math.min(1, last));
  if (k === last) return secant(channel, last - 1, last);
  if (kind === SMOOTH) return secant(channel, k - 1, k + 1);
  return kind === LINEAR && side === channel.tangentsIn ? secant(channel, k - 1, k) : secant(channel, k, k + 1);
}

/** 0 between keys at one time, and where the slope is no number that doubles hold. */
function secant(channel: Channel, from: number, to: number): number {
  const s = (channel.values[to] - channel.values[from]) / (channel.times[to] - channel.times[from]);
  return Number.isFinite(s) ? s : 0;
}
