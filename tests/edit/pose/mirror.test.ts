import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { counterpartOf, mirroredPose } from '../../../src/edit/pose/mirror.ts';
import { reflectionOf } from '../../../src/edit/pose/reflection.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { filePose, firstDofs, restPose } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { anyMotion, middleMotion, rigOf, symmetricRig, turningMotion } from './rigs.ts';

/** Signs alone change nothing but the last bits of what is turned in the world. */
const EXACT = 1e-9;
/** Fitted joints come within a step of Levenberg and Marquardt's of the very best. */
const FITTED = 1e-6;
/** Rotations that are not the pose's own have passed through quaternions twice. */
const TWICE = 1e-7;

function worldOf(skeleton: Skeleton, dofs: ArrayLike<number>): Float64Array {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, Float64Array.from(dofs), world);
  return world;
}

/** M·W·M, with the reflection across x. */
function acrossX(world: Float64Array, j: number): number[] {
  return Array.from({ length: 16 }, (_, k) => {
    const isFlipped = (k % 4 === 0) !== (Math.floor(k / 4) === 0);
    return world[16 * j + k] * (isFlipped ? -1 : 1);
  });
}

function mostApart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.max(0, ...Array.from(a, (v, i) => Math.abs(v - b[i])));
}

/** A pose of any DOFs, away from rest by less than a right angle, or a unit of length. */
function somePose(skeleton: Skeleton, seeds: readonly number[], reach = 1.2): number[] {
  return restPose(skeleton, 0).map((rest, d) => rest + (seeds[d % seeds.length] - 0.5) * reach * (d % 2 ? 1 : 0.7));
}

const seeds = fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 11, maxLength: 11 });

