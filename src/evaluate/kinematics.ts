/**
 * Forward kinematics: from a character's DOFs to the matrices of its joints.
 *
 *     local L = T(offset) · J(φ)        world W = W_parent · L        root: L = T(offset + root translation) · J(φ)
 *
 * All functions take the character's complete list of DOFs (`model/dofs.ts`): root translation, joints, morphs.
 * Matrices are 16 numbers per joint, column-major, in the character's own space (before its placement).
 */
import { multiplyAffine } from '../math/mat4.ts';
import { writeRotation } from '../math/quaternion.ts';
import { perObject } from '../model/per-object.ts';
import { couplesOf, type DofCouple } from '../model/skeleton/couples.ts';
import { rootDofCount } from '../model/skeleton/dofs.ts';
import { dofsOf, factorsOf, offsetBesideDofs, takesLimits } from '../model/skeleton/joint-types.ts';
import { perSkeleton } from '../model/skeleton/per-skeleton.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from '../model/skeleton/skeleton.ts';
import { stretchOf } from '../model/skeleton/stretch.ts';
import { atTip } from './motions/acclaim.ts';
import type { JointMotion } from './motions/motion.ts';
import { jointMotion } from './motions.ts';
import { appliedDofs, eulerDofs } from './rotations/euler-dofs.ts';
import type { PoseRotations } from './rotations/pose-rotations.ts';

/** A skeleton ready for posing. Joints are in depth-first pre-order, so a subtree is a contiguous range. */
export interface CompiledSkeleton {
  readonly jointCount: number;
  /** Number of DOFs of all joints, without root translation and morphs. */
  readonly dofCount: number;
  /** -1 for the root; otherwise smaller than the joint's own index. */
  readonly parent: Int32Array;
  /** Joints `j` up to (excluding) `subtreeEnd[j]` are j and its descendants. */
  readonly subtreeEnd: Int32Array;
  /** Index of each joint's first DOF in the character's list; one more than the number of joints. */
  readonly firstDof: Int32Array;
  /** The DOFs that move the character along x, y and z: root translation, or the root joint's own. */
  readonly travel: Int32Array;
  /** Whether root translation precedes the joints' DOFs. */
  readonly hasRootTranslation: boolean;
  /** x y z per joint; 0 where the joint's own DOFs replace it. */
  readonly offsets: Float64Array;
  /** Limits of each joint DOF, in order (`firstDof[0]` is the first); infinite if min > max. */
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  /** The DOFs that have limits; none for motion capture, whose limits mean unlimited. */
  readonly limited: Int32Array;
  readonly motions: readonly JointMotion[];
  /** Three per joint of the form T(t)·R with three angles: those DOFs, in order of application; else −1. */
  readonly turns: Int32Array;
  /** Three per joint: its DOFs along x, y and z; −1 for none. */
  readonly slides: Int32Array;
  /** Linked DOFs, each after the one that it follows. */
  readonly couples: readonly DofCouple[];
}

/** The skeleton's compiled form, cached. */
export const compileSkeleton = perSkeleton(compile);

function compile(skeleton: Skeleton): CompiledSkeleton {
  const { joints } = skeleton;
  const jointCount = joints.length;
  const parent = Int32Array.from(joints, (j) => j.parent);
  const subtreeEnd = new Int32Array(jointCount);
  for (let j = jointCount - 1; j >= 0; j--) {
    subtreeEnd[j] = Math.max(subtreeEnd[j], j + 1);
    if (parent[j] >= 0) subtreeEnd[parent[j]] = Math.max(subtreeEnd[parent[j]], subtreeEnd[j]);
  }
  const firstDof = new Int32Array(jointCount + 1);
  const lower: number[] = [];
  const upper: number[] = [];
  firstDof[0] = rootDofCount(skeleton);
  joints.forEach((joint, j) => {
    const count = dofsOf(joint.motion).length;
    for (let d = 0; d < count; d++) {
      const limit = joint.limits[d];
      const holds = limit !== undefined && limit.min <= limit.max && takesLimits(joint.motion);
      lower.push(holds ? limit.min : -Infinity);
      upper.push(holds ? limit.max : Infinity);
    }
    firstDof[j + 1] = firstDof[j] + count;
  });
  const slides = dofsOfAll(joints, firstDof, slidesOf);
  return {
    jointCount,
    dofCount: lower.length,
    parent,
    subtreeEnd,
    firstDof,
    travel: firstDof[0] > 0 ? Int32Array.of(0, 1, 2) : slides.slice(0, 3),
    hasRootTranslation: firstDof[0] > 0,
    offsets: Float64Array.from(joints.flatMap(offsetBesideDofs)),
    lower: Float64Array.from(lower),
    upper: Float64Array.from(upper),
    limited: Int32Array.from([...lower.keys()].filter((d) => lower[d] > UNLIMITED.min || upper[d] < UNLIMITED.max)),
    motions: joints.map((_, j) => motionOf(j, joints, firstDof)),
    turns: dofsOfAll(joints, firstDof, turnsOf),
    slides,
    couples: couplesOf(skeleton).ordered,
  };
}

