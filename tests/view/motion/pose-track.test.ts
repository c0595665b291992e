import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Interpolation } from '../../../src/model/takes/samples.ts';
import { type Channel, type KeyedChannel, restChannel, SAMPLED, type Take } from '../../../src/model/takes/take.ts';
import { PosePlayer } from '../../../src/view/motion/pose-track.ts';
import { character, joint, skeleton, takeOfValues } from '../../helpers/builders.ts';

function channel(times: number[], values: number[], more: Partial<KeyedChannel> = {}): KeyedChannel {
  const tangents = () => ({ kinds: new Uint8Array(times.length).fill(1), slopes: new Float64Array(times.length) });
  return {
    kind: 'keys',
    extrapolateIn: 'linear',
    extrapolateOut: 'cycle_offset',
    times: Float64Array.from(times),
    values: Float64Array.from(values),
    tangentsIn: tangents(),
    tangentsOut: tangents(),
    ...more,
  };
}

const playing = (channels: readonly Channel[], range: readonly [number, number] = [0, 1]): Take => ({
  name: 'go',
  range,
  channels,
});

function player(shown: Take, more: Partial<Parameters<typeof character>[0]> = {}) {
  return new PosePlayer(character({ takes: [shown], shownTake: 0, ...more }));
}

describe('the track of a character', () => {
  it('the track of a character is exact before 0, past the end and far past it', () => {
    const played = player(playing([channel([0, 1], [0, 2])]));
    for (const [time, value] of [
      [-3, -6],
      [0, 0],
      [0.25, 0.5],
      [1, 2],
      [2.5, 5],
      [1e6 + 0.5, 2e6 + 1],
    ]) {
      played.seek(time);
      expect(played.dofs[0]).toBe(value);
    }
  });

  it('the track of a character does not depend on the take having a range from 0, or one at all', () => {
    for (const range of [
      [0, 1],
      [-7, -3],
      [5, 5],
      [9, 2],
    ] as const) {
      const played = player(playing([channel([-6, -4], [1, 3])], range));
      expect(played.take.duration).toBeGreaterThan(0);
      played.seek(-5);
      expect(played.dofs[0]).toBe(2);
      played.seek(-8);
      expect(played.dofs[0]).toBe(-1);
    }
  });

  it('plays a lone key, and a channel of none', () => {
    const played = player(playing([channel([2], [5]), restChannel()]));
    for (const time of [-10, 2, 10]) {
      played.seek(time);
      expect([...played.dofs.subarray(0, 2)]).toEqual([5, 0]);
    }
  });

  it('the track of a character goes back to the same values after any other time', () => {
    const played = player(playing([channel([0, 1], [0, 2])]));
    played.seek(0.5);
    played.seek(-40);
    played.seek(40);
    played.seek(0.5);
    expect(played.dofs[0]).toBe(1);
  });

  it('agrees with the pose that the command line computes, at every time, to the last bit', () => {
    const number = fc.double({ min: -100, max: 100, noNaN: true });
    const channels = fc.array(
      fc
        .uniqueArray(fc.tuple(number, number), { selector: ([t]) => t, maxLength: 5 })
        .map((keys) => keys.sort((a, b) => a[0] - b[0]))
        .map(
          (keys): Channel =>
            keys.length
              ? channel(
                  keys.map((k) => k[0]),
                  keys.map((k) => k[1]),
                )
              : restChannel(),
        ),
      { maxLength: 12 },
    );
    fc.assert(
      fc.property(channels, fc.array(fc.double({ min: -1e3, max: 1e3, noNaN: true })), (all, times) => {
        const model = character({ skeleton: skeleton(2), takes: [playing(all)], shownTake: 0 });
        const played = new PosePlayer(model);
        const expected = new Float64Array(9);
        for (const time of times) {
          played.seek(time);
          poseAt(model, time, expected);
          // −0 counts as 0.
          expect([...played.dofs].map((x) => x + 0)).toEqual([...expected].map((x) => x + 0));
          expect(played.dofs.every(Number.isFinite)).toBe(true);
        }
      }),
      { numRuns: 60 },
    );
  });

  it('plays samples as the command line poses them, and is made anew for others', () => {
    const motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' } as const;
    const six = motion.channels.map(() => 0);
    const root = joint(-1, { motion, pose: six, limits: six.map(() => ({ min: -1e5, max: 1e5 })) });
    const values = Float64Array.from({ length: 6 * 40 }, (_, i) => 170 * Math.sin(i * i));
    const take = (interpolation: Interpolation): Take => ({
      ...playing(six.map(() => SAMPLED)),
      range: [0, 39 / 30],
      samples: {
        frameCount: 40,
        frameSeconds: 1 / 30,
        startSeconds: 0,
        firstChannel: 0,
        values,
        scales: Float64Array.of(1, 1, 1, RADIANS_PER_DEGREE, RADIANS_PER_DEGREE, RADIANS_PER_DEGREE),
        interpolation,
      },
    });
    const sampled = character({ skeleton: { name: 'taken', joints: [root] }, takes: [take('linear')], shownTake: 0 });
    const played = new PosePlayer(sampled);
    expect(played.take.duration).toBeCloseTo(1.3, 12);
    const expected = new Float64Array(6);
    for (const time of [-1, 0, 1 / 30, 0.51, 0.512, 1.2999, 1.3, 8]) {
      played.seek(time);
      poseAt(sampled, time, expected);
      expect([...played.dofs]).toEqual([...expected]);
    }
    expect(played.fits({ ...sampled, pose: [1] })).toBe(true);
    expect(played.fits({ ...sampled, takes: [take('cubic')] })).toBe(false);
  });

  it('leaves to the pose what no channel drives, and clamps to the limits', () => {
    const limits = [
      { min: -1, max: 1 },
      { min: -1, max: 1 },
      { min: -1, max: 1 },
    ];
    const own = { name: 'one', joints: [joint(-1, { limits })] };
    const pose = [0, 0, 0, 0, 0.5, 7];
    const model = { skeleton: own, pose };
    const played = player(takeOfValues('go', [1, 2, 3, 4]), model);
    played.seek(0);
    expect([...played.dofs]).toEqual([1, 2, 3, 1, 0.5, 1]);
    const free = player(takeOfValues('go', [1, 2, 3, 4]), { ...model, clampsToLimits: false });
    free.seek(0);
    expect([...free.dofs]).toEqual([1, 2, 3, 4, 0.5, 7]);
  });

  it('shows a value set by hand at its moment only', () => {
    const model = character({
      takes: [takeOfValues('go', [1, 2])],
      shownTake: 0,
      unkeyed: { timeSeconds: 0.5, dofs: [1], values: [9] },
    });
    const played = new PosePlayer({ ...model, pose: model.pose.map(() => 7), clampsToLimits: false });
    played.seek(0.5);
    expect([...played.dofs.subarray(0, 3)]).toEqual([1, 9, 7]);
    played.seek(0.6);
    expect([...played.dofs.subarray(0, 3)]).toEqual([1, 2, 7]);
  });

  it('sees an edit of the pose without being made anew', () => {
    const model = character();
    const played = new PosePlayer(model);
    played.seek(0);
    const edited = { ...model, pose: model.pose.map(() => 3) };
    expect(played.fits(edited)).toBe(true);
    played.character = edited;
    played.seek(0);
    expect(played.dofs[4]).toBe(3);
  });
});
