/** Quaternions x y z w as rotations. */

/**
 * Writes the 3×3 matrix of a unit quaternion at `out[o]`, column-major; with stride 4 the fourth rows are left alone.
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

/** The unit quaternion of a rotation's 9 numbers, column-major (Shepperd 1978: divides by the largest component). */
export function quaternionOfRotation(m: Float64Array, o: number, q: Float64Array): void {
  const a = m[o];
  const e = m[o + 4];
  const i = m[o + 8];
  const trace = a + e + i;
  if (trace >= a && trace >= e && trace >= i) {
    const w = Math.sqrt(Math.max(0, 1 + trace)) / 2;
    q[3] = w;
    q[0] = (m[o + 5] - m[o + 7]) / (4 * w);
    q[1] = (m[o + 6] - m[o + 2]) / (4 * w);
    q[2] = (m[o + 1] - m[o + 3]) / (4 * w);
  } else if (a >= e && a >= i) {
    const x = Math.sqrt(Math.max(0, 1 + a - e - i)) / 2;
    q[0] = x;
    q[1] = (m[o + 1] + m[o + 3]) / (4 * x);
    q[2] = (m[o + 2] + m[o + 6]) / (4 * x);
    q[3] = (m[o + 5] - m[o + 7]) / (4 * x);
  } else if (e >= i) {
    const y = Math.sqrt(Math.max(0, 1 - a + e - i)) / 2;
    q[1] = y;
    q[0] = (m[o + 1] + m[o + 3]) / (4 * y);
    q[2] = (m[o + 5] + m[o + 7]) / (4 * y);
    q[3] = (m[o + 6] - m[o + 2]) / (4 * y);
  } else {
    const z = Math.sqrt(Math.max(0, 1 - a - e + i)) / 2;
    q[2] = z;
    q[0] = (m[o + 2] + m[o + 6]) / (4 * z);
    q[1] = (m[o + 5] + m[o + 7]) / (4 * z);
    q[3] = (m[o + 1] - m[o + 3]) / (4 * z);
  }
}
