/**
 * Finds the DOFs that rotate a joint as close as possible to a rotation L, for any joint type.
 *
 *     quaternion              q(L)
 *     three Euler angles      exact; of the two solutions the one nearest to the file pose
 *     anything else, and      the angles that maximise  f = tr(R(φ)ᵀ · L · (I + w·d·dᵀ))
 *     if limits apply         one angle at a time, each with the best value within its limits
 *
 * d is the direction of the bone and w its weight relative to the twist: if both can't be matched, a forearm should
 * point the right way rather than have the right twist. In each single angle f is A·cos φ + B·sin φ + C, so its best
 * value is known directly; cycling over two or three angles converges within a few rounds. (Gauss-Newton takes fewer
 * rounds, but needs derivatives and special treatment at every limit.)
 */
import { eulerNear, turnedNear } from '../../math/euler.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { dofsOf, quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Joint } from '../../model/skeleton/skeleton.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import { eulerDofs, type RenamedAxes, renamedAxes, rigidEulerDofs } from '../rotations/euler-dofs.ts';

const BONE_WEIGHT = 4;
const MAX_SWEEPS = 24;
const SETTLED = 1e-10;

/** How one joint's angles are found; angles are in radians. */
export interface JointFit {
  /** Index into the character's DOFs. */
  readonly first: number;
  /** Indices of the angles among the joint's own DOFs. */
  readonly angles: Int32Array;
  /** In the order of `angles`; infinite if the character doesn't enforce limits. */
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** The angles of the file pose; of equivalent solutions the nearest to them is chosen. */
  readonly rest: Float64Array;
  /** `angles` in order of application; absent if they are no whole rotation. */
  readonly euler?: RenamedAxes & { readonly applied: readonly number[] };
  readonly isQuaternion: boolean;
}

/** Undefined for a joint that can't rotate. */
export function jointFit(skeleton: CompiledSkeleton, joint: Joint, j: number, clamps: boolean): JointFit | undefined {
  const first = skeleton.firstDof[j];
  const at = first - skeleton.firstDof[0];
  const dofs = dofsOf(joint.motion);
  const isQuaternion = quaternionDofs(joint.motion).length > 0;
  const angles = dofs.flatMap(({ unit }, d) => (unit === 'angle' ? [d] : []));
  if (!angles.length && !isQuaternion) return undefined;
  const bound = (limits: Float64Array, none: number) =>
    Float64Array.from(angles, (d) => (clamps ? limits[at + d] : none));
  // Translations in between don't affect the rotation of a compound; scales do.
  const euler = rigidEulerDofs(joint.motion) ?? eulerDofs(joint.motion);
  const at3 = euler && [euler.x, euler.y, euler.z].map((d) => angles.indexOf(d));
  const renaming = euler && renamedAxes(euler.order);
  return {
    first,
    angles: Int32Array.from(angles),
    lower: bound(skeleton.lower, -Infinity),
    upper: bound(skeleton.upper, Infinity),
    rest: Float64Array.from(angles, (d) => joint.pose[d] ?? 0),
    isQuaternion,
    ...(renaming && { euler: { ...renaming, applied: renaming.axes.map((axis) => at3?.[axis] ?? 0) } }),
  };
}

/** Scratch; never escapes. */
const q = new Float64Array(4);
const renamed = new Float64Array(9);
const three = new Float64Array(3);
const weighted = new Float64Array(9);
const matrix = new Float64Array(16);

/**
 * Writes the joint's DOFs to `dofs`.
 * @param wanted nine numbers: the rotation relative to the parent
 * @param bone a unit vector at `bo` in the joint's own space; zero if no direction counts more than others
 */