describe('a mirrored pose', () => {
  it('a mirrored pose is the reflected one in the world, for every kind of joint', () => {
    fc.assert(
      fc.property(symmetricRig(anyMotion, middleMotion), seeds, ({ skeleton, partner }, values) => {
        const pose = somePose(skeleton, values);
        const { dofs } = mirroredPose(skeleton, pose, false, { way: 'swap' });
        const [before, after] = [worldOf(skeleton, pose), worldOf(skeleton, dofs)];
        partner.forEach((other, j) => {
          const got = after.subarray(16 * other, 16 * other + 16);
          expect(mostApart(got, acrossX(before, j))).toBeLessThan(EXACT * (1 + Math.hypot(...got)));
        });
      }),
      { numRuns: 80 },
    );
  });

  it('a mirrored pose is restored exactly when mirrored again', () => {
    fc.assert(
      fc.property(symmetricRig(anyMotion, middleMotion), seeds, ({ skeleton }, values) => {
        const pose = somePose(skeleton, values);
        const once = mirroredPose(skeleton, pose, false, { way: 'swap' }).dofs;
        const twice = mirroredPose(skeleton, once, false, { way: 'swap' }).dofs;
        expect(mostApart(twice, pose)).toBe(0);
      }),
      { numRuns: 60 },
    );
  });

  it('a mirrored pose keeps the reference pose', () => {
    fc.assert(
      fc.property(symmetricRig(anyMotion, middleMotion), ({ skeleton }) => {
        const { reference } = reflectionOf(skeleton);
        expect(mostApart(mirroredPose(skeleton, reference, false, { way: 'swap' }).dofs, reference)).toBe(0);
      }),
    );
  });

  it('a mirrored pose stays within enforced limits, and keeps links', () => {
    fc.assert(
      fc.property(symmetricRig(turningMotion), seeds, ({ skeleton }, values) => {
        const tight = {
          ...skeleton,
          joints: skeleton.joints.map((j, i) => ({
            ...j,
            limits: j.limits.map((_, d) => ({ min: -0.2 - 0.05 * ((i + d) % 5), max: 0.3 + 0.1 * ((i * d) % 3) })),
          })),
        };
        const compiled = compileSkeleton(tight);
        const pose = Float64Array.from(somePose(tight, values, 4));
        applyConstraints(compiled, pose, true);
        const { dofs } = mirroredPose(tight, pose, true, { way: 'swap' });
        const settled = dofs.slice();
        applyConstraints(compiled, settled, true);
        expect(settled).toEqual(dofs);
      }),
      { numRuns: 30 },
    );
  });

  it('a mirrored pose turns as nearly as it can where the other side has joints of other kinds', () => {
    const ball: Motion = { kind: 'ball', order: 'xyz' };
    const { skeleton } = rigOf(
      [{ motion: ball, offset: [0, 0, 0] }],
      [
        {
          at: 0,
          joints: [
            { motion: ball, offset: [1, 0, 0] },
            { motion: ball, offset: [1, 0, 0] },
          ],
        },
      ],
      (side, index) => `${side} ${index}`,
    );
    const asQuaternion = (order: Motion): Skeleton => ({
      ...skeleton,
      joints: skeleton.joints.map((j) =>
        j.name.startsWith('right') ? { ...j, motion: order, pose: dofsOf(order).map(({ rest }) => rest) } : j,
      ),
    });
    for (const motion of [
      { kind: 'quaternion' },
      { kind: 'ball', order: 'zxy' },
      { kind: 'ball', order: 'yzx' },
    ] as const) {
      const mixed = asQuaternion(motion);
      const pose = somePose(mixed, [0.9, 0.2, 0.7, 0.4, 0.1], 2);
      const { dofs } = mirroredPose(mixed, pose, false, { way: 'swap' });
      const [before, after] = [worldOf(mixed, pose), worldOf(mixed, dofs)];
      for (const j of [1, 2, 3, 4]) {
        const other = counterpartOf(mixed, j) ?? -1;
        expect(mostApart(after.subarray(16 * other, 16 * other + 16), acrossX(before, j))).toBeLessThan(FITTED);
      }
      const twice = mirroredPose(mixed, dofs, false, { way: 'swap' }).dofs;
      expect(mostApart(worldOf(mixed, twice), before)).toBeLessThan(TWICE);
    }
  });

  it('a mirrored pose is made up for below a joint that can not follow', () => {
    const free: Motion = { kind: 'ball', order: 'xyz' };
    const { skeleton } = rigOf(
      [{ motion: free, offset: [0, 0, 0] }],
      [
        {
          at: 0,
          joints: [
            { motion: free, offset: [1, 0, 0] },
            { motion: free, offset: [1, 0, 0] },
          ],
        },
      ],
      (side, index) => `${side} ${index}`,
    );
    const joints = skeleton.joints.map((j) =>
      j.name === 'right 0' ? { ...j, limits: j.limits.map(() => ({ min: -0.1, max: 0.1 })) } : j,
    );
    const limited = { ...skeleton, joints };
    const [upper, lower] = ['left 0', 'left 1'].map((name) => joints.findIndex((j) => j.name === name));
    const pose = restPose(limited, 0);
    const first = firstDofs(limited);
    pose[first[upper] + 2] = 0.8;
    pose[first[lower] + 2] = 0.3;
    const { dofs } = mirroredPose(limited, pose, true, { way: 'swap' });
    const [before, after] = [worldOf(limited, pose), worldOf(limited, dofs)];
    const other = counterpartOf(limited, lower) ?? -1;
    // Its turn is right although that above is not.
    const turn = (m: ArrayLike<number>, o: number) => [0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => m[o + k]);
    expect(mostApart(turn(after, 16 * other), turn(acrossX(before, lower), 0))).toBeLessThan(FITTED);
    const above = counterpartOf(limited, upper) ?? -1;
    expect(mostApart(turn(after, 16 * above), turn(acrossX(before, upper), 0))).toBeGreaterThan(0.1);
  });

  it('moves the root to the other side of its rest position', () => {
    const { skeleton } = rigOf([{ motion: { kind: 'ball', order: 'xyz' }, offset: [0, 0, 0] }], [], () => 'root');
    const { dofs } = mirroredPose(skeleton, [2, 3, 4, 0.1, 0.2, 0.3], false, { way: 'swap' });
    expect([...dofs]).toEqual([-2, 3, 4, 0.1, -0.2, -0.3]);
  });
});

