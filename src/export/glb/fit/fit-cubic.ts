/**
 * Keys of cubic splines (glTF's `CUBICSPLINE`): Hermite curves of the components, of rotations normalised. The values
 * at keys are exact, the slopes on both sides of each segment are those of the least squares over the rows in it.
 */

import type { Rows } from '../rows.ts';
import type { Track } from '../tracks.ts';
import { type FittedKeys, lastNotAbove, normalise, type SegmentHolds } from './fit-linear.ts';

/** Slopes of the segment fitted last; grows to the widest track. */
const scratch = { left: new Float64Array(8), right: new Float64Array(8) };

/** Room for slopes of `width` numbers. */
function reserve(width: number): void {
  if (scratch.left.length >= width) return;
  scratch.left = new Float64Array(width);
  scratch.right = new Float64Array(width);
}

/**
 * Writes the slopes of the segment from row i to row j, per segment, to `scratch`: those of the straight line plus what
 * least squares add; with few rows in between as little as possible.
 */
function fitSlopes(rows: Rows, at: number, dims: number, i: number, j: number): void {
  const { values, seconds, width } = rows;
  const { left, right } = scratch;
  const a = i * width + at;
  const b = j * width + at;
  const span = seconds[j] - seconds[i];
  let aa = 0;
  let ab = 0;
  let bb = 0;
  for (let k = 0; k < dims; k++) left[k] = right[k] = 0;
  for (let m = i + 1; m < j; m++) {
    const u = (seconds[m] - seconds[i]) / span;
    const v = 1 - u;
    const h = u * v * v;
    const g = -u * u * v;
    aa += h * h;
    ab += h * g;
    bb += g * g;
    const o = m * width + at;
    for (let k = 0; k < dims; k++) {
      // What is left of the curve beside the straight line.
      const rest = values[o + k] - v * values[a + k] - u * values[b + k];
      left[k] += h * rest;
      right[k] += g * rest;
    }
  }
  if (j - i < 2) {
    for (let k = 0; k < dims; k++) left[k] = right[k] = values[b + k] - values[a + k];
    return;
  }
  const ridge = (j - i > 3 ? 1e-10 : 1e-4) * (aa + bb);
  aa += ridge;
  bb += ridge;
  const determinant = aa * bb - ab * ab;
  for (let k = 0; k < dims; k++) {
    const p = left[k];
    const q = right[k];
    const chord = values[b + k] - values[a + k];
    left[k] = chord + (p * bb - q * ab) / determinant;
    right[k] = chord + (q * aa - p * ab) / determinant;
  }
}

/**
 * A test whether one cubic from row i to row j is within the tolerance at all rows between, and halfway between them.
 * @param tolerance radians for rotations, else in the track's unit
 */
export function cubicHolds(rows: Rows, { at, width: dims, path }: Track, tolerance: number): SegmentHolds {
  const { values, seconds, width } = rows;
  const isRotation = path === 'rotation';
  const cos = Math.cos(Math.min(tolerance, Math.PI) / 2);
  const limit = isRotation ? cos * cos : tolerance * tolerance;
  reserve(dims);
  return (i, j) => {
    fitSlopes(rows, at, dims, i, j);
    const { left, right } = scratch;
    const a = i * width + at;
    const b = j * width + at;
    const span = seconds[j] - seconds[i];
    // Halfway between rows, too: a cubic that has to turn a corner between two of them swings out.
    for (let n = 2 * i + 1; n < 2 * j; n++) {
      const p = n >> 1;
      const q = (n + 1) >> 1;
      const u = ((seconds[p] + seconds[q]) / 2 - seconds[i]) / span;
      const v = 1 - u;
      const h = u * v * v;
      const g = -u * u * v;
      const c0 = 1 - u * u * (3 - 2 * u);
      const c1 = 1 - c0;
      let sum = 0;
      let dot = 0;
      let length = 0;
      for (let k = 0; k < dims; k++) {
        const made = c0 * values[a + k] + c1 * values[b + k] + h * left[k] + g * right[k];
        const own = (values[p * width + at + k] + values[q * width + at + k]) / 2;
        const d = isRotation ? made : made - own;
        sum += d * d;
        dot += made * own;
        length += own * own;
      }
      if (isRotation ? dot * dot < limit * sum * length || sum < 0.25 : sum > limit) return false;
    }
    return true;
  };
}

/** Keys at the given rows; those of a fit before are kept where nothing was added beside them. */
export function fitCubic(
  rows: Rows,
  { at, width: dims }: Track,
  keys: readonly number[],
  before?: FittedKeys,
): FittedKeys {
  const values = new Float64Array(keys.length * dims);
  const slopesIn = new Float64Array(values.length);
  const slopesOut = new Float64Array(values.length);
  reserve(dims);
  let old = 0;
  keys.forEach((row, k) => {
    const o = row * rows.width + at;
    for (let c = 0; c < dims; c++) values[k * dims + c] = rows.values[o + c];
    const known = before?.rows;
    if (known && known[old] < row) old++;
    if (k === 0 || rows.jumps[row]) return;
    const isKept = known && known[old] === row && known[old - 1] === keys[k - 1];
    const span = rows.seconds[row] - rows.seconds[keys[k - 1]];
    if (!isKept) fitSlopes(rows, at, dims, keys[k - 1], row);
    for (let c = 0; c < dims; c++) {
      const [left, right] = [(k - 1) * dims + c, k * dims + c];
      slopesOut[left] = isKept && before.slopesOut ? before.slopesOut[(old - 1) * dims + c] : scratch.left[c] / span;
      slopesIn[right] = isKept && before.slopesIn ? before.slopesIn[old * dims + c] : scratch.right[c] / span;
    }
  });
  return { rows: keys.slice(), values, slopesIn, slopesOut };
}

/** Writes what programs make of the keys at each row, from the key at row `first` to that at `last`. */
export function expandCubic(
  { seconds, width, jumps }: Rows,
  { at, width: dims, path }: Track,
  { rows: keys, values, slopesIn, slopesOut }: FittedKeys,
  out: Float64Array,
  first: number,
  last: number,
): void {
  for (let k = lastNotAbove(keys, first); k < keys.length && keys[k] <= last; k++) {
    const o = keys[k] * width + at;
    for (let c = 0; c < dims; c++) out[o + c] = values[k * dims + c];
    if (k + 1 === keys.length || jumps[keys[k + 1]] || !slopesIn || !slopesOut) continue;
    const from = keys[k];
    const to = keys[k + 1];
    const span = seconds[to] - seconds[from];
    for (let m = from + 1; m < to; m++) {
      const u = (seconds[m] - seconds[from]) / span;
      const v = 1 - u;
      const h = u * v * v * span;
      const g = -u * u * v * span;
      const c1 = u * u * (3 - 2 * u);
      const p = m * width + at;
      for (let c = 0; c < dims; c++) {
        const l = k * dims + c;
        out[p + c] = (1 - c1) * values[l] + c1 * values[l + dims] + h * slopesOut[l] + g * slopesIn[l + dims];
      }
      if (path === 'rotation') normalise(out, p);
    }
  }
}
