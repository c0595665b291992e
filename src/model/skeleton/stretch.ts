/** Bones that a DOF lengthens: the `l` of Acclaim. */
import { unit, type Vec3 } from '../../math/vec3.ts';
import { lengthDofOf } from './joint-types.ts';
import type { Joint } from './skeleton.ts';

/** How a bone is lengthened. */
export interface Stretch {
  /** Index among the joint's DOFs. */
  readonly dof: number;
  /** Where its tip goes, in the joint's space; of length 1 but for the digits of files. */
  readonly along: Vec3;
}

/** How a joint's bone is lengthened: its children, and its end, move along with the tip. Undefined if nothing does. */
export function stretchOf({ motion, bone }: Pick<Joint, 'motion' | 'bone'>): Stretch | undefined {
  const dof = lengthDofOf(motion);
  if (dof < 0 || !bone) return undefined;
  const along = boneDirection(bone.direction);
  return along && { dof, along };
}

/** How far a direction may be off length 1 without being normalised: files have six digits. */
const NORMALISED = 1e-3;

/** The direction of a bone: the same object if its length is about 1, else normalised; undefined if it has none. */
export function boneDirection(direction: Vec3): Vec3 | undefined {
  return Math.abs(Math.hypot(...direction) - 1) <= NORMALISED ? direction : unit(direction);
}
