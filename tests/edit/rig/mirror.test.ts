/** The mirrored hierarchy moves as the mirror image of the original, whatever its joints are. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { mirrorJoint } from '../../../src/edit/commands/rig.ts';
import { mirroredMotion } from '../../../src/edit/rig/mirrored-motion.ts';
import { mirroredName } from '../../../src/edit/rig/names.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { jointMotion } from '../../../src/evaluate/motions.ts';
import { AXIS_LETTERS } from '../../../src/model/skeleton/dof-axis.ts';
import { firstDofs, restPose } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Joint, Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { diceOf, randomBvhMotion, randomMotion, randomValue, seeds } from './random-rig.ts';

const EXACT = 1e-12;
/** Of places, in units of a character that is a few of them large. */
const NEAR = 1e-9;

const mirrors = fc.constantFrom(0, 1, 2);

function jointOf(motion: Motion, name: string, parent: number, more: Partial<Joint> = {}): Joint {
  const dofs = dofsOf(motion);
  return joint(parent, {
    name,
    motion,
    limits: dofs.map(() => ({ min: -2, max: 1 })),
    pose: dofs.map(({ rest }) => rest),
    ...more,
  });
}

/** M · m · M, with M = −1 at one axis. */
function reflectedMatrix(m: Float64Array, across: number): Float64Array {
  return m.map((value, k) => ((k % 4 === across) !== (k >> 2 === across) ? -value : value));
}

function farthest(a: Float64Array, b: Float64Array): number {
  return a.reduce((most, value, i) => Math.max(most, Math.abs(value - b[i])), 0);
}

describe('mirroredMotion', () => {
  it('mirroredMotion is M · J(φ) · M for every kind of joint', () => {
    fc.assert(
      fc.property(seeds, mirrors, (seed, across) => {
        const dice = diceOf(seed);
        const motion = dice.is(0.2) ? randomBvhMotion(dice, 'replace') : randomMotion(dice);
        const values = Float64Array.from(dofsOf(motion), ({ rest }) => randomValue(dice, rest));
        const { motion: other, signs } = mirroredMotion(motion, across);
        const [a, b] = [new Float64Array(16), new Float64Array(16)];
        jointMotion(motion).write(values, 0, a, 0);
        jointMotion(other).write(
          values.map((value, d) => value * signs[d]),
          0,
          b,
          0,
        );
        expect(farthest(reflectedMatrix(a, across), b)).toBeLessThan(EXACT);
      }),
      { numRuns: 200 },
    );
  });

  it('mirroredMotion keeps the axis direction of an existing joint, and negates its DOF', () => {
    const hinge: Motion = { kind: 'hinge', axis: [0, 0, 1] };
    expect(mirroredMotion(hinge, 0)).toEqual({ motion: { kind: 'hinge', axis: [0, 0, -1] }, signs: [1] });
    expect(mirroredMotion(hinge, 0, { kind: 'hinge', axis: [0, 0.1, 2] })).toEqual({ motion: hinge, signs: [-1] });
  });
});

/** A root, a body in the middle, and a leg of random joints on one side. */
function figure(seed: number, across: number): Skeleton {
  const dice = diceOf(seed);
  const any = () => (dice.is(0.15) ? randomBvhMotion(dice, 'add') : randomMotion(dice));
  const inMiddle = [0.5, 1, 0.25].map((v, k) => (k === across ? 0 : v));
  const side = [0.5, -0.5, 0.75] as const;
  return {
    name: 'hero',
    joints: [
      jointOf({ kind: 'ball', order: 'xyz' }, 'root', -1, { offset: [0, 3, 0] }),
      jointOf({ kind: 'ball', order: 'zyx' }, 'body', 0, { offset: [inMiddle[0], inMiddle[1], inMiddle[2]] }),
      jointOf(any(), 'hip_l', 1, { offset: side, box: { min: [0, 0, 0], max: [1, 2, 3] } }),
      jointOf(any(), 'knee_l', 2, { offset: [0.25, -1, 0.5], endSites: [[0.1, 0.2, 0.3]] }),
      jointOf(any(), 'foot_l', 3, { offset: [0.1, -1, 0.25] }),
      jointOf(any(), 'toe_l', 2, { offset: [-0.1, -0.5, 0.25] }),
    ],
  };
}

const mirrorOf = (skeleton: Skeleton, index: number, across: number) => {
  const document = documentOf(character({ skeleton }));
  const args = { characterId: 'c1', joint: index, across: AXIS_LETTERS[across] };
  return { document, next: documentIn(mirrorJoint.run(document, args)) };
};

