/** Mistakes in the matrices of joints. */
import { EULER_ORDERS, type EulerOrder } from '../../model/skeleton/skeleton.ts';
import type { Breadth, JointRules, WorldMap } from '../program/program.ts';
import { finer, inJoints, type Mistake, type Variant } from './mistake.ts';

/** As a variant's detail says it. */
const BREADTHS: readonly (readonly [Breadth, string])[] = [
  ['all', ''],
  ['not listed', 'in all joints but compounds'],
  ['ordered', 'in ball, universal and free joints'],
  ['balls', 'in ball joints'],
];
const DEGREE = Math.PI / 180;
const COUNTED = { joints: 'joints', dofs: 'DOFs', both: 'joints and DOFs' } as const;

/** Factors are written from left to right, the last one applied first. */
function product(order: EulerOrder): string {
  return [...order]
    .reverse()
    .map((axis) => `R${axis}`)
    .join('·');
}

function insteadOfOwn(order: EulerOrder): string {
  return order === 'xyz'
    ? `${product(order)} instead of each joint's own order`
    : `${product(order)} instead of ${product('xyz')}`;
}

const SIGNS: readonly (readonly [string, JointRules['signs']['are']])[] = [
  ['−φx', [-1, 1, 1, 1]],
  ['−φy', [1, -1, 1, 1]],
  ['−φz', [1, 1, -1, 1]],
  ['all angles negated', [-1, -1, -1, -1]],
  ['angles about x, y and z negated', [-1, -1, -1, 1]],
];

