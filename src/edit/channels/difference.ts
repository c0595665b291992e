/**
 * The exact distance between two curves. Between the keys of both, the difference of two cubics is a cubic
 *
 *     d(τ) = a + b·τ + c·τ² + d·τ³
 *
 * whose maximum is at one of the ends or where d′(τ) = b + 2c·τ + 3d·τ² is 0. (Sampling would miss narrow peaks and
 * cost more: a dozen differences per span rather than one.)
 */
import { compileChannels } from '../../evaluate/compiled-clip.ts';
import type { KeyedChannel } from '../../model/clip.ts';

/** The largest difference and its position. */
export interface Difference {
  /** |new − old|, in the channel's unit. */
  readonly largestError: number;
  /** Seconds of the clip. */
  readonly atSeconds: number;
}

/**
 * The largest |b − a| over the common range of keys. At a step both sides count, as limits; the time itself, with a
 * single value, does not. O(n + m) for n and m keys.
 */
export function largestDifference(a: KeyedChannel, b: KeyedChannel): Difference {
  let largestError = 0;
  let atSeconds = a.times[0] ?? 0;
  if (a.times.length < 2 || b.times.length < 2) return { largestError, atSeconds };
  const one = compileChannels([a]).cubics;
  const other = compileChannels([b]).cubics;
  const from = Math.max(a.times[0], b.times[0]);
  const to = Math.min(a.times[a.times.length - 1], b.times[b.times.length - 1]);
  let i = 0;
  let j = 0;
  for (let start = from; start < to; ) {
    while (a.times[i + 1] <= start) i++;
    while (b.times[j + 1] <= start) j++;
    const end = Math.min(a.times[i + 1], b.times[j + 1], to);
    shifted(one, 4 * i, start - a.times[i], 1);
    shifted(other, 4 * j, start - b.times[j], -1);
    const h = end - start;
    const worst = placeOfLargest(difference[0], difference[1], difference[2], difference[3], h);
    const error = Math.abs(((difference[3] * worst + difference[2]) * worst + difference[1]) * worst + difference[0]);
    if (error > largestError) {
      largestError = error;
      atSeconds = start + worst;
    }
    start = end;
  }
  return { largestError, atSeconds };
}

/** Scratch: the cubic of the difference, in the time since the span's start. */
const difference = new Float64Array(4);

/** The cubic at `cubics[o]`, starting `by` seconds after its key: written for sign 1, subtracted for sign −1. */
function shifted(cubics: Float64Array, o: number, by: number, sign: 1 | -1): void {
  const keep = sign === 1 ? 0 : 1;
  const b = cubics[o + 1];
  const c = cubics[o + 2];
  const d = cubics[o + 3];
  difference[0] = keep * difference[0] + sign * (((d * by + c) * by + b) * by + cubics[o]);
  difference[1] = keep * difference[1] + sign * ((3 * d * by + 2 * c) * by + b);
  difference[2] = keep * difference[2] + sign * (3 * d * by + c);
  difference[3] = keep * difference[3] + sign * d;
}

/** τ in 0 … h at which |a + bτ + cτ² + dτ³| is largest. */
export function placeOfLargest(a: number, b: number, c: number, d: number, h: number): number {
  let place = 0;
  let largest = Math.abs(a);
  const consider = (t: number) => {
    if (!(t > 0 && t <= h)) return;
    const size = Math.abs(((d * t + c) * t + b) * t + a);
    if (size > largest) {
      largest = size;
      place = t;
    }
  };
  consider(h);
  const under = c * c - 3 * b * d;
  if (under >= 0) {
    // Both roots without cancellation; a division by 0 gives none.
    const q = -(c + Math.sign(c || 1) * Math.sqrt(under));
    consider(q / (3 * d));
    consider(b / q);
  }
  return place;
}
