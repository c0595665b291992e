/** Three numbers at a time, for what is done once a drag or once a picture. */
import type { Vec3 } from '../../math/vec3.ts';

export function add(a: Vec3, b: Vec3, times = 1): Vec3 {
  return [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]];
}

export function subtract(a: Vec3, b: Vec3): Vec3 {
  return add(a, b, -1);
}

export function scaled(a: Vec3, by: number): Vec3 {
  return [a[0] * by, a[1] * by, a[2] * by];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Of length 1; undefined where it has no direction. */
export function unit(a: Vec3): Vec3 | undefined {
  const length = Math.hypot(...a);
  return length > 0 && length < Infinity ? scaled(a, 1 / length) : undefined;
}

/** The 3×3 part of a column-major matrix at `o`, times a vector. */
export function turned(m: Float64Array, v: Vec3, o = 0): Vec3 {
  const [x, y, z] = v;
  return [
    m[o] * x + m[o + 4] * y + m[o + 8] * z,
    m[o + 1] * x + m[o + 5] * y + m[o + 9] * z,
    m[o + 2] * x + m[o + 6] * y + m[o + 10] * z,
  ];
}

/** The whole of it, times a point. */
export function moved(m: Float64Array, p: Vec3, o = 0): Vec3 {
  return add(turned(m, p, o), [m[o + 12], m[o + 13], m[o + 14]]);
}

/** One of the directions at right angles to one of length 1. */
export function acrossOf(axis: Vec3): Vec3 {
  const [x, y, z] = axis;
  const least = Math.abs(x) <= Math.abs(y) && Math.abs(x) <= Math.abs(z) ? 0 : Math.abs(y) <= Math.abs(z) ? 1 : 2;
  const other: Vec3 = [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0];
  return unit(cross(axis, other)) ?? [1, 0, 0];
}
