/**
 * Poses from a character's list of DOFs to names, and from names to any character's list. Between skeletons whose joints
 * have the same names in the same order, one goes to one. Otherwise joints go by name (`same-joints.ts`).
 */
import type { Character } from '../../model/document.ts';
import { characterDofs, firstDofs, rootDofCount } from '../../model/dofs.ts';
import { dofsOf } from '../../model/joint-types.ts';
import type { NamedValue, PoseByNames, PosedJoint } from '../../model/pose-by-names.ts';
import type { NamedPose } from '../../model/poses.ts';
import type { Joint } from '../../model/skeleton.ts';
import { haveSameNames, sameNames } from './same-joints.ts';

type Posed = Pick<Character, 'skeleton' | 'morphs'>;

/** @param values one for each of the character's DOFs; what has no place in them is at rest */
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

export interface TakenPose {
  /** By DOF of the character. */
  readonly values: ReadonlyMap<number, number>;
  /** Joints of the pose that the character has, or has in part. */
  readonly found: number;
  /** Names of those that it has not. */
  readonly missing: readonly string[];
}

/**
 * What a pose comes to for a character; DOFs that it says nothing of, or that it has by another name, are in no value.
 * @param known of each of its joints the character's, or -1, where that is known; else names tell
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
      missing.push(posed.name);
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

/** Of each posed joint the character's joint, or -1; each of those once. Nameless ones go by their place in the list. */
function matched(posed: readonly PosedJoint[], joints: readonly Joint[]): ArrayLike<number> {
  if (haveSameNames(posed, joints)) return posed.map((_, j) => j);
  const targets = sameNames(posed, joints);
  posed.forEach(({ name, dofs }, j) => {
    const isAlike = name === '' && joints[j]?.name === '' && haveSameNames(dofs, dofsOf(joints[j].motion));
    if (isAlike) targets[j] = j;
  });
  return targets;
}
