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

/** The other modes only store the axis. */
function scalesAlongAxis({ mode }: ScaleMotion): boolean {
  return mode === 'axis' || mode === 'volume';
}

const SCALE_FORMULAS: Readonly<Record<ScaleMotion['mode'], string>> = {
  uniform: 's · I',
  xyz: 'S(sx, sy, sz)',
  axis: 'I + (s − 1) · a·aᵀ',
  volume: '1/√s · I + (s − 1/√s) · a·aᵀ',
};

/** The scale joint: one factor s, or sx sy sz in the mode `xyz`; a factor of 1 changes nothing. */
export const SCALE: JointType<ScaleMotion> = {
  keyword: 'scalejoint',
  label: 'Scale',
  summary: 'scales',
  format: 'skel',
  initial: { kind: 'scale', mode: 'uniform', axis: X },
  parameters: { mode: MODE, axis: AXIS },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  usesAxis: scalesAlongAxis,
  dofs: ({ mode }) => (mode === 'xyz' ? SX_SY_SZ : S),
  factors: ({ mode }) => (mode === 'xyz' ? ['sx', 'sy', 'sz'] : undefined),
  formula: ({ mode }) => SCALE_FORMULAS[mode],
  carriesCharacter: () => false,
  mirrored: (motion, across) => ({ ...motion, axis: reflected(motion.axis, across) }),
  text: (motion, number) =>
    `scalejoint, mode ${motion.mode}${scalesAlongAxis(motion) ? `, axis ${motion.axis.map((value) => number(value)).join(' ')}` : ''}`,
};

/** The shear joint: three factors hxy hxz hyz of an upper triangular matrix; 0 changes nothing. */
export const SHEAR: JointType<MotionOf<'shear'>> = {
  keyword: 'shearjoint',
  label: 'Shear',
  summary: 'shears along x y z',
  format: 'skel',
  initial: { kind: 'shear' },
  parameters: {},
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => SHEARS,
  factors: () => undefined,
  formula: () => 'x + hxy·y + hxz·z, y + hyz·z, z',
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
  text: () => 'shearjoint',
};
