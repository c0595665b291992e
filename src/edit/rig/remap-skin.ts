/**
 * Remaps a skin to other joints: attachments and bindings by the joints' new indices. Vertices of a removed joint are
 * reassigned to its nearest ancestor. Bindings are kept; a new joint gets one that is ready for weighting, so that a
 * vertex assigned to it stays where its parent has it:
 *
 *     B_new = B_parent · T(offset) · J(rest)          so that  W_new · B_new⁻¹ = W_parent · B_parent⁻¹  at rest
 */
import { compileSkeleton, localMatrices, worldMatrices } from '../../evaluate/kinematics.ts';
import { isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { restPose, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type Attachments, bindingCount, type Skin } from '../../model/skin.ts';
import type { JointMap } from './joint-map.ts';

/** A skin with the new indices of joints; the same object if all joints keep their indices and none is new. */
export function remapSkin(skin: Skin, map: JointMap): Skin {
  if (map.keepsJoints) return skin;
  const attachments = skin.attachments && remapAttachments(skin.attachments, map);
  const bindings = remapBindings(skin, map);
  if (attachments === skin.attachments && bindings === skin.bindings) return skin;
  return { ...skin, ...(attachments && { attachments }), bindings };
}

/**
 * The new index of each joint's data, `count` in all. A skin may refer to joints beyond the skeleton's: joints added at
 * the end adopt them in order, otherwise they stay beyond the end.
 */
function targets({ heirs, after }: JointMap, count: number): Uint32Array {
  const isGrown = heirs.every((heir, j) => heir === j);
  const shift = isGrown ? 0 : after.joints.length - heirs.length;
  return Uint32Array.from({ length: count }, (_, j) => (j < heirs.length ? heirs[j] : j + shift));
}

function highest(joints: Uint32Array): number {
  let most = 0;
  for (const joint of joints) if (joint > most) most = joint;
  return most;
}

function remapAttachments(attachments: Attachments, map: JointMap): Attachments {
  const { start, joints, weights } = attachments;
  const to = targets(map, Math.max(map.heirs.length, highest(joints) + 1));
  if (joints.every((joint) => to[joint] === joint)) return attachments;
  const isMerged = map.to.some((index) => index < 0);
  if (!isMerged) return { start, joints: joints.map((joint) => to[joint]), weights };
  const nextStart = new Uint32Array(start.length);
  const nextJoints = new Uint32Array(joints.length);
  const nextWeights = new Float64Array(joints.length);
  let end = 0;
  for (let v = 0; v + 1 < start.length; v++) {
    const begin = end;
    for (let a = start[v]; a < start[v + 1]; a++) {
      const joint = to[joints[a]];
      // Merges only attachments that were joined here: a file may list one joint twice on purpose.
      const at = isMergedInto(map, joints, start[v], a) ? indexOf(nextJoints, joint, begin, end) : -1;
      if (at >= 0) nextWeights[at] += weights[a];
      else {
        nextJoints[end] = joint;
        nextWeights[end++] = weights[a];
      }
    }
    nextStart[v + 1] = end;
  }
  return { start: nextStart, joints: nextJoints.slice(0, end), weights: nextWeights.slice(0, end) };
}

/** Whether this attachment's joint, or an earlier one of the same vertex with the same heir, was removed. */
function isMergedInto({ to, heirs }: JointMap, joints: Uint32Array, from: number, a: number): boolean {
  const own = joints[a];
  if (own >= to.length) return false;
  if (to[own] < 0) return true;
  for (let b = from; b < a; b++)
    if (joints[b] < to.length && to[joints[b]] < 0 && heirs[joints[b]] === heirs[own]) return true;
  return false;
}

function indexOf(list: Uint32Array, value: number, from: number, to: number): number {
  for (let i = from; i < to; i++) if (list[i] === value) return i;
  return -1;
}

/** A skin with bindings for all joints keeps that; one with fewer gets as many as needed. */
function remapBindings(skin: Skin, map: JointMap): Float64Array {
  const bound = bindingCount(skin);
  if (bound === 0) return skin.bindings;
  const { after, to } = map;
  const target = targets(map, bound);
  let count = bound < to.length ? 1 : after.joints.length;
  for (let j = 0; j < bound; j++) count = Math.max(count, target[j] + 1);
  const bindings = new Float64Array(16 * count);
  const known = new Uint8Array(count);
  for (let j = 0; j < bound; j++) {
    if (j < to.length && to[j] < 0) continue;
    bindings.set(skin.bindings.subarray(16 * j, 16 * j + 16), 16 * target[j]);
    known[target[j]] = 1;
  }
  bindNew(after, bindings, known);
  return bindings;
}

/**
 * Computes bindings of joints that have none, as above; if the parent has none, from the joint's matrix at rest.
 * @param known by joint, whether `bindings` contains its 16 numbers; updated
 */
export function bindNew(skeleton: Skeleton, bindings: Float64Array, known: Uint8Array): void {
  if (known.every((has) => has === 1)) return;
  const compiled = compileSkeleton(skeleton);
  const rest = Float64Array.from(restAtOffsets(skeleton));
  const local = new Float64Array(16 * compiled.jointCount);
  const world = new Float64Array(16 * compiled.jointCount);
  localMatrices(compiled, rest, local);
  worldMatrices(compiled, rest, world);
  for (let j = 0; j < Math.min(known.length, compiled.jointCount); j++) {
    if (known[j]) continue;
    known[j] = 1;
    const parent = compiled.parent[j];
    if (parent >= 0) multiplyAffine(bindings, 16 * parent, local, 16 * j, bindings, 16 * j);
    else bindings.set(world.subarray(16 * j, 16 * j + 16), 16 * j);
    if (isSingular(bindings, 16 * j)) setIdentity(bindings, 16 * j);
  }
}

/** Every DOF at rest, and position channels that replace offsets at the offsets. */
export function restAtOffsets(skeleton: Skeleton): number[] {
  const values = restPose(skeleton, 0);
  let d = rootDofCount(skeleton);
  for (const { motion, offset } of skeleton.joints) {
    const dofs = dofsOf(motion);
    dofs.forEach(({ name }, i) => {
      if (replacesOffset(motion, name)) values[d + i] = offset['xyz'.indexOf(name[1])];
    });
    d += dofs.length;
  }
  return values;
}
