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

/** `Rz·Ry·Rx (xyz)`: the letters alone are read as Rx·Ry·Rz. */
function orderText(order: EulerOrder | AxisPair): string {
  const factors = [...order].reverse().map((axis) => `R${axis}`);
  return `${factors.join('·')} (${order})`;
}

/** The ball joint: three Euler angles rx ry rz in radians, whatever the order in which they are applied. */
export const BALL: JointType<MotionOf<'ball'>> = {
  keyword: 'balljoint',
  label: 'Ball',
  summary: 'three rotations in order',
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
  text: ({ order }) => `balljoint, ${orderText(order)}`,
};

/** The universal joint: two rotations in radians, about the two axes of its order. */
export const UNIVERSAL: JointType<MotionOf<'universal'>> = {
  keyword: 'universaljoint',
  label: 'Universal',
  summary: 'two rotations',
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
  text: ({ order }) => `universaljoint, ${orderText(order)}`,
};

/** The quaternion joint: four DOFs x y z w without unit, normalised before use, so that no limits apply. */
export const QUATERNION_JOINT: JointType<MotionOf<'quaternion'>> = {
  keyword: 'quaternionjoint',
  label: 'Quaternion',
  summary: 'any rotation, without gimbal lock',
  format: 'skel',
  initial: { kind: 'quaternion' },
  parameters: {},
  takesLimits: false,
  quaternion: [0, 1, 2, 3],
  isAxisAngle: false,
  dofs: () => QUATERNION,
  factors: () => undefined,
  formula: () => 'R(q / |q|)',
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
  text: () => 'quaternionjoint',
};

/**
 * The free joint: tx ty tz in units of length, then rx ry rz in radians. The translation comes before the rotations.
 */
export const FREE: JointType<MotionOf<'free'>> = {
  keyword: 'freejoint',
  label: 'Free',
  summary: 'moves along x y z and rotates like a ball joint',
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
  text: ({ order }) => `freejoint, ${orderText(order)}`,
};
