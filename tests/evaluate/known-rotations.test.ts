import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { KnownRotations } from '../../src/evaluate/known-rotations.ts';
import { poseFrom, poseSource } from '../../src/evaluate/pose.ts';
import { restChannel, SAMPLED } from '../../src/model/clip.ts';
import { RADIANS_PER_DEGREE } from '../../src/model/samples.ts';
import type { Skeleton } from '../../src/model/skeleton.ts';
import { character, joint } from '../helpers/builders.ts';

/** A rotation by way of its angles, or of the quaternion that they came from. */
const SAME_ELEMENT = 1e-12;

const ORDERS = [
  ['rz', 'rx', 'ry'],
  ['rx', 'ry', 'rz'],
  ['rz', 'ry', 'rx'],
  ['ry', 'rz', 'rx'],
] as const;

const none = { min: -100000, max: 100000 };

/** A chain of joints that turn in all manner of orders. */
const chain: Skeleton = {
  name: 'chain',
  joints: ORDERS.map((channels, j) =>
    joint(j - 1, {
      motion: { kind: 'bvh', channels, positions: 'replace' },
      limits: channels.map(() => none),
      pose: channels.map(() => 0),
      offset: [1, 2, 3],
    }),
  ),
};

const WIDTH = 3 * ORDERS.length;
/** The root's translation comes before them. */
const COUNT = 3 + WIDTH;

function sampled(degrees: readonly number[]) {
  return character({
    skeleton: chain,
    clips: [
      {
        name: 'two frames',
        range: [0, 1],
        channels: Array.from({ length: COUNT }, (_, c) => (c < 3 ? restChannel() : SAMPLED)),
        samples: {
          frameCount: 2,
          frameSeconds: 1,
          startSeconds: 0,
          firstChannel: 3,
          values: Float64Array.from(degrees),
          scales: new Float64Array(WIDTH).fill(RADIANS_PER_DEGREE),
          interpolation: 'linear',
        },
      },
    ],
    shownClip: 0,
  });
}

function posed(dofs: Float64Array, known?: Float64Array): Float64Array {
  const out = new Float64Array(16 * ORDERS.length);
  worldMatrices(compileSkeleton(chain), dofs, out, known);
  return out;
}

function expectSame(a: Float64Array, b: Float64Array): void {
  expect(Math.max(...a.map((v, i) => Math.abs(v - b[i])))).toBeLessThan(SAME_ELEMENT);
}

const degrees = fc.array(fc.double({ min: -170, max: 170, noNaN: true }), {
  minLength: 2 * WIDTH,
  maxLength: 2 * WIDTH,
});
const between = fc.double({ min: 0.01, max: 0.99, noNaN: true });

describe('rotations that are known beside their angles', () => {
  it('give the matrices that the angles give', () => {
    fc.assert(
      fc.property(degrees, between, (values, time) => {
        const known = new KnownRotations();
        known.reserve(COUNT);
        const dofs = new Float64Array(COUNT);
        poseFrom(poseSource(sampled(values)), time, dofs, known.values);
        expectSame(posed(dofs, known.values), posed(dofs));
      }),
    );
  });

  it('are those that are taken, where the angles are the very same', () => {
    const known = new KnownRotations();
    known.reserve(COUNT);
    const dofs = new Float64Array(COUNT).fill(0.5);
    // Of the first joint (Rz·Rx·Ry) the rotation about y is applied first.
    known.values.set([0.5, 0.5, 0.5, 0, 0, 0, 1], 8 * 5);
    expect([...posed(dofs, known.values).subarray(0, 3)]).toEqual([1, 0, 0]);
    dofs[3] = 0.6;
    expectSame(posed(dofs, known.values), posed(dofs));
  });

  it('say nothing of a pose that was changed since', () => {
    fc.assert(
      fc.property(degrees, between, fc.integer({ min: 3, max: COUNT - 1 }), (values, time, dof) => {
        const known = new KnownRotations();
        known.reserve(COUNT);
        const dofs = new Float64Array(COUNT);
        poseFrom(poseSource(sampled(values)), time, dofs, known.values);
        dofs[dof] += 0.25;
        expectSame(posed(dofs, known.values), posed(dofs));
      }),
    );
  });
});
