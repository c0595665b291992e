/**
 * The exact distance between two curves. Between the keys of both, the difference of two cubics is a cubic
 *
 *     d(τ) = a + b·τ + c·τ² + d·τ³
 *
 * whose maximum is at one of the ends or where d′(τ) = b + 2c·τ + 3d·τ² is 0. (Sampling would miss narrow peaks and
 * cost more: a dozen differences per span rather than one.)
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import type { KeyedChannel } from '../../model/takes/take.ts';

/** The largest difference and its position. */
export interface Difference {
  /** |new − old|, in the channel's unit. */
  readonly largestError: number;
  /** Seconds of the take. */
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
    writeShifted(one, 4 * i, start - a.times[i], shiftedA);
    writeShifted(other, 4 * j, start - b.times[j], shiftedB);
    for (let k = 0; k < 4; k++) difference[k] = shiftedA[k] - shiftedB[k];
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

/** Scratch: both cubics and their difference, in the time since the span's start. */
const shiftedA = new Float64Array(4);
const shiftedB = new Float64Array(4);
const difference = new Float64Array(4);

/** The cubic at `cubics[o]`, from `by` seconds after its key on. */
function writeShifted(cubics: Float64Array, o: number, by: number, out: Float64Array): void {
  const b = cubics[o + 1];
  const c = cubics[o + 2];
  const d = cubics[o + 3];
  out[0] = ((d * by + c) * by + b) * by + cubics[o];
  out[1] = (3 * d * by + 2 * c) * by + b;
  out[2] = 3 * d * by + c;
  out[3] = d;
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
