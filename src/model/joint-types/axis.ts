/**
 * Joints that rotate about or slide along their own axis. Under a reflection M, rotation axes are pseudovectors: a
 * rotation about `a` becomes one about −M·a, whereas sliding along `a` becomes sliding along M·a.
 */
import { negated, reflected } from '../../math/vec3.ts';
import type { Motion } from '../skeleton/skeleton.ts';
import { dofList } from './dof.ts';
import { AXIS, PITCH, X } from './parameters.ts';
import type { JointType } from './type.ts';

type MotionOf<K> = Extract<Motion, { readonly kind: K }>;

const R = dofList('r');
const T = dofList('t');

/** The hinge joint: one DOF, a rotation about its axis in radians. */
export const HINGE: JointType<MotionOf<'hinge'>> = {
  keyword: 'hingejoint',
  label: 'Hinge',
  summary: 'a rotation about an axis',
  format: 'skel',
  initial: { kind: 'hinge', axis: X },
  parameters: { axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: true,
  dofs: () => R,
  factors: () => undefined,
  formula: () => 'cos r · I + sin r · [a]× + (1 − cos r) · a·aᵀ',
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: negated(reflected(motion.axis, across)) }),
  text: ({ axis }, number) => `hingejoint, axis ${axis.map((value) => number(value)).join(' ')}`,
};

/** The prismatic joint: one DOF, a translation along its axis in units of length. */
export const PRISMATIC: JointType<MotionOf<'prismatic'>> = {
  keyword: 'prismaticjoint',
  label: 'Prismatic',
  summary: 'moves along an axis',
  format: 'skel',
  initial: { kind: 'prismatic', axis: X },
  parameters: { axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => T,
  factors: () => undefined,
  formula: () => 'T(t · a)',
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: reflected(motion.axis, across) }),
  text: ({ axis }, number) => `prismaticjoint, axis ${axis.map((value) => number(value)).join(' ')}`,
};

/**
 * The screw joint: one DOF, a rotation about its axis in radians that also moves along it by the pitch per full turn.
 */
export const SCREW: JointType<MotionOf<'screw'>> = {
  keyword: 'screwjoint',
  label: 'Screw',
  summary: 'rotates about an axis and moves along it by the pitch',
  format: 'skel',
  initial: { kind: 'screw', axis: X, pitch: 0 },
  parameters: { axis: AXIS, pitch: PITCH },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => R,
  factors: () => undefined,
  formula: ({ pitch }) => `T(${pitch} · r/2π · a) · R(a, r)`,
  carriesCharacter: () => false,
  // The same rotation about −M·a; the advance along M·a is −pitch along −M·a.
  mirrored: (motion, across) => ({
    ...motion,
    axis: negated(reflected(motion.axis, across)),
    pitch: -motion.pitch + 0,
  }),
  text: ({ axis, pitch }, number) =>
    `screwjoint, axis ${axis.map((value) => number(value)).join(' ')}, ${number(pitch)} per turn`,
};
