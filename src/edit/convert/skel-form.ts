/**
 * Converts a BVH capture to a skeleton that `.skel` can store, and its takes to what `.anim` can.
 *
 *     three rotations                    balljoint, of their order
 *     … and all three positions          freejoint
 *     no channels                        fixedjoint
 *     anything else                      compoundjoint, translation first as in BVH
 *     End Site                           a leaf `fixedjoint End_Site`
 *
 * Where position channels replace the offset, the offset along them becomes 0, since here they are added to it.
 *
 * `.skel` has no End Sites. Boxes that extend to them would show them, but could not be converted back; a joint without
 * DOFs is exact, changes no channel, and becomes an End Site again (`evaluate/bvh-capture.ts`).
 */
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import { filePose, firstDofs, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf, isOfBvh, offsetBesideDofs } from '../../model/skeleton/joint-types.ts';
import { couplesInOrder, skelMotionOf } from '../../model/skeleton/skel-motion.ts';
import {
  type Box,
  isUnlimited,
  type Joint,
  type Limit,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
import { type Channel, restChannel, type Take } from '../../model/takes/take.ts';
import { keyedTake, type SampleKeyOptions } from './keys-of-samples.ts';

/** A skeleton that `.skel` can store, and which old channel each of its channels comes from. */
export interface SkelForm {
  readonly skeleton: Skeleton;
  /** For each channel of a take of the new skeleton, that of the old one; -1 for none. */
  readonly channelMap: readonly number[];
}

/** Thickness of the boxes relative to the character's extent. */
const THICKNESS = 1 / 80;

/** Name of a leaf that represents an End Site; a single token, as `.skel` requires. */
const END_SITE = 'End_Site';

/** Returns the skeleton itself if it has no BVH joints. Cached per skeleton. */
export const skelForm = perObject(make);

/** A take as `.anim` can store it: keys for the DOFs of `skelFigure(skeleton)`. */
export function skelTake(take: Take, skeleton: Skeleton, options: SampleKeyOptions = {}): Take {
  const { channelMap } = skelForm(skeleton);
  const keyed = keyedTake(take, skeleton, options);
  if (channelMap.every((c, i) => c === i)) return keyed;
  const none = restChannel();
  const past = take.channels.slice(rootDofCount(skeleton) + dofCount(skeleton));
  const channels = channelMap.map((c): Channel => (c < 0 ? none : (keyed.channels[c] ?? none)));
  return { ...keyed, channels: [...channels, ...past] };
}

/** A character's pose for the new skeleton's joints: one value per DOF. */
export function skelPose(pose: readonly number[], skeleton: Skeleton): readonly number[] {
  const { skeleton: to, channelMap } = skelForm(skeleton);
  return channelMap.slice(rootDofCount(to)).map((c) => (c < 0 ? 0 : (pose[c] ?? 0)));
}

function dofCount({ joints }: Skeleton): number {
  return joints.reduce((sum, { motion }) => sum + dofsOf(motion).length, 0);
}

function make(skeleton: Skeleton): SkelForm {
  const identity = () => Array.from({ length: rootDofCount(skeleton) + dofCount(skeleton) }, (_, c) => c);
  if (!skeleton.joints.some(({ motion }) => isOfBvh(motion))) return { skeleton, channelMap: identity() };
  const thickness = THICKNESS * extentOf(skeleton);
  const boxes = boxesOf(skeleton, thickness);
  const joints: Joint[] = [];
  /** For each old joint its new index; for each new one the old index or -1. */
  const numbers: number[] = [];
  const origins: number[] = [];
  skeleton.joints.forEach((joint, j) => {
    numbers.push(joints.length);
    origins.push(j);
    joints.push({ ...skelJoint(joint, boxes[j]), parent: numbers[joint.parent] ?? -1 });
    for (const end of joint.endSites ?? []) {
      origins.push(-1);
      joints.push(endSite(numbers[j], end, thickness));
    }
  });
  const known = joints.map(({ couples, ...joint }): Joint => {
    if (!couples) return joint;
    const numbered = couples.map((couple) => ({ ...couple, joint: numbers[couple.joint] ?? 0 }));
    return { ...joint, couples: couplesInOrder(numbered, joint.motion) };
  });
  const to: Skeleton = { name: skeleton.name, joints: known };
  return { skeleton: to, channelMap: channelMapOf(skeleton, to, origins) };
}

function skelJoint(joint: Joint, box: Box): Joint {
  const { endSites: _, ...rest } = joint;
  if (!isOfBvh(joint.motion)) return rest;
  const { motion, dofMap } = skelMotionOf(joint.motion);
  return {
    ...rest,
    box,
    motion,
    offset: offsetBesideDofs(joint),
    limits: dofMap.map((d) => limitOf(joint, d)),
    pose: dofMap.map((d) => joint.pose[d] ?? 0),
  };
}

/** Writes any unlimited range as `.skel` does, since decimals can't be infinite. */
function limitOf({ limits }: Joint, dof: number): Limit {
  const limit = limits[dof] ?? UNLIMITED;
  return isUnlimited(limit) ? UNLIMITED : limit;
}

function endSite(parent: number, offset: Vec3, thickness: number): Joint {
  const box: Box = { min: [-thickness, -thickness, -thickness], max: [thickness, thickness, thickness] };
  return { name: END_SITE, parent, offset, box, motion: { kind: 'fixed' }, limits: [], pose: [] };
}

function channelMapOf(from: Skeleton, to: Skeleton, origins: readonly number[]): readonly number[] {
  const starts = firstDofs(from);
  const own = rootDofCount(from);
  const map = Array.from({ length: rootDofCount(to) }, (_, c) => (c < own ? c : -1));
  origins.forEach((j) => {
    if (j < 0) return;
    map.push(...skelMotionOf(from.joints[j].motion).dofMap.map((d) => starts[j] + d));
  });
  return map;
}

/** Boxes around the bones that start at each joint, so that the character looks right drawn as boxes. */
function boxesOf({ joints }: Skeleton, thickness: number): readonly Box[] {
  const least = joints.map(() => [0, 0, 0]);
  const most = joints.map(() => [0, 0, 0]);
  const reachTo = (j: number, point: Vec3) => {
    point.forEach((v, k) => {
      least[j][k] = Math.min(least[j][k], v);
      most[j][k] = Math.max(most[j][k], v);
    });
  };
  joints.forEach(({ parent, offset, endSites = [] }, j) => {
    if (parent >= 0) reachTo(parent, offset);
    for (const end of endSites) reachTo(j, end);
  });
  return joints.map((_, j): Box => {
    const [x, y, z] = least[j];
    const [u, v, w] = most[j];
    return {
      min: [x - thickness, y - thickness, z - thickness],
      max: [u + thickness, v + thickness, w + thickness],
    };
  });
}

/** The longest side of the box around the joints in the file pose. */
function extentOf(skeleton: Skeleton): number {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, Float64Array.from(filePose(skeleton, 0)), world);
  const sides = [12, 13, 14].map((k) => {
    const along = skeleton.joints.map((_, j) => world[16 * j + k]);
    return along.reduce((a, b) => Math.max(a, b)) - along.reduce((a, b) => Math.min(a, b));
  });
  return Math.max(...sides) || 1;
}
