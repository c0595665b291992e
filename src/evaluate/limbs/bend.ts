/**
 * The bend of a limb of three joints, in the first joint's frame: the middle joint turns by A·R(a, θ)·B, of which θ is
 * solved and A and B are of its other DOFs. With the middle pivot b₁ there and the limb's end b₂ in the middle's frame,
 *
 *     u = Aᵀ·b₁   w = B·b₂   p = u·w − (u·a)(w·a)   q = u·(a × w)   h = √(p² + q²)   θ₀ = atan2(q, p)
 *     |b₁ + A·R(a,θ)·B·b₂|² = |b₁|² + |b₂|² + 2(u·a)(w·a) + 2h·cos(θ − θ₀)
 */
import { length3, normalizeAt } from '../../math/vec3.ts';
import type { Limb } from '../../model/limbs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type CompiledSkeleton, writeLocal } from '../kinematics.ts';
import type { Screw } from '../motions/motion.ts';
import { type TurnedJoint, turnedJoint } from './turned-joint.ts';

/** A limb of three joints that is solved in closed form. */
export interface Chain {
  readonly skeleton: CompiledSkeleton;
  readonly first: number;
  readonly middle: number;
  readonly last: number;
  readonly turnsFirst: TurnedJoint;
  /** If it takes the goal's rotation. */
  readonly turnsLast: TurnedJoint | undefined;
  readonly tip: Limb['tip'];
  /** Of the bend, when the goal doesn't say. */
  readonly sign: 1 | -1;
  /** The DOF that is solved, and its axis a. */
  readonly dof: number;
  readonly axis: Screw['axis'];
  /** The screws of A and B, from left to right, with the DOFs that turn them. */
  readonly before: readonly Turn[];
  readonly after: readonly Turn[];
}

interface Turn {
  readonly axis: Screw['axis'];
  readonly dof: number;
}

/** The limb in closed form; undefined if its joints are of other types, or more. */
export function closedChain(limb: Limb, skeleton: Skeleton, compiled: CompiledSkeleton): Chain | undefined {
  const [first, middle, last] = limb.joints;
  const { bend, orient, tip } = limb;
  if (limb.joints.length !== 3 || !bend) return undefined;
  for (let j = last; j >= 0; j = compiled.parent[j]) if (compiled.motions[j].stretches) return undefined;
  const turnsFirst = turnedJoint(skeleton, compiled, first);
  const turnsLast = orient ? turnedJoint(skeleton, compiled, last) : undefined;
  const { screws } = compiled.motions[middle];
  const own = dofsOf(skeleton.joints[middle].motion).findIndex(({ name }) => name === bend.dof);
  const at = screws?.findIndex(({ dof }) => dof === own) ?? -1;
  if (!turnsFirst || !screws || at < 0 || (orient && !turnsLast)) return undefined;
  if (screws.some(({ turn, slide }) => turn !== 1 || slide !== 0)) return undefined;
  const turns = screws.map(({ axis, dof }) => ({ axis, dof: compiled.firstDof[middle] + dof }));
  return {
    ...{ skeleton: compiled, first, middle, last, turnsFirst, turnsLast, tip },
    sign: bend.sign >= 0 ? 1 : -1,
    ...turns[at],
    before: turns.slice(0, at),
    after: turns.slice(at + 1),
  };
}

/** The numbers that a bend is computed from; see the top of the file. Vectors are in the first joint's frame. */
export interface BendNumbers {
  /** |b₁|² + |b₂|² + 2(u·a)(w·a), and h. */
  rest: number;
  h: number;
  angle0: number;
  /** |b₁| + |b₂|. */
  reach: number;
}

/** The results of the last call of `writeBend`. */
export const bendNumbers: BendNumbers = { rest: 0, h: 0, angle0: 0, reach: 0 };
/** b₁ + A·R(a, θ)·B·b₂ of the last call of `writeReach`, and the side of the knee. */
export const reached = new Float64Array(3);
/** The side of the knee, k, of the last call of `writeReach`. */
export const side = new Float64Array(3);

