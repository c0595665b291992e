/** Quaternions x y z w as rotations. */

/**
 * Writes the 3×3 matrix of a unit quaternion at `out[o]`, column-major; what lies between its columns stays.
 *
 *     │ 1 − 2(y² + z²)   2(xy − wz)       2(xz + wy)     │
 *     │ 2(xy + wz)       1 − 2(x² + z²)   2(yz − wx)     │
 *     │ 2(xz − wy)       2(yz + wx)       1 − 2(x² + y²) │
 *
 * @param stride from one column to the next: 3 for nine numbers, 4 within a 4×4 matrix
 */
export function writeRotation(
  x: number,
  y: number,
  z: number,
  w: number,
  out: Float64Array,
  o: number,
  stride: 3 | 4,
): void {
  const p = o + stride;
  const q = p + stride;
  out[o] = 1 - 2 * (y * y + z * z);
  out[o + 1] = 2 * (x * y + w * z);
  out[o + 2] = 2 * (x * z - w * y);
  out[p] = 2 * (x * y - w * z);
  out[p + 1] = 1 - 2 * (x * x + z * z);
  out[p + 2] = 2 * (y * z + w * x);
  out[q] = 2 * (x * z + w * y);
  out[q + 1] = 2 * (y * z - w * x);
  out[q + 2] = 1 - 2 * (x * x + y * y);
}
