/**
 * The goal, pole and bend at which IK gives FK's pose of a limb, in a space:
 *
 *     goal   the tip of the FK pose and the last joint's rotation
 *     bend   the sign of sin(θ − θ₀)
 *     pole   S + ½(g − S) + (|b₁| + |b₂|) · k
 */
import { backMultiply3, writeRotationPart } from '../../math/mat3.ts';
import { invertAffine } from '../../math/mat4.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { LimbMatch } from '../../model/limbs.ts';
import { bendNumbers, reached, side, writeBend, writeReach } from './bend.ts';
import { placed, placeFirst } from './closed.ts';
import type { CompiledLimb, TakeLimbs } from './over-pose.ts';
import { writeTip } from './target.ts';

/** A bend of less is none. */
const STRAIGHT = 1e-9;

/**
 * Matches IK to the pose of a limb.
 * @param dofs a pose, with the matrices of `TakeLimbs.world` computed
 * @param space the joint in whose space the goal is; -1 for the character's
 */
export function matchOf(all: TakeLimbs, limb: CompiledLimb, dofs: Float64Array, space: number): LimbMatch {
  const { chain } = limb;
  const last = new Float64Array(16);
  all.writeLast(limb, dofs, last);
  const tip = new Float64Array(3);
  writeTip(limb.limb.tip, last, 0, tip);
  const point = intoSpace(all.world, space, tip);
  const goal = [...point, ...anglesIn(all.world, space, last)];
  if (!chain) return { goal, pole: [0, 0, 0], bend: (limb.limb.bend?.sign ?? 1) >= 0 ? 1 : -1 };
  placeFirst(chain, dofs, all.world);
  writeBend(chain, dofs);
  const sine = Math.sin(dofs[chain.dof] - bendNumbers.angle0);
  const bend = Math.abs(sine) < STRAIGHT ? chain.sign : sine > 0 ? 1 : -1;
  writeReach(chain, dofs, dofs[chain.dof], bend);
  const pole = new Float64Array(3);
  const { turn, pivot } = placed;
  for (let k = 0; k < 3; k++) {
    pole[k] = pivot[k];
    for (let c = 0; c < 3; c++) pole[k] += turn[3 * c + k] * (reached[c] / 2 + bendNumbers.reach * side[c]);
  }
  return { goal, pole: intoSpace(all.world, space, pole), bend };
}

/** A point of the character's space in that of a joint. */
export function intoSpace(world: Float64Array, space: number, [x, y, z]: ArrayLike<number> & Iterable<number>): Vec3 {
  if (space < 0) return [x, y, z];
  const inverse = new Float64Array(16);
  invertAffine(world, 16 * space, inverse, 0);
  const along = (k: number) => inverse[k] * x + inverse[4 + k] * y + inverse[8 + k] * z + inverse[12 + k];
  return [along(0), along(1), along(2)];
}

/** The rotation of a matrix in the space of a joint, as rx ry rz of Rz·Ry·Rx. */
export function anglesIn(world: Float64Array, space: number, matrix: Float64Array): Vec3 {
  const turn = new Float64Array(9);
  writeRotationPart(matrix, 0, turn, 0, 3);
  const relative = turn.slice();
  if (space >= 0) {
    const frame = new Float64Array(9);
    writeRotationPart(world, 16 * space, frame, 0, 3);
    backMultiply3(frame, 0, turn, 0, relative, 0);
  }
  const [x0, x1, x2, y0, y1, y2, z0, z1, z2] = relative;
  const cosY = Math.hypot(y2, z2);
  // In gimbal lock only the sum or the difference of two angles counts: z is none of it.
  const z = cosY < 1e-12 ? 0 : Math.atan2(x1, x0);
  const [sin, cos] = [Math.sin(z), Math.cos(z)];
  // With what z leaves of the rotation, x is right near gimbal lock, too, where either alone is rounded.
  return [Math.atan2(sin * z0 - cos * z1, cos * y1 - sin * y0), Math.atan2(-x2, cosY), z];
}
