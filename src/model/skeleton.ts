/**
 * A skeleton: joints in depth-first pre-order, each a list of DOFs and a rule that makes a matrix of them.
 *
 *     local L = T(offset) · J(φ)        world W = W_parent · L        (root: T(offset + root translation))
 *
 * Values stay as the file has them (poses out of limits too); `evaluate` clamps and converts.
 */
import type { Vec3 } from '../math/vec3.ts';

/** Identified by its index, in depth-first pre-order; names repeat and may be empty. */
export interface Joint {
  readonly name: string;
  /** Smaller than the joint's own index; -1 for the root. */
  readonly parent: number;
  /** The pivot's position in the parent's space. */
  readonly offset: Vec3;
  readonly box: Box;
  readonly motion: Motion;
  /** One for each of the motion's DOFs, in their order. */
  readonly limits: readonly Limit[];
  /** One value for each DOF: the file's pose, as written. */
  readonly pose: readonly number[];
  /** Points that end a bone where no joint is (BVH's `End Site`), in the joint's space and the file's order. */
  readonly endSites?: readonly Vec3[];
}

/** One tree: joint 0 is its root, and the only one with parent -1. */
export interface Skeleton {
  readonly name: string;
  readonly joints: readonly Joint[];
}

/** The box drawn for a joint, in its own space. min > max occurs in real files and is drawn all the same. */
export interface Box {
  readonly min: Vec3;
  readonly max: Vec3;
}

/** min > max: ignored when clamping (the reader warns). */
export interface Limit {
  readonly min: number;
  readonly max: number;
}

/** How a joint moves. `evaluate/motions.ts` holds each kind's rule. */
export type Motion = { readonly kind: 'ball'; readonly order: EulerOrder } | BvhMotion;

/**
 * A joint of BVH: the channels it has are its DOFs, in their order. The translation comes before the rotations, wherever
 * it stands among them; the rotations are multiplied from left to right. A position channel replaces the offset on its
 * axis, or, as some exporters meant it, is added to it.
 */
export interface BvhMotion {
  readonly kind: 'bvh';
  /** Each at most once. */
  readonly channels: readonly BvhChannel[];
  readonly positions: 'replace' | 'add';
}

/** `Xposition` is tx, `Zrotation` rz. */
export type BvhChannel = 'tx' | 'ty' | 'tz' | 'rx' | 'ry' | 'rz';

/** The axes in the order in which the rotations are applied: xyz is Rz·Ry·Rx. */
export type EulerOrder = 'xyz' | 'xzy' | 'yxz' | 'yzx' | 'zxy' | 'zyx';

export const EULER_ORDERS: readonly EulerOrder[] = ['xyz', 'xzy', 'yxz', 'yzx', 'zxy', 'zyx'];

/** What a DOF measures, which decides its unit on screen and its range when it has no limits. */
export type DofUnit = 'angle' | 'length' | 'weight';

export interface Dof {
  /** As the format spells it: rx, ry, rz, tx … */
  readonly name: string;
  readonly unit: DofUnit;
}

export const DEFAULT_BOX: Box = { min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1] };
export const DEFAULT_MOTION: Motion = { kind: 'ball', order: 'xyz' };
/** What the course's files mean by "no limit"; shown as unlimited. */
export const UNLIMITED: Limit = { min: -100000, max: 100000 };

const BALL: readonly Dof[] = [
  { name: 'rx', unit: 'angle' },
  { name: 'ry', unit: 'angle' },
  { name: 'rz', unit: 'angle' },
];

/** The DOFs of a motion, in the order in which poses, limits and channels list them. */
export function dofsOf(motion: Motion): readonly Dof[] {
  switch (motion.kind) {
    case 'ball':
      return BALL;
    case 'bvh':
      return motion.channels.map((name) => (name.startsWith('t') ? { name, unit: 'length' } : { name, unit: 'angle' }));
  }
}

/** Whether a joint as the root carries the whole character by its own DOFs, and needs no root translation. */
export function movesByItself(motion: Motion): boolean {
  return motion.kind === 'bvh' && TRANSLATIONS.every((name) => motion.channels.includes(name));
}

const TRANSLATIONS = ['tx', 'ty', 'tz'] as const;

export function isUnlimited(limit: Limit): boolean {
  return limit.min <= UNLIMITED.min && limit.max >= UNLIMITED.max;
}
