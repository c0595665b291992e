/** Joints that rotate about x, y and z, or freely. */
import type { AxisPair, EulerOrder, Motion } from '../skeleton/skeleton.ts';
import { dofList } from './dof.ts';
import { EULER_ORDER, PAIR_ORDER } from './parameters.ts';
import type { JointType } from './type.ts';

type MotionOf<K> = Extract<Motion, { readonly kind: K }>;
type Rotation = 'rx' | 'ry' | 'rz';

const RX_RY_RZ = dofList('rx', 'ry', 'rz');
const TX_TY_TZ_RX_RY_RZ = dofList('tx', 'ty', 'tz', 'rx', 'ry', 'rz');
const QUATERNION = dofList('qx', 'qy', 'qz', 'qw');

/** Orders name the first applied first, which is multiplied last. */
function rotations(order: EulerOrder | AxisPair): readonly Rotation[] {
  // Letters of an order are axes.
  return [...order].reverse().map((axis) => `r${axis}` as Rotation);
}

/** The ball joint: three Euler angles rx ry rz in radians, whatever the order in which they are applied. */
export const BALL: JointType<MotionOf<'ball'>> = {
  keyword: 'balljoint',
  format: 'skel',
  initial: { kind: 'ball', order: 'xyz' },
  parameters: { order: EULER_ORDER },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => RX_RY_RZ,
  factors: ({ order }) => rotations(order),
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** The universal joint: two rotations in radians, about the two axes of its order. */
export const UNIVERSAL: JointType<MotionOf<'universal'>> = {
  keyword: 'universaljoint',
  format: 'skel',
  initial: { kind: 'universal', order: 'xy' },
  parameters: { order: PAIR_ORDER },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: ({ order }) => RX_RY_RZ.filter(({ name }) => order.includes(name[1])),
  factors: ({ order }) => rotations(order),
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** The quaternion joint: four DOFs x y z w without unit, normalised before use, so that no limits apply. */
export const QUATERNION_JOINT: JointType<MotionOf<'quaternion'>> = {
  keyword: 'quaternionjoint',
  format: 'skel',
  initial: { kind: 'quaternion' },
  parameters: {},
  takesLimits: false,
  quaternion: [0, 1, 2, 3],
  isAxisAngle: false,
  dofs: () => QUATERNION,
  factors: () => undefined,
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/**
 * The free joint: tx ty tz in units of length, then rx ry rz in radians. The translation comes before the rotations.
 */
export const FREE: JointType<MotionOf<'free'>> = {
  keyword: 'freejoint',
  format: 'skel',
  initial: { kind: 'free', order: 'xyz' },
  parameters: { order: EULER_ORDER },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => TX_TY_TZ_RX_RY_RZ,
  factors: ({ order }) => ['tx', 'ty', 'tz', ...rotations(order)],
  carriesCharacter: () => true,
  mirrored: (motion) => motion,
};
