/** Joints whose DOFs are a list: none, x y z, or those named in their file. */
import type { BvhMotion, CompoundDof, EulerOrder, Motion } from '../skeleton/skeleton.ts';
import { dof, dofList } from './dof.ts';
import { COMPOUND } from './parameters.ts';
import type { JointType } from './type.ts';

type MotionOf<K> = Extract<Motion, { readonly kind: K }>;

const TRANSLATIONS = ['tx', 'ty', 'tz'] as const;
const TX_TY_TZ = dofList(...TRANSLATIONS);
const NONE = dofList();
const POINT_DOFS = dofList(...TRANSLATIONS, 'valid');

/** The translational joint: three DOFs, tx ty tz, in units of length. */
export const TRANSLATIONAL: JointType<MotionOf<'translational'>> = {
  keyword: 'translationaljoint',
  format: 'skel',
  initial: { kind: 'translational' },
  parameters: {},
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => TX_TY_TZ,
  factors: () => TRANSLATIONS,
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** The fixed joint, which has no DOFs: its local matrix is its offset alone. */
export const FIXED: JointType<MotionOf<'fixed'>> = {
  keyword: 'fixedjoint',
  format: 'skel',
  initial: { kind: 'fixed' },
  parameters: {},
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => NONE,
  factors: () => [],
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** The compound joint: DOFs chosen from `COMPOUND_DOFS`, whose one-DOF matrices are multiplied from left to right. */
export const COMPOUND_JOINT: JointType<MotionOf<'compound'>> = {
  keyword: 'compoundjoint',
  format: 'skel',
  initial: { kind: 'compound', dofs: [] },
  parameters: { dofs: COMPOUND },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: ({ dofs }) => dofs.map(dof),
  factors: ({ dofs }) => dofs,
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** The point of a capture without bones: three DOFs in units of length, and whether it is there. */
export const POINT: JointType<MotionOf<'point'>> = {
  keyword: 'point',
  format: 'points',
  initial: { kind: 'point' },
  parameters: {},
  isPoint: true,
  takesLimits: false,
  quaternion: [],
  isAxisAngle: false,
  dofs: () => POINT_DOFS,
  // Whether it is there is no factor.
  factors: () => undefined,
  carriesCharacter: () => false,
  mirrored: (motion) => motion,
};

/** In BVH the translation comes first, wherever its channels are listed. */
function bvhFactors({ channels }: BvhMotion): readonly CompoundDof[] {
  return [...channels.filter((name) => name.startsWith('t')), ...channels.filter((name) => name.startsWith('r'))];
}

/**
 * The joint of a `.bvh`: its channels are its DOFs. It converts to a fixed, ball, free or compound joint of `.skel`.
 */
export const BVH: JointType<BvhMotion> = {
  keyword: 'bvh',
  format: 'bvh',
  initial: { kind: 'bvh', channels: [], positions: 'replace' },
  parameters: {
    channels: { type: 'list', subject: 'The channels', choices: [...TRANSLATIONS, 'rx', 'ry', 'rz'] },
    positions: {
      type: 'choice',
      subject: 'The meaning of position channels',
      choices: ['replace', 'add'],
      describe: (meaning) => meaning,
    },
  },
  takesLimits: true,
  quaternion: [],
  isAxisAngle: false,
  dofs: ({ channels }) => channels.map(dof),
  factors: bvhFactors,
  carriesCharacter: ({ channels }) => TRANSLATIONS.every((name) => channels.includes(name)),
  mirrored: (motion) => motion,
  asSkel({ channels }) {
    const turns = channels.filter((name) => name.startsWith('r'));
    const moves = TRANSLATIONS.filter((name) => channels.includes(name));
    if (channels.length === 0) return { kind: 'fixed' };
    if (turns.length === 3 && (moves.length === 0 || moves.length === 3)) {
      // A permutation of three letters, which is exactly an order.
      const order = turns
        .map((name) => name[1])
        .reverse()
        .join('') as EulerOrder;
      return { kind: moves.length ? 'free' : 'ball', order };
    }
    return { kind: 'compound', dofs: [...moves, ...turns] };
  },
};
