/**
 * The types of joints: one record a type, and the questions that the rest of the program asks about a motion. Which type a
 * joint is, is asked only here, in the records and in `evaluate/motions.ts`; CONTRIBUTING.md tells how a type is added.
 */
import type { Vec3 } from '../math/vec3.ts';
import { HINGE, PRISMATIC, SCREW } from './joint-types/axis.ts';
import { BVH, COMPOUND_JOINT, FIXED, TRANSLATIONAL } from './joint-types/listed.ts';
import type { Parameter, ParameterValues } from './joint-types/parameters.ts';
import { BALL, FREE, QUATERNION_JOINT, UNIVERSAL } from './joint-types/rotating.ts';
import { SCALE, SHEAR } from './joint-types/stretching.ts';
import type { JointType } from './joint-types/type.ts';
import type { BvhChannel, BvhMotion, CompoundDof, Dof, Joint, Motion } from './skeleton.ts';

type MotionKind = Motion['kind'];

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
};

// The keys of the table are just those.
export const MOTION_KINDS = Object.keys(JOINT_TYPES) as readonly MotionKind[];

export function jointTypeOf({ kind }: { readonly kind: MotionKind }): JointType {
  return JOINT_TYPES[kind];
}

export function isSameType(a: Motion, b: Motion): boolean {
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

/** Whether a joint as the root carries the whole character by its own DOFs, and needs no root translation. */
export function carriesCharacter(motion: Motion): boolean {
  return jointTypeOf(motion).carriesCharacter(motion);
}

/** Whether a motion's DOFs take limits. Those of a quaternion are no quantities of their own. */
export function takesLimits(motion: Motion): boolean {
  return jointTypeOf(motion).takesLimits;
}

/** Which of a motion's DOFs are the x y z w of a quaternion; empty where it has none. */
export function quaternionDofs(motion: Motion): readonly number[] {
  return jointTypeOf(motion).quaternion;
}

/** Whether a DOF turns its joint: an angle, or a part of a quaternion. */
export function turnsJoint({ name, unit }: Dof): boolean {
  return unit === 'angle' || name.startsWith('q');
}

/** Whether a motion can make another matrix of its space than a rotation and a translation. */
export function stretches(motion: Motion): boolean {
  return dofsOf(motion).some(({ name }) => name.startsWith('s') || name.startsWith('h'));
}

/** Whether joints that move so come from a `.bvh`, and become others before they are written to `.skel`. */
export function isOfBvh(motion: Motion): boolean {
  return jointTypeOf(motion).format === 'bvh';
}

/** The parameters of a motion's type, by name, in the order in which they are written. */
export function parametersOf(motion: { readonly kind: MotionKind }): readonly (readonly [string, Parameter])[] {
  // The record's type lists the fields of one kind; this is any kind.
  return Object.entries<Parameter>(jointTypeOf(motion).parameters);
}

/** The value of a parameter; undefined where the motion has none of that name and type. */
export function parameterOf<T extends Parameter['type']>(
  motion: Motion,
  name: string,
  type: T,
): ParameterValues[T] | undefined {
  const parameter = parametersOf(motion).find(([own]) => own === name)?.[1];
  if (parameter?.type !== type) return undefined;
  // A parameter's name is that of a field, whose values are those of its type.
  return (motion as unknown as Readonly<Record<string, ParameterValues[T]>>)[name];
}

/** The motion with another value of one of its own parameters. */
export function withParameter(motion: Motion, name: string, value: ParameterValues[Parameter['type']]): Motion {
  return { ...motion, [name]: value };
}

/** The axis that is written for a motion, whether it counts or not; undefined where its type has none. */
export function axisParameter(motion: Motion): Vec3 | undefined {
  return parameterOf(motion, 'axis', 'axis');
}

/** The axis that a motion goes by, as written; undefined where it has none, or one that does not count. */
export function axisOf(motion: Motion): Vec3 | undefined {
  const counts = jointTypeOf(motion).usesAxis?.(motion) ?? true;
  return counts ? axisParameter(motion) : undefined;
}

/** How far a whole turn about the axis advances along it: 0 for all but screws. */
export function pitchOf(motion: Motion): number {
  return parameterOf(motion, 'pitch', 'number') ?? 0;
}

/** The channels of a joint of BVH, as its file lists them; undefined for any other joint. */
export function bvhChannelsOf(motion: Motion): readonly BvhChannel[] | undefined {
  // What that parameter lists are channels.
  return parameterOf(motion, 'channels', 'list') as readonly BvhChannel[] | undefined;
}

/** What the position channels of a joint of BVH mean; undefined where a motion has none. */
export function positionsOf(motion: Motion): BvhMotion['positions'] | undefined {
  const meaning = parameterOf(motion, 'positions', 'choice');
  if (meaning === undefined || !dofsOf(motion).some(({ unit }) => unit === 'length')) return undefined;
  return meaning === 'add' ? 'add' : 'replace';
}

/** Whether the DOF of that name takes the place of the offset on its axis, as position channels of BVH do. */
export function replacesOffset(motion: Motion, name: string): boolean {
  return name.startsWith('t') && positionsOf(motion) === 'replace' && dofsOf(motion).some((dof) => dof.name === name);
}

/** What of a joint's offset is left beside DOFs that replace it. */
export function offsetBesideDofs({ offset: [x, y, z], motion }: Pick<Joint, 'offset' | 'motion'>): Vec3 {
  const left = (name: string, value: number) => (replacesOffset(motion, name) ? 0 : value);
  return [left('tx', x), left('ty', y), left('tz', z)];
}

/** A joint of another type, with what of the one before has a meaning for it: axis, order, DOFs. */
export function motionOfKind(kind: MotionKind, before: Motion): Motion {
  const { initial } = JOINT_TYPES[kind];
  const from = { axis: axisParameter(before), factors: factorsOf(before) ?? [] };
  const values = parametersOf(initial).flatMap(([name, { inherit }]) => (inherit ? [[name, inherit(from)]] : []));
  // Each parameter inherits values of its own type.
  return { ...initial, ...Object.fromEntries(values) } as Motion;
}

/** `hingejoint, axis 1 1 0.5`. @param number how numbers are written */
export function motionText(motion: Motion, number: (value: number) => string): string {
  return jointTypeOf(motion).text(motion, number);
}

/** The same for a heading: `hinge, axis 1 1 0.5`; no more of motion capture than its channels. */
export function motionHeading(motion: Motion, number: (value: number) => string): string {
  const type = jointTypeOf(motion);
  return type.heading?.(motion) ?? type.text(motion, number).replace(/^(\w+)joint\b/, '$1');
}
