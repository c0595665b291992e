/**
 * Selection sets and locked DOFs of a character: saved in `NAME.sets.json` beside its skeleton, with joints by name.
 * Here joints are indices, and `sets-by-name.ts` goes from one to the other.
 */
import type { OtherFields } from './other-fields.ts';
import { perPair } from './per-object.ts';
import { characterDofs } from './skeleton/dofs.ts';
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
  /**
   * Names, such as `rx`; the root's translation is `tx`, `ty` and `tz` of joint 0. Those that the joint lacks count for
   * nothing.
   */
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

/** The end of what its files are called: `wasp.sets.json`. */
export const SETS_EXTENSION = 'sets.json';

/** A character without sets and locks. */
export const NO_SETS: Sets = { sets: [], locked: [] };

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

/** Joints ascending, each once. */
export function inOrder(joints: readonly number[]): readonly number[] {
  return [...new Set(joints)].sort((a, b) => a - b);
}

/** Those that say anything, by their joints. */
export function byJoint(rows: readonly LockedDofs[]): readonly LockedDofs[] {
  return rows.filter(({ dofs, others }) => dofs.length > 0 || others).sort((a, b) => a.joint - b.joint);
}
