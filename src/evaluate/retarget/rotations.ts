/** Rotations as nine numbers, column-major, in flat arrays: what retargeting multiplies at every frame. */

/** `out = a · b`; `out` may not overlap either. */
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

/** `out = aᵀ · b`, which is a⁻¹ · b; `out` may not overlap either. */
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

export function setIdentity3(out: Float64Array, o = 0): void {
  out.fill(0, o, o + 9);
  out[o] = out[o + 4] = out[o + 8] = 1;
}

export function copy3(from: Float64Array, fo: number, to: Float64Array, o: number): void {
  for (let k = 0; k < 9; k++) to[o + k] = from[fo + k];
}

/** The upper left 3×3 of 16 numbers, without its scale and shear: Gram and Schmidt, the first column kept. */
export function rotationOf(m: Float64Array, mo: number, out: Float64Array, o: number): void {
  let x = m[mo];
  let y = m[mo + 1];
  let z = m[mo + 2];
  let s = 1 / (Math.sqrt(x * x + y * y + z * z) || 1);
  x *= s;
  y *= s;
  z *= s;
  let u = m[mo + 4];
  let v = m[mo + 5];
  let w = m[mo + 6];
  const along = x * u + y * v + z * w;
  u -= along * x;
  v -= along * y;
  w -= along * z;
  s = 1 / (Math.sqrt(u * u + v * v + w * w) || 1);
  u *= s;
  v *= s;
  w *= s;
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
  out[o + 3] = u;
  out[o + 4] = v;
  out[o + 5] = w;
  out[o + 6] = y * w - z * v;
  out[o + 7] = z * u - x * w;
  out[o + 8] = x * v - y * u;
}

/** A turn about a unit axis (Rodrigues), by the cosine and sine of its angle. */
export function turnAbout(x: number, y: number, z: number, cos: number, sin: number, out: Float64Array, o: number) {
  const t = 1 - cos;
  out[o] = cos + t * x * x;
  out[o + 1] = t * x * y + sin * z;
  out[o + 2] = t * x * z - sin * y;
  out[o + 3] = t * x * y - sin * z;
  out[o + 4] = cos + t * y * y;
  out[o + 5] = t * y * z + sin * x;
  out[o + 6] = t * x * z + sin * y;
  out[o + 7] = t * y * z - sin * x;
  out[o + 8] = cos + t * z * z;
}

/**
 * The smallest turn that takes one direction to another (of any lengths above 0). Half a turn goes about any axis
 * across; of vectors without a direction there is none, which is the identity.
 */
export function swing(from: Float64Array, fo: number, to: Float64Array, t: number, out: Float64Array, o: number): void {
  const lengths = Math.hypot(from[fo], from[fo + 1], from[fo + 2]) * Math.hypot(to[t], to[t + 1], to[t + 2]);
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
    // Across the smallest part of the direction.
    const [a, b, c] = [Math.abs(from[fo]), Math.abs(from[fo + 1]), Math.abs(from[fo + 2])];
    if (a <= b && a <= c) [x, y, z] = [0, -from[fo + 2], from[fo + 1]];
    else if (b <= c) [x, y, z] = [from[fo + 2], 0, -from[fo]];
    else [x, y, z] = [-from[fo + 1], from[fo], 0];
    const s = 1 / Math.hypot(x, y, z);
    turnAbout(x * s, y * s, z * s, -1, 0, out, o);
    return;
  }
  const s = 1 / sin;
  const length = Math.hypot(cos, sin);
  sin /= length;
  turnAbout(x * s, y * s, z * s, cos / length, sin, out, o);
}

/** The unit quaternion x y z w of a rotation (Shepperd 1978: divides by the largest part). */
export function quaternionOf(m: Float64Array, o: number, q: Float64Array): void {
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
