/**
 * A joint type: everything known about it except its matrix, which is in `evaluate/motions.ts`. Code that needs to know
 * something about a joint asks its type's record, never which type it is.
 */
import type { CompoundDof, Dof, Motion } from '../skeleton/skeleton.ts';
import type { Parameter } from './parameters.ts';

/** The record of a joint type: names, parameters, DOFs, and what formats, limits and mirroring need to know. */
export interface JointType<M extends Motion = Motion> {
  /** Its name in `.skel` and scripts: `hingejoint`. */
  readonly keyword: string;
  /** The format that has joints of this type: those of others are converted before they are written to `.skel`. */
  readonly format: 'skel' | 'bvh' | 'asf' | 'points';
  /** The motion of a joint whose file gives only its type. */
  readonly initial: M;
  /** The parameters of such a motion, by field name; `.skel` has a token of the same name for each. */
  readonly parameters: { readonly [F in Exclude<keyof M, 'kind'>]: Parameter };
  /**
   * Whether it is a point of a capture: nothing is attached to it, its translation replaces its offset, and its last
   * DOF tells whether it is there (1) or missing (less).
   */
  readonly isPoint?: true;
  /** Whether its DOFs take limits. Quaternion components don't: they are not independent quantities. */
  readonly takesLimits: boolean;
  /** Indices of the DOFs that are a quaternion's x y z w; empty if there is none. */
  readonly quaternion: readonly number[];
  /** Whether the axis-angle form of `.skel` can hold it: it rotates about its axis and nothing else. */
  readonly isAxisAngle: boolean;
  /** Whether the axis is used, for types where that depends on another parameter; absent: always. */
  usesAxis?(motion: M): boolean;
  /** The DOFs, in the order of poses, limits and channels. */
  dofs(motion: M): readonly Dof[];
  /**
   * The matrix as a product of one-DOF matrices along and about x, y and z, from left to right, each named by its DOF:
   * `rz ry rx` for a balljoint of order xyz. Undefined if it is no such product.
   */
  factors(motion: M): readonly CompoundDof[] | undefined;
  /**
   * The rotations of such a product, from left to right, where the matrix has constant turns before or after them;
   * absent: those of `factors`.
   */
  turns?(motion: M): readonly CompoundDof[];
  /** Whether a root joint of this type moves the whole character by its own DOFs and needs no root translation. */
  carriesCharacter(motion: M): boolean;
  /**
   * The motion mirrored across a plane perpendicular to an axis; the signs of its DOFs follow from their names
   * (`edit/rig/mirrored-motion.ts`).
   * @param across 0, 1 or 2 for x, y or z
   */
  mirrored(motion: M, across: number): M;
  /** The equivalent `.skel` motion, for types that `.skel` lacks. */
  asSkel?(motion: M): Motion;
}