describe('a character that is mirrored in place', () => {
  const stays = { way: 'swap', stays: true } as const;
  const turningRig = symmetricRig(anyMotion, turningMotion).filter(({ skeleton }) => skeleton.joints.length > 1);
  /** Where the root's sides lie, in the ground: cosine and sine. */
  const sidesOf = (world: Float64Array) => {
    const length = Math.hypot(world[0], world[2]);
    return [world[0] / length, world[2] / length];
  };
  /** Fits of fits; lengths here are a few units. */
  const TWICE_FITTED = 1e-6;

  it('a character that is mirrored in place keeps its position and heading, and is otherwise the mirrored character', () => {
    fc.assert(
      fc.property(turningRig, seeds, ({ skeleton }, values) => {
        const pose = somePose(skeleton, values);
        const kept = worldOf(skeleton, mirroredPose(skeleton, pose, false, stays).dofs);
        const carried = worldOf(skeleton, mirroredPose(skeleton, pose, false, { way: 'swap' }).dofs);
        const before = worldOf(skeleton, pose);
        expect(mostApart(kept.subarray(12, 15), before.subarray(12, 15))).toBeLessThan(FITTED);
        // Lying on its side it has another heading.
        const isSteep = Math.hypot(before[0], before[2]) < 0.4;
        if (!isSteep) expect(mostApart(sidesOf(kept), sidesOf(before))).toBeLessThan(FITTED);
        for (let j = 0; j < skeleton.joints.length; j++) {
          const away = (world: Float64Array) => [0, 1, 2].map((k) => world[16 * j + 12 + k] - world[12 + k]);
          const [[x0, y0, z0], [x1, y1, z1]] = [away(kept), away(carried)];
          expect(y0).toBeCloseTo(y1, 5);
          expect(Math.hypot(x0, z0)).toBeCloseTo(Math.hypot(x1, z1), 5);
        }
      }),
      { numRuns: 60 },
    );
  });

  it('a character that is mirrored in place is restored when mirrored again', () => {
    fc.assert(
      fc.property(turningRig, seeds, ({ skeleton }, values) => {
        const pose = somePose(skeleton, values);
        const once = mirroredPose(skeleton, pose, false, stays).dofs;
        const twice = mirroredPose(skeleton, once, false, stays).dofs;
        expect(mostApart(worldOf(skeleton, twice), worldOf(skeleton, pose))).toBeLessThan(TWICE_FITTED);
      }),
      { numRuns: 60 },
    );
  });

  const ball: Motion = { kind: 'ball', order: 'xyz' };
  const part = { motion: ball, offset: [0, 1, 0] as Vec3 };
  const figure = rigOf([part], [{ at: 0, joints: [part, part] }], (side, i) =>
    side === 'middle' ? 'hip' : `leg_${i}_${side[0]}`,
  ).skeleton;

  it('a character that is mirrored in place is mirrored exactly if it faces along the plane, however it leans', () => {
    const pose = somePose(figure, [0.1, 0.9, 0.4, 0.7, 0.2]);
    pose[4] = 0;
    const { dofs } = mirroredPose(figure, pose, false, stays);
    const carried = mirroredPose(figure, pose, false, { way: 'swap' }).dofs;
    expect([...dofs]).toEqual([...pose.slice(0, 3), ...carried.slice(3)]);
    expect([...mirroredPose(figure, dofs, false, stays).dofs]).toEqual(pose);
  });

  it('walking in a circle, leans to its other side and continues on the same path', () => {
    // Turned by 2 about y, leaning forward by 0.2: Rz·Ry·Rx.
    const pose = restPose(figure, 0);
    const turn = (x: number, y: number) => [-1.1, 0.9, 2.5, x, y, 0];
    pose.splice(0, 6, ...turn(0.2, 2));
    const { dofs } = mirroredPose(figure, pose, false, stays);
    expect(mostApart(dofs.subarray(0, 6), turn(0.2, 2))).toBeLessThan(FITTED);
    const up = { ...stays, up: 'z' } as const;
    expect(mirroredPose(figure, pose, false, up).dofs.subarray(0, 3)).toEqual(Float64Array.of(-1.1, 0.9, 2.5));
  });

  it('a character that is mirrored in place keeps its place by its own DOFs too, as motion capture has it', () => {
    const motion: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'add' };
    const captured = rigOf([{ motion, offset: [0, 0, 0] }], [{ at: 0, joints: [part, part] }], (side, i) =>
      side === 'middle' ? 'hip' : `leg_${i}_${side[0]}`,
    ).skeleton;
    const pose = restPose(captured, 0);
    const hip = [3, 1, -2, 0.1, 0.2, 0.9];
    pose.splice(0, 6, ...hip);
    const { dofs } = mirroredPose(captured, pose, false, stays);
    expect(mostApart(dofs.subarray(0, 3), hip.slice(0, 3))).toBeLessThan(FITTED);
    const sides = [pose, dofs].map((of) => sidesOf(worldOf(captured, of)));
    expect(mostApart(sides[0], sides[1])).toBeLessThan(FITTED);
  });
});