/** Scratch; never escapes. */
const local = new Float64Array(16);
const b1 = new Float64Array(3);
const w = new Float64Array(3);
const u = new Float64Array(3);

/** Computes the numbers of the bend for a pose. */
export function writeBend(chain: Chain, dofs: Float64Array): void {
  const { skeleton, middle, last, before, after, tip, turnsLast } = chain;
  writeLocal(skeleton, middle, dofs, local, 0);
  for (let k = 0; k < 3; k++) u[k] = b1[k] = local[12 + k];
  writeLocal(skeleton, last, dofs, local, 0);
  for (let k = 0; k < 3; k++) {
    w[k] = local[12 + k];
    if (!turnsLast) w[k] += local[k] * tip[0] + local[4 + k] * tip[1] + local[8 + k] * tip[2];
  }
  for (let i = 0; i < before.length; i++) turn(u, before[i].axis, -dofs[before[i].dof]);
  for (let i = after.length - 1; i >= 0; i--) turn(w, after[i].axis, dofs[after[i].dof]);
  const [x, y, z] = chain.axis;
  const alongU = u[0] * x + u[1] * y + u[2] * z;
  const alongW = w[0] * x + w[1] * y + w[2] * z;
  const p = u[0] * w[0] + u[1] * w[1] + u[2] * w[2] - alongU * alongW;
  const q = u[0] * (y * w[2] - z * w[1]) + u[1] * (z * w[0] - x * w[2]) + u[2] * (x * w[1] - y * w[0]);
  const [length1, length2] = [length3(b1[0], b1[1], b1[2]), length3(w[0], w[1], w[2])];
  bendNumbers.rest = length1 * length1 + length2 * length2 + 2 * alongU * alongW;
  bendNumbers.h = Math.sqrt(p * p + q * q);
  bendNumbers.angle0 = Math.atan2(q, p);
  bendNumbers.reach = length1 + length2;
}

/**
 * Writes where the limb's end is at an angle of the bend, and to which side the knee is, after `writeBend` of the same
 * pose.
 */
export function writeReach(chain: Chain, dofs: Float64Array, angle: number, bend: number): void {
  const { before, axis } = chain;
  for (let k = 0; k < 3; k++) {
    reached[k] = w[k];
    side[k] = axis[k];
  }
  turn(reached, axis, angle);
  for (let i = before.length - 1; i >= 0; i--) {
    turn(reached, before[i].axis, dofs[before[i].dof]);
    turn(side, before[i].axis, dofs[before[i].dof]);
  }
  for (let k = 0; k < 3; k++) reached[k] += b1[k];
  // k = bend · unit(c × A·a), here still with the length of c.
  const [x, y, z] = side;
  side[0] = bend * (reached[1] * z - reached[2] * y);
  side[1] = bend * (reached[2] * x - reached[0] * z);
  side[2] = bend * (reached[0] * y - reached[1] * x);
  if (!normalizeAt(side, 0)) writeAcross(reached, side);
}

/** Any direction at right angles to another: that of the axis that is farthest from it. */
function writeAcross(v: Float64Array, out: Float64Array): void {
  const [x, y, z] = [Math.abs(v[0]), Math.abs(v[1]), Math.abs(v[2])];
  out[0] = out[1] = out[2] = 0;
  if (x <= y && x <= z) [out[1], out[2]] = [-v[2], v[1]];
  else if (y <= z) [out[0], out[2]] = [v[2], -v[0]];
  else [out[0], out[1]] = [-v[1], v[0]];
  if (!normalizeAt(out, 0)) out[0] = 1;
}

/** Turns a vector about a unit axis (Rodrigues). */
function turn(v: Float64Array, [x, y, z]: Screw['axis'], angle: number): void {
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  const along = (1 - cos) * (x * v[0] + y * v[1] + z * v[2]);
  const [a, b, c] = [v[0], v[1], v[2]];
  v[0] = cos * a + sin * (y * c - z * b) + along * x;
  v[1] = cos * b + sin * (z * a - x * c) + along * y;
  v[2] = cos * c + sin * (x * b - y * a) + along * z;
}
