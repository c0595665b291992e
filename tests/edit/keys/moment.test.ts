import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { samplesWithMoment, weightAt, withMoment } from '../../../src/edit/keys/moment.ts';
import { sampleColumn } from '../../../src/evaluate/samples/sampling.ts';
import { swing } from '../samples/made.ts';
import { between, channelOf, channels, pointsOf, valueAt } from './channels.ts';

const moments = fc.record({ at: between(-5, 5), easeIn: between(0.01, 3), easeOut: between(0.01, 3) });
const near = (a: number, b: number, size = 1) => Math.abs(a - b) <= 1e-7 * Math.max(1, Math.abs(a), Math.abs(b), size);

describe('a pose for a moment', () => {
  it('has the posed value at its time to the digit, and is the take plus the eased offset at all times', () => {
    fc.assert(
      fc.property(
        channels(2, { extrapolations: ['constant', 'linear'] }),
        moments,
        between(-3, 3),
        fc.array(between(-8, 8), { minLength: 1, maxLength: 6 }),
        (channel, moment, value, times) => {
          const changed = withMoment(channel, moment, value, [0, 1]);
          expect(valueAt(changed, moment.at)).toBe(value);
          const offset = value - valueAt(channel, moment.at);
          for (const time of times) {
            const expected = valueAt(channel, time) + offset * weightAt(moment, time);
            expect(near(valueAt(changed, time), expected, 1e3 * Math.abs(offset))).toBe(true);
          }
        },
      ),
    );
  });

  it('bakes the repetitions around it: the others, and the keys outside it, are what they were', () => {
    const walk = channelOf(
      [
        [0, 0],
        [0.2, 0.5],
        [0.5, -0.25],
        [0.8, 0],
      ],
      'cycle',
    );
    const changed = withMoment(walk, { at: 2.9, easeIn: 0.4, easeOut: 0.4 }, 2, [0, 6.4]);
    expect([changed.times[0], changed.times.at(-1)]).toEqual([0, expect.closeTo(6.4, 9)]);
    expect(valueAt(changed, 2.9)).toBe(2);
    for (let t = -1; t < 6.4; t += 0.013) {
      const isOutside = t < 2.5 || t > 3.3;
      if (isOutside) expect(valueAt(changed, t)).toBeCloseTo(valueAt(walk, t), 9);
    }
    // With what repeats now: every 6.4 s.
    expect(valueAt(changed, 2.9 + 6.4)).toBeCloseTo(2, 9);
    expect(valueAt(changed, 2.9 + 3.2)).toBeCloseTo(valueAt(walk, 2.9), 9);
  });

  it('leaves the keys of dense curves outside it as they are', () => {
    const dense = channelOf(Array.from({ length: 61 }, (_, i) => [i / 30, Math.sin(i / 7), 'linear'] as const));
    const changed = withMoment(dense, { at: 1, easeIn: 0.3, easeOut: 0.3 }, 5, [0, 2]);
    expect(changed.times).toEqual(dense.times);
    const outside = ([time]: readonly [number, number]) => time < 0.7 || time > 1.3;
    expect(pointsOf(changed).filter(outside)).toEqual(pointsOf(dense).filter(outside));
    expect(Math.max(...changed.values)).toBe(5);
    // No frame takes more than a part of the way.
    const steps = pointsOf(changed).map(([, value], i, all) => Math.abs(value - (all[i - 1]?.[1] ?? value)));
    expect(Math.max(...steps)).toBeLessThan(1);
  });

  it('offsets the frames of samples: at a frame exactly, between two on both, and none outside', () => {
    const { samples } = swing;
    if (!samples) throw new Error('It is sampled.');
    const shownAt = (time: number) => (channel: number) => sampleColumn(samples, channel, time);
    for (const at of [1, 1.004]) {
      const moment = { at, easeIn: 0.25, easeOut: 0.5 };
      const changed = samplesWithMoment(samples, moment, new Map([[7, 1.5]]), shownAt(at));
      expect(sampleColumn(changed, 7, at)).toBeCloseTo(1.5, 12);
      const width = samples.scales.length;
      const different = [...changed.values.keys()].filter((i) => changed.values[i] !== samples.values[i]);
      expect(new Set(different.map((i) => i % width))).toEqual(new Set([7]));
      const frames = different.map((i) => Math.floor(i / width) / 60);
      expect(Math.min(...frames)).toBeGreaterThan(at - 0.25 - 1e-9);
      expect(Math.max(...frames)).toBeLessThan(at + 0.5 + 1e-9);
    }
  });
});
