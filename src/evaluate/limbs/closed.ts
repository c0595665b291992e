/**
 * A limb of three joints in closed form (`bend.ts` has the bend): with the first pivot S, the point g that the limb's
 * end goes to, θ bends it to the length |g − S|, and the first joint turns (c, k, c×k) to (d, m, d×m):
 *
 *     c   unit of the limb's end at θ        k   the side of the knee         both in the first joint's frame
 *     d   unit of g − S                      m   unit of the part of pole − S across d
 *
 * Without a pole, or with one on the line, m is of k turned by FK's first joint; if that is on the line too, of the
 * parent's x, then y axis. Out of reach the limb goes straight towards its goal.
 */

import { turnedNear } from '../../math/euler.ts';
import { backMultiply3, multiply3 } from '../../math/mat3.ts';
import { length3, normalizeAt } from '../../math/vec3.ts';
import { type CompiledSkeleton, writeLocal } from '../kinematics.ts';
import { bendNumbers, type Chain, reached, side, writeBend, writeReach } from './bend.ts';
import type { Target } from './target.ts';
import { turnJoint } from './turned-joint.ts';

/** A direction is on a line if less of it is across: its part. */
const ON_LINE = 1e-9;
/**
 * Rounding of a goal's distance, in parts of the numbers that it is computed from. A limb that reaches its goal with
 * FK's angle keeps that: where it is nearly straight, the angle is lost in the digits of the distance.
 */
const ROUNDING = 2 ** -46;

const IDENTITY = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);

/** Scratch; never escapes. */
const local = new Float64Array(16);
const parentTurn = new Float64Array(9);
/** The first pivot. */
const pivot = new Float64Array(3);
const fkTurn = new Float64Array(9);
const firstTurn = new Float64Array(9);
const middleTurn = new Float64Array(9);
const rotation = new Float64Array(9);
const from = new Float64Array(9);
const to = new Float64Array(9);
const d = new Float64Array(3);
const m = new Float64Array(3);
const v = new Float64Array(3);

/**
 * The world rotation of FK's first joint, 9 numbers, and its pivot, of the last call of `placeFirst`; valid until the
 * next.
 */
export const placed = { turn: fkTurn, pivot };

/** Computes where FK has the first joint. @param world of its parent, at least */
export function placeFirst({ skeleton, first }: Chain, dofs: Float64Array, world: Float64Array): void {
  writeLocal(skeleton, first, dofs, local, 0);
  const above = skeleton.parent[first];
  const p = 16 * above;
  for (let c = 0; c < 3; c++) {
    for (let k = 0; k < 3; k++) {
      parentTurn[3 * c + k] = above < 0 ? IDENTITY[3 * c + k] : world[p + 4 * c + k];
      rotation[3 * c + k] = local[4 * c + k];
    }
  }
  for (let k = 0; k < 3; k++) {
    pivot[k] =
      above < 0
        ? local[12 + k]
        : world[p + k] * local[12] + world[p + 4 + k] * local[13] + world[p + 8 + k] * local[14] + world[p + 12 + k];
  }
  multiply3(parentTurn, 0, rotation, 0, fkTurn, 0);
}

/**
 * Replaces FK's DOFs of the limb by those that reach the target, the nearest ones.
 * @param world of the first joint's parent, at least
 */
export function solveClosed(chain: Chain, target: Target, dofs: Float64Array, world: Float64Array): void {
  const { skeleton, middle, turnsFirst, turnsLast, tip, dof } = chain;
  const { point, turn, bend } = target;
  placeFirst(chain, dofs, world);
  writeBend(chain, dofs);
  let size = 0;
  for (let k = 0; k < 3; k++) {
    const end = turnsLast ? point[k] - turn[k] * tip[0] - turn[3 + k] * tip[1] - turn[6 + k] * tip[2] : point[k];
    d[k] = end - pivot[k];
    size += Math.abs(end) + Math.abs(pivot[k]);
  }
  const angle = bentAngle(dofs[dof], bend, length3(d[0], d[1], d[2]), size);
  writeReach(chain, dofs, angle, bend);
  writeDirections(target);
  // Columns (c, k, c×k) and (d, m, d×m).
  writeFrame(reached, side, from);
  writeFrame(d, m, to);
  // to · fromᵀ: the first joint's rotation.
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) {
      firstTurn[3 * c + r] = to[r] * from[c] + to[3 + r] * from[3 + c] + to[6 + r] * from[6 + c];
    }
  }
  backMultiply3(parentTurn, 0, firstTurn, 0, rotation, 0);
  turnJoint(turnsFirst, rotation, dofs);
  dofs[dof] = angle;
  if (!turnsLast) return;
  writeTurn(skeleton, middle, dofs, rotation);
  multiply3(firstTurn, 0, rotation, 0, middleTurn, 0);
  backMultiply3(middleTurn, 0, turn, 0, rotation, 0);
  turnJoint(turnsLast, rotation, dofs);
}

