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
import { dofsOf, isOfBvh, jointTypeOf, offsetBesideDofs } from './joint-types.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from './skeleton.ts';

export interface SkelMotion {
  readonly motion: Motion;
  /** For each DOF of that motion, which of the given motion's DOFs it is. */
  readonly dofMap: readonly number[];
}

/** A motion that `.skel` has; any but BVH's is itself, its DOFs in their order. */
export function skelMotionOf(before: Motion): SkelMotion {
  const motion = jointTypeOf(before).asSkel?.(before) ?? before;
  const names = dofsOf(before).map(({ name }) => name);
  return { motion, dofMap: dofsOf(motion).map(({ name }) => names.indexOf(name)) };
}

/** The joint with a motion that `.skel` has, its limits, pose and offset along with it; the same where it has one. */
export function skelJoint(joint: Joint): Joint {
  const { limits, pose } = joint;
  if (!isOfBvh(joint.motion)) return joint;
  const { motion, dofMap } = skelMotionOf(joint.motion);
  return {
    ...joint,
    motion,
    offset: offsetBesideDofs(joint),
    limits: dofMap.map((dof) => limits[dof] ?? UNLIMITED),
    pose: dofMap.map((dof) => pose[dof] ?? 0),
  };
}

/** The skeleton with no joint of BVH in it; the same where there is none. Joints keep their indices. */
export function skelSkeleton(skeleton: Skeleton): Skeleton {
  if (!skeleton.joints.some(({ motion }) => isOfBvh(motion))) return skeleton;
  return { ...skeleton, joints: skeleton.joints.map(skelJoint) };
}