/** All known mistakes in kinematics, each with its variants. */
export const KINEMATICS: readonly Mistake[] = [
  {
    code: 'rotation-order',
    subject: 'kinematics',
    sentence: (detail) => `You multiply ${detail.replace(' instead of ', '; it should be ')}.`,
    formula: 'J = Rz(φz)·Ry(φy)·Rx(φx)',
    variants: overJoints(EULER_ORDERS.map((is) => [insteadOfOwn(is), (breadth) => ({ order: { is, for: breadth } })])),
  },
  {
    code: 'rotation-sign',
    subject: 'kinematics',
    sentence: (detail) =>
      `Your rotations turn the wrong way: ${detail}. Positive angles should turn counter-clockwise about the axis.`,
    formula: 'Rx(φ) = (1 0 0; 0 cos φ −sin φ; 0 sin φ cos φ)',
    variants: overJoints([
      ...SIGNS.map(([detail, are]): Rule => [detail, (breadth) => ({ signs: { are, for: breadth } })]),
      ['R transposed', (breadth) => ({ transposed: breadth })],
    ]),
  },
  {
    code: 'degrees-for-radians',
    subject: 'kinematics',
    sentence: () => 'You use degrees as radians. Angles should be converted to radians once; sin and cos take radians.',
    formula: 'φ [rad] = φ [°]·π/180',
    variants: angles(1 / DEGREE),
  },
  {
    code: 'radians-for-degrees',
    subject: 'kinematics',
    sentence: () => 'You convert angles to radians although they already are. They should be used as in the file.',
    formula: 'φ [rad] as in the file',
    variants: angles(DEGREE),
  },
  {
    code: 'offset-after-rotation',
    subject: 'kinematics',
    sentence: () => 'You rotate before the offset, J·T(offset); it should be T(offset)·J.',
    formula: 'L = T(offset)·J(φ)',
    variants: [
      inJoints('J·T(offset + t)', { offset: 'after' }),
      finer(inJoints("R·T(offset + t), with the joint's own translation", { offset: 'inner after' })),
    ],
  },
  {
    code: 'concatenation-order',
    subject: 'kinematics',
    sentence: () => 'You multiply L·W_parent; it should be W_parent·L.',
    formula: 'W = W_parent·L',
    variants: [inJoints('L·W_parent', { concatenation: 'parent last' })],
  },
  {
    code: 'no-parent',
    subject: 'kinematics',
    sentence: () => "You use local matrices as world matrices. Each should be multiplied by its parent's world matrix.",
    formula: 'W = W_parent·L',
    variants: [inJoints('W = L', { concatenation: 'no parent' })],
  },
  {
    code: 'parent-offset-missing',
    subject: 'kinematics',
    sentence: () => "You ignore joint offsets. The offset should place a joint in its parent's space.",
    formula: 'L = T(offset)·J(φ)',
    variants: [inJoints('offset 0', { offset: 'none' })],
  },
  {
    code: 'no-root-translation',
    subject: 'kinematics',
    sentence: () => 'You ignore the root translation. The first three channels should move the whole character.',
    formula: 'L_root = T(offset + t)·J(φ)',
    variants: [
      inJoints('t = 0', { root: 'stays at 0' }),
      finer(inJoints('t = 0 at the offset', { root: 'stays at offset' })),
    ],
  },
  {
    code: 'limits-not-applied',
    subject: 'kinematics',
    sentence: () => "You don't apply limits. Each DOF should be clamped to its limits before its matrix is built.",
    formula: 'φ = min(max, max(min, φ))',
    variants: [inJoints('', { hasLimits: false })],
  },
  {
    code: 'pose-ignored',
    subject: 'kinematics',
    sentence: () =>
      'You ignore the pose: all DOFs are at rest. They should have the values of the pose, or of the channels at that time.',
    formula: 'φ = pose, or the channel at the time',
    variants: (['rest', 'rest, root at 0', 'rest, root at offset'] as const).flatMap((pose) => [
      pose === 'rest' ? inJoints(pose, { pose }) : finer(inJoints(pose, { pose })),
      finer(inJoints(`${pose}, without limits`, { pose, hasLimits: false })),
    ]),
  },
  {
    code: 'breadth-first',
    subject: 'kinematics',
    sentence: (detail) =>
      `You count ${detail} level by level; the order should be depth-first: a joint, then all its descendants.`,
    formula: 'joints and their DOFs in depth-first pre-order',
    variants: [false, true].flatMap((isInverse) =>
      (['joints', 'dofs', 'both'] as const).map((of) => {
        const variant = inJoints(`${COUNTED[of]}${isInverse ? ', each put in its proper place' : ''}`, {
          breadthFirst: { of, isInverse },
        });
        return isInverse ? finer(variant) : variant;
      }),
    ),
  },
  {
    code: 'dof-order',
    subject: 'kinematics',
    sentence: () => 'You read the three angles of a joint as z y x; they should be x y z.',
    formula: 'pose x y z; channels x y z of each joint',
    variants: overJoints([
      ['z y x', (breadth) => ({ dofOrder: { isReversed: true, for: breadth, withRoot: true } })],
      ['z y x below the root', (breadth) => ({ dofOrder: { isReversed: true, for: breadth, withRoot: false } }), true],
    ]),
  },
  mapped(
    'matrix-inverse',
    'Your world matrices are inverted. They should lead from joint space to world space.',
    'W = W_parent·L',
    ['inverse'],
  ),
  mapped('handedness', 'Your z axis is mirrored. Axes should be right-handed, with y up.', 'x × y = z', [
    'mirror z',
    'mirror z of points',
  ]),
  mapped('y-z-swapped', 'Your y and z axes are swapped. y should be up.', 'x right, y up, z towards you', [
    'swap y z',
    'swap y z of points',
  ]),
  {
    code: 'bvh-position-added',
    subject: 'kinematics',
    sentence: () => 'You add position channels to OFFSET. They should replace it.',
    formula: 'L = T(position channels)·R',
    variants: [inJoints('OFFSET + channels', { bvhPositions: 'added' })],
  },
  {
    code: 'bvh-channel-order',
    subject: 'kinematics',
    sentence: (detail) =>
      `You apply rotation channels in another order (${detail}). They should be multiplied from left to right, as listed.`,
    formula: 'CHANNELS 3 Zrotation Xrotation Yrotation: R = Rz·Rx·Ry',
    variants: [
      inJoints('reversed', { bvhOrder: 'reversed' }),
      ...EULER_ORDERS.map((order) =>
        finer(inJoints(`multiplied as ${product(order)}`, { bvhOrder: `multiplied ${order}` })),
      ),
      ...EULER_ORDERS.map((order) =>
        finer(inJoints(`columns read as those of ${product(order)}`, { bvhOrder: `read ${order}` })),
      ),
    ],
  },
  {
    code: 'bvh-degrees',
    subject: 'kinematics',
    sentence: () => 'You use rotation channels as radians. They are in degrees and should be converted.',
    formula: 'φ [rad] = channel·π/180',
    variants: [inJoints('', { bvhDegrees: true })],
  },
];

/**
 * The detail of a variant, its rules by the joints that they are for, and whether it is a finer form of the one before.
 */
type Rule = readonly [string, (breadth: Breadth) => Partial<JointRules>, boolean?];

/** For all joints, and for those of fewer types that a program may have in mind. */
function overJoints(rules: readonly Rule[]): readonly Variant[] {
  return BREADTHS.flatMap(([breadth, where]) =>
    rules.map(([detail, of, isFiner = false]) => {
      const variant = inJoints([detail, where].filter((part) => part !== '').join(' '), of(breadth));
      return breadth === 'all' && !isFiner ? variant : finer(variant);
    }),
  );
}

function angles(factor: number): readonly Variant[] {
  return overJoints([
    ['', (breadth) => ({ angles: { factor, at: 'joint', for: breadth } })],
    ['before limits', (breadth) => ({ angles: { factor, at: 'file', for: breadth } }), true],
  ]);
}

/** A map of all world matrices; two of them are one after the other. */
function mapped(code: string, sentence: string, formula: string, maps: readonly WorldMap[]): Mistake {
  return {
    code,
    subject: 'kinematics',
    sentence: () => sentence,
    formula,
    variants: maps.map((map, i) => ({
      ...(i > 0 && { isFiner: true }),
      detail: map,
      apply: (program) => ({ ...program, joints: { ...program.joints, world: [...program.joints.world, map] } }),
    })),
  };
}
