/** Frame rates of samples, of keys, and as files state them. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { frameRateOf, rateOfTimes, statedRate } from '../../../src/evaluate/samples/frame-rate.ts';
import { framesOfTake } from '../../../src/evaluate/samples/key-frames.ts';
import { takeOfValues } from '../../helpers/builders.ts';

/** Of a take of samples without channels. */
const rateOf = (frameSeconds: number, frameCount = 100) =>
  frameRateOf({
    ...takeOfValues('sampled', []),
    samples: {
      frameCount,
      frameSeconds,
      startSeconds: 0,
      firstChannel: 0,
      values: new Float64Array(0),
      scales: new Float64Array(0),
      interpolation: 'linear',
    },
  }) ?? Number.NaN;

describe('the frame rate', () => {
  it.each([
    [0.0333333, 30],
    [0.033333, 30],
    [0.0333, 30],
    [0.008333, 120],
    [0.0083333, 120],
    [1 / 120, 120],
    [Math.fround(1 / 60), 60],
    [0.01666667, 60],
    [0.01, 100],
    [0.008, 125],
    [0.04, 25],
    [0.041667, 24],
  ])('of a frame time of %d is the whole one that it stands for: %d', (frameSeconds, rate) => {
    expect(rateOf(frameSeconds)).toBe(rate);
  });

  it('the frame rate of television is not a whole number', () => {
    expect(rateOf(0.033367)).toBeCloseTo(30 / 1.001, 10);
    expect(rateOf(0.0166834)).toBeCloseTo(60 / 1.001, 10);
  });

  it('the frame rate is as in the file if it is no usual one', () => {
    expect(rateOf(0.03)).toBe(1 / 0.03);
  });

  it('counts every frame of a long take like the file, whatever the rounding', () => {
    for (const frameSeconds of [0.0333, 0.033333, 0.008333, 0.0083333, 0.0167]) {
      const frameCount = 40_000;
      const last = (frameCount - 1) * frameSeconds * rateOf(frameSeconds, frameCount);
      expect(Math.round(last), String(frameSeconds)).toBe(frameCount - 1);
    }
  });
});

/** Times of these frames, as a file has them. */
const timesOf = (frames: readonly number[], rate: number, stored: (seconds: number) => number = Number) =>
  Float64Array.from(frames, (frame) => stored(frame / rate));
const every = (count: number, step = 1) => Array.from({ length: count }, (_, k) => k * step);
const decimals = (count: number) => (seconds: number) => Number(seconds.toFixed(count));
const TELEVISION = [24, 30, 60].map((rate) => rate / 1.001);
const USUAL = [24, 25, 30, 60, ...TELEVISION];

describe('the frame rate of keys', () => {
  const storedAs = [Number, Math.fround, decimals(6), decimals(4)];

  it('is that of their frames, however the file rounds times, wherever the take starts', () => {
    fc.assert(
      fc.property(
        fc.constantFrom(...USUAL),
        fc.constantFrom(...storedAs),
        fc.integer({ min: 0, max: 500 }),
        fc.integer({ min: 120, max: 2000 }),
        (rate, stored, first, count) => {
          const times = timesOf(
            every(count).map((frame) => first + frame),
            rate,
            stored,
          );
          expect(rateOfTimes([times], true)).toBeCloseTo(rate, 9);
        },
      ),
    );
  });

  it('is the common divisor where only some frames have keys', () => {
    fc.assert(
      fc.property(
        fc.constantFrom(...USUAL),
        fc.constantFrom(Number, Math.fround),
        fc.array(fc.integer({ min: 1, max: 9 }), { minLength: 30, maxLength: 200 }),
        (rate, stored, steps) => {
          const frames = [0];
          // A frame apart once, so that no coarser grid has all of them.
          for (const step of [1, ...steps]) frames.push(frames[frames.length - 1] + step);
          const times = timesOf(frames, rate, stored);
          const others = times.filter((_, i) => i % 3 === 0);
          expect(rateOfTimes([others, times, times.slice()], false)).toBeCloseTo(rate, 9);
        },
      ),
    );
    expect(rateOfTimes([timesOf([0, 4, 10, 13, 24], 24)], false)).toBe(24);
    expect(rateOfTimes([timesOf([0, 4, 10, 24], 24), timesOf([6, 9, 15], 24)], false)).toBe(24);
  });

  it.each([
    [0.016667, 60],
    [0.0166667, 60],
    [0.0333333, 30],
    [0.041667, 24],
    [0.0417083, 24 / 1.001],
    [0.03, 1 / 0.03],
  ])('of keys every %d s is %d: it is written as the frame time of captures', (seconds, rate) => {
    const times = Float64Array.from(every(600), (k) => k * seconds);
    expect(rateOfTimes([times], true)).toBeCloseTo(rate, 6);
  });

  it('is as in the file where the usual one would lose half a frame', () => {
    const times = Float64Array.from(every(40_000), (k) => k * 0.016667);
    expect(rateOfTimes([times], true)).toBeCloseTo(1 / 0.016667, 6);
  });

  it('takes both keys of a step for one moment', () => {
    const times = timesOf(every(50), 30);
    const stepped = Float64Array.from([...times].flatMap((time) => [time, time + 1e-5]));
    expect(rateOfTimes([stepped], true)).toBe(30);
  });

  it('is that of keys on twos, where curves are straight in between', () => {
    expect(rateOfTimes([timesOf(every(20, 2), 24)], true)).toBe(12);
    expect(rateOfTimes([timesOf(every(20, 2), 24)], false)).toBeUndefined();
  });

  it('is none of keys at uneven times, of seconds, and of times of two decimals', () => {
    expect(rateOfTimes([Float64Array.of(0, 0.37, 0.81, 1.5)], false)).toBeUndefined();
    expect(rateOfTimes([Float64Array.of(0, 0.337, 0.812, 1.497)], true)).toBeUndefined();
    expect(rateOfTimes([Float64Array.of(0, 1, 2, 5)], true)).toBeUndefined();
    expect(rateOfTimes([Float64Array.of(0, Math.SQRT1_2, Math.E)], true)).toBeUndefined();
    expect(rateOfTimes([Float64Array.of(2)], true)).toBeUndefined();
    expect(rateOfTimes([], true)).toBeUndefined();
  });

  it('comes to an end for any times', () => {
    fc.assert(
      fc.property(fc.array(fc.double({ noNaN: true, noDefaultInfinity: true }), { maxLength: 20 }), (times) => {
        const rate = rateOfTimes([Float64Array.from(times).sort()], true);
        if (rate !== undefined) expect(rate).toBeGreaterThan(0);
      }),
    );
  });
});

describe('a stated frame rate', () => {
  it.each([
    [23.976, 24 / 1.001],
    [29.97, 30 / 1.001],
    [59.94, 60 / 1.001],
    [59.9988, 60],
    [30, 30],
    [12.5, 12.5],
  ])('of %d is %d', (stated, rate) => {
    expect(statedRate(stated)).toBe(rate);
  });

  it('counts before that of the keys, and its frames are those of the range', () => {
    const keyed = { ...takeOfValues('x', [0, 1], [0.5, 2.5]), framesPerSecond: 24 };
    expect(frameRateOf(keyed)).toBe(24);
    expect(framesOfTake(keyed, 60)).toEqual({ startSeconds: 0.5, frameSeconds: 1 / 24, frameCount: 49 });
  });
});