const skeletonIn = ({ characters: [{ skeleton }] }: ReturnType<typeof mirrorOf>['next']): Skeleton => {
  if (!skeleton) throw new Error('no skeleton');
  return skeleton;
};

describe('rig.mirror', () => {
  it('rig.mirror makes a hierarchy that is the mirror image in every mirrored pose', () => {
    fc.assert(
      fc.property(seeds, mirrors, (seed, across) => {
        const before = figure(seed, across);
        const after = skeletonIn(mirrorOf(before, 2, across).next);
        expect(after.joints.map(({ name }) => name)).toEqual([
          ...['root', 'body', 'hip_l', 'knee_l', 'foot_l', 'toe_l'],
          ...['hip_r', 'knee_r', 'foot_r', 'toe_r'],
        ]);
        const dice = diceOf(seed + 1);
        const first = firstDofs(after);
        const pose = Float64Array.from(restPose(after, 0));
        for (let j = 2; j < 6; j++) {
          const { motion } = after.joints[j];
          const { signs } = mirroredMotion(motion, across);
          dofsOf(motion).forEach(({ rest }, d) => {
            const value = randomValue(dice, rest);
            pose[first[j] + d] = value;
            pose[first[j + 4] + d] = value * signs[d];
          });
        }
        const world = new Float64Array(16 * after.joints.length);
        worldMatrices(compileSkeleton(after), pose, world);
        // The plane runs through the root, which is at 0 3 0.
        for (let o = 13; o < world.length; o += 16) world[o] -= 3;
        for (let j = 2; j < 6; j++) {
          const own = reflectedMatrix(world.slice(16 * j, 16 * j + 16), across);
          expect(farthest(own, world.slice(16 * (j + 4), 16 * (j + 5)))).toBeLessThan(NEAR);
        }
      }),
      { numRuns: 100 },
    );
  });

  it('writes offsets with as many digits as the original ones', () => {
    const ball = { kind: 'ball', order: 'xyz' } as const;
    const joints = (x: number, arm: number) => [
      jointOf(ball, 'root', -1, {}),
      jointOf(ball, 'body', 0, { offset: [x, 1, 0] }),
      jointOf(ball, 'arm_l', 1, { offset: [arm, 0.3, 0.1] }),
    ];
    const mirroredArm = (x: number, arm: number) =>
      skeletonIn(mirrorOf({ name: 'hero', joints: joints(x, arm) }, 2, 0).next).joints[3].offset;
    const long = 0.47259999999999996;
    expect(mirroredArm(0, long)).toEqual([-long, 0.3, 0.1]);
    // Its parent is slightly displaced.
    expect(-0.4726 - 0.04).not.toBe(-0.5126);
    expect(mirroredArm(0.02, 0.4726)).toEqual([-0.5126, 0.3, 0.1]);
    expect(mirroredArm(0.02, 0.0000001)).toEqual([-0.0400001, 0.3, 0.1]);
  });

  it('rig.mirror makes no −0 of 0, which files would contain', () => {
    const ball = { kind: 'ball', order: 'xyz' } as const;
    const joints = [jointOf(ball, 'root', -1, {}), jointOf(ball, 'hip_l', 0, { offset: [1, 0, 0] })];
    const { characters } = mirrorOf({ name: 'hero', joints }, 1, 0).next;
    const [{ pose, skeleton }] = characters;
    const numbers = [...pose, ...(skeleton?.joints.flatMap((j) => [...j.offset, ...j.pose]) ?? [])];
    expect(numbers.length).toBeGreaterThan(12);
    expect(numbers.filter((x) => Object.is(x, -0))).toEqual([]);
  });

  it('changes nothing if both sides match, and updates them if they do not', () => {
    fc.assert(
      fc.property(seeds, mirrors, (seed, across) => {
        const both = skeletonIn(mirrorOf(figure(seed, across), 2, across).next);
        const again = mirrorOf(both, 2, across);
        expect(again.next).toBe(again.document);
        const off = {
          ...both,
          joints: both.joints.map((j) => (j.name === 'knee_r' ? { ...j, offset: [9, 9, 9] as const } : j)),
        };
        const mended = skeletonIn(mirrorOf(off, 2, across).next);
        expect(mended.joints.map(({ offset }) => offset)).toEqual(both.joints.map(({ offset }) => offset));
        expect(mended.joints.length).toBe(both.joints.length);
      }),
      { numRuns: 30 },
    );
  });

  it('mirrors limits, boxes, End Sites and file poses', () => {
    const leg = jointOf({ kind: 'ball', order: 'xyz' }, 'leg_l', 0, {
      offset: [0.5, 0, 0],
      box: { min: [0, -1, -2], max: [0.5, 0, 2] },
      limits: [0, 1, 2].map((k) => ({ min: -k - 1, max: k })),
      pose: [0.1, 0.2, 0.3],
      endSites: [[0.25, -1, 0]],
    });
    const made = skeletonIn(mirrorOf({ name: 'x', joints: [joint(-1, { name: 'root' }), leg] }, 1, 0).next).joints[2];
    expect(made).toEqual({
      ...leg,
      name: 'leg_r',
      offset: [-0.5, 0, 0],
      box: { min: [-0.5, -1, -2], max: [0, 0, 2] },
      limits: [
        { min: -1, max: 0 },
        { min: -1, max: 2 },
        { min: -2, max: 3 },
      ],
      pose: [0.1, -0.2, -0.3],
      endSites: [[-0.25, -1, 0]],
    });
  });

  it('mirrors couples within the branch and to the middle', () => {
    const ball: Motion = { kind: 'ball', order: 'xyz' };
    const skeleton: Skeleton = {
      name: 'x',
      joints: [
        jointOf(ball, 'root', -1),
        jointOf(ball, 'wing_l', 0, {
          offset: [1, 0, 0],
          couples: [{ dof: 'ry', joint: 0, follows: 'rx', gain: 2, offset: 0.5 }],
        }),
        jointOf(ball, 'tip_l', 1, { couples: [{ dof: 'rz', joint: 1, follows: 'ry', gain: 3, offset: 0.25 }] }),
      ],
    };
    const { joints } = skeletonIn(mirrorOf(skeleton, 1, 0).next);
    expect(joints[3].couples).toEqual([{ dof: 'ry', joint: 0, follows: 'rx', gain: -2, offset: -0.5 }]);
    expect(joints[4].couples).toEqual([{ dof: 'rz', joint: 3, follows: 'ry', gain: 3, offset: -0.25 }]);
  });

  it('refuses the root, what in the mirror plane, and what hangs on a side that has no other yet', () => {
    const skeleton = figure(1, 0);
    expect(() => mirrorOf(skeleton, 0, 0)).toThrow('root, which has no other side');
    expect(() => mirrorOf(skeleton, 3, 0)).toThrow('Mirror hip_l first');
    const spine = { name: 'x', joints: [joint(-1), joint(0)] };
    expect(() => mirrorOf(spine, 1, 0)).toThrow('in the mirror plane');
    expect(() =>
      mirrorJoint.run(documentOf(character()), { characterId: 'c1', joint: 1, across: 'w' as never }),
    ).toThrow('must be one of "x", "y", "z"');
  });

  it('rig.mirror makes a second joint of one whose name has no side, and then distinguishes the two by position', () => {
    const skeleton = { name: 'x', joints: [joint(-1), joint(0, { name: 'fin', offset: [0.5, 1, 0] })] };
    const both = skeletonIn(mirrorOf(skeleton, 1, 0).next);
    expect(both.joints.map(({ name, offset }) => [name, ...offset])).toEqual([
      ['joint0', 0, 1, 0],
      ['fin', 0.5, 1, 0],
      ['fin_2', -0.5, 1, 0],
    ]);
    const again = mirrorOf(both, 1, 0);
    expect(again.next).toBe(again.document);
  });
});

describe('mirroredName', () => {
  it.each([
    ['hip_l', 'hip_r'],
    ['hip_03_r', 'hip_03_l'],
    ['LeftUpLeg', 'RightUpLeg'],
    ['mixamorig:LeftHandThumb2', 'mixamorig:RightHandThumb2'],
    ['L_Arm', 'R_Arm'],
    ['arm.L', 'arm.R'],
    ['upperleg01.R', 'upperleg01.L'],
    ['lShldr', 'rShldr'],
    ['lfemur', 'rfemur'],
    ['RIGHT_KNEE', 'LEFT_KNEE'],
    ['left {arm}', 'right {arm}'],
    ['spine', undefined],
    ['label', undefined],
    ['roll', undefined],
    ['', undefined],
  ])('of %s is %s', (name, other) => {
    expect(mirroredName(name)).toBe(other);
    if (other) expect(mirroredName(other)).toBe(name);
  });
});