/** θ, nearest to FK's. @param size of the numbers that the distance was computed from */
function bentAngle(fk: number, bend: number, distance: number, size: number): number {
  const { rest, h, angle0, reach } = bendNumbers;
  if (!(h > 0)) return fk;
  const bent = fk - angle0;
  const sine = Math.sin(bent);
  if (bend * sine >= -ON_LINE) {
    const off = rest + 2 * h * Math.cos(bent) - distance * distance;
    if (Math.abs(off) <= ROUNDING * (size + reach) * reach) return fk;
  }
  const cos = Math.min(1, Math.max(-1, (distance * distance - rest) / (2 * h)));
  return turnedNear(angle0 + bend * Math.acos(cos), fk);
}

/** Makes d a unit vector, and writes m. */
function writeDirections({ pole, hasPole }: Target): void {
  // At the first pivot itself, any direction will do: FK's.
  if (!normalizeAt(d, 0)) {
    turned(reached, d);
    if (!normalizeAt(d, 0)) turned(side, d);
  }
  if (hasPole) {
    for (let k = 0; k < 3; k++) v[k] = pole[k] - pivot[k];
    if (isAcross(v)) return;
  }
  turned(side, v);
  if (isAcross(v)) return;
  for (let axis = 0; axis < 2; axis++) {
    for (let k = 0; k < 3; k++) v[k] = parentTurn[3 * axis + k];
    if (isAcross(v)) return;
  }
}

/** A vector of the first joint's frame, turned by FK's. */
function turned(a: Float64Array, out: Float64Array): void {
  for (let k = 0; k < 3; k++) out[k] = fkTurn[k] * a[0] + fkTurn[3 + k] * a[1] + fkTurn[6 + k] * a[2];
}

/** Writes the unit of a vector's part across d to m; returns false if it is on the line. */
function isAcross(a: Float64Array): boolean {
  const along = a[0] * d[0] + a[1] * d[1] + a[2] * d[2];
  for (let k = 0; k < 3; k++) m[k] = a[k] - along * d[k];
  const part = length3(m[0], m[1], m[2]);
  return part > ON_LINE * length3(a[0], a[1], a[2]) && normalizeAt(m, 0);
}

/** The right-handed frame of two directions, of which the second is made orthogonal to the first. */
function writeFrame(x: Float64Array, y: Float64Array, out: Float64Array): void {
  for (let k = 0; k < 3; k++) {
    out[k] = x[k];
    out[3 + k] = y[k];
  }
  if (!normalizeAt(out, 0)) {
    // Folded onto its first pivot, the limb has no direction: one across its side.
    out[0] = -y[1];
    out[1] = y[0];
    out[2] = 0;
    if (!normalizeAt(out, 0)) out[0] = 1;
  }
  const along = out[0] * out[3] + out[1] * out[4] + out[2] * out[5];
  for (let k = 0; k < 3; k++) out[3 + k] -= along * out[k];
  normalizeAt(out, 3);
  out[6] = out[1] * out[5] - out[2] * out[4];
  out[7] = out[2] * out[3] - out[0] * out[5];
  out[8] = out[0] * out[4] - out[1] * out[3];
}

/** A joint's rotation relative to its parent, as 9 numbers. */
function writeTurn(skeleton: CompiledSkeleton, j: number, dofs: Float64Array, out: Float64Array): void {
  writeLocal(skeleton, j, dofs, local, 0);
  for (let c = 0; c < 3; c++) for (let k = 0; k < 3; k++) out[3 * c + k] = local[4 * c + k];
}
