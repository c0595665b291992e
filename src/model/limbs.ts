/**
 * Limbs of a character: chains of joints whose last one goes to a goal while a take plays (`evaluate/limbs/`). They are
 * saved in `NAME.limbs.json` beside the skeleton, with joints by name; the goals belong to takes (`takes/goals.ts`).
 */
import type { Vec3 } from '../math/vec3.ts';
import type { OtherFields } from './other-fields.ts';
import { jointReferences } from './skeleton/joint-reference.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** How the middle joint of a limb bends. */
export interface Bend {
  /** The rotation DOF that is solved, by its name: `rx`. */
  readonly dof: string;
  /** To which side: 1 if it is at least 0, else −1. */
  readonly sign: number;
  readonly others?: OtherFields;
}

interface LimbSettings {
  readonly name: string;
  /** The point of the last joint that goes to the goal, in that joint's space. */
  readonly tip: Vec3;
  /** Whether the last joint takes the goal's rotation, too. */
  readonly orient: boolean;
  /** Absent of chains that have no middle joint. */
  readonly bend?: Bend;
  readonly others?: OtherFields;
}

/** A chain of joints of the skeleton. */
export interface Limb extends LimbSettings {
  /** Indices, each the parent of the next. */
  readonly joints: readonly number[];
}

/** The limbs of a character. */
export interface Limbs {
  readonly list: readonly Limb[];
  readonly others?: OtherFields;
}

/** A limb as in a file: joints by their names, or `#7` by index. */
export interface LimbByName extends LimbSettings {
  readonly joints: readonly string[];
}

/** A goal that IK reaches in the pose of FK. */
export interface LimbMatch {
  /** tx ty tz rx ry rz. */
  readonly goal: readonly number[];
  readonly pole: Vec3;
  readonly bend: 1 | -1;
}

/** A limb with a goal, at a time. */
export interface LimbInfo {
  readonly name: string;
  /** Within 0 … 1. */
  readonly blend: number;
  /** `world`, `parent`, or a joint by name or `#index`. */
  readonly space: string;
  /** tx ty tz rx ry rz, in that space. */
  readonly goal: readonly number[];
  /** From the tip to the goal. */
  readonly gap: number;
  /** The goal that FK's pose reaches, in that space. */
  readonly match: LimbMatch;
}

/** A limb as its file has it, and, if it has a goal in the take shown, what `marrow pose` says of it. */
export type LimbRow = LimbByName & Partial<LimbInfo>;

/** Where the goal of a limb in IK is at a time, in the character's space. */
export interface GoalPlace {
  readonly limb: Limb;
  readonly point: Vec3;
  /** Absent without one. */
  readonly pole?: Vec3;
  /** The values with which the pole is at a point of the character's space, by the indices of `withGoalChannels`. */
  poleAt(point: Vec3): readonly { readonly index: number; readonly value: number }[];
}

/** Limbs as their file has them. */
export function limbsByName(limbs: readonly Limb[], skeleton: Skeleton): readonly LimbByName[] {
  const names = jointReferences(skeleton.joints);
  return limbs.map((limb) => ({ ...limb, joints: limb.joints.map((joint) => names[joint]) }));
}

/**
 * The limbs with the new indices of joints, without those that have lost one; the same object if all keep theirs.
 * @param to for each old joint its new index; -1 if removed
 */
export function remapLimbs(limbs: Limbs, to: ArrayLike<number>): Limbs {
  if (Array.from(to).every((joint, i) => joint === i)) return limbs;
  const moved = limbs.list.map((limb) => ({ ...limb, joints: limb.joints.map((joint) => to[joint]) }));
  return { ...limbs, list: moved.filter(({ joints }) => !joints.includes(-1)) };
}
