/** x, y, z. */
export type Vec3 = readonly [number, number, number];

/** The zero vector, shared; it must not be mutated. */
export const ZERO: Vec3 = [0, 0, 0];

/**
 * The length of (x, y, z). `Math.hypot` takes several times as long and is needed only if squares overflow or
 * underflow.
 */
export function length3(x: number, y: number, z: number): number {
  const square = x * x + y * y + z * z;
  return square > 1e-280 && square < Infinity ? Math.sqrt(square) : Math.hypot(x, y, z);
}

/**
 * Normalises `a[o …]` in place, whatever its length. Returns false and changes nothing if it has no direction: zero or
 * not finite.
 */
export function normalizeAt(a: Float64Array, o: number): boolean {
  const x = a[o];
  const y = a[o + 1];
  const z = a[o + 2];
  const square = x * x + y * y + z * z;
  if (square > 1e-200 && square < 1e200) {
    const s = 1 / Math.sqrt(square);
    a[o] = x * s;
    a[o + 1] = y * s;
    a[o + 2] = z * s;
    return true;
  }
  // Squares would overflow or underflow: scale by the largest component.
  const largest = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
  if (!(largest > 0 && largest < Infinity)) return false;
  const s = 1 / Math.hypot(x / largest, y / largest, z / largest);
  a[o] = (x / largest) * s;
  a[o + 1] = (y / largest) * s;
  a[o + 2] = (z / largest) * s;
  return true;
}

// Vectors as tuples, for code that runs once per drag or frame: each result is a new tuple.

/** a + times · b. */
export function add(a: Vec3, b: Vec3, times = 1): Vec3 {
  return [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]];
}

/** a − b. */
export function subtract(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/** by · a. */
export function scaled(a: Vec3, by: number): Vec3 {
  return [a[0] * by, a[1] * by, a[2] * by];
}

/** The dot product a · b. */
export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The cross product a × b. */
export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** The opposite vector; 0 stays 0, never −0. */
export function negated([x, y, z]: Vec3): Vec3 {
  return [-x + 0, -y + 0, -z + 0];
}

/** Mirrored across the plane perpendicular to an axis: `across` is 0, 1 or 2 for x, y or z. */
export function reflected(v: Vec3, across: number): Vec3 {
  // Adding 0 avoids −0.
  const at = (k: number) => (k === across ? -v[k] + 0 : v[k]);
  return [at(0), at(1), at(2)];
}

/** Normalised; undefined if it has no direction. */
export function unit(a: Vec3): Vec3 | undefined {
  const length = Math.hypot(...a);
  return length > 0 && length < Infinity ? scaled(a, 1 / length) : undefined;
}

/** One of the directions perpendicular to a unit vector. */
export function acrossOf(axis: Vec3): Vec3 {
  const [x, y, z] = axis;
  const least = Math.abs(x) <= Math.abs(y) && Math.abs(x) <= Math.abs(z) ? 0 : Math.abs(y) <= Math.abs(z) ? 1 : 2;
  const other: Vec3 = [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0];
  return unit(cross(axis, other)) ?? [1, 0, 0];
}

/** The point transformed by the column-major affine 4×4 matrix at `m[o …]`. */
export function transformPoint(m: Float64Array, [x, y, z]: Vec3, o = 0): Vec3 {
  return [
    m[o] * x + m[o + 4] * y + m[o + 8] * z + m[o + 12],
    m[o + 1] * x + m[o + 5] * y + m[o + 9] * z + m[o + 13],
    m[o + 2] * x + m[o + 6] * y + m[o + 10] * z + m[o + 14],
  ];
}

/** A vector transformed by an affine matrix of 16 numbers at `o`: without its translation. */
export function transformVector(m: Float64Array, [x, y, z]: Vec3, o = 0): Vec3 {
  return [
    m[o] * x + m[o + 4] * y + m[o + 8] * z,
    m[o + 1] * x + m[o + 5] * y + m[o + 9] * z,
    m[o + 2] * x + m[o + 6] * y + m[o + 10] * z,
  ];
}
