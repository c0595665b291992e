/** The kinds of joints as one chooses among them, and what becomes of a joint's rule when another kind is chosen. */
import type { Vec3 } from '../../../math/vec3.ts';
import {
  AXIS_PAIRS,
  type AxisPair,
  COMPOUND_DOFS,
  type CompoundDof,
  dofsOf,
  EULER_ORDERS,
  type EulerOrder,
  type Motion,
} from '../../../model/skeleton.ts';

export type MotionKind = Motion['kind'];

/** In the order of the list, as short as a narrow inspector. BVH's own is no choice: it is what a `.bvh` brings. */
export const MOTION_LABELS: Readonly<Record<MotionKind, string>> = {
  ball: 'Ball',
  hinge: 'Hinge',
  universal: 'Universal',
  quaternion: 'Quaternion',
  free: 'Free',
  translational: 'Translational',
  prismatic: 'Prismatic',
  screw: 'Screw',
  scale: 'Scale',
  shear: 'Shear',
  fixed: 'Fixed',
  compound: 'Compound',
  bvh: 'Channels of BVH',
};

/** What each does, for the tooltip of the list. */
export const MOTION_TIPS: Readonly<Record<MotionKind, string>> = {
  ball: 'three rotations, one after the other',
  hinge: 'a rotation about an axis',
  universal: 'two rotations',
  quaternion: 'any rotation, as four numbers without gimbal lock',
  free: 'moves along x y z, and turns as a ball does',
  translational: 'moves along x y z',
  prismatic: 'moves along an axis',
  screw: 'turns about an axis and moves along it, as far as the pitch says',
  scale: 'grows and shrinks',
  shear: 'leans x y z over each other',
  fixed: 'does not move',
  compound: 'DOFs of your choice, multiplied from left to right',
  bvh: 'what the .bvh lists for it',
};

const X: Vec3 = [1, 0, 0];

/** A joint of another kind, with what of the one before has a meaning for it: axis, order, DOFs. */
export function motionOfKind(kind: Exclude<MotionKind, 'bvh'>, before: Motion): Motion {
  const axis = axisOf(before) ?? X;
  const order = orderOf(before);
  switch (kind) {
    case 'ball':
    case 'free':
      return { kind, order };
    case 'hinge':
    case 'prismatic':
      return { kind, axis };
    case 'screw':
      return { kind, axis, pitch: 1 };
    case 'universal':
      return { kind, order: pairOf(order) };
    case 'scale':
      return { kind, mode: 'uniform', axis };
    case 'compound':
      return { kind, dofs: compoundDofs(before) };
    case 'quaternion':
    case 'translational':
    case 'shear':
    case 'fixed':
      return { kind };
  }
}

export function axisOf(motion: Motion): Vec3 | undefined {
  return 'axis' in motion ? motion.axis : undefined;
}

/** Of three letters; two of a universal joint come first. */
function orderOf(motion: Motion): EulerOrder {
  const written = 'order' in motion ? motion.order : rotationsOf(motion);
  return EULER_ORDERS.find((order) => order.startsWith(written)) ?? 'xyz';
}

/** BVH and compound joints multiply from left to right what an order applies first to last. */
function rotationsOf(motion: Motion): string {
  return dofsOf(motion)
    .flatMap(({ name }) => /^r([xyz])$/.exec(name)?.[1] ?? [])
    .reverse()
    .join('');
}

function pairOf(order: EulerOrder): AxisPair {
  return AXIS_PAIRS.find((pair) => order.startsWith(pair)) ?? 'xy';
}

/** The same motion, spelled out, where it has an order of rotations: a compound one is multiplied from left to right. */
function compoundDofs(before: Motion): readonly CompoundDof[] {
  if ('order' in before) {
    const turns = [...before.order].reverse().map((letter) => `r${letter}`);
    const written = before.kind === 'free' ? ['tx', 'ty', 'tz', ...turns] : turns;
    return written.flatMap((name) => COMPOUND_DOFS.find((dof) => dof === name) ?? []);
  }
  const known = dofsOf(before).flatMap(({ name }) => COMPOUND_DOFS.find((dof) => dof === name) ?? []);
  return known.length ? known : ['rx'];
}

/** `tx ry`, typed: the DOFs of a compound joint, or what is wrong with them. */
export function typedCompound(text: string): readonly CompoundDof[] | string {
  const words = text
    .toLowerCase()
    .split(/[\s,]+/)
    .filter(Boolean);
  const dofs: CompoundDof[] = [];
  for (const word of words) {
    const dof = COMPOUND_DOFS.find((name) => name === word);
    if (!dof) return `“${word.slice(0, 12)}” is none of ${COMPOUND_DOFS.join(' ')}.`;
    if (dofs.includes(dof)) return `${dof} is listed twice; a compound joint has each DOF once at most.`;
    dofs.push(dof);
  }
  return dofs.length ? dofs : 'A compound joint has at least one DOF: what it had stays.';
}
