/** Rotations as nine numbers of a Float64Array, column-major, for loops over frames; nothing allocates. */
import { length3 } from './vec3.ts';

/** `out = a · b`; `out` may not overlap `a` or `b`. */
export function multiply3(
  a: Float64Array,
  ao: number,
  b: Float64Array,
  bo: number,
  out: Float64Array,
  o: number,
): void {
  for (let c = 0; c < 9; c += 3) {
    const x = b[bo + c];
    const y = b[bo + c + 1];
    const z = b[bo + c + 2];
    out[o + c] = a[ao] * x + a[ao + 3] * y + a[ao + 6] * z;
    out[o + c + 1] = a[ao + 1] * x + a[ao + 4] * y + a[ao + 7] * z;
    out[o + c + 2] = a[ao + 2] * x + a[ao + 5] * y + a[ao + 8] * z;
  }
}

/** `out = aᵀ · b`, which is a⁻¹ · b; `out` may not overlap `a` or `b`. */
export function backMultiply3(
  a: Float64Array,
  ao: number,
  b: Float64Array,
  bo: number,
  out: Float64Array,
  o: number,
): void {
  for (let c = 0; c < 9; c += 3) {
    const x = b[bo + c];
    const y = b[bo + c + 1];
    const z = b[bo + c + 2];
    out[o + c] = a[ao] * x + a[ao + 1] * y + a[ao + 2] * z;
    out[o + c + 1] = a[ao + 3] * x + a[ao + 4] * y + a[ao + 5] * z;
    out[o + c + 2] = a[ao + 6] * x + a[ao + 7] * y + a[ao + 8] * z;
  }
}

/** `out = a · v`; `out` may be `v`. */
export function turnVector(a: Float64Array, ao: number, v: Float64Array, vo: number, out: Float64Array, o: number) {
  const x = v[vo];
  const y = v[vo + 1];
  const z = v[vo + 2];
  out[o] = a[ao] * x + a[ao + 3] * y + a[ao + 6] * z;
  out[o + 1] = a[ao + 1] * x + a[ao + 4] * y + a[ao + 7] * z;
  out[o + 2] = a[ao + 2] * x + a[ao + 5] * y + a[ao + 8] * z;
}

/** `out = aᵀ · v`, which is a⁻¹ · v; `out` may be `v`. */
export function backTurnVector(a: Float64Array, ao: number, v: Float64Array, vo: number, out: Float64Array, o: number) {
  const x = v[vo];
  const y = v[vo + 1];
  const z = v[vo + 2];
  out[o] = a[ao] * x + a[ao + 1] * y + a[ao + 2] * z;
  out[o + 1] = a[ao + 3] * x + a[ao + 4] * y + a[ao + 5] * z;
  out[o + 2] = a[ao + 6] * x + a[ao + 7] * y + a[ao + 8] * z;
}

/** Writes the identity into the nine numbers of `out` from index `o`. */
export function setIdentity3(out: Float64Array, o = 0): void {
  out.fill(0, o, o + 9);
  out[o] = out[o + 4] = out[o + 8] = 1;
}

/** Copies nine numbers from `from[fo …]` to `to[o …]`. */
export function copy3(from: Float64Array, fo: number, to: Float64Array, o: number): void {
  for (let k = 0; k < 9; k++) to[o + k] = from[fo + k];
}

/**
 * The rotation of a matrix that may also scale, shear or mirror, by Gram–Schmidt: the direction of the first column,
 * the second made orthogonal to it, and the third for a right-handed system. Columns without a direction get one of the
 * remaining axes. `out` may be `m`.
 *
 * @param m 16 numbers at `mo`, of which the upper left 3×3 is used
 * @param stride of `out`, from one column to the next: 3 for nine numbers, 4 within a 4×4 matrix
 * @param lengths receives at `l` the first column's length along the rotation's x, and the second's along x and y
 */
