/**
 * Decides which BVH channels a joint of any type gets, and where their values come from.
 *
 *     angles     DOFs of the joint that are the channel's angle themselves: no decomposition, nothing is lost
 *     matrix     the joint's matrix, as Zrotation Xrotation Yrotation
 *     none       the joint never rotates
 *
 * BVH can't store scale and shear. From a joint with either downwards, frames are taken from the world matrices with
 * scale and shear removed: joints stay in place, with position channels where bones change length.
 */
import {
  axisOf,
  bvhChannelsOf,
  dofsOf,
  factorsOf,
  isOfAcclaim,
  pitchOf,
  stretches,
} from '../../model/skeleton/joint-types.ts';
import type { BvhChannel, CompoundDof, Dof, Joint, Motion, Skeleton } from '../../model/skeleton/skeleton.ts';
import { stretchOf } from '../../model/skeleton/stretch.ts';
import { zxyAngles, zyxAngles } from '../rotations/euler-angles.ts';

/** How the channels of one joint are found. */
export interface JointPlan {
  /** Indices into the joint's DOFs, in channel order; absent if angles come from the matrix. */
  readonly angles?: readonly { readonly channel: BvhChannel; readonly dof: number; readonly sign: number }[];
  /** Whether its translation may differ from its offset. */
  readonly mayMove: boolean;
  /** The angles that the matrix is written by, unless they are the joint's own. */
  readonly matrix: MatrixAngles;
  /** The position channels of a BVH joint, which it keeps; those of an Acclaim bone that may move. */
  readonly positions?: readonly BvhChannel[];
  /** At or below a joint that scales or shears. */
  readonly isScaled: boolean;
}

/** Channels of the angles of a rotation, and what finds these near the ones before. */
export interface MatrixAngles {
  readonly channels: readonly BvhChannel[];
  readonly write: typeof zxyAngles;
}

/** Zrotation Xrotation Yrotation, as most motion capture has it. */
const USUAL: MatrixAngles = { channels: ['rz', 'rx', 'ry'], write: zxyAngles };
/** Zrotation Yrotation Xrotation: the angles of Acclaim, whose bones turn about x first as a rule. */
const OF_ACCLAIM: MatrixAngles = { channels: ['rz', 'ry', 'rx'], write: zyxAngles };
const POSITIONS: readonly BvhChannel[] = ['tx', 'ty', 'tz'];

/** The plans of all joints, in the skeleton's order. */
export function planJoints({ joints }: Skeleton): readonly JointPlan[] {
  const plans: JointPlan[] = [];
  for (const joint of joints) {
    const isScaled = stretches(joint.motion) || (plans[joint.parent]?.isScaled ?? false);
    if (isScaled) plans.push({ isScaled, mayMove: true, matrix: USUAL });
    else plans.push(isOfAcclaim(joint.motion) ? ofAcclaim(joint, joints[joint.parent]) : planOf(joint));
  }
  return plans;
}

/** All three angles, of whichever order; positions where the bone, or the length of the one above, may move it. */
function ofAcclaim({ motion }: Joint, above: Joint | undefined): JointPlan {
  const mayMove = dofsOf(motion).some(({ name }) => name.startsWith('t')) || (above && stretchOf(above)) !== undefined;
  return { isScaled: false, mayMove, matrix: OF_ACCLAIM, ...(mayMove && { positions: POSITIONS }) };
}

/** For a joint that neither scales nor shears. */
function planOf({ motion }: Joint): JointPlan {
  const dofs = dofsOf(motion);
  const mayMove = dofs.some(({ unit }) => unit === 'length') || pitchOf(motion) !== 0;
  const base = { isScaled: false, mayMove, matrix: USUAL };
  const factors = factorsOf(motion);
  if (!factors) {
    const angles = anglesAboutAxis(motion, dofs);
    return { ...base, ...(angles && { angles }) };
  }
  const names = dofs.map(({ name }) => name);
  const angles = factors.filter(isRotation).map((channel) => ({ channel, dof: names.indexOf(channel), sign: 1 }));
  const positions = bvhChannelsOf(motion)?.filter((channel) => channel.startsWith('t'));
  return { ...base, angles, ...(positions && { positions }) };
}

function isRotation(name: CompoundDof): name is 'rx' | 'ry' | 'rz' {
  return name.startsWith('r');
}

/** The channels of a joint with an axis: none if it only slides. Undefined if its angle is not about a main axis. */
function anglesAboutAxis(motion: Motion, dofs: readonly Dof[]): JointPlan['angles'] {
  const axis = axisOf(motion);
  if (!axis) return undefined;
  if (!dofs.some(({ unit }) => unit === 'angle')) return [];
  const angle = alongAxis(axis);
  return angle && [angle];
}

/** The channel of a rotation about x, y or z, in either direction. */
function alongAxis(axis: readonly number[]) {
  const main = axis.findIndex((v) => v !== 0);
  if (main < 0 || axis.some((v, k) => v !== 0 && k !== main)) return undefined;
  const channel = (['rx', 'ry', 'rz'] as const)[main];
  return { channel, dof: 0, sign: axis[main] > 0 ? 1 : -1 };
}
