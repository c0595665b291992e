/**
 * Converts BVH joints to `.skel` joints: the same matrices from the same numbers, reordered.
 *
 *     no channels                            fixedjoint
 *     three rotations                        balljoint; BVH lists factors from left to right, `order` names the first
 *                                            applied first: Zrotation Xrotation Yrotation is yxz
 *     three positions and three rotations    freejoint: in BVH the translation always comes before the rotations
 *     any others                             compoundjoint, translations first
 *
 * Where position channels replace the offset, the offset becomes 0 on their axes.
 */
import { dofsOf, isOfBvh, jointTypeOf, offsetBesideDofs } from './joint-types.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from './skeleton.ts';

export interface SkelMotion {
  readonly motion: Motion;
  /** For each DOF of that motion, its index among the given motion's DOFs. */
  readonly dofMap: readonly number[];
}

/** The equivalent `.skel` motion; motions other than BVH's are returned as they are. */
export function skelMotionOf(before: Motion): SkelMotion {
  const motion = jointTypeOf(before).asSkel?.(before) ?? before;
  const names = dofsOf(before).map(({ name }) => name);
  return { motion, dofMap: dofsOf(motion).map(({ name }) => names.indexOf(name)) };
}

/** The joint with a `.skel` motion, its limits, pose and offset converted; the same object if it has one. */
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

/** The skeleton without BVH joints; the same object if it has none. Joints keep their indices. */
export function skelSkeleton(skeleton: Skeleton): Skeleton {
  if (!skeleton.joints.some(({ motion }) => isOfBvh(motion))) return skeleton;
  return { ...skeleton, joints: skeleton.joints.map(skelJoint) };
}
