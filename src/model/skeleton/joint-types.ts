/**
 * Joint types: one record per type, and the questions the rest of the program asks about a motion. Only this file, the
 * records and `evaluate/motions.ts` may test a joint's type; CONTRIBUTING.md tells how to add one.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { ACCLAIM } from '../joint-types/acclaim.ts';
import { HINGE, PRISMATIC, SCREW } from '../joint-types/axis.ts';
import { BVH, COMPOUND_JOINT, FIXED, POINT, TRANSLATIONAL } from '../joint-types/listed.ts';
import type { Parameter, ParameterValues } from '../joint-types/parameters.ts';
import { BALL, FREE, QUATERNION_JOINT, UNIVERSAL } from '../joint-types/rotating.ts';
import { SCALE, SHEAR } from '../joint-types/stretching.ts';
import type { JointType } from '../joint-types/type.ts';
import type { AcclaimMotion, BvhChannel, BvhMotion, CompoundDof, Dof, Joint, Motion, Skeleton } from './skeleton.ts';

/** The kind of a motion, which names its joint type: a key of `JOINT_TYPES`. */
export type MotionKind = Motion['kind'];

/** In the order of the inspector's list. */
export const JOINT_TYPES: { readonly [K in MotionKind]: JointType<Extract<Motion, { readonly kind: K }>> } = {
  ball: BALL,
  hinge: HINGE,
  universal: UNIVERSAL,
  quaternion: QUATERNION_JOINT,
  free: FREE,
  translational: TRANSLATIONAL,
  prismatic: PRISMATIC,
  screw: SCREW,
  scale: SCALE,
  shear: SHEAR,
  fixed: FIXED,
  compound: COMPOUND_JOINT,
  bvh: BVH,
  acclaim: ACCLAIM,
  point: POINT,
};

// The table's keys are exactly these.
/** All kinds of motions, in the order of the inspector's list. */
export const MOTION_KINDS = Object.keys(JOINT_TYPES) as readonly MotionKind[];

/** The record of a motion's joint type, typed for any motion. */
export function jointTypeOf({ kind }: { readonly kind: MotionKind }): JointType {
  return JOINT_TYPES[kind];
}

/** Whether two motions are of the same joint type, whatever their parameters. */
export function isSameType(a: { readonly kind: MotionKind }, b: { readonly kind: MotionKind }): boolean {
  return a.kind === b.kind;
}

/** The DOFs of a motion, in the order in which poses, limits and channels list them. */
export function dofsOf(motion: Motion): readonly Dof[] {
  return jointTypeOf(motion).dofs(motion);
}

/** The motion's matrix as a product of one-DOF matrices: see `JointType.factors`. */
export function factorsOf(motion: Motion): readonly CompoundDof[] | undefined {
  return jointTypeOf(motion).factors(motion);
}

/** The rotations of a motion's matrix between constant turns; undefined if it has none of these: see `JointType.turns`. */
export function turnsOf(motion: Motion): readonly CompoundDof[] | undefined {
  return jointTypeOf(motion).turns?.(motion);
}

/** Whether a root joint with this motion moves the whole character by its own DOFs and needs no root translation. */
export function carriesCharacter(motion: Motion): boolean {
  return jointTypeOf(motion).carriesCharacter(motion);
}

/** Whether a motion's DOFs take limits. Quaternion components don't: they are not independent quantities. */
export function takesLimits(motion: Motion): boolean {
  return jointTypeOf(motion).takesLimits;
}

/** Indices of the DOFs that are a quaternion's x y z w; empty if there is none. */
export function quaternionDofs(motion: Motion): readonly number[] {
  return jointTypeOf(motion).quaternion;
}

/** Whether a DOF rotates its joint: an angle or a quaternion component. */
export function turnsJoint({ name, unit }: Dof): boolean {
  return unit === 'angle' || name.startsWith('q');
}

/** Whether a motion's matrix can be more than a rotation and a translation. */
export function stretches(motion: Motion): boolean {
  return dofsOf(motion).some(({ name }) => name.startsWith('s') || name.startsWith('h'));
}

/** Whether a motion can move its joint's origin in the parent's space. */
export function displaces(motion: Motion): boolean {
  return pitchOf(motion) !== 0 || dofsOf(motion).some(({ unit }) => unit === 'length');
}

/** Whether joints with this motion come from a `.bvh`, and are converted before they are written to `.skel`. */
export function isOfBvh(motion: Motion): boolean {
  return jointTypeOf(motion).format === 'bvh';
}

/** Whether joints with this motion come from a `.asf`: their lengths are those of bones. */
export function isOfAcclaim(motion: { readonly kind: MotionKind }): boolean {
  return jointTypeOf(motion).format === 'asf';
}

