/** Selection sets and locks as their file has them, with joints by name. */
import type { OtherFields } from './other-fields.ts';
import { byJoint, inOrder, type JointSet, type LockedDofs, type Sets } from './sets.ts';
import { characterDofs } from './skeleton/dofs.ts';
import { jointReferences, jointReferred } from './skeleton/joint-reference.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** As in the file: joints by their names, or `#7` by index. */
export interface SetsByName {
  readonly sets: readonly (Omit<JointSet, 'joints'> & { readonly joints: readonly string[] })[];
  readonly locked: readonly (Omit<LockedDofs, 'joint'> & { readonly joint: string })[];
  readonly others?: OtherFields;
}

/** Sets and locks as their file has them. */
export function setsByName({ sets, locked, ...rest }: Sets, skeleton: Skeleton): SetsByName {
  const names = jointReferences(skeleton.joints);
  return {
    ...rest,
    sets: sets.map((set) => ({ ...set, joints: set.joints.map((joint) => names[joint]) })),
    locked: locked.map((row) => ({ ...row, joint: names[row.joint] })),
  };
}

/** Sets and locks of a file for a skeleton, and what it lacks of them, with their paths in the file. */
export function setsOfJoints(
  { sets, locked, ...rest }: SetsByName,
  skeleton: Skeleton,
): { readonly sets: Sets; readonly unknown: readonly { readonly path: string; readonly what: string }[] } {
  const indexOf = jointReferred(skeleton.joints);
  const names = namesOfDofs(skeleton);
  const unknown: { path: string; what: string }[] = [];
  const found = (name: string, path: string) => {
    const joint = indexOf(name);
    if (joint === undefined) unknown.push({ path, what: `the joint "${name}"` });
    return joint;
  };
  const rows = new Map<number, LockedDofs>();
  locked.forEach((row, i) => {
    const joint = found(row.joint, `locked[${i}].joint`);
    if (joint === undefined) return;
    const dofs = row.dofs.filter((name, k) => {
      const isKnown = names[joint].includes(name);
      if (!isKnown) unknown.push({ path: `locked[${i}].dofs[${k}]`, what: `the DOF ${name} of "${row.joint}"` });
      return isKnown;
    });
    const { joint: _name, ...kept } = row;
    rows.set(joint, {
      ...rows.get(joint),
      ...kept,
      joint,
      dofs: [...new Set([...(rows.get(joint)?.dofs ?? []), ...dofs])],
    });
  });
  const ofJoints = sets.map((set, i) => ({
    ...set,
    joints: inOrder(set.joints.flatMap((name, k) => found(name, `sets[${i}].joints[${k}]`) ?? [])),
  }));
  return { sets: { ...rest, sets: ofJoints, locked: byJoint([...rows.values()]) }, unknown };
}

/** The names of the DOFs of each joint, the root's translation among those of joint 0. */
function namesOfDofs(skeleton: Skeleton): readonly (readonly string[])[] {
  const names: string[][] = skeleton.joints.map(() => []);
  for (const { joint, name } of characterDofs(skeleton, [])) names[joint].push(name);
  return names;
}
