import { describe, expect, it } from 'vitest';
import { FloatPool } from '../../../src/dataset/float-pool.ts';
import { takeOf } from '../../../src/dataset/take.ts';
import { takeArrays } from '../../../src/dataset/take-arrays.ts';
import { jointMasses } from '../../../src/evaluate/measure/mass.ts';
import { quantityOf } from '../../../src/evaluate/measure/quantities.ts';
import { measuredFrames, trackJoints } from '../../../src/evaluate/measure/tracks.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { BVH_FILES, sharedCaptures } from '../../helpers/bvh-files.ts';
import { captured } from '../../helpers/mocap.ts';
import { conformance, describeShared } from '../../helpers/shared.ts';

function tracked(of: Character) {
  const frames = measuredFrames(of, 30);
  if (!frames || !of.skeleton) throw new Error(`${of.name} has no take`);
  return runToEnd(
    trackJoints(
      of,
      frames,
      of.skeleton.joints.map((_, j) => j),
    ),
  );
}

function opened(name: string): readonly Character[] {
  return sharedCaptures(name).flatMap(({ skeleton: own, take }) => (take ? [captured(own, take)] : []));
}

interface Expected {
  readonly files: Readonly<
    Record<
      string,
      {
        readonly nodes: readonly (readonly [string, number, string | null])[];
        readonly positions: Readonly<Record<string, readonly (readonly number[])[]>>;
        readonly tolerance: number;
      }
    >
  >;
}

describe('the tracks of joints', () => {
  it('are at the frames of the take in seconds of the transport; a character without a take has none', () => {
    const made = character({ takes: [takeOfValues('walk', [], [0, 2])], shownTake: 0, timeOffsetSeconds: 0.5 });
    expect(measuredFrames(made, 10)).toEqual({ startSeconds: -0.5, frameSeconds: 0.1, frameCount: 21 });
    expect(measuredFrames(character(), 10)).toBeUndefined();
    const stated = character({ takes: [{ ...takeOfValues('walk', [], [0, 2]), framesPerSecond: 24 }], shownTake: 0 });
    expect(measuredFrames(stated, 10)).toEqual({ startSeconds: 0, frameSeconds: 1 / 24, frameCount: 49 });
  });

  it.each([
    [0, 1e308],
    [-1e308, 1e308],
    [0, 1e6],
  ])('a range of keys from %d to %d s is measured in frames that a page can hold', (start, end) => {
    const long = character({ skeleton: skeleton(1), takes: [takeOfValues('take', [0], [start, end])], shownTake: 0 });
    const frames = measuredFrames(long, 30);
    expect(frames?.frameCount).toBeLessThanOrEqual(1e6);
    const { startSeconds = 0, frameCount = 0, frameSeconds = 0 } = frames ?? {};
    // The length of the longest is no number.
    const [from, half] = [startSeconds / end, ((frameCount - 1) / 2) * (frameSeconds / end)];
    expect(from + half + half).toBeCloseTo(1, 9);
  });

  it('positions are metres of the scene, and rotations are from rest and relative to the parent', () => {
    const made = character({
      skeleton: skeleton(2),
      takes: [takeOfValues('take', [100, 0, 0, 0, 0, 0, 0.5, 0, 0])],
      shownTake: 0,
      space: { up: 'y', unit: 'centimetres', lift: 0 },
      placements: [{ ...DEFAULT_PLACEMENT, position: [0, 3, 0] }],
    });
    const { positions, rotations, frames } = tracked(made);
    expect([...positions[0].subarray(0, 3)].map((x) => Number(x.toFixed(9)))).toEqual([1, 3.01, 0]);
    const angle = quantityOf({ positions: positions[1], rotations: rotations[1] }, 'angle', frames.frameSeconds);
    expect(angle?.[0]).toBeCloseTo((0.5 * 180) / Math.PI, 9);
    expect(quantityOf({ positions: positions[0], rotations: rotations[0] }, 'angle', 1)?.[0]).toBeCloseTo(0, 9);
  });

  it('the centre of mass of a skeleton that is no body is the middle of its bones', () => {
    const own = skeleton(3);
    expect(jointMasses(own)).toEqual({ model: 'bones', weights: Float64Array.of(0.25, 0.5, 0.25) });
    const made = character({ skeleton: own, takes: [takeOfValues('take', [4, 0, 0])], shownTake: 0 });
    expect([...tracked(made).mass.subarray(0, 3)]).toEqual([4, 2, 0]);
    expect(jointMasses(skeleton(1)).weights).toEqual(Float64Array.of(1));
  });
});

