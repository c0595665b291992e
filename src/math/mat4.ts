/**
 * 4×4 matrices as 16 consecutive numbers of a Float64Array, column-major: element (row r, column c) is at `offset + 4 *
 * c + r`; points are column vectors. Every function takes offsets, so that many matrices share one array and playback
 * allocates nothing.
 *
 * One small object per matrix would be easier to index, but a pose of 100 joints would be 100 objects, which can't be
 * transferred from a worker and are unfriendly to the cache.
 */

/** Writes the identity. */
export function setIdentity(out: Float64Array, o = 0): void {
  out.fill(0, o, o + 16);
  out[o] = out[o + 5] = out[o + 10] = out[o + 15] = 1;
}

/** `out = a · b` for matrices whose last row is 0 0 0 1. `out` may not overlap `a` or `b`. */
export function multiplyAffine(
  a: Float64Array,
  ao: number,
  b: Float64Array,
  bo: number,
  out: Float64Array,
  o: number,
): void {
  const a0 = a[ao];
  const a1 = a[ao + 1];
  const a2 = a[ao + 2];
  const a4 = a[ao + 4];
  const a5 = a[ao + 5];
  const a6 = a[ao + 6];
  const a8 = a[ao + 8];
  const a9 = a[ao + 9];
  const a10 = a[ao + 10];
  for (let c = 0; c < 16; c += 4) {
    const x = b[bo + c];
    const y = b[bo + c + 1];
    const z = b[bo + c + 2];
    out[o + c] = a0 * x + a4 * y + a8 * z;
    out[o + c + 1] = a1 * x + a5 * y + a9 * z;
    out[o + c + 2] = a2 * x + a6 * y + a10 * z;
    out[o + c + 3] = 0;
  }
  out[o + 12] += a[ao + 12];
  out[o + 13] += a[ao + 13];
  out[o + 14] += a[ao + 14];
  out[o + 15] = 1;
}

/** Determinant of the upper left 3×3: negative if the matrix mirrors, 0 if it flattens. */
export function determinant3(m: Float64Array, o = 0): number {
  return (
    m[o] * (m[o + 5] * m[o + 10] - m[o + 9] * m[o + 6]) +
    m[o + 4] * (m[o + 9] * m[o + 2] - m[o + 1] * m[o + 10]) +
    m[o + 8] * (m[o + 1] * m[o + 6] - m[o + 5] * m[o + 2])
  );
}

/**
 * Whether an affine matrix has no usable inverse: its 3×3 determinant is (nearly) zero relative to the product of its
 * columns' lengths. Independent of the unit of length.
 */
export function isSingular(m: Float64Array, o = 0): boolean {
  const scale =
    Math.hypot(m[o], m[o + 1], m[o + 2]) *
    Math.hypot(m[o + 4], m[o + 5], m[o + 6]) *
    Math.hypot(m[o + 8], m[o + 9], m[o + 10]);
  return !(Math.abs(determinant3(m, o)) > 1e-12 * scale);
}

/**
 * `out = m⁻¹` for a matrix whose last row is 0 0 0 1, by cofactors. `out` may be `m`. A singular matrix gives
 * infinities: check `isSingular` first.
 */
export function invertAffine(m: Float64Array, mo: number, out: Float64Array, o: number): void {
  const a = m[mo];
  const b = m[mo + 1];
  const c = m[mo + 2];
  const d = m[mo + 4];
  const e = m[mo + 5];
  const f = m[mo + 6];
  const g = m[mo + 8];
  const h = m[mo + 9];
  const i = m[mo + 10];
  const x = m[mo + 12];
  const y = m[mo + 13];
  const z = m[mo + 14];
  const s = 1 / determinant3(m, mo);
  out[o] = (e * i - f * h) * s;
  out[o + 1] = (c * h - b * i) * s;
  out[o + 2] = (b * f - c * e) * s;
  out[o + 3] = 0;
  out[o + 4] = (f * g - d * i) * s;
  out[o + 5] = (a * i - c * g) * s;
  out[o + 6] = (c * d - a * f) * s;
  out[o + 7] = 0;
  out[o + 8] = (d * h - e * g) * s;
  out[o + 9] = (b * g - a * h) * s;
  out[o + 10] = (a * e - b * d) * s;
  out[o + 11] = 0;
  out[o + 12] = -(out[o] * x + out[o + 4] * y + out[o + 8] * z);
  out[o + 13] = -(out[o + 1] * x + out[o + 5] * y + out[o + 9] * z);
  out[o + 14] = -(out[o + 2] * x + out[o + 6] * y + out[o + 10] * z);
  out[o + 15] = 1;
}

/**
 * The matrix for normals: the inverse transpose of the upper left 3×3, as 9 numbers, column-major, at `out[o]`. A
 * matrix that flattens has none; its cofactors (the inverse transpose times the determinant) still give the direction.
 */
export function inverseTranspose3(m: Float64Array, mo: number, out: Float64Array, o: number): void {
  const a = m[mo];
  const b = m[mo + 1];
  const c = m[mo + 2];
  const d = m[mo + 4];
  const e = m[mo + 5];
  const f = m[mo + 6];
  const g = m[mo + 8];
  const h = m[mo + 9];
  const i = m[mo + 10];
  const s = isSingular(m, mo) ? 1 : 1 / determinant3(m, mo);
  out[o] = (e * i - f * h) * s;
  out[o + 1] = (f * g - d * i) * s;
  out[o + 2] = (d * h - e * g) * s;
  out[o + 3] = (c * h - b * i) * s;
  out[o + 4] = (a * i - c * g) * s;
  out[o + 5] = (b * g - a * h) * s;
  out[o + 6] = (b * f - c * e) * s;
  out[o + 7] = (c * d - a * f) * s;
  out[o + 8] = (a * e - b * d) * s;
}
