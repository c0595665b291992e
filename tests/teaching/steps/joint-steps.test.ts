import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, localMatrices, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { multiplyAffine } from '../../../src/math/mat4.ts';
import type { Character } from '../../../src/model/document.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { type Motion, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { stepsOfPose } from '../../../src/teaching/steps/dof-steps.ts';
import { formulaText, subscript } from '../../../src/teaching/steps/formula.ts';
import { framesOf, type JointSteps, productOfFactors, stepsOfJoint } from '../../../src/teaching/steps/joint-steps.ts';
import { orthonormalityError } from '../../../src/teaching/steps/matrix-facts.ts';
import { bvhMotion, motion } from '../../formats/arbitraries.ts';
import { describeShared } from '../../helpers/shared.ts';
import { character, joint, skeleton } from '../../ui/builders.ts';
import { characterOf, OWN, SHARED } from '../lesson-files.ts';

const TIMES = [-1.3, 0.27, 1.15];

describe('the steps of every joint of our examples', () => {
  it.each(Object.entries(OWN))('end at the very numbers that evaluation gives: %s', (_, files) => {
    expectSame(characterOf(...files), TIMES);
  });
});

describeShared('the steps of every joint of the reference files', () => {
  const withJoints = Object.entries(SHARED).filter(([name]) => name !== 'sample' && name !== 'curves');
  it.each(withJoints)('end at the very numbers that evaluation gives: %s', (_, files) => {
    expectSame(characterOf(...files), TIMES);
  });
});

describe('the steps of random joints', () => {
  const offset = fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -9, max: 9, noNaN: true })));
  const value = fc.double({ min: -7, max: 7, noNaN: true });
  /** Pitches of 1e300 overflow. */
  const isTame = (of: Motion) => of.kind !== 'screw' || Math.abs(of.pitch) < 1e6;
  const chain: fc.Arbitrary<Skeleton> = fc
    .array(fc.tuple(fc.oneof(motion, bvhMotion).filter(isTame), offset, fc.nat()), { minLength: 1, maxLength: 5 })
    .map((all) => ({
      name: 'x',
      joints: all.map(([own, at, above], j) => ({
        ...joint(`j${j}`, j ? above % j : -1),
        motion: own,
        offset: [at[0], at[1], at[2]] as const,
        limits: dofsOf(own).map((_, d) => (d % 2 ? UNLIMITED : { min: -2, max: 3 })),
        pose: dofsOf(own).map(({ rest }) => rest),
      })),
    }));

  it('random joints of any type end at the very numbers that evaluation gives', () => {
    fc.assert(
      fc.property(chain, fc.array(value, { minLength: 40, maxLength: 40 }), fc.boolean(), (of, values, clamps) => {
        const posed = character({ skeleton: of, clampsToLimits: clamps });
        expectSame({ ...posed, pose: values.slice(0, dofCountOf(posed)) }, [0]);
      }),
      { numRuns: 200 },
    );
  });
});

