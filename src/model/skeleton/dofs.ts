/**
 * All DOFs of a character as one list, in the order in which `.anim` channels drive them:
 *
 *     0 1 2        root translation x y z; omitted if the root joint's own DOFs move the character
 *     then         each joint's DOFs, joints in depth-first order
 *     then         the morph weights
 *
 * Sliders, commands, channels and the mixer's track all address a DOF by its index in this list.
 */

import type { Morph } from '../morph.ts';
import { carriesCharacter, dofsOf, takesLimits } from './joint-types.ts';
import { type Dof, type DofUnit, type Limit, type Skeleton, UNLIMITED } from './skeleton.ts';

const ROOT_TRANSLATION: readonly Dof[] = [
  { name: 'tx', unit: 'length', rest: 0 },
  { name: 'ty', unit: 'length', rest: 0 },
  { name: 'tz', unit: 'length', rest: 0 },
];

/** A DOF of a character, with all that is needed to show a slider for it. */
export interface CharacterDof extends Dof {
  /** -1 for a morph weight; the root's index for its translation. */
  readonly joint: number;
  /** Unlimited if the DOF takes no limits. */
  readonly limit: Limit;
  /** False for root translation, morph weights and quaternion components. */
  readonly takesLimits: boolean;
}

/** A value that one of a character's DOFs takes. */
export interface DofValue {
  /** Into the character's DOFs. */
  readonly index: number;
  readonly value: number;
}

/** Root translation is never clamped, however far an animation walks. */
const NO_LIMIT: Limit = { min: Number.NEGATIVE_INFINITY, max: Number.POSITIVE_INFINITY };

/** The root translation of a character with this skeleton; empty if the root joint moves by itself. */
export function rootDofs(skeleton: Skeleton | undefined): readonly Dof[] {
  const root = skeleton?.joints[0];
  return root && carriesCharacter(root.motion) ? NONE : ROOT_TRANSLATION;
}

const NONE: readonly Dof[] = [];

/** Number of DOFs before those of the joints. */
export function rootDofCount(skeleton: Skeleton | undefined): number {
  return rootDofs(skeleton).length;
}

/** Number of DOFs of the joints, without root translation and morphs. */
export function jointDofCount(skeleton: Skeleton | undefined): number {
  let count = 0;
  for (const joint of skeleton?.joints ?? []) count += dofsOf(joint.motion).length;
  return count;
}

/** Index of each joint's first DOF in the character's list. */
export function firstDofs(skeleton: Skeleton): number[] {
  let next = rootDofCount(skeleton);
  return skeleton.joints.map((joint) => {
    const first = next;
    next += dofsOf(joint.motion).length;
    return first;
  });
}

/** Every DOF of a character with this skeleton and these morphs, in order. */
export function characterDofs(skeleton: Skeleton | undefined, morphs: readonly { readonly name: string }[]) {
  const all: CharacterDof[] = rootDofs(skeleton).map((dof) => ({
    ...dof,
    joint: 0,
    limit: NO_LIMIT,
    takesLimits: false,
  }));
  skeleton?.joints.forEach((joint, index) => {
    const limited = takesLimits(joint.motion);
    dofsOf(joint.motion).forEach((dof, i) => {
      const limit = limited ? (joint.limits[i] ?? UNLIMITED) : NO_LIMIT;
      all.push({ ...dof, joint: index, limit, takesLimits: limited });
    });
  });
  for (const morph of morphs)
    all.push({ name: morph.name, unit: 'weight', rest: 0, joint: -1, limit: { min: 0, max: 1 }, takesLimits: false });
  return all;
}

/**
 * The unit of a channel's values: that of the DOF it drives. Channels beyond the DOFs, or of a take without a skeleton,
 * drive nothing and are plain numbers, like weights.
 */
export function unitOfChannel(dofs: readonly CharacterDof[], channel: number): DofUnit {
  return channel < dofs.length ? dofs[channel].unit : 'weight';
}

/** The file's pose as a character's DOFs: root translation 0, joints as written, morph weights 0. */
export function filePose(skeleton: Skeleton | undefined, morphCount: number): number[] {
  const values = rootDofs(skeleton).map(() => 0);
  for (const joint of skeleton?.joints ?? []) values.push(...joint.pose);
  for (let m = 0; m < morphCount; m++) values.push(0);
  return values;
}

/** The file pose of a whole character, with the weights that its file gives to morphs. */
export function wholeFilePose(skeleton: Skeleton | undefined, morphs: readonly Pick<Morph, 'weight'>[]): number[] {
  return [...filePose(skeleton, 0), ...morphs.map(({ weight = 0 }) => weight)];
}

/** Every DOF at rest, as in an empty pose. Scales are 1, quaternions the identity. */
export function restPose(skeleton: Skeleton | undefined, morphCount: number): number[] {
  const values = rootDofs(skeleton).map(({ rest }) => rest);
  for (const joint of skeleton?.joints ?? []) values.push(...dofsOf(joint.motion).map(({ rest }) => rest));
  for (let m = 0; m < morphCount; m++) values.push(0);
  return values;
}