export function fitJoint(
  { motions }: CompiledSkeleton,
  j: number,
  fit: JointFit,
  wanted: Float64Array,
  bone: Float64Array,
  bo: number,
  dofs: Float64Array,
): void {
  const { first, angles, lower, upper, rest } = fit;
  if (fit.isQuaternion) {
    quaternionOfRotation(wanted, 0, q);
    const sign = q[3] < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) dofs[first + k] = sign * q[k];
    return;
  }
  let isDone = false;
  for (let i = 0; i < angles.length; i++) dofs[first + angles[i]] = rest[i];
  if (fit.euler) {
    const { axes, sign, applied } = fit.euler;
    for (let r = 0; r < 3; r++) {
      for (let c = 0; c < 3; c++) renamed[3 * c + r] = wanted[3 * axes[c] + axes[r]];
    }
    quaternionOfRotation(renamed, 0, q);
    for (let i = 0; i < 3; i++) three[i] = sign * rest[applied[i]];
    eulerNear(q, three, 0);
    isDone = true;
    for (let i = 0; i < 3; i++) {
      const a = applied[i];
      const value = sign * three[i];
      const kept = Math.min(upper[a], Math.max(lower[a], value));
      if (kept !== value) isDone = false;
      dofs[first + angles[a]] = kept;
    }
  } else {
    for (let i = 0; i < angles.length; i++) {
      dofs[first + angles[i]] = Math.min(upper[i], Math.max(lower[i], rest[i]));
    }
  }
  if (isDone) return;
  weigh(wanted, bone, bo);
  for (let sweep = 0; sweep < MAX_SWEEPS; sweep++) {
    let moved = 0;
    for (let i = 0; i < angles.length; i++) {
      if (upper[i] <= lower[i]) continue;
      const at = first + angles[i];
      const before = dofs[at];
      const best = bestAngle(motions[j], first, at, lower[i], upper[i], rest[i], dofs);
      dofs[at] = best;
      moved = Math.max(moved, Math.abs(best - before));
    }
    if (moved < SETTLED || angles.length === 1) return;
  }
}

/** L · (I + w·d·dᵀ) = L + w·(L·d)·dᵀ */
function weigh(wanted: Float64Array, bone: Float64Array, bo: number): void {
  const x = bone[bo];
  const y = bone[bo + 1];
  const z = bone[bo + 2];
  for (let r = 0; r < 3; r++) {
    const along = BONE_WEIGHT * (wanted[r] * x + wanted[3 + r] * y + wanted[6 + r] * z);
    weighted[r] = wanted[r] + along * x;
    weighted[3 + r] = wanted[3 + r] + along * y;
    weighted[6 + r] = wanted[6 + r] + along * z;
  }
}

function bestAngle(
  motion: CompiledSkeleton['motions'][number],
  first: number,
  at: number,
  low: number,
  high: number,
  rest: number,
  dofs: Float64Array,
): number {
  const here = dofs[at];
  const f0 = score(motion, first, at, 0, dofs);
  const f1 = score(motion, first, at, Math.PI / 2, dofs);
  const f2 = score(motion, first, at, Math.PI, dofs);
  const c = (f0 + f2) / 2;
  const a = (f0 - f2) / 2;
  const b = f1 - c;
  // The angle has no effect, like the twist of a bone in gimbal lock.
  if (a * a + b * b < 1e-24) return here;
  const best = turnedNear(Math.atan2(b, a), rest);
  if (best >= low && best <= high) return best;
  const back = best - 2 * Math.PI;
  if (back >= low && back <= high) return back;
  const on = best + 2 * Math.PI;
  if (on >= low && on <= high) return on;
  const atLow = low > -Infinity ? a * Math.cos(low) + b * Math.sin(low) : -Infinity;
  const atHigh = high < Infinity ? a * Math.cos(high) + b * Math.sin(high) : -Infinity;
  return atLow >= atHigh ? low : high;
}

function score(
  motion: CompiledSkeleton['motions'][number],
  first: number,
  at: number,
  value: number,
  dofs: Float64Array,
): number {
  dofs[at] = value;
  motion.write(dofs, first, matrix, 0);
  let sum = 0;
  for (let col = 0; col < 3; col++) {
    for (let r = 0; r < 3; r++) sum += matrix[4 * col + r] * weighted[3 * col + r];
  }
  return sum;
}
