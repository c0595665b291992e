/**
 * Converts poses between a character's list of DOFs and names, and so between characters. If the joints have the same
 * names in the same order, they correspond one to one; otherwise they are matched by name (`same-joints.ts`).
 */
import type { Character } from '../../model/document.ts';
import type { NamedValue, PoseByNames, PosedJoint } from '../../model/pose-by-names.ts';
import type { NamedPose } from '../../model/poses.ts';
import { characterDofs, firstDofs, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Joint } from '../../model/skeleton/skeleton.ts';
import { haveSameNames, sameNames } from './same-joints.ts';

type Posed = Pick<Character, 'skeleton' | 'morphs'>;

/**
 * A pose of the library by the names of joints, DOFs and morphs.
 * @param values one per DOF of the character; missing ones are at rest
 */
export function poseByNames(character: Posed, { name, values }: NamedPose): PoseByNames {
  const all = characterDofs(character.skeleton, character.morphs);
  const joints: { name: string; dofs: NamedValue[] }[] = (character.skeleton?.joints ?? []).map((joint) => ({
    name: joint.name,
    dofs: [],
  }));
  const weights: NamedValue[] = [];
  const root: number[] = [];
  const own = rootDofCount(character.skeleton);
  all.forEach((dof, index) => {
    const value = values[index] ?? dof.rest;
    if (dof.joint < 0) weights.push({ name: dof.name, value });
    else if (index < own) root.push(value);
    else joints[dof.joint].dofs.push({ name: dof.name, value });
  });
  const [x, y, z] = root;
  return { name, ...(root.length === 3 && { root: [x, y, z] }), joints, weights };
}

/** A pose by names, as values of a character's DOFs. */
export interface TakenPose {
  /** By DOF of the character. */
  readonly values: ReadonlyMap<number, number>;
  /** Joints of the pose that the character has, at least in part. */
  readonly found: number;
  /** Names of those that it lacks, except for joints without values. */
  readonly missing: readonly string[];
}

/**
 * A pose applied to a character; DOFs that the pose lacks, or has under another name, get no value.
 * @param known for each of its joints the character's, or -1, if known; else matched by name
 */
export function takePose(character: Posed, pose: PoseByNames, known?: ArrayLike<number>): TakenPose {
  const all = characterDofs(character.skeleton, character.morphs);
  const values = new Map<number, number>();
  const missing: string[] = [];
  let found = 0;
  const first = character.skeleton ? firstDofs(character.skeleton) : [];
  const joints = character.skeleton?.joints ?? [];
  const targets = known ?? matched(pose.joints, joints);
  pose.joints.forEach((posed, i) => {
    const joint = targets[i];
    if (joint < 0) {
      if (posed.dofs.length > 0) missing.push(posed.name);
      return;
    }
    const dofs = dofsOf(joints[joint].motion);
    let taken = 0;
    for (const { name, value } of posed.dofs) {
      const d = dofs.findIndex((dof) => dof.name === name);
      if (d < 0) continue;
      values.set(first[joint] + d, value);
      taken++;
    }
    if (taken > 0 || posed.dofs.length === 0) found++;
    else missing.push(posed.name);
  });
  if (pose.root && rootDofCount(character.skeleton) === 3) for (let k = 0; k < 3; k++) values.set(k, pose.root[k]);
  for (const { name, value } of pose.weights) {
    const index = all.findIndex((dof) => dof.joint < 0 && dof.name === name && !values.has(all.indexOf(dof)));
    if (index >= 0) values.set(index, value);
  }
  return { values, found, missing };
}

/** For each posed joint the character's joint, or -1; each used once. Unnamed ones are matched by index. */
function matched(posed: readonly PosedJoint[], joints: readonly Joint[]): ArrayLike<number> {
  if (haveSameNames(posed, joints)) return posed.map((_, j) => j);
  const targets = sameNames(posed, joints);
  posed.forEach(({ name, dofs }, j) => {
    const isAlike = name === '' && joints[j]?.name === '' && haveSameNames(dofs, dofsOf(joints[j].motion));
    if (isAlike) targets[j] = j;
  });
  return targets;
}