/** The motion, if it is that of an Acclaim bone. */
export function acclaimMotionOf(motion: Motion): AcclaimMotion | undefined {
  return motion.kind === 'acclaim' ? motion : undefined;
}

/** Whether a joint is a point of a capture, which has no bone. */
export function isPoint(motion: { readonly kind: MotionKind }): boolean {
  return jointTypeOf(motion).isPoint ?? false;
}

/** Whether a skeleton is points alone: a capture without bones. */
export function arePoints(skeleton: Skeleton | undefined): boolean {
  const { joints = [] } = skeleton ?? {};
  return joints.length > 0 && joints.every(({ motion }) => isPoint(motion));
}

/** Whether such joints are made by hand; those of captures come with their files. */
export function isOffered(kind: MotionKind): boolean {
  return JOINT_TYPES[kind].format === 'skel';
}

/** The DOF that lengthens a joint's own bone: its index among the joint's; -1 if there is none. */
export function lengthDofOf(motion: Motion): number {
  return isOfAcclaim(motion) ? dofsOf(motion).findIndex(({ name }) => name === 'l') : -1;
}

/** The parameters of a motion's type, by name, in the order in which they are written. */
export function parametersOf(motion: { readonly kind: MotionKind }): readonly (readonly [string, Parameter])[] {
  // The record lists the fields of one kind; here it is any kind.
  return Object.entries<Parameter>(jointTypeOf(motion).parameters);
}

/** The value of a parameter; undefined if the motion has none of that name and type. */
export function parameterOf<T extends Parameter['type']>(
  motion: Motion,
  name: string,
  type: T,
): ParameterValues[T] | undefined {
  const parameter = parametersOf(motion).find(([own]) => own === name)?.[1];
  if (parameter?.type !== type) return undefined;
  // A parameter is named after a field, whose values have the parameter's type.
  return (motion as unknown as Readonly<Record<string, ParameterValues[T]>>)[name];
}

/** A copy of the motion with another value for one of its parameters. */
export function withParameter(motion: Motion, name: string, value: ParameterValues[Parameter['type']]): Motion {
  return { ...motion, [name]: value };
}

/** The axis written for a motion, even if its mode ignores it; undefined if its type has none. */
export function axisParameter(motion: Motion): Vec3 | undefined {
  return parameterOf(motion, 'axis', 'axis');
}

/** The axis that a motion uses, as written; undefined if it has none or ignores it. */
export function axisOf(motion: Motion): Vec3 | undefined {
  const counts = jointTypeOf(motion).usesAxis?.(motion) ?? true;
  return counts ? axisParameter(motion) : undefined;
}

/** Advance along the axis per full turn; 0 for all types but screws. */
export function pitchOf(motion: Motion): number {
  return parameterOf(motion, 'pitch', 'number') ?? 0;
}

/** The channels of a BVH joint, as its file lists them; undefined for any other joint. */
export function bvhChannelsOf(motion: Motion): readonly BvhChannel[] | undefined {
  // That parameter lists channels.
  return parameterOf(motion, 'channels', 'list') as readonly BvhChannel[] | undefined;
}

/** The meaning of a BVH joint's position channels; undefined if it has none. */
export function positionsOf(motion: Motion): BvhMotion['positions'] | undefined {
  const meaning = parameterOf(motion, 'positions', 'choice');
  if (meaning === undefined || !dofsOf(motion).some(({ unit }) => unit === 'length')) return undefined;
  return meaning === 'add' ? 'add' : 'replace';
}

/** Whether this DOF replaces the offset on its axis, as BVH position channels and those of points do. */
export function replacesOffset(motion: Motion, name: string): boolean {
  return name.startsWith('t') && replaces(motion) && dofsOf(motion).some((dof) => dof.name === name);
}

function replaces(motion: Motion): boolean {
  return isPoint(motion) || positionsOf(motion) === 'replace';
}

/** The part of a joint's offset that its DOFs do not replace. */
export function offsetBesideDofs({ offset, motion }: Pick<Joint, 'offset' | 'motion'>): Vec3 {
  if (!replaces(motion)) return offset;
  const [x, y, z] = offset;
  const left = (name: string, value: number) => (replacesOffset(motion, name) ? 0 : value);
  return [left('tx', x), left('ty', y), left('tz', z)];
}

/** A motion of another type that inherits what still applies: axis, order, DOFs. */
export function motionOfKind(kind: MotionKind, before: Motion): Motion {
  const { initial } = JOINT_TYPES[kind];
  const from = { axis: axisParameter(before), factors: factorsOf(before) ?? [] };
  const values = parametersOf(initial).flatMap(([name, { inherit }]) => (inherit ? [[name, inherit(from)]] : []));
  // Each parameter inherits values of its own type.
  return { ...initial, ...Object.fromEntries(values) } as Motion;
}
