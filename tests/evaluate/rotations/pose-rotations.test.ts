import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseFrom, poseSource } from '../../../src/evaluate/pose.ts';
import { PoseRotations } from '../../../src/evaluate/rotations/pose-rotations.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { jointDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { character, joint } from '../../helpers/builders.ts';

/** A rotation by way of its angles, or of the quaternion that they came from. */
const SAME_ELEMENT = 1e-12;

/** Three angles in several orders, some behind a translation. */
const MOTIONS: readonly Motion[] = [
  { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' },
  { kind: 'ball', order: 'xyz' },
  { kind: 'bvh', channels: ['rz', 'ty', 'ry', 'rx'], positions: 'add' },
  { kind: 'free', order: 'yzx' },
  { kind: 'compound', dofs: ['tx', 'rx', 'rz', 'ry'] },
  { kind: 'compound', dofs: ['sx', 'ry', 'rz', 'rx'] },
  { kind: 'hinge', axis: [1, 0, 0] },
];

const none = { min: -100000, max: 100000 };

const chain: Skeleton = {
  name: 'chain',
  joints: MOTIONS.map((motion, j) =>
    joint(j - 1, {
      motion,
      limits: dofsOf(motion).map(() => none),
      pose: dofsOf(motion).map(() => 0),
      offset: [1, 2, 3],
    }),
  ),
};

const WIDTH = jointDofCount(chain);
/** The root's translation comes before them. */
const COUNT = 3 + WIDTH;
/** Of the root joint: Rz·Rx·Ry, of which the rotation about y is applied first. */
const [RZ, RX, RY] = [3, 4, 5];

function sampled(degrees: readonly number[]) {
  return character({
    skeleton: chain,
    takes: [
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
    shownTake: 0,
  });
}

function sampledAt(values: readonly number[], time: number) {
  const rotations = new PoseRotations(chain.joints.length);
  const dofs = new Float64Array(COUNT);
  poseFrom(poseSource(sampled(values)), time, dofs, rotations);
  return { dofs, rotations };
}

function posed(dofs: Float64Array, rotations?: PoseRotations): Float64Array {
  const out = new Float64Array(16 * MOTIONS.length);
  worldMatrices(compileSkeleton(chain), dofs, out, rotations);
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

describe('rotations that samples gave', () => {
  it('give the matrices that the angles give', () => {
    fc.assert(
      fc.property(degrees, between, (values, time) => {
        const { dofs, rotations } = sampledAt(values, time);
        expectSame(posed(dofs, rotations), posed(dofs));
      }),
    );
  });

  it('rotations given by samples make the matrices while the joint has the angles they came with', () => {
    const rotations = new PoseRotations(chain.joints.length);
    rotations.areGiven = true;
    const dofs = new Float64Array(COUNT).fill(0.5);
    // Another rotation than that of the angles, so that one can see which of them is taken.
    rotations.values.set([0.5, 0.5, 0.5, 0, 0, 0, 1]);
    expect([...posed(dofs, rotations).subarray(0, 3)]).toEqual([1, 0, 0]);
    for (const dof of [RZ, RX, RY]) {
      const changed = dofs.slice();
      changed[dof] = 0.6;
      expectSame(posed(changed, rotations), posed(changed));
    }
  });

  it('rotations that samples gave do not count where a DOF was changed since', () => {
    fc.assert(
      fc.property(degrees, between, fc.integer({ min: 3, max: COUNT - 1 }), (values, time, dof) => {
        const { dofs, rotations } = sampledAt(values, time);
        dofs[dof] += 0.25;
        expectSame(posed(dofs, rotations), posed(dofs));
      }),
    );
  });

  it('rotations given by samples are those of the last pose alone', () => {
    // The first joint stays in gimbal lock, whose rotation is not worked out; all others turn.
    const values = Array.from({ length: 2 * WIDTH }, (_, i) =>
      i % WIDTH === 1 ? 90 : i % WIDTH < 3 ? 20 : (3 * i) % 70,
    );
    const source = poseSource(sampled(values));
    const rotations = new PoseRotations(chain.joints.length);
    // As if it had turned at an earlier time.
    rotations.values.set([1, 1, 1, 0, 0, 0, 1]);
    const dofs = new Float64Array(COUNT);
    poseFrom(source, 0.5, dofs, rotations);
    expect(rotations.areGiven).toBe(true);
    // Nor the hinge, which does not turn by three angles.
    const given = chain.joints.map((_, j) => !Number.isNaN(rotations.values[8 * j]));
    expect(given).toEqual([false, true, true, true, true, true, false]);
    poseFrom(source, 1, dofs, rotations);
    expect(rotations.areGiven).toBe(false);
    expectSame(posed(dofs, rotations), posed(dofs));
  });
});
