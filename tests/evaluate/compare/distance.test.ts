import { describe, expect, it } from 'vitest';
import { commonFrames, type Distances, measureDistances } from '../../../src/evaluate/compare/distance.ts';
import { matchJoints } from '../../../src/evaluate/compare/joint-match.ts';
import type { Alignment } from '../../../src/evaluate/compare/posed-joints.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { zxyAngles } from '../../../src/evaluate/rotations/euler-angles.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { SAMPLED, type Take } from '../../../src/model/takes/take.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { sharedCaptures } from '../../helpers/bvh-files.ts';
import { captured } from '../../helpers/mocap.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';

/** Moved along x by the value of its first channel; joints one above the other. */
function moving(values: readonly number[], more: Partial<Character> = {}): Character {
  return character({ skeleton: skeleton(3), takes: [takeOfValues('take', values)], shownTake: 0, ...more });
}

function measured(a: Character, b: Character, alignment: Alignment = 'world', framesPerSecond = 10): Distances {
  if (!a.skeleton || !b.skeleton) throw new Error('both need a skeleton');
  const match = matchJoints(a.skeleton, b.skeleton);
  const times = commonFrames(a, b, framesPerSecond, match.first.length);
  if (!times) throw new Error('no time in common');
  const work = measureDistances(a, b, match, times, alignment);
  for (;;) {
    const step = work.next();
    if (step.done) return step.value;
  }
}

describe('the distance of two takes', () => {
  it('the distance of two takes is 0 between a take and itself', () => {
    const { values, mean, most, frameCount } = measured(moving([1]), moving([1]));
    expect(frameCount).toBe(11);
    expect([...values, ...mean, ...most].every((d) => d === 0)).toBe(true);
  });

  it('the distance of two takes is how far each joint is from its partner in the scene', () => {
    const d = measured(moving([1, 0, 0]), moving([4, 4, 0]));
    expect([...d.values]).toEqual(new Array(33).fill(5));
    expect([...d.jointMean, ...d.jointMost, ...d.jointRms]).toEqual(new Array(9).fill(5));
  });

  it('counts where the characters stand, and in which unit they are', () => {
    const inCentimetres = { space: { up: 'y', unit: 'centimetres', lift: 0 } } as const;
    const a = moving([100], inCentimetres);
    const b = moving([1], { placements: [{ ...DEFAULT_PLACEMENT, position: [0, 0, 2] }] });
    // Joints are 1 cm above each other in one, and 1 m in the other: whoever says nothing is taken as it is.
    const d = measured(a, b);
    expect(d.values[0]).toBeCloseTo(Math.hypot(2, 0.99), 6);
    expect(d.values[d.frameCount]).toBeCloseTo(Math.hypot(2, 1.98), 6);
  });

  it('leaves out where the root is, and how it is turned, where asked to', () => {
    const turned = [3, 0, 1, 0, 0.7, 0];
    const [a, b] = [moving([]), moving(turned)];
    expect(measured(a, b, 'world').jointMost[0]).toBeGreaterThan(3);
    expect(measured(a, b, 'root').jointMost[0]).toBe(0);
    // A chain upright on its root: a turn about y leaves it alone, one about x does not.
    const [c, d] = [moving([]), moving([3, 0, 1, 0.7, 0, 0])];
    expect(measured(c, d, 'root').jointMost[2]).toBeGreaterThan(0.5);
    expect(measured(c, d, 'turned').jointMost[2]).toBeCloseTo(0, 6);
  });

  it('the distance of a take and itself, moved and turned as a whole, is 0 relative to a root that stays at the origin', () => {
    const own = {
      name: 'studio',
      joints: [
        bvhJoint(-1, ['tx', 'ty', 'tz']),
        bvhJoint(0, ['tx', 'ty', 'tz', 'ry', 'rx']),
        bvhJoint(1, ['rx'], { offset: [1, -8, 0] }),
        bvhJoint(1, ['rx'], { offset: [-1, -8, 0] }),
      ],
    };
    /** Walks 50 to where it turns `heading` degrees from z, from x on. */
    const walk = (x: number, heading: number, id: string) => {
      const [sin, cos] = [Math.sin((heading * Math.PI) / 180), Math.cos((heading * Math.PI) / 180)];
      const rows = Array.from({ length: 11 }, (_, f) => {
        const swing = 30 * Math.sin(f);
        return [0, 0, 0, x + 5 * f * sin, 9, 5 * f * cos, heading, f, swing, -swing];
      });
      const { skeleton: made, take } = captureOf(own, rows);
      if (!take) throw new Error('no take was made');
      return captured(made, take, { id });
    };
    const [a, b] = [walk(0, 0, 'a'), walk(30, 110, 'b')];
    expect(Math.max(...measured(a, b, 'world', 25).jointMost.subarray(1))).toBeGreaterThan(30);
    // The static root is the only joint that the walk leaves behind.
    expect(Math.max(...measured(a, b, 'root', 25).jointMost.subarray(2))).toBeGreaterThan(1);
    expect(Math.max(...measured(a, b, 'turned', 25).jointMost.subarray(1))).toBeLessThan(1e-5);
    const beside = walk(30, 0, 'beside');
    expect(Math.max(...measured(a, beside, 'root', 25).jointMost.subarray(1))).toBeLessThan(1e-5);
  });

  it('the distance of two takes is taken where both takes are, at the finer rate, each with its offset', () => {
    const sampled: Take = {
      ...takeOfValues('sampled', []),
      range: [0, 1],
      samples: {
        frameCount: 51,
        frameSeconds: 0.02,
        startSeconds: 0,
        firstChannel: 0,
        values: new Float64Array(51),
        scales: Float64Array.of(1),
        interpolation: 'linear',
      },
    };
    const a = moving([], { takes: [sampled], timeOffsetSeconds: 0.5 });
    const b = moving([0], { takes: [takeOfValues('keyed', [0], [0, 3])] });
    const times = commonFrames(a, b, 10, 3);
    expect(times?.startSeconds).toBeCloseTo(0, 12);
    expect(times?.frameSeconds).toBeCloseTo(0.02, 12);
    expect(times?.frameCount).toBe(26);
    expect(commonFrames(a, moving([], { timeOffsetSeconds: -9 }), 10, 3)).toBeUndefined();
    expect(commonFrames(a, { ...b, shownTake: -1 }, 10, 3)).toBeUndefined();
  });

  it('says of each joint how far it is in the mean and at most, and when', () => {
    const samples: Samples = {
      frameCount: 3,
      frameSeconds: 0.5,
      startSeconds: 0,
      firstChannel: 0,
      values: Float64Array.of(0, 6, 3),
      scales: Float64Array.of(1),
      interpolation: 'linear',
    };
    const ramp: Take = { name: 'ramp', range: [0, 1], channels: [SAMPLED], samples };
    const d = measured(moving([], { takes: [ramp] }), moving([0]), 'world', 2);
    expect([...d.values.subarray(0, d.frameCount)]).toEqual([0, 6, 3]);
    expect(d.jointMost[0]).toBe(6);
    expect(d.jointMostAt[0]).toBe(1);
    expect(d.jointMean[0]).toBe(3);
    expect(d.jointRms[0]).toBeCloseTo(Math.sqrt(15), 12);
  });
});