/** The rule of a joint; where a DOF lengthens the bone above, from the tip of that. */
function motionOf(j: number, joints: readonly Joint[], firstDof: Int32Array): JointMotion {
  const { motion, parent } = joints[j];
  const own = jointMotion(motion);
  const stretch = parent < 0 ? undefined : stretchOf(joints[parent]);
  return stretch ? atTip(own, firstDof[parent] + stretch.dof - firstDof[j], stretch.along) : own;
}

/** Three DOFs of each joint, by what its motion tells of its own; −1 for none. */
function dofsOfAll(
  joints: Skeleton['joints'],
  firstDof: Int32Array,
  own: (motion: Motion) => readonly number[],
): Int32Array {
  const dofs = new Int32Array(3 * joints.length).fill(-1);
  for (let j = 0; j < joints.length; j++) {
    const { parent, motion } = joints[j];
    // Such a joint is not T(offset + t)·R: its offset varies.
    if (own === turnsOf && parent >= 0 && stretchOf(joints[parent])) continue;
    const three = own(motion);
    for (let k = 0; k < 3; k++) if (three[k] >= 0) dofs[3 * j + k] = firstDof[j] + three[k];
  }
  return dofs;
}

/** Cached, since thousands of joints share what they don't state. */
const turnsOf = perObject((motion: Motion): readonly number[] => {
  const euler = eulerDofs(motion);
  const before = factorsOf(motion)?.slice(0, -3) ?? [];
  return euler && before.every((name) => name.startsWith('t')) ? appliedDofs(euler) : [-1, -1, -1];
});

const slidesOf = perObject((motion: Motion): readonly number[] => {
  const names = dofsOf(motion).map(({ name }) => name);
  return ['tx', 'ty', 'tz'].map((name) => names.indexOf(name));
});

/** Clamps the joints' DOFs to their limits, in place. Root translation and morph weights have none. */
export function clampDofs(skeleton: CompiledSkeleton, dofs: Float64Array): void {
  const { lower, upper, limited } = skeleton;
  const first = skeleton.firstDof[0];
  for (let i = 0; i < limited.length; i++) {
    const d = limited[i];
    const value = dofs[first + d];
    if (value < lower[d]) dofs[first + d] = lower[d];
    else if (value > upper[d]) dofs[first + d] = upper[d];
  }
}

/**
 * Applies the skeleton's limits and linked DOFs to a pose, in place: all limits first, then each linked DOF from the
 * final value of the DOF that it follows, clamped to its own limits.
 * @param clamps whether limits are enforced; links always are
 */
export function applyConstraints(skeleton: CompiledSkeleton, dofs: Float64Array, clamps: boolean): void {
  if (clamps) clampDofs(skeleton, dofs);
  const { couples, lower, upper } = skeleton;
  const first = skeleton.firstDof[0];
  for (let i = 0; i < couples.length; i++) {
    const { dof, follows, gain, offset } = couples[i];
    const value = gain * dofs[follows] + offset;
    dofs[dof] = clamps ? Math.min(upper[dof - first], Math.max(lower[dof - first], value)) : value;
  }
}

/** Each joint's matrix relative to its parent. */
export function localMatrices(skeleton: CompiledSkeleton, dofs: Float64Array, out: Float64Array): void {
  for (let j = 0; j < skeleton.jointCount; j++) writeLocal(skeleton, j, dofs, out, 16 * j);
}

/** Scratch; never escapes. */
const local = new Float64Array(16);

/**
 * Each joint's matrix in the character's space.
 * @param rotations those that came with the DOFs, for joints of the same skeleton
 */
