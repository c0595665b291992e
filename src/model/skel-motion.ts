/**
 * Joints of BVH as joints of `.skel`: the same matrices from the same numbers, in another order.
 *
 *     no channels                            fixedjoint
 *     three rotations                        balljoint; BVH lists what is multiplied from left to right, `order` what is
 *                                            applied first: Zrotation Xrotation Yrotation is yxz
 *     three positions and three rotations    freejoint: the translation comes before the rotations in BVH anyway
 *     any others                             compoundjoint, translations first
 *
 * Where position channels replace the offset, the offset is 0 afterwards on their axes.
 */
import type { Vec3 } from '../math/vec3.ts';
import {
  type BvhChannel,
  dofsOf,
  type EulerOrder,
  type Joint,
  type Motion,
  type Skeleton,
  UNLIMITED,
} from './skeleton.ts';

export interface SkelMotion {
  readonly motion: Exclude<Motion, { readonly kind: 'bvh' }>;
  /** For each DOF of that motion, which of the given motion's DOFs it is. */
  readonly dofMap: readonly number[];
}

/** A motion that `.skel` has; any but BVH's is itself, its DOFs in their order. */
export function skelMotionOf(motion: Motion): SkelMotion {
  if (motion.kind !== 'bvh') return { motion, dofMap: dofsOf(motion).map((_, i) => i) };
  const { channels } = motion;
  const turns = channels.filter((name) => name.startsWith('r'));
  const moves = TRANSLATIONS.filter((name) => channels.includes(name));
  // All DOFs of what it becomes are channels' names.
  const mapped = (to: SkelMotion['motion']): SkelMotion => ({
    motion: to,
    dofMap: dofsOf(to).map(({ name }) => channels.indexOf(name as BvhChannel)),
  });
  if (channels.length === 0) return mapped({ kind: 'fixed' });
  if (turns.length === 3 && (moves.length === 0 || moves.length === 3)) {
    // The three letters of a permutation, which is what the orders are.
    const order = turns
      .map((name) => name[1])
      .reverse()
      .join('') as EulerOrder;
    return mapped({ kind: moves.length ? 'free' : 'ball', order });
  }
  return mapped({ kind: 'compound', dofs: [...moves, ...turns] });
}

const TRANSLATIONS: readonly BvhChannel[] = ['tx', 'ty', 'tz'];

/** The joint with a motion that `.skel` has, its limits, pose and offset along with it; the same where it has one. */
export function skelJoint(joint: Joint): Joint {
  const { motion: before, offset, limits, pose } = joint;
  if (before.kind !== 'bvh') return joint;
  const { motion, dofMap } = skelMotionOf(before);
  const isReplaced = (name: BvhChannel) => before.positions === 'replace' && before.channels.includes(name);
  const left = (axis: number) => (isReplaced(TRANSLATIONS[axis]) ? 0 : offset[axis]);
  const others: Vec3 = [left(0), left(1), left(2)];
  return {
    ...joint,
    motion,
    offset: others,
    limits: dofMap.map((dof) => limits[dof] ?? UNLIMITED),
    pose: dofMap.map((dof) => pose[dof] ?? 0),
  };
}

/** The skeleton with no joint of BVH in it; the same where there is none. Joints keep their indices. */
export function skelSkeleton(skeleton: Skeleton): Skeleton {
  if (!skeleton.joints.some(({ motion }) => motion.kind === 'bvh')) return skeleton;
  return { ...skeleton, joints: skeleton.joints.map(skelJoint) };
}
