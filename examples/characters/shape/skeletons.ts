/** Builds skeletons by name: parents are names rather than indices, and joints are sorted depth-first. */

import { add, type Vec3 } from '../../../src/math/vec3.ts';
import {
  type Box,
  DEFAULT_MOTION,
  type Limit,
  type Skeleton,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { apply, ballRotation, type Mat3, rotate } from './vectors.ts';

/** A ball joint of an example. */
export interface BallJointPlan {
  readonly name: string;
  /** Name of the parent; absent for the root, which comes first. */
  readonly parent?: string;
  readonly offset: Vec3;
  readonly box: Box;
  readonly pose?: Vec3;
  /** Limits of rx, ry, rz in radians, if any. */
  readonly limits?: readonly (readonly [number, number] | undefined)[];
}

/** Children are in the order of the list. Throws if a parent is missing. */
export function buildSkeleton(name: string, plans: readonly BallJointPlan[]): Skeleton {
  const ordered: BallJointPlan[] = [];
  const visit = (plan: BallJointPlan) => {
    ordered.push(plan);
    for (const child of plans) if (child.parent === plan.name) visit(child);
  };
  visit(plans[0]);
  if (ordered.length !== plans.length) throw new Error(`${name}: a joint's parent is not in the list`);
  return {
    name,
    joints: ordered.map((plan) => ({
      name: plan.name,
      parent: ordered.findIndex((p) => p.name === plan.parent),
      offset: plan.offset,
      box: plan.box,
      motion: DEFAULT_MOTION,
      limits: [0, 1, 2].map((i): Limit => {
        const limit = plan.limits?.[i];
        return limit ? { min: limit[0], max: limit[1] } : UNLIMITED;
      }),
      pose: plan.pose ?? [0, 0, 0],
    })),
  };
}

/** Depth-first index of the joint of this name. Throws if there is none. */
export function jointIndex(skeleton: Skeleton, name: string): number {
  const index = skeleton.joints.findIndex((j) => j.name === name);
  if (index < 0) throw new Error(`no joint is called ${name}`);
  return index;
}

/** A joint's frame in the character's space. */
export interface Frame {
  readonly turn: Mat3;
  readonly at: Vec3;
}

/** Frames of all joints in the file pose, W = W_parent · T(offset) · R(pose). */
export function posedFrames(skeleton: Skeleton): Frame[] {
  const frames: Frame[] = [];
  for (const joint of skeleton.joints) {
    const turn = ballRotation([joint.pose[0], joint.pose[1], joint.pose[2]]);
    const parent = frames[joint.parent];
    frames.push(
      parent
        ? { turn: rotate(parent.turn, turn), at: add(parent.at, apply(parent.turn, joint.offset)) }
        : { turn, at: joint.offset },
    );
  }
  return frames;
}

/** Frames as bindings: 16 numbers per joint, column-major. */
export function bindingMatrices(frames: readonly Frame[]): Float64Array {
  return Float64Array.from(
    frames.flatMap(({ turn: m, at }) => [m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, ...at, 1]),
  );
}

/** A box from −half to half about a centre. */
export function boxAbout(centre: Vec3, half: Vec3): Box {
  const box = {
    min: [centre[0] - half[0], centre[1] - half[1], centre[2] - half[2]] as const,
    max: [centre[0] + half[0], centre[1] + half[1], centre[2] + half[2]] as const,
  };
  const tidy = (v: Vec3): Vec3 => [Number(v[0].toFixed(4)), Number(v[1].toFixed(4)), Number(v[2].toFixed(4))];
  return { min: tidy(box.min), max: tidy(box.max) };
}
