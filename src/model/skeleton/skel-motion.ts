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

import { layerCode } from '../takes/layer-code.ts';
import { columnOf, type Samples } from '../takes/samples.ts';
import { type Channel, restChannel, type Take } from '../takes/take.ts';
import { firstDofs, jointDofCount, rootDofCount, rootDofs } from './dofs.ts';
import { dofsOf, isOfBvh, jointTypeOf, offsetBesideDofs } from './joint-types.ts';
import { type Couple, type Joint, type Motion, type Skeleton, UNLIMITED } from './skeleton.ts';

/** A motion that `.skel` can hold, and where its DOFs come from. */
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
  const { limits, pose, couples } = joint;
  if (!isOfBvh(joint.motion)) return joint;
  const { motion, dofMap } = skelMotionOf(joint.motion);
  return {
    ...joint,
    motion,
    offset: offsetBesideDofs(joint),
    limits: dofMap.map((dof) => limits[dof] ?? UNLIMITED),
    pose: dofMap.map((dof) => pose[dof] ?? 0),
    ...(couples && { couples: couplesInOrder(couples, motion) }),
  };
}

/** Links in the order of a motion's DOFs, as they are read. */
export function couplesInOrder(couples: readonly Couple[], motion: Motion): readonly Couple[] {
  const order = dofsOf(motion).map(({ name }) => name);
  return couples.toSorted((a, b) => order.indexOf(a.dof) - order.indexOf(b.dof));
}

/** The skeleton without BVH joints; the same object if it has none. Joints keep their indices. */
export function skelSkeleton(skeleton: Skeleton): Skeleton {
  if (!skeleton.joints.some(({ motion }) => isOfBvh(motion))) return skeleton;
  return { ...skeleton, joints: skeleton.joints.map(skelJoint) };
}

/**
 * A take of a skeleton with the channels of its `skelSkeleton`: the DOFs of joints may come in another order, and
 * behind a root translation that a root of motion capture did without. The same object if nothing changes.
 * @param pose values of the DOFs that the take has no channels for
 */
export function skelChannels(take: Take, skeleton: Skeleton, pose: readonly number[]): Take {
  if (take.layers) return ofEach(take, pose, (each, values) => skelChannels(each, skeleton, values));
  const own = rootDofCount(skeleton);
  const order = channelOrder(skeleton);
  if (order.every((c, i) => c === i)) return take;
  const { samples, channels, ...rest } = take;
  // A take may have fewer channels than DOFs, and more: those of morphs.
  const count = order.findLastIndex((c) => c >= 0 && c < channels.length) + 1;
  const past = channels.length - own - jointDofCount(skeleton);
  const from = order.slice(0, past >= 0 ? order.length : count);
  for (let i = 0; i < past; i++) from.push(channels.length - past + i);
  return {
    ...rest,
    channels: from.map((c) => channels[c] ?? restChannel(pose[c])),
    ...(samples && { samples: reordered(samples, from) }),
  };
}

/**
 * The reverse for keys: channels that are in the order of the skeleton's `skelSkeleton`, as in an `.anim`, in that of
 * its own DOFs. The same object if nothing changes.
 */
export function ownChannels(take: Take, skeleton: Skeleton, pose: readonly number[]): Take {
  if (take.layers) return ofEach(take, pose, (each, values) => ownChannels(each, skeleton, values));
  const order = channelOrder(skeleton);
  if (order.every((c, i) => c === i)) return take;
  const channels: Channel[] = [];
  const given = order.slice(0, take.channels.length);
  const count = given.reduce((most, c) => Math.max(most, c + 1), 0);
  for (let c = 0; c < count; c++) channels.push(restChannel(pose[c]));
  given.forEach((c, i) => {
    if (c >= 0) channels[c] = take.channels[i];
  });
  return { ...take, channels: [...channels, ...take.channels.slice(order.length)] };
}

/** A take with layers with the channels of each in another order; layers leave what they lack alone. */
function ofEach(take: Take, pose: readonly number[], order: (take: Take, pose: readonly number[]) => Take): Take {
  return layerCode(take).withMotions(take, (each, layer) => order(each, layer < 0 ? pose : []));
}

/** For each channel of a take of its `skelSkeleton`, the skeleton's own; -1 for none. */
function channelOrder(skeleton: Skeleton): readonly number[] {
  const first = firstDofs(skeleton);
  const own = rootDofCount(skeleton);
  const order = rootDofs(skelSkeleton(skeleton)).map((_, c) => (c < own ? c : -1));
  skeleton.joints.forEach(({ motion }, j) => {
    order.push(...skelMotionOf(motion).dofMap.map((d) => first[j] + d));
  });
  return order;
}

/** @param from the channel whose samples each channel gets; -1 for none */
function reordered(samples: Samples, from: readonly number[]): Samples {
  const columns = from.map((c) => (c < 0 ? -1 : columnOf(samples, c)));
  const firstChannel = columns.findIndex((column) => column >= 0);
  const taken = columns.slice(firstChannel, columns.findLastIndex((column) => column >= 0) + 1);
  const { frameCount, scales } = samples;
  const values = new Float64Array(frameCount * taken.length);
  taken.forEach((column, k) => {
    if (column < 0) return;
    for (let f = 0; f < frameCount; f++) values[f * taken.length + k] = samples.values[f * scales.length + column];
  });
  return { ...samples, firstChannel, values, scales: Float64Array.from(taken, (column) => scales[column] ?? 1) };
}
