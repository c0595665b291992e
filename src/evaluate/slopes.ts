/** Resolves tangents of all kinds to a slope on each side of a key. */
import { autoSlope } from '../model/takes/auto-slope.ts';
import type { KeyedCurve, Keys, Tangents } from '../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, LINEAR, SMOOTH } from '../model/takes/tangent-kinds.ts';

/** The slopes of a channel's tangents, in value per second, one per key. */
export interface Slopes {
  readonly in: Float64Array;
  readonly out: Float64Array;
}

/** The tangents of each key as slopes: for handles, and for keys inserted on the curve. */
export function resolvedSlopes(keys: KeyedCurve): Slopes {
  const slopes = { in: new Float64Array(keys.times.length), out: new Float64Array(keys.times.length) };
  for (let k = 0; k < keys.times.length; k++) {
    slopes.in[k] = slope(keys, k, keys.tangentsIn);
    slopes.out[k] = slope(keys, k, keys.tangentsOut);
  }
  return slopes;
}

/** The slope on one side of a key, in value per second. */
export function keySlope(keys: KeyedCurve, key: number, side: 'in' | 'out'): number {
  return slope(keys, key, side === 'in' ? keys.tangentsIn : keys.tangentsOut);
}

/** Slope of key `k` on the side of the given tangents. */
export function slope(keys: KeyedCurve, k: number, side: Tangents): number {
  const last = keys.times.length - 1;
  const kind = side.kinds[k];
  if (kind === FLAT) return 0;
  if (kind === FIXED_TANGENT) return side.slopes[k];
  if (kind === AUTO_TANGENT) return autoSlope(keys, k);
  // The end keys have a single neighbour, so both kinds and both sides use the same segment.
  if (k === 0) return secant(keys, 0, Math.min(1, last));
  if (k === last) return secant(keys, last - 1, last);
  if (kind === SMOOTH) return secant(keys, k - 1, k + 1);
  return kind === LINEAR && side === keys.tangentsIn ? secant(keys, k - 1, k) : secant(keys, k, k + 1);
}

/** 0 between keys at the same time, and if the slope overflows. */
function secant(keys: Keys, from: number, to: number): number {
  const s = (keys.values[to] - keys.values[from]) / (keys.times[to] - keys.times[from]);
  return Number.isFinite(s) ? s : 0;
}
