import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, localMatrices } from '../../../src/evaluate/kinematics.ts';
import { fitJoint, jointFit } from '../../../src/evaluate/retarget/fit.ts';
import { writeRotationPart } from '../../../src/math/mat3.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  EULER_ORDERS,
  type Limit,
  type Motion,
  type Skeleton,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

const NO_BONE = new Float64Array(3);

function skeletonOf(motion: Motion, limit: Limit = UNLIMITED): Skeleton {
  const dofs = dofsOf(motion);
  return {
    name: 'one',
    joints: [joint(-1), joint(0, { motion, limits: dofs.map(() => limit), pose: dofs.map(({ rest }) => rest) })],
  };
}

/** The rotation that joint 1's DOFs make. */
function rotation(skeleton: Skeleton, own: readonly number[]): Float64Array {
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(compiled.firstDof[2]);
  dofs.set(own, compiled.firstDof[1]);
  const local = new Float64Array(32);
  localMatrices(compiled, dofs, local);
  const out = new Float64Array(9);
  writeRotationPart(local, 16, out, 0, 3);
  return out;
}

/** The DOFs of joint 1 that come nearest to a rotation. */
function fitted(skeleton: Skeleton, wanted: Float64Array, bone = NO_BONE): number[] {
  const compiled = compileSkeleton(skeleton);
  const fit = jointFit(compiled, skeleton.joints[1], 1, true);
  const dofs = new Float64Array(compiled.firstDof[2]);
  if (fit) fitJoint(compiled, 1, fit, wanted, bone, 0, dofs);
  return [...dofs.subarray(compiled.firstDof[1])];
}

const MOTIONS: readonly Motion[] = [
  ...EULER_ORDERS.map((order) => ({ kind: 'ball', order }) as const),
  { kind: 'quaternion' },
  { kind: 'hinge', axis: [1, 2, -1] },
  { kind: 'universal', order: 'xz' },
  { kind: 'bvh', channels: ['rz', 'ty', 'rx', 'ry'], positions: 'replace' },
  { kind: 'bvh', channels: ['rx', 'rz'], positions: 'replace' },
  { kind: 'compound', dofs: ['ry', 'tx', 'rx', 'rz'] },
];

describe('fitting a joint to a rotation', () => {
  it.each(MOTIONS.map((motion) => [JSON.stringify(motion), motion] as const))(
    'is exact where the joint can: %s',
    (_, motion) => {
      const skeleton = skeletonOf(motion);
      const count = dofsOf(motion).length;
      fc.assert(
        fc.property(
          fc.array(fc.double({ min: -1.5, max: 1.5, noNaN: true }), { minLength: count, maxLength: count }),
          (values) => {
            // A quaternion of nothing turns nothing.
            if (motion.kind === 'quaternion') values[3] = 1;
            const wanted = rotation(skeleton, values);
            const found = rotation(skeleton, fitted(skeleton, wanted));
            expect(Math.max(...found.map((v, i) => Math.abs(v - wanted[i])))).toBeLessThan(1e-7);
          },
        ),
        { numRuns: 60 },
      );
    },
  );

  it('fitting a joint to a rotation keeps to limits, and there finds no worse than any other angles', () => {
    const skeleton = skeletonOf({ kind: 'ball', order: 'xyz' }, { min: -0.4, max: 0.6 });
    const free = skeletonOf({ kind: 'ball', order: 'xyz' });
    const off = (a: Float64Array, b: Float64Array) => a.reduce((sum, v, i) => sum + (v - b[i]) ** 2, 0);
    const angles = fc.array(fc.double({ min: -1.2, max: 1.2, noNaN: true }), { minLength: 3, maxLength: 3 });
    const within = fc.array(fc.double({ min: -0.4, max: 0.6, noNaN: true }), { minLength: 3, maxLength: 3 });
    fc.assert(
      fc.property(angles, within, (values, other) => {
        const wanted = rotation(free, values);
        const found = fitted(skeleton, wanted);
        for (const value of found) {
          expect(value).toBeGreaterThanOrEqual(-0.4);
          expect(value).toBeLessThanOrEqual(0.6);
        }
        expect(off(rotation(skeleton, found), wanted)).toBeLessThan(off(rotation(skeleton, other), wanted) + 1e-6);
      }),
      { numRuns: 200 },
    );
  });

  it('points a bone where it should rather than turning it about itself', () => {
    // Two axes, of which one twists the bone: the direction is had all the same.
    const skeleton = skeletonOf({ kind: 'hinge', axis: [0, 0, 1] });
    const both = skeletonOf({ kind: 'ball', order: 'xyz' });
    const wanted = rotation(both, [1, 0, 0.5]);
    const [angle] = fitted(skeleton, wanted, Float64Array.of(1, 0, 0));
    expect(angle).toBeCloseTo(0.5, 6);
  });
});
