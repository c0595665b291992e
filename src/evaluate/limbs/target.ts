/** Where a limb goes at a time: its goal, pole and bend, in the character's space. */
import { multiply3, writeRotationPart } from '../../math/mat3.ts';
import type { Limb } from '../../model/limbs.ts';

/** Overwritten for each limb and time. */
export interface Target {
  /** Of the tip, the rotation of the last joint (9 numbers, column-major), and the pole. */
  readonly point: Float64Array;
  readonly turn: Float64Array;
  readonly pole: Float64Array;
  hasPole: boolean;
  bend: 1 | -1;
}

/** A target to be written. */
export function newTarget(): Target {
  return {
    point: new Float64Array(3),
    turn: new Float64Array(9),
    pole: new Float64Array(3),
    hasPole: false,
    bend: 1,
  };
}

/** Scratch; never escapes. */
const own = new Float64Array(9);
const frame = new Float64Array(9);

/**
 * Writes goal and pole of a space to the target.
 * @param values the goal's channels (`GOAL_CHANNELS`) from `at` on
 * @param world the matrices of joints
 * @param space the joint whose space it is; -1 for the character's
 */
export function writeTarget(values: Float64Array, at: number, world: Float64Array, space: number, out: Target): void {
  const { point, turn, pole } = out;
  writePoint(values, at + TX, world, space, point);
  writePoint(values, at + PX, world, space, pole);
  writeEuler(values[at + RX], values[at + RX + 1], values[at + RX + 2], own);
  if (space < 0) turn.set(own);
  else {
    writeRotationPart(world, 16 * space, frame, 0, 3);
    multiply3(frame, 0, own, 0, turn, 0);
  }
}

/** Places in `GOAL_CHANNELS`. */
export const TX = 1;
/** The first angle's. */
export const RX = 4;
/** The first coordinate of the pole's. */
export const PX = 7;
/** The place of `bend` among them. */
export const BEND = 10;

function writePoint(values: Float64Array, at: number, world: Float64Array, space: number, out: Float64Array): void {
  const [x, y, z] = [values[at], values[at + 1], values[at + 2]];
  if (space < 0) {
    out[0] = x;
    out[1] = y;
    out[2] = z;
    return;
  }
  const o = 16 * space;
  for (let k = 0; k < 3; k++)
    out[k] = world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
}

/** Rz·Ry·Rx as 9 numbers, column-major. */
export function writeEuler(x: number, y: number, z: number, out: Float64Array): void {
  const [sx, cx, sy, cy, sz, cz] = [Math.sin(x), Math.cos(x), Math.sin(y), Math.cos(y), Math.sin(z), Math.cos(z)];
  out[0] = cz * cy;
  out[1] = sz * cy;
  out[2] = -sy;
  out[3] = cz * sy * sx - sz * cx;
  out[4] = sz * sy * sx + cz * cx;
  out[5] = cy * sx;
  out[6] = cz * sy * cx + sz * sx;
  out[7] = sz * sy * cx - cz * sx;
  out[8] = cy * cx;
}

/** The place of a limb's tip, with the matrix of its last joint at `last[o]`. */
export function writeTip(tip: Limb['tip'], last: Float64Array, o: number, out: Float64Array): void {
  for (let k = 0; k < 3; k++) {
    out[k] = last[o + k] * tip[0] + last[o + 4 + k] * tip[1] + last[o + 8 + k] * tip[2] + last[o + 12 + k];
  }
}
