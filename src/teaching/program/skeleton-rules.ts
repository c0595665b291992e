/** The skeleton that a program goes by: the file's, with what its rules read otherwise. */

import { type CompiledSkeleton, compileSkeleton } from '../../evaluate/kinematics.ts';
import { eulerDofs } from '../../evaluate/rotations/euler-dofs.ts';
import { perObject } from '../../model/per-object.ts';
import {
  bvhChannelsOf,
  dofsOf,
  isOfBvh,
  parameterOf,
  positionsOf,
  withParameter,
} from '../../model/skeleton/joint-types.ts';
import type { BvhChannel, EulerOrder, Joint, Motion, Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Breadth, JointRules } from './program.ts';

/** A skeleton as a program reads it. */
export interface ProgramSkeleton {
  readonly compiled: CompiledSkeleton;
  /** For each DOF of the joints, the file's DOF whose value it has; absent: the same. */
  readonly dofFrom: Int32Array | undefined;
}

/** Whether a rule is for a joint. */
export function isFor(motion: Motion, breadth: Breadth): boolean {
  if (breadth === 'all') return true;
  if (breadth === 'not listed') return parameterOf(motion, 'dofs', 'list') === undefined;
  const isOrdered = parameterOf(motion, 'order', 'choice') !== undefined;
  return isOrdered && (breadth === 'ordered' || (dofsOf(motion).length === 3 && hasThreeAngles(motion)));
}

/** Whether rx, ry and rz are among its DOFs; cached. */
export const hasThreeAngles = perObject(
  (motion: Motion): boolean => !isOfBvh(motion) && eulerDofs(motion) !== undefined,
);

/** Whether a joint rotates: one of its DOFs is an angle or part of a quaternion. */
export function turns(motion: Motion): boolean {
  return dofsOf(motion).some(({ name, unit }) => unit === 'angle' || name.startsWith('q'));
}

/** The skeletons that programs make of one, each made once for all comparisons of a character; cached. */
export const programSkeletons = perObject((skeleton: Skeleton) => new ProgramSkeletons(skeleton));

/** The skeletons that programs make of one, each made once. */
class ProgramSkeletons {
  private readonly known = new Map<string, ProgramSkeleton>();
  private readonly first: CompiledSkeleton;

  constructor(private readonly skeleton: Skeleton) {
    this.first = compileSkeleton(skeleton);
  }

  /** The skeleton by these rules; the file's where they leave it as it is. */
  get(rules: JointRules): ProgramSkeleton {
    const { order, bvhPositions, bvhOrder } = rules;
    if (!order && bvhPositions === 'given' && bvhOrder === 'listed')
      return { compiled: this.first, dofFrom: undefined };
    const key = `${order?.is} ${order?.for} ${bvhPositions} ${bvhOrder}`;
    let made = this.known.get(key);
    if (!made) {
      made = this.make(rules);
      this.known.set(key, made);
    }
    return made;
  }

  private make({ order, bvhPositions, bvhOrder }: JointRules): ProgramSkeleton {
    const { firstDof } = this.first;
    const dofFrom = Int32Array.from({ length: firstDof[this.first.jointCount] }, (_, d) => d);
    const joints = this.skeleton.joints.map((joint, j): Joint => {
      let { motion } = joint;
      if (order && isFor(motion, order.for)) motion = withOrder(motion, order.is, order.for);
      if (bvhPositions === 'added' && positionsOf(motion)) motion = withParameter(motion, 'positions', 'add');
      const channels = bvhChannelsOf(motion);
      if (channels && bvhOrder !== 'listed') {
        const next = reordered(channels, bvhOrder);
        motion = withParameter(motion, 'channels', next);
        if (!bvhOrder.startsWith('read')) {
          next.forEach((name, i) => {
            dofFrom[firstDof[j] + i] = firstDof[j] + channels.indexOf(name);
          });
        }
      }
      return motion === joint.motion ? joint : { ...joint, motion };
    });
    return { compiled: compileSkeleton({ ...this.skeleton, joints }), dofFrom };
  }
}

/** Two axes keep the order that they have among the three. */
function withOrder(motion: Motion, order: EulerOrder, breadth: Breadth): Motion {
  const own = parameterOf(motion, 'order', 'choice');
  if (own === undefined) return motion;
  if (own.length === 3) return withParameter(motion, 'order', order);
  return breadth === 'all'
    ? withParameter(motion, 'order', [...order].filter((axis) => own.includes(axis)).join(''))
    : motion;
}

/** The channels with their rotations in another order; translations keep their places. */
function reordered(channels: readonly BvhChannel[], order: JointRules['bvhOrder']): readonly BvhChannel[] {
  const turned = channels.filter((name) => name.startsWith('r'));
  // The last word of a rule is an order; BVH lists the factor first that an order names last.
  const asked =
    order === 'reversed'
      ? undefined
      : ([...(order.split(' ')[1] as EulerOrder)].reverse().map((axis) => `r${axis}`) as BvhChannel[]);
  const next = asked ? asked.filter((name) => turned.includes(name)) : [...turned].reverse();
  let at = 0;
  return channels.map((name) => (name.startsWith('r') ? next[at++] : name));
}