export function writeRotationPart(
  m: Float64Array,
  mo: number,
  out: Float64Array,
  o: number,
  stride: 3 | 4,
  lengths?: Float64Array,
  l = 0,
): void {
  let x = m[mo];
  let y = m[mo + 1];
  let z = m[mo + 2];
  let length = Math.sqrt(x * x + y * y + z * z);
  const alongX = length;
  if (!(length > 0)) {
    x = length = 1;
    y = z = 0;
  }
  x /= length;
  y /= length;
  z /= length;
  let u = m[mo + 4];
  let v = m[mo + 5];
  let w = m[mo + 6];
  const size = Math.sqrt(u * u + v * v + w * w);
  const along = x * u + y * v + z * w;
  u -= along * x;
  v -= along * y;
  w -= along * z;
  length = Math.sqrt(u * u + v * v + w * w);
  if (lengths) {
    lengths[l] = alongX;
    lengths[l + 1] = along;
    lengths[l + 2] = length;
  }
  if (!(length > 1e-12 * size)) {
    // Any orthogonal direction: from x, or from y if the column is nearly along x.
    const isX = Math.abs(x) < 0.9;
    const by = isX ? x : y;
    u = (isX ? 1 : 0) - by * x;
    v = (isX ? 0 : 1) - by * y;
    w = -by * z;
    length = Math.sqrt(u * u + v * v + w * w);
  }
  u /= length;
  v /= length;
  w /= length;
  const p = o + stride;
  const q = p + stride;
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
  out[p] = u;
  out[p + 1] = v;
  out[p + 2] = w;
  out[q] = y * w - z * v;
  out[q + 1] = z * u - x * w;
  out[q + 2] = x * v - y * u;
}

/**
 * Rotation about a unit axis (Rodrigues), from the cosine and sine of its angle:
 *
 *     R = cos · I + sin · [a]× + (1 − cos) · a·aᵀ
 *
 * @param stride from one column to the next, as for `writeRotationPart`
 */
export function turnAbout(
  x: number,
  y: number,
  z: number,
  cos: number,
  sin: number,
  out: Float64Array,
  o: number,
  stride: 3 | 4 = 3,
): void {
  const t = 1 - cos;
  const p = o + stride;
  const q = p + stride;
  out[o] = cos + t * x * x;
  out[o + 1] = t * x * y + sin * z;
  out[o + 2] = t * x * z - sin * y;
  out[p] = t * x * y - sin * z;
  out[p + 1] = cos + t * y * y;
  out[p + 2] = t * y * z + sin * x;
  out[q] = t * x * z + sin * y;
  out[q + 1] = t * y * z - sin * x;
  out[q + 2] = cos + t * z * z;
}

/**
 * The smallest rotation that takes one direction to another (vectors of any length greater than 0). Opposite directions
 * use any perpendicular axis; a vector without a direction gives the identity.
 */
export function swing(from: Float64Array, fo: number, to: Float64Array, t: number, out: Float64Array, o: number): void {
  const lengths = length3(from[fo], from[fo + 1], from[fo + 2]) * length3(to[t], to[t + 1], to[t + 2]);
  if (!(lengths > 0)) {
    setIdentity3(out, o);
    return;
  }
  let x = (from[fo + 1] * to[t + 2] - from[fo + 2] * to[t + 1]) / lengths;
  let y = (from[fo + 2] * to[t] - from[fo] * to[t + 2]) / lengths;
  let z = (from[fo] * to[t + 1] - from[fo + 1] * to[t]) / lengths;
  const cos = (from[fo] * to[t] + from[fo + 1] * to[t + 1] + from[fo + 2] * to[t + 2]) / lengths;
  let sin = Math.sqrt(x * x + y * y + z * z);
  if (sin < 1e-15) {
    if (cos > 0) {
      setIdentity3(out, o);
      return;
    }
    // Perpendicular to the direction's smallest component.
    const [a, b, c] = [Math.abs(from[fo]), Math.abs(from[fo + 1]), Math.abs(from[fo + 2])];
    if (a <= b && a <= c) [x, y, z] = [0, -from[fo + 2], from[fo + 1]];
    else if (b <= c) [x, y, z] = [from[fo + 2], 0, -from[fo]];
    else [x, y, z] = [-from[fo + 1], from[fo], 0];
    const s = 1 / length3(x, y, z);
    turnAbout(x * s, y * s, z * s, -1, 0, out, o);
    return;
  }
  const s = 1 / sin;
  const length = Math.sqrt(cos * cos + sin * sin);
  sin /= length;
  turnAbout(x * s, y * s, z * s, cos / length, sin, out, o);
}
