/**
 * Selection sets and locked DOFs of a character: saved in `NAME.sets.json` beside its skeleton, with joints by name.
 * Here joints are indices, and `setsByName` and `setsOfJoints` go from one to the other.
 */
import type { OtherFields } from './other-fields.ts';
import { perPair } from './per-object.ts';
import { characterDofs } from './skeleton/dofs.ts';
import { jointReferences, jointReferred } from './skeleton/joint-reference.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** Joints that are selected together. */
export interface JointSet {
  readonly name: string;
  /** A colour of CSS, such as `#4a90e2`; absent: none of its own. */
  readonly color?: string;
  /** Indices, ascending, each once. */
  readonly joints: readonly number[];
  readonly others?: OtherFields;
}

/** DOFs of a joint that posing by hand and keying leave alone. */
export interface LockedDofs {
  readonly joint: number;
  /** Names, such as `rx`; the root's translation is `tx`, `ty` and `tz` of joint 0. Those that the joint lacks count for nothing. */
  readonly dofs: readonly string[];
  readonly others?: OtherFields;
}

/** Selection sets and locks of a character. */
export interface Sets {
  /** In the order of the list. */
  readonly sets: readonly JointSet[];
  /** At most one for each joint, ascending. */
  readonly locked: readonly LockedDofs[];
  readonly others?: OtherFields;
}

/** As in the file: joints by their names, or `#7` by index. */
export interface SetsByName {
  readonly sets: readonly (Omit<JointSet, 'joints'> & { readonly joints: readonly string[] })[];
  readonly locked: readonly (Omit<LockedDofs, 'joint'> & { readonly joint: string })[];
  readonly others?: OtherFields;
}

/** The end of what its files are called: `wasp.sets.json`. */
export const SETS_EXTENSION = 'sets.json';

/** A character without sets and locks. */
export const NO_SETS: Sets = { sets: [], locked: [] };

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

/**
 * The sets with the new indices of joints; the same object if all keep theirs.
 * @param to for each old joint its new index; -1 if removed, together with what refers to it
 */
export function remapSets(sets: Sets, to: ArrayLike<number>): Sets {
  if (Array.from(to).every((joint, i) => joint === i)) return sets;
  const moved = (joint: number) => (to[joint] >= 0 ? [to[joint]] : []);
  return {
    ...sets,
    sets: sets.sets.map((set) => ({ ...set, joints: inOrder(set.joints.flatMap(moved)) })),
    locked: byJoint(sets.locked.flatMap((row) => moved(row.joint).map((joint) => ({ ...row, joint })))),
  };
}

/** Whether there is nothing to save. */
export function isWithoutSets({ sets, locked, others }: Sets): boolean {
  return sets.length === 0 && locked.length === 0 && others === undefined;
}

const NONE: ReadonlySet<number> = new Set();
const lockedBy = perPair(indicesOf);

/** The locked DOFs of a character, by their indices in its list (`skeleton/dofs.ts`). Cached. */
export function lockedDofs({
  sets,
  skeleton,
}: {
  readonly sets?: Sets;
  readonly skeleton?: Skeleton;
}): ReadonlySet<number> {
  return sets && skeleton && sets.locked.length > 0 ? lockedBy(sets, skeleton) : NONE;
}

function indicesOf({ locked }: Sets, skeleton: Skeleton): ReadonlySet<number> {
  const names = new Map(locked.map(({ joint, dofs }) => [joint, dofs]));
  const all = characterDofs(skeleton, []);
  return new Set(all.flatMap(({ joint, name }, dof) => (names.get(joint)?.includes(name) ? [dof] : [])));
}

/** The names of the DOFs of each joint, the root's translation among those of joint 0. */
function namesOfDofs(skeleton: Skeleton): readonly (readonly string[])[] {
  const names: string[][] = skeleton.joints.map(() => []);
  for (const { joint, name } of characterDofs(skeleton, [])) names[joint].push(name);
  return names;
}

function inOrder(joints: readonly number[]): readonly number[] {
  return [...new Set(joints)].sort((a, b) => a - b);
}

function byJoint(rows: readonly LockedDofs[]): readonly LockedDofs[] {
  return rows.filter(({ dofs, others }) => dofs.length > 0 || others).sort((a, b) => a.joint - b.joint);
}
