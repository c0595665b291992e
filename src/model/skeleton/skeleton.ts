/**
 * A skeleton: joints in depth-first pre-order, each with a list of DOFs and a rule that makes a matrix of them.
 *
 *     local L = T(offset) · J(φ)        world W = W_parent · L        (root: T(offset + root translation))
 *
 * Values stay as in the file (including poses beyond limits); `evaluate` clamps and converts.
 */
import type { Vec3 } from '../../math/vec3.ts';

/** Identified by its index, in depth-first pre-order; names may repeat or be empty. */
export interface Joint {
  readonly name: string;
  /** Smaller than the joint's own index; -1 for the root. */
  readonly parent: number;
  /** The pivot's position in the parent's space. */
  readonly offset: Vec3;
  readonly box: Box;
  readonly motion: Motion;
  /** One per DOF of the motion, in order. */
  readonly limits: readonly Limit[];
  /** One value per DOF: the file pose, as written. */
  readonly pose: readonly number[];
  /** Ends of bones that no joint continues (BVH's `End Site`), in the joint's space and the file's order. */
  readonly endSites?: readonly Vec3[];
  readonly restAngles?: RestAngles;
  /** Length of the joint's own bone along +y from the pivot, at least 0. Absent if it has none. */
  readonly length?: number;
  /** In DOF order, at most one per DOF. Absent rather than empty. */
  readonly couples?: readonly Couple[];
  /**
   * The part of the body that it is, where a file says so, as VRM calls it: `leftUpperArm`. Retargeting goes by it
   * before names.
   */
  readonly role?: string;
  /** What an Acclaim skeleton says of its bone, which is kept for writing. */
  readonly bone?: AcclaimBone;
}

/** A bone as a `.asf` has it, beside its joint. */
export interface AcclaimBone {
  readonly id?: string;
  /** Of any length, as written: the bone runs along it, in the joint's space at rest. */
  readonly direction: Vec3;
  /** In units of length. */
  readonly length: number;
  /** Lines that Marrow has no use for, such as `bodymass 3.5`. Absent rather than empty. */
  readonly kept?: readonly string[];
}

/** The head of a `.asf`, kept for writing: texts, and the units of its lengths and angles. */
export interface AcclaimHeader {
  readonly version?: string;
  readonly name?: string;
  readonly documentation?: readonly string[];
  /** `mass 1.0` and others, without `length` and `angle`. */
  readonly units: readonly string[];
  /** A unit is 1/`length` inches. */
  readonly length: number;
  /** Of the angles in the `.asf`, and of those in an `.amc` that names none. */
  readonly angle: 'deg' | 'rad';
}

/**
 * Numbers that SOMA's BVH has after the numbers of an OFFSET: angles of a rest orientation, in degrees. They turn
 * nothing, and are kept for writing.
 */
export interface RestAngles {
  /** Angles of the joint. */
  readonly own?: Vec3;
  /** Angles of each of its End Sites, undefined for one without. Absent if none has any. */
  readonly ends?: readonly (Vec3 | undefined)[];
}

/**
 * A linked DOF: it is gain·φ + offset of another DOF φ, within its limits; its own value is ignored. No DOF follows
 * itself, directly or through others.
 */
export interface Couple {
  /** The name of one of the joint's own DOFs. */
  readonly dof: string;
  /** Index of the joint it follows, which may be its own. */
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
  /** Read from the axis-angle form of `.skel`, and written so again if it still fits; absent: the hierarchy form. */
  readonly form?: 'axis-angle';
  /** Of a skeleton read from a `.asf`. */
  readonly acclaim?: AcclaimHeader;
}

/** The box drawn for a joint, in its own space. Real files may have min > max; it is drawn anyway. */
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
 * How a joint moves. Parameters stay as written (axes of any length except 0); `joint-types.ts` has a record for each
 * kind, `evaluate/motions.ts` its matrix.
 */
export type Motion =
  | { readonly kind: 'ball'; readonly order: EulerOrder }
  | { readonly kind: 'hinge'; readonly axis: Vec3 }
  | { readonly kind: 'universal'; readonly order: AxisPair }
  | { readonly kind: 'quaternion' }
  | { readonly kind: 'prismatic'; readonly axis: Vec3 }
  | { readonly kind: 'translational' }
  | { readonly kind: 'free'; readonly order: EulerOrder }
  /** `pitch` is the advance along the axis per full turn. */
  | { readonly kind: 'screw'; readonly axis: Vec3; readonly pitch: number }
  /** The axis is kept in all modes, even those that ignore it. */
  | { readonly kind: 'scale'; readonly mode: ScaleMode; readonly axis: Vec3 }
  | { readonly kind: 'shear' }
  | { readonly kind: 'fixed' }
  /** One-DOF matrices, multiplied from left to right; each DOF at most once. */
  | { readonly kind: 'compound'; readonly dofs: readonly CompoundDof[] }
  | BvhMotion
  | AcclaimMotion
  /** A point of a capture without bones: where it is, and whether it is there. */
  | { readonly kind: 'point' };