describe('the steps of a joint', () => {
  const arm = skeleton(['shoulder', -1], ['elbow', 0]);

  it('names what its formula multiplies, by the index of the joint', () => {
    const steps = stepsOf(character({ skeleton: arm }), 1);
    expect(formulaText(steps.localFormula)).toBe('L₁ = T(offset) · Rz(rz) · Ry(ry) · Rx(rx)');
    expect(formulaText(steps.worldFormula)).toBe('W₁ = W₀ · L₁');
    expect(subscript(120)).toBe('₁₂₀');
  });

  it('has the root translation before the offset of the root', () => {
    const steps = stepsOf(character({ skeleton: arm, pose: [5, 0, 0, 0, 0, 0, 0, 0, 0] }), 0);
    expect(formulaText(steps.localFormula)).toBe('L₀ = T(tx, ty, tz) · T(offset) · Rz(rz) · Ry(ry) · Rx(rx)');
    expect(formulaText(steps.worldFormula)).toBe('W₀ = L₀');
    expect([...steps.world.slice(12)]).toEqual([5, 1, 0, 1]);
  });

  it('tells where a value comes from, and what its limits do to it', () => {
    const limited = {
      ...arm,
      joints: [arm.joints[0], { ...arm.joints[1], limits: [{ min: -1, max: 1 }, UNLIMITED, UNLIMITED] }],
    };
    const own = character({ skeleton: limited, pose: [0, 0, 0, 0, 0, 0, 2, 3, 0] });
    expect(stepsOf(own, 1).values[0]).toMatchObject({ name: 'rx', source: 'pose', given: 2, limit: [-1, 1], value: 1 });
    expect(stepsOf(own, 1).values[1]).toMatchObject({ name: 'ry', given: 3, value: 3 });
    const free = stepsOf({ ...own, clampsToLimits: false }, 1).values[0];
    expect(free).toMatchObject({ given: 2, value: 2 });
    expect(free.limit).toBeUndefined();
    const changed = { ...own, unkeyed: { timeSeconds: 0, dofs: [6], values: [0.5] } };
    expect(stepsOf(changed, 1).values[0]).toMatchObject({ source: 'unkeyed', given: 0.5, value: 0.5 });
  });

  it('tells of a linked DOF what it follows, after that DOF’s limits', () => {
    const linked = {
      ...arm,
      joints: [
        { ...arm.joints[0], limits: [{ min: -1, max: 1 }, UNLIMITED, UNLIMITED] },
        { ...arm.joints[1], couples: [{ dof: 'ry', joint: 0, follows: 'rx', gain: 2, offset: 0.25 }] },
      ],
    };
    const steps = stepsOf(character({ skeleton: linked, pose: [0, 0, 0, 9, 0, 0, 0, 7, 0] }), 1);
    expect(steps.values[1]).toMatchObject({
      source: 'link',
      given: 2.25,
      value: 2.25,
      link: { follows: 3, followed: 1 },
    });
  });

  it('does not exist for a joint that the character lacks', () => {
    expect(stepsOfJoint(stepsOfPose(character({ skeleton: arm }), 0), 2)).toBeUndefined();
    expect(stepsOfJoint(stepsOfPose(character(), 0), 0)).toBeUndefined();
  });

  it('leads a frame from the parent’s to the joint’s', () => {
    const steps = stepsOf(character({ skeleton: arm, pose: [0, 0, 0, 0, 0, 1, 0.4, 0.3, 0.2] }), 1);
    const frames = framesOf(steps);
    expect(frames).toHaveLength(5);
    expect(frames[0]).toBe(steps.parentWorld);
    expect(frames[4]).toBe(steps.world);
    expect(equal(frames[1].subarray(0, 12), frames[0].subarray(0, 12))).toBe(true);
    expect(equal(frames[1].subarray(12), frames[4].subarray(12))).toBe(true);
  });
});

describe('the orthonormality error', () => {
  it('the orthonormality error is 0 for a rotation, and otherwise how far lengths or angles are off', () => {
    const m = Float64Array.of(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1);
    expect(orthonormalityError(m)).toBe(0);
    m[10] = 2;
    expect(orthonormalityError(m)).toBe(3);
    m[10] = Number.NaN;
    expect(orthonormalityError(m)).toBeNaN();
  });
});

function stepsOf(of: Character, index: number): JointSteps {
  const steps = stepsOfJoint(stepsOfPose(of, 0), index);
  if (!steps) throw new Error('No such joint.');
  return steps;
}

/** Equal as numbers: 0 and −0 are one. */
function equal(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  return a.length === b.length && Array.from(a).every((x, i) => x === b[i]);
}

function expectSame(of: Character, times: readonly number[]): void {
  const { skeleton: own } = of;
  if (!own) throw new Error('No skeleton.');
  const compiled = compileSkeleton(own);
  const dofs = new Float64Array(dofCountOf(of));
  const world = new Float64Array(16 * compiled.jointCount);
  const local = new Float64Array(world.length);
  for (const time of times) {
    poseAt(of, time, dofs);
    worldMatrices(compiled, dofs, world);
    localMatrices(compiled, dofs, local);
    const pose = stepsOfPose(of, time);
    expect(equal(pose.dofs, dofs)).toBe(true);
    own.joints.forEach((_, j) => {
      const steps = stepsOfJoint(pose, j);
      if (!steps) throw new Error(`No steps for joint ${j}.`);
      for (const { dof, value, given, limit } of steps.values) {
        const limited = limit ? Math.min(limit[1], Math.max(limit[0], given)) : given;
        if (!Object.is(value, dofs[dof]) || !Object.is(limited, value)) {
          expect([value, limited], `DOF ${dof}`).toEqual([dofs[dof], value]);
        }
      }
      expect(equal(productOfFactors(steps), local.subarray(16 * j, 16 * j + 16)), `L of joint ${j} at ${time}`).toBe(
        true,
      );
      const product = new Float64Array(16);
      multiplyAffine(steps.parentWorld, 0, steps.local, 0, product, 0);
      expect(equal(product, world.subarray(16 * j, 16 * j + 16)), `W of joint ${j} at ${time}`).toBe(true);
      expect(equal(steps.world, product)).toBe(true);
    });
  }
}
