/** What tangents come to: a slope on each side of a key, whatever kind of tangent says so. */
import { FIXED_TANGENT, FLAT, type Keys, LINEAR, SMOOTH, type Tangents } from '../model/clip.ts';

/** The slopes that a channel's tangents come to, in value per second, one a key. */
export interface Slopes {
  readonly in: Float64Array;
  readonly out: Float64Array;
}

/** What each key's tangents are as slopes: for handles, and for a key put on the curve. */
export function resolvedSlopes(keys: Keys): Slopes {
  const slopes = { in: new Float64Array(keys.times.length), out: new Float64Array(keys.times.length) };
  for (let k = 0; k < keys.times.length; k++) {
    slopes.in[k] = slope(keys, k, keys.tangentsIn);
    slopes.out[k] = slope(keys, k, keys.tangentsOut);
  }
  return slopes;
}

/** The slope that one side of a key's tangents comes to, in value per second. */
export function keySlope(keys: Keys, key: number, side: 'in' | 'out'): number {
  return slope(keys, key, side === 'in' ? keys.tangentsIn : keys.tangentsOut);
}

/** Slope of key `k` on the side whose tangents are given. */
export function slope(keys: Keys, k: number, side: Tangents): number {
  const last = keys.times.length - 1;
  const kind = side.kinds[k];
  if (kind === FLAT) return 0;
  if (kind === FIXED_TANGENT) return side.slopes[k];
  // The ends have one neighbour, so there both kinds and both sides mean the same segment.
  if (k === 0) return secant(keys, 0, Math.min(1, last));
  if (k === last) return secant(keys, last - 1, last);
  if (kind === SMOOTH) return secant(keys, k - 1, k + 1);
  return kind === LINEAR && side === keys.tangentsIn ? secant(keys, k - 1, k) : secant(keys, k, k + 1);
}

/** 0 between keys at one time, and where the slope is no number that doubles hold. */
function secant(keys: Keys, from: number, to: number): number {
  const s = (keys.values[to] - keys.values[from]) / (keys.times[to] - keys.times[from]);
  return Number.isFinite(s) ? s : 0;
}
