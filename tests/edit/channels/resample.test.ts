import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { resampleChannel } from '../../../src/edit/channels/resample.ts';
import { CommandError } from '../../../src/edit/command-error.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, expectNoCrowd, pointsOf, rowsOf, valueAt } from '../keys/channels.ts';
import { largestSampled } from './sampled.ts';

const frames = (from: number, to: number, tangents: 'linear' | 'smooth' = 'smooth', framesPerSecond = 4) => ({
  framesPerSecond,
  from,
  to,
  tangents,
});

describe('resampling', () => {
  it('puts a key with the value of the curve on each frame', () => {
    const cases = fc.tuple(channels(1), fc.integer({ min: -30, max: 20 }), fc.integer({ min: 0, max: 20 }));
    fc.assert(
      fc.property(cases, fc.constantFrom('linear' as const, 'smooth' as const), ([channel, from, length], tangents) => {
        const { channel: after } = resampleChannel(channel, frames(from, from + length, tangents, 7));
        checkChannel(after);
        expectNoCrowd(after);
        const end = channel.times[channel.times.length - 1];
        for (let n = 7 * from; n <= 7 * (from + length); n++) {
          const t = n / 7;
          // At a seam of a cycle there may be two values.
          const meant = [valueAt(channel, t), valueAt(channel, t - 1e-9), valueAt(channel, t + 1e-9)];
          const off = meant.map((m) => Math.abs(valueAt(after, t) - m));
          const isKeyed = after.times.some((time) => Math.abs(time - t) < 1e-9);
          if (!isKeyed || !(Math.min(...off) < 1e-3)) expect.fail(`the key at ${t} s, ${isKeyed}, is off by ${off}`);
        }
        expect(end).toBeDefined();
      }),
      { numRuns: 60 },
    );
  });

  it('resampling keeps a smooth curve by the fourth power of the frame, a linear one by the second', () => {
    const wave = channelOf(
      Array.from({ length: 41 }, (_, i) => [i / 40, Math.sin(6.28 * (i / 40)), 6.28 * Math.cos(6.28 * (i / 40))]),
    );
    const error = (rate: number, tangents: 'linear' | 'smooth') =>
      resampleChannel(wave, frames(0, 1, tangents, rate)).largestError;
    expect(error(8, 'smooth') / error(16, 'smooth')).toBeGreaterThan(12);
    expect(error(8, 'linear') / error(16, 'linear')).toBeGreaterThan(3.3);
    expect(error(8, 'linear') / error(16, 'linear')).toBeLessThan(4.7);
  });

  it('resampling is the same as that of a curve that lies earlier by the offset', () => {
    fc.assert(
      fc.property(
        channels(1),
        fc.integer({ min: -6, max: 6 }),
        fc.integer({ min: -20, max: 10 }),
        (channel, by, from) => {
          // Eighths and a rate of 4: nothing is rounded.
          const offsetSeconds = by / 8;
          const moved = { ...channel, times: channel.times.map((t) => t + offsetSeconds) };
          const there = resampleChannel(channel, frames(from, from + 5)).channel;
          const shifted = { ...frames(from + offsetSeconds, from + 5 + offsetSeconds), offsetSeconds };
          const { channel: after } = resampleChannel(moved, shifted);
          expect(after.times.length).toBe(there.times.length);
          for (const [k, time] of after.times.entries()) {
            expect(time - offsetSeconds).toBeCloseTo(there.times[k], 9);
            expect(after.values[k]).toBeCloseTo(there.values[k], 6);
          }
        },
      ),
      { numRuns: 60 },
    );
  });

  it('measures its error', () => {
    fc.assert(
      fc.property(channels(2, { steps: true }), fc.integer({ min: -20, max: 10 }), (channel, from) => {
        const done = resampleChannel(channel, frames(from, from + 9, 'smooth', 3));
        const [start, end] = [done.channel.times[0], done.channel.times[done.channel.times.length - 1]];
        const sampled = largestSampled(channel, done.channel, start, end, 3000);
        expect(sampled).toBeLessThanOrEqual(done.largestError * (1 + 1e-6) + 1e-6);
      }),
      { numRuns: 60 },
    );
  });

  it('leaves keys outside the range, with the curve there', () => {
    fc.assert(
      fc.property(channels(4), fc.constantFrom('linear' as const, 'smooth' as const), (channel, tangents) => {
        const [start, end] = [channel.times[0], channel.times[channel.times.length - 1]];
        const from = Math.ceil(start + 0.3 * (end - start));
        const to = Math.floor(start + 0.6 * (end - start));
        fc.pre(from <= to);
        const { channel: after } = resampleChannel(channel, frames(from, to, tangents));
        const scale = Math.max(1, ...channel.values.map(Math.abs));
        expect(largestSampled(channel, after, start, from, 500)).toBeLessThan(1e-7 * scale);
        expect(largestSampled(channel, after, to, end, 500)).toBeLessThan(1e-7 * scale);
      }),
    );
  });

  const step = (at: number) =>
    channelOf([
      [0, 0, 'flat'],
      [at, 0, 'flat'],
      [at, 1, 'flat'],
      [2, 1, 'flat'],
    ]);

  it('resampling keeps a step that lies on a frame', () => {
    const { channel, largestError } = resampleChannel(step(1), frames(0, 2, 'smooth', 2));
    expect(pointsOf(channel)).toEqual([
      [0, 0],
      [0.5, 0],
      [1, 0],
      [1, 1],
      [1.5, 1],
      [2, 1],
    ]);
    expect(largestError).toBe(0);
  });

  it('resampling turns a step between frames into a ramp over one frame, does not overshoot, and reports the error', () => {
    const { channel, largestError } = resampleChannel(step(1.25), frames(0, 2, 'smooth', 2));
    expect(pointsOf(channel)).toEqual([0, 0.5, 1, 1.5, 2].map((t) => [t, t < 1.25 ? 0 : 1]));
    expect(largestError).toBeCloseTo(0.5, 9);
    for (let t = 0; t <= 2; t += 0.01) {
      expect(valueAt(channel, t)).toBeGreaterThanOrEqual(0);
      expect(valueAt(channel, t)).toBeLessThanOrEqual(1);
    }
  });

  it('takes keys that a file has rounded for keys on the frame', () => {
    const rounded = channelOf([
      [0, 0, 'linear'],
      [0.033333, 1, 'linear'],
      [0.066667, 0, 'linear'],
    ]);
    const { channel } = resampleChannel(rounded, frames(0, 0.0667, 'smooth', 30));
    expect(channel.times[1]).toBe(1 / 30);
    expect(rowsOf(channel)[1].slice(1, 2)).toEqual([1]);
    expect(channel.times).toHaveLength(3);
  });

  it('reaches beyond the ends, and holds what repeated from there on', () => {
    const loop = channelOf(
      [
        [0, 0],
        [1, 5],
        [2, 0],
      ],
      'cycle',
    );
    const { channel } = resampleChannel(loop, frames(0, 4, 'smooth', 1));
    expect(pointsOf(channel)).toEqual([0, 1, 2, 3, 4].map((t) => [t, t % 2 ? 5 : 0]));
    expect([channel.extrapolateIn, channel.extrapolateOut]).toEqual(['cycle', 'constant']);
  });

  it('leaves a range without a frame; refuses a million keys', () => {
    expect(resampleChannel(step(1), frames(0.1, 0.2)).channel).toEqual(step(1));
    expect(() => resampleChannel(step(1), frames(0, 1e6))).toThrow(CommandError);
  });
});
