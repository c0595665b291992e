/** Joint types in words, apart from their records: programs that only evaluate need none of these. */
import type { AxisPair, EulerOrder, Motion, ScaleMode } from '../skeleton/skeleton.ts';
import { scalesAlongAxis } from './stretching.ts';

/** Words about one joint type. */
export interface JointTexts<M extends Motion = Motion> {
  /** Its name in the list of types; short, for narrow inspectors. */
  readonly label: string;
  /** Motion of such a joint, in a few words. */
  readonly summary: string;
  /**
   * J as a formula of its DOFs and of the normalised axis a, for motions without factors: `T(t·a)`.
   */
  formula?(motion: M): string;
  /** The type and its parameters: `hingejoint, axis 1 1 0.5`; `number` formats numbers. */
  text(motion: M, number: (value: number) => string): string;
  /** For a heading, if other than `text` without its "joint". */
  heading?(motion: M): string;
}

/** `Rz·Ry·Rx (xyz)`: the letters alone are read as Rx·Ry·Rz. */
function orderText(order: EulerOrder | AxisPair): string {
  const factors = [...order].reverse().map((axis) => `R${axis}`);
  return `${factors.join('·')} (${order})`;
}

function axisText({ axis }: { readonly axis: readonly number[] }, number: (value: number) => string): string {
  return `axis ${axis.map((value) => number(value)).join(' ')}`;
}

const SCALE_FORMULAS: Readonly<Record<ScaleMode, string>> = {
  uniform: 's · I',
  xyz: 'S(sx, sy, sz)',
  axis: 'I + (s − 1) · a·aᵀ',
  volume: '1/√s · I + (s − 1/√s) · a·aᵀ',
};

/** The words about each joint type. */
export const JOINT_TEXTS: { readonly [K in Motion['kind']]: JointTexts<Extract<Motion, { readonly kind: K }>> } = {
  ball: {
    label: 'Ball',
    summary: 'three rotations in order',
    text: ({ order }) => `balljoint, ${orderText(order)}`,
  },
  hinge: {
    label: 'Hinge',
    summary: 'a rotation about an axis',
    formula: () => 'cos r · I + sin r · [a]× + (1 − cos r) · a·aᵀ',
    text: (motion, number) => `hingejoint, ${axisText(motion, number)}`,
  },
  universal: {
    label: 'Universal',
    summary: 'two rotations',
    text: ({ order }) => `universaljoint, ${orderText(order)}`,
  },
  quaternion: {
    label: 'Quaternion',
    summary: 'any rotation, without gimbal lock',
    formula: () => 'R(q / |q|)',
    text: () => 'quaternionjoint',
  },
  free: {
    label: 'Free',
    summary: 'moves along x y z and rotates like a ball joint',
    text: ({ order }) => `freejoint, ${orderText(order)}`,
  },
  translational: { label: 'Translational', summary: 'moves along x y z', text: () => 'translationaljoint' },
  prismatic: {
    label: 'Prismatic',
    summary: 'moves along an axis',
    formula: () => 'T(t · a)',
    text: (motion, number) => `prismaticjoint, ${axisText(motion, number)}`,
  },
  screw: {
    label: 'Screw',
    summary: 'rotates about an axis and moves along it by the pitch',
    formula: ({ pitch }) => `T(${pitch} · r/2π · a) · R(a, r)`,
    text: (motion, number) => `screwjoint, ${axisText(motion, number)}, ${number(motion.pitch)} per turn`,
  },
  scale: {
    label: 'Scale',
    summary: 'scales',
    formula: ({ mode }) => SCALE_FORMULAS[mode],
    text: (motion, number) =>
      `scalejoint, mode ${motion.mode}${scalesAlongAxis(motion) ? `, ${axisText(motion, number)}` : ''}`,
  },
  shear: {
    label: 'Shear',
    summary: 'shears along x y z',
    formula: () => 'x + hxy·y + hxz·z, y + hyz·z, z',
    text: () => 'shearjoint',
  },
  fixed: { label: 'Fixed', summary: 'does not move', text: () => 'fixedjoint' },
  compound: {
    label: 'Compound',
    summary: 'DOFs you choose, multiplied left to right',
    text: ({ dofs }) => (dofs.length ? `compoundjoint, ${dofs.join(' ')}` : 'compoundjoint without DOFs'),
  },
  bvh: {
    label: 'BVH channels',
    summary: 'the channels listed in the .bvh',
    text({ channels, positions }) {
      if (channels.length === 0) return 'BVH joint without channels';
      const moves = channels.some((channel) => channel.startsWith('t'));
      const meaning = positions === 'add' ? ', added to its offset' : ', replacing its offset';
      return `BVH joint, channels ${channels.join(' ')}${moves ? meaning : ''}`;
    },
    heading: ({ channels }) => channels.join(' ') || 'no channels',
  },
  acclaim: {
    label: 'Acclaim bone',
    summary: 'the DOFs listed in the .asf',
    formula: ({ frame }) => (frame === 'bone' ? 'C·T(t)·R·C⁻¹' : 'T(t)·C·R'),
    text: ({ dofs }) => (dofs.length ? `Acclaim bone, ${dofs.join(' ')}` : 'Acclaim bone without DOFs'),
    heading: ({ dofs }) => dofs.join(' ') || 'no DOFs',
  },
  point: { label: 'Point', summary: 'where a capture has it', formula: () => 'T(t)', text: () => 'point' },
};

/** Typed for any motion. */
function textsOf({ kind }: Motion): JointTexts {
  return JOINT_TEXTS[kind];
}

/** The motion's matrix as a formula, for motions without factors: see `JointTexts.formula`. */
export function formulaOf(motion: Motion): string | undefined {
  return textsOf(motion).formula?.(motion);
}

/** `hingejoint, axis 1 1 0.5`. @param number formats numbers */
export function motionText(motion: Motion, number: (value: number) => string): string {
  return textsOf(motion).text(motion, number);
}

/** A motion as a heading: `hinge, axis 1 1 0.5`; of motion capture only the channels. */
export function motionHeading(motion: Motion, number: (value: number) => string): string {
  const { heading } = textsOf(motion);
  return (
    heading?.(motion) ??
    motionText(motion, number)
      .replace(/^(\w+)joint\b/, '$1')
      .replace(/ \([xyz]+\)$/, '')
  );
}
