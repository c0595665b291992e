/**
 * Vectors and rotation matrices for building samples: small values that are made and thrown away, which is fine here
 * since this code runs once, on the desk of whoever changes a sample, and never while a character plays.
 *
 * A rotation is nine numbers by rows: `[m00, m01, m02, m10, …]`, acting on column vectors.
 */
import type { Vec3 } from '../../math/vec3.ts';

export type Mat3 = readonly number[];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const mixVec = (a: Vec3, b: Vec3, t: number): Vec3 => add(scale(a, 1 - t), scale(b, t));

/** Of length 1; a zero vector stays zero. */
export function normalise(a: Vec3): Vec3 {
  return scale(a, 1 / (length(a) || 1));
}

export const rotationX = (a: number): Mat3 => [1, 0, 0, 0, Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a)];
export const rotationY = (a: number): Mat3 => [Math.cos(a), 0, Math.sin(a), 0, 1, 0, -Math.sin(a), 0, Math.cos(a)];
export const rotationZ = (a: number): Mat3 => [Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a), 0, 0, 0, 1];

/** The product of rotations, from left to right as written: the last one is applied first. */
export function rotate(...factors: readonly Mat3[]): Mat3 {
  return factors.reduce((a, b) => {
    const out: number[] = [];
    for (let r = 0; r < 9; r += 3) {
      for (let c = 0; c < 3; c++) out.push(a[r] * b[c] + a[r + 1] * b[c + 3] + a[r + 2] * b[c + 6]);
    }
    return out;
  });
}

export const inverse = (m: Mat3): Mat3 => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
export const apply = (m: Mat3, v: Vec3): Vec3 => [
  m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
  m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
  m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
];

/** The rotation whose columns are these axes. */
export const fromAxes = (x: Vec3, y: Vec3, z: Vec3): Mat3 => [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]];

/** rx, ry, rz of a ball joint in xyz order: R = Rz·Ry·Rx, |ry| ≤ π/2. */
export function ballAngles(m: Mat3): Vec3 {
  return [Math.atan2(m[7], m[8]), Math.asin(Math.max(-1, Math.min(1, -m[6]))), Math.atan2(m[3], m[0])];
}

/** R = Rz·Ry·Rx. */
export const ballRotation = (a: Vec3): Mat3 => rotate(rotationZ(a[2]), rotationY(a[1]), rotationX(a[0]));

/** 0 below `from`, 1 above `to`, an S between (either way round). */
export function smoothstep(from: number, to: number, x: number): number {
  const t = Math.max(0, Math.min(1, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

export const mix = (a: number, b: number, t: number): number => a + (b - a) * t;

/** To so many decimals, without a negative zero. */
export function round(x: number, decimals: number): number {
  return Number(x.toFixed(decimals)) + 0;
}