describe('counterparts', () => {
  const chain = (names: readonly string[]) => {
    const offsets: readonly Vec3[] = [
      [0, 0, 0],
      [0, 1, 0],
      [1, 0, 0],
      [1, -1, 0],
      [-1, 0, 0],
      [-1, -1, 0],
    ];
    const parents = [-1, 0, 1, 2, 1, 4];
    const joints = parents.map((parent, j) => joint(parent, { name: names[j], offset: offsets[j] }));
    return [...reflectionOf({ name: 's', joints }).partner];
  };

  it.each([
    [['hips', 'chest', 'LeftArm', 'LeftHand', 'RightArm', 'RightHand']],
    [['hips', 'chest', 'L_arm', 'L_hand', 'R_arm', 'R_hand']],
    [['hips', 'chest', 'arm.L', 'hand.L', 'arm.R', 'hand.R']],
    [['hips', 'chest', 'lArm', 'lHand', 'rArm', 'rHand']],
    [['hips', 'chest', 'arm_01_l', 'arm_02_l', 'arm_01_r', 'arm_02_r']],
    [['hips', 'chest', 'lhumerus', 'lradius', 'rhumerus', 'rradius']],
    [['m:Hips', 'm:Chest', 'm:LeftArm', 'm:LeftHand', 'm:RightArm', 'm:RightHand']],
    // No sides in the names below: they go with what is above.
    [['hips', 'chest', 'arm left', 'hand', 'arm right', 'hand']],
    [['a', 'b', 'c', 'd', 'e', 'f']],
    [['', '', '', '', '', '']],
  ])('counterparts are found for %j', (names) => {
    expect(chain(names)).toEqual([0, 1, 4, 5, 2, 3]);
  });

  it('counterparts are found by shape if all offsets of one side are reflections of the other’s, for any rig', () => {
    fc.assert(
      fc.property(symmetricRig(turningMotion), ({ skeleton, partner }) => {
        const bare = { ...skeleton, joints: skeleton.joints.map((j) => ({ ...j, name: '' })) };
        const { partner: found, normal } = reflectionOf(bare);
        // Limbs that end where they begin have nothing to be told by, and a plane of limbs has two planes of symmetry.
        fc.pre(normal[0] === 1);
        const points = worldOf(skeleton, restPose(skeleton, 0));
        found.forEach((other, j) => {
          if (other < 0 || other === partner[j]) return;
          const at = (i: number) => [12, 13, 14].map((k) => points[16 * i + k]);
          // Another one may do as well, but none that is elsewhere by much.
          expect(mostApart(at(other), at(partner[j]))).toBeLessThan(2);
        });
      }),
    );
  });

  it('counterparts do not exist for a joint of one side if the other’s name is missing', () => {
    const joints = [joint(-1, { name: 'hips' }), joint(0, { name: 'sword_l', offset: [1, 0, 0] })];
    expect([...reflectionOf({ name: 's', joints }).partner]).toEqual([0, -1]);
    const pose = [0, 0, 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    const { dofs, alone } = mirroredPose({ name: 's', joints }, pose, false, { way: 'swap' });
    expect([...dofs.subarray(6)]).toEqual([0.4, 0.5, 0.6]);
    expect(alone).toEqual([1]);
  });
});

describe('one side’s pose on the other', () => {
  const ball: Motion = { kind: 'ball', order: 'xyz' };
  const { skeleton, partner } = rigOf(
    [
      { motion: ball, offset: [0, 0, 0] },
      { motion: ball, offset: [0, 1, 0] },
    ],
    [
      {
        at: 1,
        joints: [
          { motion: ball, offset: [1, 0, 0] },
          { motion: ball, offset: [1, 0, 0] },
        ],
      },
    ],
    (side, index) => `${side} ${index}`,
  );
  const first = firstDofs(skeleton);
  const arm = skeleton.joints.findIndex(({ name }) => name.startsWith('left'));
  const pose = somePose(skeleton, [0.9, 0.3, 0.6, 0.1, 0.8], 2);

  it('leaves its own side, and everything above, unchanged', () => {
    const { dofs, joints } = mirroredPose(skeleton, pose, false, { joint: arm, way: 'toOther' });
    expect(joints).toEqual([partner[arm], partner[arm + 1]].sort((a, b) => a - b));
    pose.forEach((value, d) => {
      const isOther = joints.some((j) => d >= first[j] && d < first[j] + 3);
      if (!isOther) expect(dofs[d]).toBe(value);
    });
  });

  it('one side’s pose on the other looks as on its own side, seen from the joint above both', () => {
    const { dofs } = mirroredPose(skeleton, pose, false, { joint: arm, way: 'toOther' });
    for (const j of [arm, arm + 1]) {
      const [x, y, z] = [...dofs.subarray(first[partner[j]], first[partner[j]] + 3)];
      expect([x, -y, -z]).toEqual(pose.slice(first[j], first[j] + 3));
    }
  });

  it('one side’s pose on the other swaps a branch alone', () => {
    const { dofs } = mirroredPose(skeleton, pose, false, { joint: arm, way: 'swap' });
    const twice = mirroredPose(skeleton, dofs, false, { joint: arm, way: 'swap' }).dofs;
    expect([...twice]).toEqual(pose);
    expect([...dofs.subarray(0, first[arm])]).toEqual(pose.slice(0, first[arm]));
    const whole = mirroredPose(skeleton, pose, false, { way: 'swap' }).dofs;
    expect([...dofs.subarray(first[arm])]).toEqual([...whole.subarray(first[arm])]);
  });
});

describe('joints with axes of their own', () => {
  it('joints with axes of their own are mirrored by offsets, along the bone on one side and against it on the other', () => {
    const bvh: Motion = { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' };
    const place: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' };
    const none = (motion: Motion) => ({
      motion,
      pose: dofsOf(motion).map(() => 0),
      limits: dofsOf(motion).map(() => ({ min: -1e5, max: 1e5 })),
    });
    const joints = [
      joint(-1, { name: 'Hips', ...none(place) }),
      joint(0, { name: 'LeftLeg', offset: [1, 0, 0], ...none(bvh) }),
      joint(1, { name: 'LeftFoot', offset: [3, 0, 0], ...none(bvh) }),
      joint(0, { name: 'RightLeg', offset: [-1, 0, 0], ...none(bvh) }),
      joint(3, { name: 'RightFoot', offset: [3, 0, 0], ...none(bvh) }),
    ];
    const skeleton: Skeleton = { name: 's', joints };
    // Hanging down on both sides, each by its own way to turn; and the left one forward.
    const pose = filePose(skeleton, 0);
    const first = firstDofs(skeleton);
    pose[first[1]] = -Math.PI / 2;
    pose[first[3]] = -Math.PI / 2;
    pose[first[1] + 2] = 0.4;
    const { dofs } = mirroredPose(skeleton, pose, false, { way: 'swap' });
    const [before, after] = [worldOf(skeleton, pose), worldOf(skeleton, dofs)];
    const at = (world: Float64Array, j: number) => [...world.subarray(16 * j + 12, 16 * j + 15)];
    const [x, y, z] = at(before, 2);
    expect(mostApart(at(after, 4), [-x, y, z])).toBeLessThan(FITTED);
    const twice = mirroredPose(skeleton, dofs, false, { way: 'swap' }).dofs;
    expect(mostApart(worldOf(skeleton, twice), before)).toBeLessThan(TWICE);
  });
});

describeShared('mirroring the reference characters', () => {
  it.each(['cse169/wasp.skel', 'cse169/dragon.skel', 'axis-skel/human.axskel', 'axis-skel/hexapod.axskel'])(
    '%s',
    (name) => {
      const skeleton = readSkel(sharedBytes(`data/${name}`), name).value?.[0] ?? { name: '', joints: [] };
      const pose = filePose(skeleton, 0).map((v, d) => v + 0.3 * Math.sin(7 * d + 1));
      const { dofs } = mirroredPose(skeleton, pose, false, { way: 'swap' });
      const { normal, partner, size } = reflectionOf(skeleton);
      const [before, after] = [worldOf(skeleton, pose), worldOf(skeleton, dofs)];
      partner.forEach((other, j) => {
        expect(other).toBeGreaterThanOrEqual(0);
        const p = [0, 1, 2].map((k) => before[16 * j + 12 + k]);
        const beyond = 2 * (p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2]);
        const mirrored = p.map((v, k) => v - beyond * normal[k]);
        expect(mostApart(mirrored, after.subarray(16 * other + 12, 16 * other + 15))).toBeLessThan(EXACT * size);
      });
    },
  );
});
