import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { largestDifference } from '../../../src/edit/channels/difference.ts';
import { channelOf, channels, valueAt } from '../keys/channels.ts';
import { largestSampled } from './sampled.ts';

describe('the difference of two curves', () => {
  it('the difference of two curves is found between keys, where a cubic overshoots', () => {
    const straight = channelOf([
      [0, 0, 'linear'],
      [1, 0, 'linear'],
    ]);
    const bulging = channelOf([
      [0, 0, 1],
      [1, 0, -1],
    ]);
    expect(largestDifference(straight, bulging)).toEqual({ largestError: 0.25, atSeconds: 0.5 });
  });

  it('takes both sides of a step', () => {
    const step = channelOf([
      [0, 0, 'flat'],
      [1, 0, 'flat'],
      [1, 5, 'flat'],
      [2, 5, 'flat'],
    ]);
    const level = channelOf([
      [0, 1, 'flat'],
      [2, 1, 'flat'],
    ]);
    expect(largestDifference(step, level).largestError).toBe(4);
    expect(largestDifference(level, step).largestError).toBe(4);
  });

  it('the difference of two curves is zero between a curve and itself, or if there is no curve', () => {
    const one = channelOf([[0, 3]]);
    expect(largestDifference(one, one)).toEqual({ largestError: 0, atSeconds: 0 });
    expect(largestDifference(channelOf([[7, 1]]), one).largestError).toBe(0);
  });

  it('the difference of two curves is found after one that overflowed', () => {
    const level = (value: number) =>
      channelOf([
        [0, value, 'flat'],
        [1, value, 'flat'],
      ]);
    largestDifference(level(1.7e308), level(-1.7e308));
    expect(largestDifference(level(1), level(3))).toEqual({ largestError: 2, atSeconds: 0 });
  });

  it('the difference of two curves is what dense sampling nearly finds, and never less', () => {
    fc.assert(
      fc.property(channels(2, { steps: true }), channels(2, { steps: true }), (a, b) => {
        const from = Math.max(a.times[0], b.times[0]);
        const to = Math.min(a.times[a.times.length - 1], b.times[b.times.length - 1]);
        fc.pre(to > from);
        const { largestError, atSeconds } = largestDifference(a, b);
        const sampled = largestSampled(a, b, from, to, 4000);
        expect(largestError).toBeGreaterThanOrEqual(sampled * (1 - 1e-9) - 1e-9);
        expect(sampled).toBeGreaterThan(0.9 * largestError - 0.1);
        // At the place that it names, or right beside it where that is a step.
        const there = [atSeconds, atSeconds - 1e-9, atSeconds + 1e-9].map((t) =>
          Math.abs(valueAt(a, t) - valueAt(b, t)),
        );
        expect(Math.max(...there)).toBeGreaterThan(largestError - 1e-4);
      }),
    );
  });
});