describeShared('the distance of a real take and itself', () => {
  it('a real take is at distance 0 from itself at the same offset, and at that of its motion at another', () => {
    const { value } = readBvh(sharedBytes('data/bvh/cmu-daz-pirouette.bvh'), 'pirouette.bvh');
    const capture = value?.[0];
    if (!capture?.take) throw new Error('the file has no motion');
    const { skeleton: own, take } = capture;
    const base = { skeleton: own, pose: filePose(own, 0), takes: [take], shownTake: 0 };
    const same = measured(character(base), character({ ...base, id: 'c2' }));
    expect(same.frameCount).toBe(take.samples?.frameCount);
    expect(Math.max(...same.jointMost)).toBe(0);
    const later = measured(character(base), character({ ...base, id: 'c2', timeOffsetSeconds: 0.25 }));
    expect(Math.max(...later.jointMost)).toBeGreaterThan(1);
    expect(later.match.first).toHaveLength(own.joints.length);
  });
  it('a real take whose root stays at the origin is at distance 0 from itself, moved and turned as a whole', () => {
    const [{ skeleton: own, take }] = sharedCaptures('bandai-namco-bow-normal.bvh');
    if (!take?.samples) throw new Error('the file has no motion');
    const { samples } = take;
    const compiled = compileSkeleton(own);
    const world = new Float64Array(16 * own.joints.length);
    const values = samples.values.slice();
    const count = samples.scales.length;
    const [sin, cos] = [Math.sin(2), Math.cos(2)];
    const matrix = new Float64Array(16);
    // The channels of the hips, 6 to 11: position, then angles of z, x and y in degrees.
    for (let row = 0; row < values.length; row += count) {
      worldMatrices(
        compiled,
        samples.values.subarray(row, row + count).map((v, c) => v * samples.scales[c]),
        world,
      );
      for (let column = 0; column < 3; column++) {
        const [x, y, z] = world.subarray(16 + 4 * column, 19 + 4 * column);
        matrix.set([cos * x + sin * z, y, cos * z - sin * x], 4 * column);
      }
      zxyAngles(matrix, 0, values, row + 9);
      for (let c = 9; c < 12; c++) values[row + c] /= samples.scales[c];
      const [x, y, z] = samples.values.subarray(row + 6, row + 9);
      values.set([cos * x + sin * z + 120, y, cos * z - sin * x - 40], row + 6);
    }
    const a = captured(own, take, { id: 'a' });
    const b = captured(own, { ...take, samples: { ...samples, values } }, { id: 'b' });
    expect(Math.min(...measured(a, b, 'world').jointMost.subarray(1))).toBeGreaterThan(100);
    expect(Math.max(...measured(a, b, 'turned').jointMost.subarray(1))).toBeLessThan(1e-3);
  });
});