export function worldMatrices(
  skeleton: CompiledSkeleton,
  dofs: Float64Array,
  world: Float64Array,
  rotations?: PoseRotations,
): void {
  const { parent, jointCount } = skeleton;
  const given = rotations?.areGiven ? rotations.values : undefined;
  for (let j = 0; j < jointCount; j++) {
    const above = parent[j];
    if (above < 0) writeRoot(skeleton, j, dofs, world, given);
    else if (given === undefined || !turnWorld(skeleton, j, dofs, given, world)) {
      writeLocal(skeleton, j, dofs, local, 0);
      multiplyAffine(world, 16 * above, local, 0, world, 16 * j);
    }
  }
}

/** With a given rotation, only the root computes sines and cosines that are not used. */
function writeRoot(
  skeleton: CompiledSkeleton,
  j: number,
  dofs: Float64Array,
  world: Float64Array,
  given: Float64Array | undefined,
): void {
  writeLocal(skeleton, j, dofs, world, 16 * j);
  if (given === undefined || !hasAnglesOf(skeleton, j, dofs, given)) return;
  const g = 8 * j;
  writeRotation(given[g + 3], given[g + 4], given[g + 5], given[g + 6], world, 16 * j, 4);
}

/** Whether the joint's angles are still those of its stored rotation. */
function hasAnglesOf({ turns }: CompiledSkeleton, j: number, dofs: Float64Array, given: Float64Array): boolean {
  const first = turns[3 * j];
  return (
    first >= 0 &&
    given[8 * j] === dofs[first] &&
    given[8 * j + 1] === dofs[turns[3 * j + 1]] &&
    given[8 * j + 2] === dofs[turns[3 * j + 2]]
  );
}

/**
 * W = W_parent · L for a joint with a given rotation: most joints of a crowd. Its local matrix is never written.
 * Returns false and writes nothing for all others.
 */
function turnWorld(
  skeleton: CompiledSkeleton,
  j: number,
  dofs: Float64Array,
  given: Float64Array,
  out: Float64Array,
): boolean {
  if (!hasAnglesOf(skeleton, j, dofs, given)) return false;
  const { parent, offsets, slides } = skeleton;
  const x = given[8 * j + 3];
  const y = given[8 * j + 4];
  const z = given[8 * j + 5];
  const w = given[8 * j + 6];
  const l0 = 1 - 2 * (y * y + z * z);
  const l1 = 2 * (x * y + w * z);
  const l2 = 2 * (x * z - w * y);
  const l4 = 2 * (x * y - w * z);
  const l5 = 1 - 2 * (x * x + z * z);
  const l6 = 2 * (y * z + w * x);
  const l8 = 2 * (x * z + w * y);
  const l9 = 2 * (y * z - w * x);
  const l10 = 1 - 2 * (x * x + y * y);
  const sx = slides[3 * j];
  const sy = slides[3 * j + 1];
  const sz = slides[3 * j + 2];
  const tx = offsets[3 * j] + (sx < 0 ? 0 : dofs[sx]);
  const ty = offsets[3 * j + 1] + (sy < 0 ? 0 : dofs[sy]);
  const tz = offsets[3 * j + 2] + (sz < 0 ? 0 : dofs[sz]);
  const p = 16 * parent[j];
  const o = 16 * j;
  for (let r = 0; r < 3; r++) {
    const a = out[p + r];
    const b = out[p + r + 4];
    const c = out[p + r + 8];
    out[o + r] = a * l0 + b * l1 + c * l2;
    out[o + r + 4] = a * l4 + b * l5 + c * l6;
    out[o + r + 8] = a * l8 + b * l9 + c * l10;
    out[o + r + 12] = a * tx + b * ty + c * tz + out[p + r + 12];
  }
  out[o + 3] = out[o + 7] = out[o + 11] = 0;
  out[o + 15] = 1;
  return true;
}

/** A joint's matrix relative to its parent, as 16 numbers at `out[o]`. */
export function writeLocal(
  skeleton: CompiledSkeleton,
  j: number,
  dofs: Float64Array,
  out: Float64Array,
  o: number,
): void {
  const { offsets } = skeleton;
  skeleton.motions[j].write(dofs, skeleton.firstDof[j], out, o);
  out[o + 12] += offsets[3 * j];
  out[o + 13] += offsets[3 * j + 1];
  out[o + 14] += offsets[3 * j + 2];
  if (skeleton.parent[j] < 0 && skeleton.hasRootTranslation) {
    out[o + 12] += dofs[0];
    out[o + 13] += dofs[1];
    out[o + 14] += dofs[2];
  }
}
