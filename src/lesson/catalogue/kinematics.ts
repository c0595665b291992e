/** Mistakes in the matrices of joints. */
import { EULER_ORDERS, type EulerOrder } from '../../model/skeleton.ts';
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
      `Rotations turn the wrong way: ${detail}. Positive angles turn counter-clockwise about the axis.`,
    formula: 'Rx(φ) = (1 0 0; 0 cos φ −sin φ; 0 sin φ cos φ)',
    variants: overJoints([
      ...SIGNS.map(([detail, are]): Rule => [detail, (breadth) => ({ signs: { are, for: breadth } })]),
      ['R transposed', (breadth) => ({ transposed: breadth })],
    ]),
  },
  {
    code: 'degrees-for-radians',
    subject: 'kinematics',
    sentence: () => 'Angles in degrees are used as radians. Convert degrees to radians once; sin and cos take radians.',
    formula: 'φ [rad] = φ [°]·π/180',
    variants: angles(1 / DEGREE),
  },
  {
    code: 'radians-for-degrees',
    subject: 'kinematics',
    sentence: () => 'Angles in radians are converted as if they were degrees. They are radians in the file already.',
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
    sentence: () => 'You multiply L·W of the parent; it should be W of the parent times L.',
    formula: 'W = W_parent·L',
    variants: [inJoints('L·W_parent', { concatenation: 'parent last' })],
  },
  {
    code: 'no-parent',
    subject: 'kinematics',
    sentence: () => "Local matrices are used as world matrices; each must be multiplied by its parent's world matrix.",
    formula: 'W = W_parent·L',
    variants: [inJoints('W = L', { concatenation: 'no parent' })],
  },
  {
    code: 'parent-offset-missing',
    subject: 'kinematics',
    sentence: () => "The offset of joints is ignored; it is the joint's position in its parent's space.",
    formula: 'L = T(offset)·J(φ)',
    variants: [inJoints('offset 0', { offset: 'none' })],
  },
  {
    code: 'no-root-translation',
    subject: 'kinematics',
    sentence: () => 'The translation of the root is ignored: the first three channels move the whole character.',
    formula: 'L_root = T(offset + t)·J(φ)',
    variants: [
      inJoints('t = 0', { root: 'stays at 0' }),
      finer(inJoints('t = 0 at the offset', { root: 'stays at offset' })),
    ],
  },
  {
    code: 'limits-not-applied',
    subject: 'kinematics',
    sentence: () => 'Limits are not applied: clamp each DOF to its limits before making the matrix.',
    formula: 'φ = min(max, max(min, φ))',
    variants: [inJoints('', { hasLimits: false })],
  },
  {
    code: 'pose-ignored',
    subject: 'kinematics',
    sentence: () => 'The pose is ignored: all DOFs are at rest.',
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
      `You count ${detail} level by level; the order is depth-first: a joint, then all its descendants.`,
    formula: 'joints and their DOFs in depth-first pre-order',
    variants: [false, true].flatMap((isInverse) =>
      (['joints', 'dofs', 'both'] as const).map((of) => {
        const variant = inJoints(`${COUNTED[of]}${isInverse ? ', put in their places' : ''}`, {
          breadthFirst: { of, isInverse },
        });
        return isInverse ? finer(variant) : variant;
      }),
    ),
  },
  {
    code: 'dof-order',
    subject: 'kinematics',
    sentence: () => 'The three angles of a joint are read as z y x; they are x y z.',
    formula: 'pose x y z; channels x y z of each joint',
    variants: overJoints([
      ['z y x', (breadth) => ({ dofOrder: { isReversed: true, for: breadth, withRoot: true } })],
      ['z y x below the root', (breadth) => ({ dofOrder: { isReversed: true, for: breadth, withRoot: false } }), true],
    ]),
  },
  mapped(
    'matrix-inverse',
    'World matrices are inverted: they lead from joint space to world space.',
    'W = W_parent·L',
    ['inverse'],
  ),
  mapped('handedness', 'The z axis is mirrored: axes are right-handed, y up.', 'x × y = z', [
    'mirror z',
    'mirror z of points',
  ]),
  mapped('y-z-swapped', 'The axes y and z are exchanged: y is up.', 'x right, y up, z towards you', [
    'swap y z',
    'swap y z of points',
  ]),
  {
    code: 'bvh-position-added',
    subject: 'kinematics',
    sentence: () => 'Position channels are added to OFFSET; they replace it.',
    formula: 'L = T(position channels)·R',
    variants: [inJoints('OFFSET + channels', { bvhPositions: 'added' })],
  },
  {
    code: 'bvh-channel-order',
    subject: 'kinematics',
    sentence: (detail) =>
      `Rotation channels are taken in another order (${detail}); multiply them from left to right as listed.`,
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
    sentence: () => 'Rotation channels are used as radians; they are degrees.',
    formula: 'φ [rad] = channel·π/180',
    variants: [inJoints('', { bvhDegrees: true })],
  },
];

/** What a variant says, the rules by the joints that they are for, and whether it is a finer form of the one before. */
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
