/**
 * Mirrors the links of a hierarchy: with s and t the signs of the two DOFs on the other side,
 *
 *     φ = g·ψ + o        there  φ′ = s·φ, ψ′ = t·ψ        so  φ′ = (s·t·g)·ψ′ + s·o
 *
 * A followed joint outside the hierarchy is replaced by its counterpart, if it has one.
 */
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Couple, Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { mirroredMotion } from './mirrored-motion.ts';

/** A joint's other side: its new index, and the signs of its DOFs there. */
export interface MirroredJoint {
  readonly joint: number;
  readonly signs: readonly number[];
}

/**
 * The joints of `after` with the links of those of `before`; the same list if they have them.
 * @param sides by old joint, the mirrored ones
 * @param elsewhere the other side of any other joint, or the joint itself; -1 for none
 */
export function mirroredCouples(
  before: Skeleton,
  after: Skeleton,
  across: number,
  sides: ReadonlyMap<number, MirroredJoint>,
  elsewhere: (joint: number) => number,
): readonly Joint[] {
  let joints = after.joints;
  for (const [index, { joint: own, signs }] of sides) {
    const { couples = [], motion } = before.joints[index];
    const names = dofsOf(motion).map(({ name }) => name);
    const made = couples.flatMap((couple): readonly Couple[] => {
      const { motion: followed } = before.joints[couple.joint];
      const side = sides.get(couple.joint);
      const other = side?.joint ?? elsewhere(couple.joint);
      if (other < 0) return [];
      const { motion: there } = after.joints[other];
      if (!dofsOf(there).some(({ name }) => name === couple.follows)) return [];
      const theirs = side?.signs ?? mirroredMotion(followed, across, there).signs;
      const at = dofsOf(followed).findIndex(({ name }) => name === couple.follows);
      const sign = signs[names.indexOf(couple.dof)] ?? 1;
      // Adding 0 avoids −0, which would be written with its sign.
      const gain = sign * (theirs[at] ?? 1) * couple.gain + 0;
      return [{ ...couple, joint: other, gain, offset: sign * couple.offset + 0 }];
    });
    if (JSON.stringify(joints[own].couples ?? []) === JSON.stringify(made)) continue;
    const { couples: _before, ...rest } = joints[own];
    joints = joints.map((joint, j) => (j !== own ? joint : made.length ? { ...rest, couples: made } : rest));
  }
  return joints;
}
