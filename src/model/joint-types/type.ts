/**
 * What a type of joint is: a record of everything that is known about it but its matrix, which is in
 * `evaluate/motions.ts`. Whoever wants to know something about a joint asks its type's record, never which type it is.
 */
import type { CompoundDof, Dof, Motion } from '../skeleton.ts';
import type { Parameter } from './parameters.ts';

export interface JointType<M extends Motion = Motion> {
  /** As `.skel` and scripts call it: `hingejoint`. */
  readonly keyword: string;
  /** In the list of types, as short as a narrow inspector. */
  readonly label: string;
  /** What a joint of this type does, in a few words. */
  readonly summary: string;
  /** The format whose files have joints of this type: those of `bvh` become others before they are written to `.skel`. */
  readonly format: 'skel' | 'bvh';
  /** The motion of a joint about which its file says nothing more than its type. */
  readonly initial: M;
  /** What can be said about a motion of this type, by the names of its fields; `.skel` has a token of that name for each. */
  readonly parameters: { readonly [F in Exclude<keyof M, 'kind'>]: Parameter };
  /** Whether limits of its DOFs have a meaning. Those of a quaternion are no quantities of their own. */
  readonly takesLimits: boolean;
  /** Which of its DOFs are the x y z w of a quaternion; empty where it has none. */
  readonly quaternion: readonly number[];
  /** Whether the axis-angle form of `.skel` can hold it: it turns about its axis, and that is all. */
  readonly isAxisAngle: boolean;
  /** Whether the axis counts, of a type whose other parameters decide about that; absent: it does. */
  usesAxis?(motion: M): boolean;
  /** The DOFs, in the order in which poses, limits and channels list them. */
  dofs(motion: M): readonly Dof[];
  /**
   * Its matrix as a product of one-DOF matrices along and about x, y and z, from left to right, each by the name of its
   * DOF: `rz ry rx` for a balljoint of order xyz. Undefined where it is no such product.
   */
  factors(motion: M): readonly CompoundDof[] | undefined;
  /** Whether such a joint as the root carries the whole character by its own DOFs, and needs no root translation. */
  carriesCharacter(motion: M): boolean;
  /**
   * The motion on the other side of a plane across an axis, where its DOFs have the signs that their names say
   * (`edit/rig/mirrored-motion.ts`).
   * @param across 0, 1 or 2 for x, y or z
   */
  mirrored(motion: M, across: number): M;
  /** The type and its parameters: `hingejoint, axis 1 1 0.5`; `number` writes its numbers. */
  text(motion: M, number: (value: number) => string): string;
  /** For a heading, where that is not `text` without its "joint". */
  heading?(motion: M): string;
  /** The same motion as one that `.skel` has, for a type that it does not have. */
  asSkel?(motion: M): Motion;
}
