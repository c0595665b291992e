import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { compileSkeleton, localMatrices } from '../../../src/evaluate/kinematics.ts';
import { PoseRotations } from '../../../src/evaluate/rotations/pose-rotations.ts';
import { nearEuler, readRows } from '../../../src/evaluate/samples/near-eulers.ts';
import { sampledJoints } from '../../../src/evaluate/samples/sampled-joints.ts';
import type { BvhChannel, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { bvhJoint } from '../../helpers/bvh.ts';

/** Radians; of matrices their elements. */
const CLOSE = 1e-12;

const ORDERS: readonly (readonly BvhChannel[])[] = [
  ['rz', 'rx', 'ry'],
  ['rx', 'ry', 'rz'],
  ['rz', 'ry', 'rx'],
  ['ry', 'rz', 'rx'],
  ['rx', 'rz', 'ry'],
  ['ry', 'rx', 'rz'],
];

interface Between {
  readonly isNear: boolean;
  /** Three angles. */
  readonly dofs: Float64Array;
  /** As `PoseRotations` has them. */
  readonly rotation: Float64Array;
  readonly skeleton: Skeleton;
}

/** One joint, between a frame of these radians and one of those. */
function between(order: readonly BvhChannel[], from: readonly number[], to: readonly number[], part: number): Between {
  const skeleton = { name: 'one', joints: [bvhJoint(-1, order)] };
  const samples: Samples = {
    frameCount: 2,
    frameSeconds: 1,
    startSeconds: 0,
    firstChannel: 3,
    values: Float64Array.from([...from, ...to]),
    scales: new Float64Array(3).fill(1),
    interpolation: 'linear',
  };
  const channels = Array.from({ length: 6 }, (_, c) => (c < 3 ? restChannel() : SAMPLED));
  const joints = sampledJoints(compileTake({ name: 'go', range: [0, 1], channels, samples }), skeleton);
  const out = new Float64Array(6);
  const rotations = new PoseRotations(1);
  readRows(samples, joints, 0, part);
  return { isNear: nearEuler(joints, 0, out, rotations), dofs: out.subarray(3), rotation: rotations.values, skeleton };
}

function matrix(skeleton: Skeleton, angles: ArrayLike<number>): Float64Array {
  const out = new Float64Array(16);
  localMatrices(compileSkeleton(skeleton), Float64Array.from([0, 0, 0, ...Array.from(angles)]), out);
  return out;
}

/** Of the rotation that takes one to the other; by the skew part, which is exact for small angles. */
function angleBetween(a: Float64Array, b: Float64Array): number {
  let squares = 0;
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) squares += (a[4 * c + r] - b[4 * c + r]) ** 2;
  }
  return 2 * Math.asin(Math.min(1, Math.sqrt(squares / 8)));
}

const order = fc.constantFrom(...ORDERS);
const angles = fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -1.4, max: 1.4, noNaN: true }))) as fc.Arbitrary<
  [number, number, number]
>;
const step = fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -0.05, max: 0.05, noNaN: true }))) as fc.Arbitrary<
  [number, number, number]
>;
const part = fc.double({ min: 0.01, max: 0.99, noNaN: true });

describe('angles between two frames that are near to each other', () => {
  it('angles between two near frames are those of slerp: the share of the way from the one, the rest of it to the other', () => {
    fc.assert(
      fc.property(order, angles, step, part, (channels, from, by, share) => {
        const to = from.map((angle, i) => angle + by[i]);
        const { isNear, dofs, skeleton } = between(channels, from, to, share);
        expect(isNear).toBe(true);
        const [first, middle, last] = [from, dofs, to].map((set) => matrix(skeleton, set));
        const whole = angleBetween(first, last);
        expect(Math.abs(angleBetween(first, middle) - share * whole)).toBeLessThan(CLOSE);
        expect(Math.abs(angleBetween(middle, last) - (1 - share) * whole)).toBeLessThan(CLOSE);
        from.forEach((angle, i) => {
          expect(Math.abs(dofs[i] - angle)).toBeLessThan(1);
        });
      }),
    );
  });

  it('angles between two frames that are near to each other come with the quaternion of the same rotation, of length 1', () => {
    fc.assert(
      fc.property(order, angles, step, part, (channels, from, by, share) => {
        const to = from.map((angle, i) => angle + by[i]);
        const { dofs, rotation, skeleton } = between(channels, from, to, share);
        const [x, y, z, w] = rotation.subarray(3);
        expect(Math.abs(Math.hypot(x, y, z, w) - 1)).toBeLessThan(CLOSE);
        const m = matrix(skeleton, dofs);
        const column = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
        column.forEach((value, r) => {
          expect(Math.abs(value - m[r])).toBeLessThan(CLOSE);
        });
        expect(Math.abs(2 * (y * z + w * x) - m[6])).toBeLessThan(CLOSE);
      }),
    );
  });

  it('angles between two frames are exactly unchanged if nothing rotates', () => {
    fc.assert(
      fc.property(order, angles, part, (channels, given, share) => {
        // As many digits as files have: the smallest numbers there are can't be halved.
        const from = given.map((angle) => Math.round(1e6 * angle) / 1e6 + 0);
        expect([...between(channels, from, from, share).dofs]).toEqual(from);
      }),
    );
  });

  it('angles are not interpolated as near if far apart, at or near gimbal lock, or not finite', () => {
    const isNear = (from: readonly number[], to: readonly number[]) => between(ORDERS[1], from, to, 0.5).isNear;
    expect(isNear([0, 0, 0], [0.1, 0.1, 0.1])).toBe(true);
    expect(isNear([0, 0, 0], [2, 0, 0])).toBe(false);
    expect(isNear([3.1, 0, 0], [-3.1, 0, 0])).toBe(false);
    expect(isNear([0, 1.57, 0], [0, 1.56, 0])).toBe(false);
    expect(isNear([0, 2, 0], [0, 2.01, 0])).toBe(false);
    expect(isNear([0, 0, 0], [0, Number.NaN, 0])).toBe(false);
  });
});
