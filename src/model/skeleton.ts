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
  /** Of the bone from the pivot along +y, at least 0. Absent where a joint has none of its own. */
  readonly length?: number;
  /** In the order of its DOFs, at most one for each. Absent rather than empty. */
  readonly couples?: readonly Couple[];
}

/**
 * A DOF that follows another, φ: it is gain·φ + offset, within its limits, and its own value counts for nothing. No DOF
 * follows itself, directly or by way of others.
 */
export interface Couple {
  /** The name of one of the joint's own DOFs. */
  readonly dof: string;
  /** Index of the joint that it follows, which may be its own. */
  readonly joint: number;
  /** The name of that joint's DOF. */
  readonly follows: string;
  readonly gain: number;
  readonly offset: number;
}

/** One tree: joint 0 is its root, and the only one with parent -1. */
export interface Skeleton {
  readonly name: string;
  readonly joints: readonly Joint[];
  /** Read from the axis-angle form of `.skel`, and written so again where it still can be; absent: the hierarchy form. */
  readonly form?: 'axis-angle';
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

/**
 * How a joint moves. What is said of it stays as written (axes of any length, but not of none); `joint-types.ts` has a
 * record of each kind, `evaluate/motions.ts` its matrix.
 */
export type Motion =
  | { readonly kind: 'ball'; readonly order: EulerOrder }
  | { readonly kind: 'hinge'; readonly axis: Vec3 }
  | { readonly kind: 'universal'; readonly order: AxisPair }
  | { readonly kind: 'quaternion' }
  | { readonly kind: 'prismatic'; readonly axis: Vec3 }
  | { readonly kind: 'translational' }
  | { readonly kind: 'free'; readonly order: EulerOrder }
  /** `pitch` is how far a whole turn advances along the axis. */
  | { readonly kind: 'screw'; readonly axis: Vec3; readonly pitch: number }
  /** The axis is kept whatever the mode, which may not ask for one. */
  | { readonly kind: 'scale'; readonly mode: ScaleMode; readonly axis: Vec3 }
  | { readonly kind: 'shear' }
  | { readonly kind: 'fixed' }
  /** One-DOF matrices, multiplied from left to right; each DOF at most once. */
  | { readonly kind: 'compound'; readonly dofs: readonly CompoundDof[] }
  | BvhMotion;

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

/** Two axes, that which is turned about first standing first: xy is Ry·Rx. */
export const AXIS_PAIRS = ['xy', 'xz', 'yx', 'yz', 'zx', 'zy'] as const;
export type AxisPair = (typeof AXIS_PAIRS)[number];

/** All axes alike; each by itself; along an axis only; along an axis, and across it so that the volume stays. */
export const SCALE_MODES = ['uniform', 'xyz', 'axis', 'volume'] as const;
export type ScaleMode = (typeof SCALE_MODES)[number];

export const COMPOUND_DOFS = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz', 'sx', 'sy', 'sz'] as const;
export type CompoundDof = (typeof COMPOUND_DOFS)[number];

/**
 * What a DOF measures, which decides its unit on screen and its range when it has no limits. Scales, shears and the
 * parts of a quaternion are factors.
 */
export const DOF_UNITS = ['angle', 'length', 'factor', 'weight'] as const;
export type DofUnit = (typeof DOF_UNITS)[number];

export interface Dof {
  /** As the format spells it: rx, ry, rz, tx … */
  readonly name: string;
  readonly unit: DofUnit;
  /** Where it changes nothing: 0, but 1 for scales and the real part of a quaternion. */
  readonly rest: number;
}

export const DEFAULT_BOX: Box = { min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1] };
export const DEFAULT_MOTION: Motion = { kind: 'ball', order: 'xyz' };
/** What the course's files mean by "no limit"; shown as unlimited. */
export const UNLIMITED: Limit = { min: -100000, max: 100000 };

export function isUnlimited(limit: Limit): boolean {
  return limit.min <= UNLIMITED.min && limit.max >= UNLIMITED.max;
}
