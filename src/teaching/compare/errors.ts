/**
 * How far numbers are from others: the largest difference of an element, rotations, normals and channels as they are,
 * lengths over the character's size. Numbers that are not finite are infinitely far.
 */

/**
 * Default tolerance: a fraction of the character's size, of a radian, of a channel's unit: programs use floats and
 * print six digits.
 */
export const DEFAULT_TOLERANCE = 1e-4;

/** Error of a matrix at `o`. */
export function matrixError(a: Float64Array, b: Float64Array, o: number, size: number): number {
  let error = 0;
  for (let i = o; i < o + 12; i++) error = larger(error, a[i] - b[i]);
  for (let i = o + 12; i < o + 15; i++) error = larger(error, (a[i] - b[i]) / size);
  return error;
}

/** Error of three numbers. */
export function pointError(a: Float64Array, ao: number, b: Float64Array, bo: number, size: number): number {
  let error = 0;
  for (let k = 0; k < 3; k++) error = larger(error, (a[ao + k] - b[bo + k]) / size);
  return error;
}

/** The larger of an error and a difference; infinite for NaN. */
export function larger(error: number, difference: number): number {
  const own = Math.abs(difference);
  if (own <= error) return error;
  return own > error ? own : Number.POSITIVE_INFINITY;
}

/** The diagonal of the box around points: x y z every `stride` numbers, from `first`. At least the smallest number. */
export function diagonalOf(points: Float64Array, stride: number, first: number): number {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let o = first; o + 2 < points.length; o += stride) {
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k], points[o + k]);
      max[k] = Math.max(max[k], points[o + k]);
    }
  }
  const diagonal = Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  return diagonal > 0 && diagonal < Infinity ? diagonal : 1;
}
