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
  format: 'skel',
  initial: { kind: 'hinge', axis: X },
  parameters: { axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: true,
  dofs: () => R,
  factors: () => undefined,
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: negated(reflected(motion.axis, across)) }),
};

/** The prismatic joint: one DOF, a translation along its axis in units of length. */
export const PRISMATIC: JointType<MotionOf<'prismatic'>> = {
  keyword: 'prismaticjoint',
  format: 'skel',
  initial: { kind: 'prismatic', axis: X },
  parameters: { axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => T,
  factors: () => undefined,
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: reflected(motion.axis, across) }),
};

/**
 * The screw joint: one DOF, a rotation about its axis in radians that also moves along it by the pitch per full turn.
 */
export const SCREW: JointType<MotionOf<'screw'>> = {
  keyword: 'screwjoint',
  format: 'skel',
  initial: { kind: 'screw', axis: X, pitch: 0 },
  parameters: { axis: AXIS, pitch: PITCH },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => R,
  factors: () => undefined,
  carriesCharacter: () => false,
  // The same rotation about −M·a; the advance along M·a is −pitch along −M·a.
  mirrored: (motion, across) => ({
    ...motion,
    axis: negated(reflected(motion.axis, across)),
    pitch: -motion.pitch + 0,
  }),
};