/**
 * A BVH joint: its channels are its DOFs, in order. The translation comes before the rotations, wherever it is listed;
 * rotations are multiplied from left to right. A position channel replaces the offset on its axis or, as some exporters
 * meant it, is added to it.
 */
export interface BvhMotion {
  readonly kind: 'bvh';
  /** Each at most once. */
  readonly channels: readonly BvhChannel[];
  readonly positions: 'replace' | 'add';
}

/**
 * A bone of an Acclaim skeleton, with C the rotation of its axes: C·T(t)·R·C⁻¹, and T(t)·C·R for the root. The
 * translation comes before the rotations, wherever it is listed; of these the first listed is applied first. `l`
 * lengthens the bone, which moves its children and its end, but not the joint itself.
 */
export interface AcclaimMotion {
  readonly kind: 'acclaim';
  /** Each at most once. */
  readonly dofs: readonly AcclaimDof[];
  /** Angles of the axes about x, y and z; radians. */
  readonly axes: Vec3;
  /** In which these angles are applied. */
  readonly order: EulerOrder;
  /** Whether the rotations are those of a bone, within its axes, or of the root, which start from them. */
  readonly frame: 'bone' | 'root';
}

/** DOFs of an Acclaim bone: translations, rotations, and its length. */
export const ACCLAIM_DOFS = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz', 'l'] as const;
/** A DOF of an Acclaim bone; see `ACCLAIM_DOFS`. */
export type AcclaimDof = (typeof ACCLAIM_DOFS)[number];

/** `Xposition` is tx, `Zrotation` rz. */
export type BvhChannel = 'tx' | 'ty' | 'tz' | 'rx' | 'ry' | 'rz';

/** The axes in the order in which rotations are applied: xyz is Rz·Ry·Rx. */
export type EulerOrder = 'xyz' | 'xzy' | 'yxz' | 'yzx' | 'zxy' | 'zyx';

/** All orders of three rotations; see `EulerOrder`. */
export const EULER_ORDERS: readonly EulerOrder[] = ['xyz', 'xzy', 'yxz', 'yzx', 'zxy', 'zyx'];

/** Two axes, the first applied first: xy is Ry·Rx. */
export const AXIS_PAIRS = ['xy', 'xz', 'yx', 'yz', 'zx', 'zy'] as const;
/** The axes of a universal joint, the first applied first; see `AXIS_PAIRS`. */
export type AxisPair = (typeof AXIS_PAIRS)[number];

/** Uniform; per axis; along one axis; along one axis, preserving volume. */
export const SCALE_MODES = ['uniform', 'xyz', 'axis', 'volume'] as const;
/** How a scale joint scales; see `SCALE_MODES`. */
export type ScaleMode = (typeof SCALE_MODES)[number];

/** The DOFs that a compound joint can have: translations, rotations and scales along and about x, y and z. */
export const COMPOUND_DOFS = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz', 'sx', 'sy', 'sz'] as const;
/** A DOF that a compound joint can have; see `COMPOUND_DOFS`. */
export type CompoundDof = (typeof COMPOUND_DOFS)[number];

/**
 * Kinds of quantities that a DOF measures: decides its unit on screen and its range without limits. Scales, shears and
 * quaternion components are factors.
 */
export const DOF_UNITS = ['angle', 'length', 'factor', 'weight'] as const;
/** Kind of quantity that a DOF measures; see `DOF_UNITS`. Values are in radians, units of length, or without unit. */
export type DofUnit = (typeof DOF_UNITS)[number];

/** A degree of freedom of a joint, or of the character: its name, unit and neutral value. */
export interface Dof {
  /** As formats spell it: rx, ry, rz, tx … */
  readonly name: string;
  readonly unit: DofUnit;
  /** The neutral value: 0, but 1 for scales and a quaternion's real part. */
  readonly rest: number;
}

/** The box of a joint whose `.skel` gives none, in the course's units. */
export const DEFAULT_BOX: Box = { min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1] };
/** That of a joint without a box: it is drawn as a bone. */
export const NO_BOX: Box = { min: [0, 0, 0], max: [0, 0, 0] };
/** The motion of a joint whose `.skel` gives no type: a ball joint of order xyz. */
export const DEFAULT_MOTION: Motion = { kind: 'ball', order: 'xyz' };
/** How the course's files write "no limit"; shown as unlimited. */
export const UNLIMITED: Limit = { min: -100000, max: 100000 };

/** Whether a limit is at least as wide as `UNLIMITED`, so that it restricts nothing. */
export function isUnlimited(limit: Limit): boolean {
  return limit.min <= UNLIMITED.min && limit.max >= UNLIMITED.max;
}
