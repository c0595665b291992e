/**
 * A student's solver of inverse kinematics for axis-angle skeletons, written apart from ours: two arms on a trunk, by
 * rotations about an axis and J = a × (p − o).
 */
import { add, cross, dot, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';

/** Length, parent from 1 (0: none), axis, degrees. The first hand is the fourth bone, the other one the sixth. */
export const ARMS = [
  [1, 0, 0, 0, 1, 10],
  [1.2, 1, 1, 0, 0, 35],
  [0.9, 2, 0, 0, 1, -25],
  [0.7, 3, 1, 1, 0, 40],
  [1.1, 1, 0, 1, 1, -50],
  [0.8, 5, 1, 0, 0, -30],
] as const;

const childrenOf = (j: number) => ARMS.filter(([, parent]) => parent === j + 1).length;

/** The file: a bone a line, in depth-first order, its number of children last. */
export const ARMS_TEXT = ARMS.map(
  ([length, , x, y, z, angle], j) => `${length} ${x} ${y} ${z} ${angle} ${childrenOf(j)}\n`,
).join('');
export const HAND = 3;
export const OTHER_HAND = 5;

/** Columns of the rotation, and the origin. */
export interface Frame {
  readonly x: Vec3;
  readonly y: Vec3;
  readonly z: Vec3;
  readonly origin: Vec3;
}

function rotated(v: Vec3, axis: Vec3, angle: number): Vec3 {
  const a = scaled(axis, 1 / Math.hypot(...axis));
  const turned = add(scaled(v, Math.cos(angle)), cross(a, v), Math.sin(angle));
  return add(turned, a, dot(a, v) * (1 - Math.cos(angle)));
}

function inFrame({ x, y, z }: Frame, [a, b, c]: Vec3): Vec3 {
  return add(add(scaled(x, a), y, b), z, c);
}

const GROUND: Frame = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], origin: [0, 0, 0] };

export function framesOf(angles: readonly number[]): readonly Frame[] {
  const frames: Frame[] = [];
  ARMS.forEach(([, parent, ...axis], j) => {
    const above = parent === 0 ? GROUND : frames[parent - 1];
    const length = parent === 0 ? 0 : ARMS[parent - 1][0];
    const turn = (v: Vec3) => inFrame(above, rotated(v, [axis[0], axis[1], axis[2]], angles[j]));
    const [x, y, z] = [turn([1, 0, 0]), turn([0, 1, 0]), turn([0, 0, 1])];
    frames.push({ x, y, z, origin: add(above.origin, above.y, length) });
  });
  return frames;
}

export const START: readonly number[] = ARMS.map(([, , , , , angle]) => (angle * Math.PI) / 180);

export function tipOf(angles: readonly number[], joint: number): Vec3 {
  const { origin, y } = framesOf(angles)[joint];
  return add(origin, y, ARMS[joint][0]);
}

/** A column of J for each bone; 0 for those that don't move the point. */
export function jacobian(angles: readonly number[], joint: number, point: Vec3): readonly Vec3[] {
  const frames = framesOf(angles);
  const onPath = new Set<number>();
  for (let j = joint; j >= 0; j = ARMS[j][1] - 1) onPath.add(j);
  return ARMS.map(([, , x, y, z], j) => {
    const a = inFrame(frames[j], scaled([x, y, z], 1 / Math.hypot(x, y, z)));
    return onPath.has(j) ? cross(a, subtract(point, frames[j].origin)) : [0, 0, 0];
  });
}

/** Jᵀe for the tip of a joint. */
export function transposeStep(angles: readonly number[], joint: number, target: Vec3): readonly number[] {
  const tip = tipOf(angles, joint);
  const error = subtract(target, tip);
  return jacobian(angles, joint, tip).map((column) => dot(column, error));
}

/** Until the tip is there. */
export function reached(joint: number, target: Vec3): readonly number[] {
  let angles = START;
  for (let i = 0; i < 20000; i++) {
    const step = transposeStep(angles, joint, target);
    if (step.every((part) => Math.abs(part) < 1e-7)) break;
    angles = stepped(angles, step, 0.03);
  }
  return angles;
}

export function stepped(angles: readonly number[], step: readonly number[], by = 1): readonly number[] {
  return angles.map((angle, j) => angle + by * step[j]);
}

/** Column-major, as floats print. */
export function worldOf(angles: readonly number[]): Float64Array {
  return Float64Array.from(
    framesOf(angles).flatMap(({ x, y, z, origin }) => [...x, 0, ...y, 0, ...z, 0, ...origin, 1]),
    (value) => Number(value.toPrecision(6)),
  );
}

export function positionsOf(angles: readonly number[]): Float64Array {
  return Float64Array.from(
    framesOf(angles).flatMap(({ origin }) => origin),
    (value) => Number(value.toPrecision(6)),
  );
}
