/**
 * Vectors and rotation matrices for building examples: allocated freely, since this code runs only when an example is
 * changed, never while a character plays.
 */
import { multiply3, turnVector } from '../../../src/math/mat3.ts';
import { add, scaled, type Vec3 } from '../../../src/math/vec3.ts';

/** A rotation, column-major as in `math/mat3.ts`. */
export type Mat3 = Float64Array;

export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const mixVec = (a: Vec3, b: Vec3, t: number): Vec3 => add(scaled(a, 1 - t), scaled(b, t));

/** Unit length; a zero vector stays zero. */
export function normalise(a: Vec3): Vec3 {
  return scaled(a, 1 / (length(a) || 1));
}

export const rotationX = (a: number): Mat3 =>
  Float64Array.of(1, 0, 0, 0, Math.cos(a), Math.sin(a), 0, -Math.sin(a), Math.cos(a));
export const rotationY = (a: number): Mat3 =>
  Float64Array.of(Math.cos(a), 0, -Math.sin(a), 0, 1, 0, Math.sin(a), 0, Math.cos(a));
export const rotationZ = (a: number): Mat3 =>
  Float64Array.of(Math.cos(a), Math.sin(a), 0, -Math.sin(a), Math.cos(a), 0, 0, 0, 1);

/** The product of rotations as written: the last one is applied first. */
export function rotate(...factors: readonly Mat3[]): Mat3 {
  return factors.reduce((a, b) => {
    const out = new Float64Array(9);
    multiply3(a, 0, b, 0, out, 0);
    return out;
  });
}

export const inverse = (m: Mat3): Mat3 => Float64Array.of(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);

export function apply(m: Mat3, [x, y, z]: Vec3): Vec3 {
  const out = Float64Array.of(x, y, z);
  turnVector(m, 0, out, 0, out, 0);
  return [out[0], out[1], out[2]];
}

/** The rotation whose columns are these axes. */
export const fromAxes = (x: Vec3, y: Vec3, z: Vec3): Mat3 => Float64Array.of(...x, ...y, ...z);

/** rx, ry, rz of a ball joint in xyz order: R = Rz·Ry·Rx, |ry| ≤ π/2. */
export function ballAngles(m: Mat3): Vec3 {
  return [Math.atan2(m[5], m[8]), Math.asin(Math.max(-1, Math.min(1, -m[2]))), Math.atan2(m[1], m[0])];
}

/** R = Rz·Ry·Rx. */
export const ballRotation = (a: Vec3): Mat3 => rotate(rotationZ(a[2]), rotationY(a[1]), rotationX(a[0]));

export const mix = (a: number, b: number, t: number): number => a + (b - a) * t;

/** Rounded to so many decimals, without a negative zero. */
export function round(x: number, decimals: number): number {
  return Number(x.toFixed(decimals)) + 0;
}
