/** Symmetric skeletons, of any kinds of joints, for tests of mirroring. */
import fc from 'fast-check';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  AXIS_PAIRS,
  COMPOUND_DOFS,
  EULER_ORDERS,
  type Joint,
  type Motion,
  SCALE_MODES,
  type Skeleton,
} from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';
import { evenly } from '../../helpers/evenly.ts';

const vector: fc.Arbitrary<Vec3> = fc.tuple(evenly(-1, 1), evenly(-1, 1), evenly(-1, 1));
const axis = vector.filter((v) => Math.hypot(...v) > 0.3);

/** Of every kind. Scales and shear are leaves in no one's way: they are given no rotation below them. */
export const anyMotion: fc.Arbitrary<Motion> = fc.oneof(
  fc.record({ kind: fc.constant('ball' as const), order: fc.constantFrom(...EULER_ORDERS) }),
  fc.record({ kind: fc.constant('hinge' as const), axis }),
  fc.record({ kind: fc.constant('universal' as const), order: fc.constantFrom(...AXIS_PAIRS) }),
  fc.constant<Motion>({ kind: 'quaternion' }),
  fc.record({ kind: fc.constant('prismatic' as const), axis }),
  fc.constant<Motion>({ kind: 'translational' }),
  fc.record({ kind: fc.constant('free' as const), order: fc.constantFrom(...EULER_ORDERS) }),
  fc.record({ kind: fc.constant('screw' as const), axis, pitch: evenly(-1, 1) }),
  fc.record({ kind: fc.constant('scale' as const), mode: fc.constantFrom(...SCALE_MODES), axis }),
  fc.constant<Motion>({ kind: 'shear' }),
  fc.constant<Motion>({ kind: 'fixed' }),
  fc.record({
    kind: fc.constant('compound' as const),
    dofs: fc.uniqueArray(fc.constantFrom(...COMPOUND_DOFS), { minLength: 1, maxLength: 5 }),
  }),
  fc.record({
    kind: fc.constant('bvh' as const),
    channels: fc.uniqueArray(fc.constantFrom('tx', 'ty', 'tz', 'rx', 'ry', 'rz'), { minLength: 1, maxLength: 6 }),
    positions: fc.constantFrom('replace' as const, 'add' as const),
  }),
);

/** The motion of the other side, across x: an axis is mirrored as turns are, the other way for what slides. */
export function mirroredMotion(motion: Motion): Motion {
  if (motion.kind === 'prismatic' || motion.kind === 'scale') return { ...motion, axis: acrossX(motion.axis) };
  // A turn about the mirrored axis goes the other way round, and what it slides on the way is mirrored too.
  if (motion.kind === 'hinge') return { ...motion, axis: acrossX(motion.axis) };
  if (motion.kind === 'screw') return { ...motion, axis: acrossX(motion.axis), pitch: -motion.pitch };
  return motion;
}

export function acrossX([x, y, z]: Vec3): Vec3 {
  return [-x, y, z];
}

export interface SymmetricRig {
  readonly skeleton: Skeleton;
  /** Each joint's counterpart. */
  readonly partner: readonly number[];
}

/** A trunk in the middle, with limbs on both sides of it. */
export function rigOf(
  trunk: readonly { readonly motion: Motion; readonly offset: Vec3 }[],
  limbs: readonly {
    readonly at: number;
    readonly joints: readonly { readonly motion: Motion; readonly offset: Vec3 }[];
  }[],
  nameOf: (side: 'left' | 'right' | 'middle', index: number) => string,
): SymmetricRig {
  const children = trunk.map((_, j) => limbs.filter(({ at }) => at % trunk.length === j));
  const joints: Joint[] = [];
  const partner: number[] = [];
  const add = (parent: number, motion: Motion, offset: Vec3, name: string) => {
    const values = dofsOf(motion);
    const free = { min: -100000, max: 100000 };
    joints.push(
      joint(parent, { name, motion, offset, pose: values.map((d) => d.rest), limits: values.map(() => free) }),
    );
    return joints.length - 1;
  };
  const build = (t: number, parent: number) => {
    const { motion, offset } = trunk[t];
    const own = add(parent, motion, t === 0 ? [0, 0, 0] : [0, offset[1], offset[2]], nameOf('middle', t));
    partner[own] = own;
    children[t].forEach((limb, l) => {
      const chains = (['left', 'right'] as const).map((side) => {
        let above = own;
        return limb.joints.map((part, i) => {
          const outward: Vec3 =
            i === 0 ? [0.5 + Math.abs(part.offset[0]), part.offset[1], part.offset[2]] : part.offset;
          const isLeft = side === 'left';
          above = add(
            above,
            isLeft ? part.motion : mirroredMotion(part.motion),
            isLeft ? outward : acrossX(outward),
            nameOf(side, 100 * t + 10 * l + i),
          );
          return above;
        });
      });
      chains[0].forEach((left, i) => {
        partner[left] = chains[1][i];
        partner[chains[1][i]] = left;
      });
    });
    if (t + 1 < trunk.length) build(t + 1, own);
  };
  build(0, -1);
  return { skeleton: { name: 'rig', joints }, partner };
}

const part = (motion: fc.Arbitrary<Motion>) => fc.record({ motion, offset: vector });

/** With motions of these kinds, named by sides. */
export const symmetricRig = (motion: fc.Arbitrary<Motion>, middle = motion): fc.Arbitrary<SymmetricRig> =>
  fc
    .tuple(
      fc.array(part(middle), { minLength: 1, maxLength: 3 }),
      fc.array(fc.record({ at: fc.nat(2), joints: fc.array(part(motion), { minLength: 1, maxLength: 3 }) }), {
        minLength: 1,
        maxLength: 2,
      }),
    )
    .map(([trunk, limbs]) =>
      rigOf(trunk, limbs, (side, index) => (side === 'middle' ? `spine ${index}` : `limb_${index}_${side[0]}`)),
    );

/** Turns freely, in every way in which joints of skeletons do. */
export const turningMotion: fc.Arbitrary<Motion> = fc.oneof(
  fc.record({ kind: fc.constant('ball' as const), order: fc.constantFrom(...EULER_ORDERS) }),
  fc.constant<Motion>({ kind: 'quaternion' }),
  fc.record({ kind: fc.constant('free' as const), order: fc.constantFrom(...EULER_ORDERS) }),
);

/** Joints in the middle that a mirrored pose of theirs is a pose of: those of hinges about any axis are not. */
export const middleMotion: fc.Arbitrary<Motion> = fc.oneof(
  turningMotion,
  fc.constantFrom<Motion>(
    { kind: 'hinge', axis: [1, 0, 0] },
    { kind: 'hinge', axis: [0, 0.6, 0.8] },
    { kind: 'universal', order: 'zx' },
    { kind: 'translational' },
    { kind: 'fixed' },
    { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'add' },
  ),
);
