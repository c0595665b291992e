/**
 * Which channels a joint of any kind becomes in BVH, and where their values come from.
 *
 *     angles     DOFs of the joint that are the channel's angle themselves: nothing is lost to a decomposition
 *     matrix     the joint's matrix, as Zrotation Xrotation Yrotation
 *     none       the joint never turns
 *
 * Scales and shears BVH can't hold. From a joint that has some down, frames are taken from the world matrices with
 * scale and shear left out: joints stand where they stood, with position channels where bones change their length.
 */
import type { BvhChannel, Joint, Motion, Skeleton } from '../model/skeleton.ts';
import { eulerDofs } from './euler-dofs.ts';

export interface JointPlan {
  /** DOFs among the joint's own, in the order of the channels; absent where angles come from the matrix. */
  readonly angles?: readonly { readonly channel: BvhChannel; readonly dof: number; readonly sign: number }[];
  /** Whether its translation may be another than its offset. */
  readonly mayMove: boolean;
  /** The position channels that a joint of BVH has, which it keeps. */
  readonly positions?: readonly BvhChannel[];
  /** In or below a joint that scales or shears. */
  readonly isScaled: boolean;
}

/** Zrotation Xrotation Yrotation: what `zxyAngles` gives. */
export const MATRIX_CHANNELS: readonly BvhChannel[] = ['rz', 'rx', 'ry'];

export function planJoints({ joints }: Skeleton): readonly JointPlan[] {
  const plans: JointPlan[] = [];
  for (const joint of joints) {
    const isScaled = scales(joint.motion) || (plans[joint.parent]?.isScaled ?? false);
    plans.push(isScaled ? { isScaled, mayMove: true } : planOf(joint));
  }
  return plans;
}

/** Whether any joint has what BVH can't hold. */
export function scales(motion: Motion): boolean {
  if (motion.kind === 'scale' || motion.kind === 'shear') return true;
  return motion.kind === 'compound' && motion.dofs.some((name) => name.startsWith('s'));
}

function planOf({ motion }: Joint): JointPlan {
  const plain = { isScaled: false, mayMove: false };
  switch (motion.kind) {
    case 'bvh': {
      const angles = motion.channels.flatMap((channel, dof) =>
        channel.startsWith('r') ? [{ channel, dof, sign: 1 }] : [],
      );
      const positions = motion.channels.filter((channel) => channel.startsWith('t'));
      return { ...plain, mayMove: positions.length > 0, angles, positions };
    }
    case 'ball':
      return { ...plain, ...eulerPlan(motion) };
    case 'free':
      return { ...plain, ...eulerPlan(motion), mayMove: true };
    case 'hinge': {
      const angle = alongAxis(motion.axis);
      return angle ? { ...plain, angles: [angle] } : plain;
    }
    case 'universal': {
      // `xy` is Ry·Rx; DOFs are in the order of the axes.
      const [first, second] = motion.order;
      const dof = (axis: string) => ('xyz'.indexOf(axis) < 'xyz'.indexOf(axis === first ? second : first) ? 0 : 1);
      const angle = (axis: string) => ({ channel: `r${axis}` as BvhChannel, dof: dof(axis), sign: 1 });
      return { ...plain, angles: [angle(second), angle(first)] };
    }
    case 'prismatic':
    case 'translational':
      return { ...plain, mayMove: true, angles: [] };
    case 'fixed':
      return { ...plain, angles: [] };
    case 'compound': {
      const angles = motion.dofs.flatMap((name, dof) =>
        name === 'rx' || name === 'ry' || name === 'rz' ? [{ channel: name, dof, sign: 1 }] : [],
      );
      // The rotations are multiplied in their order, whatever translations stand between them.
      return { ...plain, mayMove: motion.dofs.some((name) => name.startsWith('t')), angles };
    }
    case 'screw': {
      const angle = alongAxis(motion.axis);
      const mayMove = motion.pitch !== 0;
      return angle ? { ...plain, mayMove, angles: [angle] } : { ...plain, mayMove };
    }
    case 'quaternion':
    case 'scale':
    case 'shear':
      return plain;
  }
}

/** `xyz` is Rz·Ry·Rx: the channels are the letters from the last to the first. */
function eulerPlan(motion: Motion): Pick<JointPlan, 'angles'> {
  const euler = eulerDofs(motion);
  if (!euler) return {};
  // Letters of the order are axes.
  const axes = [...euler.order].reverse() as ('x' | 'y' | 'z')[];
  return { angles: axes.map((axis) => ({ channel: `r${axis}` as const, dof: euler[axis], sign: 1 })) };
}

/** The one channel of a rotation about x, y or z, or against one of them. */
function alongAxis(axis: readonly number[]) {
  const main = axis.findIndex((v) => v !== 0);
  if (main < 0 || axis.some((v, k) => v !== 0 && k !== main)) return undefined;
  const channel = (['rx', 'ry', 'rz'] as const)[main];
  return { channel, dof: 0, sign: axis[main] > 0 ? 1 : -1 };
}
