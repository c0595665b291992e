/** Joints that scale or shear. */
import { reflected } from '../../math/vec3.ts';
import type { Motion } from '../skeleton/skeleton.ts';
import { dofList } from './dof.ts';
import { AXIS, MODE, X } from './parameters.ts';
import type { JointType } from './type.ts';

type MotionOf<K> = Extract<Motion, { readonly kind: K }>;
type ScaleMotion = MotionOf<'scale'>;

const S = dofList('s');
const SX_SY_SZ = dofList('sx', 'sy', 'sz');
const SHEARS = dofList('hxy', 'hxz', 'hyz');

/** Whether a scale joint uses its axis: the other modes only store it. */
export function scalesAlongAxis({ mode }: ScaleMotion): boolean {
  return mode === 'axis' || mode === 'volume';
}

/** The scale joint: one factor s, or sx sy sz in the mode `xyz`; a factor of 1 changes nothing. */
export const SCALE: JointType<ScaleMotion> = {
  keyword: 'scalejoint',
  format: 'skel',
  initial: { kind: 'scale', mode: 'uniform', axis: X },
  parameters: { mode: MODE, axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  usesAxis: scalesAlongAxis,
  dofs: ({ mode }) => (mode === 'xyz' ? SX_SY_SZ : S),
  factors: ({ mode }) => (mode === 'xyz' ? ['sx', 'sy', 'sz'] : undefined),
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: reflected(motion.axis, across) }),
};

/** The shear joint: three factors hxy hxz hyz of an upper triangular matrix; 0 changes nothing. */
export const SHEAR: JointType<MotionOf<'shear'>> = {
  keyword: 'shearjoint',
  format: 'skel',
  initial: { kind: 'shear' },
  parameters: {},
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => SHEARS,
  factors: () => undefined,
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};