describeShared('the tracks of real takes', () => {
  it.each(BVH_FILES)('positions of %s are those of the reference', (name) => {
    const { nodes, positions, tolerance } = conformance<Expected>('bvh-positions.json').files[name];
    const all = opened(name).map(({ space: _, ...one }) => tracked({ ...one, placements: [DEFAULT_PLACEMENT] }));
    for (const [frame, points] of Object.entries(positions)) {
      const expected = points.filter((_, i) => nodes[i][2] !== null);
      const got = all.flatMap(({ positions: rows }) =>
        rows.map((row) => row.subarray(3 * Number(frame)).subarray(0, 3)),
      );
      expect(got.length).toBe(expected.length);
      for (const [j, point] of expected.entries()) {
        for (const k of [0, 1, 2]) expect(Math.abs(got[j][k] - point[k])).toBeLessThanOrEqual(tolerance);
      }
    }
  });

  it('contacts are those of the exported arrays, and velocities have the speed', () => {
    const [one] = opened('cmu-01_01.bvh');
    const tracks = tracked(one);
    const arrays = takeArrays(takeOf(one, {}), new FloatPool('float64'));
    const width = arrays.contactJoints.length;
    expect(width).toBe(2);
    expect(tracks.feet).toEqual([...arrays.contactJoints]);
    tracks.contacts.forEach((row, i) => {
      expect([...row]).toEqual(Array.from(row, (_, f) => arrays.contacts[f * width + i]));
      expect(row.includes(1) && row.includes(0)).toBe(true);
    });
    const speed = quantityOf({ positions: tracks.positions[0] }, 'speed', tracks.frames.frameSeconds);
    const J = tracks.joints.length;
    speed?.forEach((value, f) => {
      const velocity = arrays.velocities.subarray(3 * J * f, 3 * J * f + 3);
      // A file's frame time has few digits, and the exported rate is whole.
      expect(Math.abs(value - Math.hypot(...velocity))).toBeLessThan(1e-5 * Math.max(1, value));
    });
  });

  it('the mass of a body is in its segments, and its centre above the hips', () => {
    const [one] = opened('cmu-01_01.bvh');
    const masses = jointMasses(one.skeleton ?? skeleton());
    expect(masses.model).toBe('segments');
    expect(masses.weights.reduce((sum, w) => sum + w, 0)).toBeCloseTo(1, 12);
    const { mass, positions } = tracked(one);
    const heightOf = (name: string) => positions[one.skeleton?.joints.findIndex((j) => j.name === name) ?? -1][1];
    expect(mass[1]).toBeGreaterThan(heightOf('LeftUpLeg'));
    expect(mass[1]).toBeLessThan(heightOf('LeftArm'));
  });

  it('placing and turning a character changes positions only', () => {
    const [one] = opened('cmu-01_01.bvh');
    const a = tracked(one);
    const b = tracked({ ...one, placements: [{ ...DEFAULT_PLACEMENT, position: [3, 0, -2], turn: [0, 1.1, 0] }] });
    for (const quantity of ['speed', 'acceleration', 'angle', 'angularSpeed', 'height'] as const) {
      for (const j of [0, 5, 20]) {
        const of = ({ positions, rotations }: typeof a) =>
          quantityOf({ positions: positions[j], rotations: rotations[j] }, quantity, a.frames.frameSeconds) ?? [];
        const [first, second] = [of(a), of(b)];
        expect(Math.max(...first.map((x, f) => Math.abs(x - second[f])))).toBeLessThan(1e-8);
      }
    }
    expect(a.contacts).toEqual(b.contacts);
  });
});
