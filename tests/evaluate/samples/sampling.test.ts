import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../../src/evaluate/curves.ts';
import { columnSlope, frameAt, sampleColumn } from '../../../src/evaluate/samples/sampling.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { INTERPOLATIONS, type Interpolation, type Samples } from '../../../src/model/takes/samples.ts';
import { type KeyedChannel, restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';

function column(values: readonly number[], more: Partial<Samples> = {}): Samples {
  return {
    frameCount: values.length,
    frameSeconds: 0.5,
    startSeconds: 0,
    firstChannel: 0,
    values: Float64Array.from(values),
    scales: Float64Array.of(1),
    interpolation: 'linear',
    ...more,
  };
}

const someValues = fc.array(fc.double({ min: -500, max: 500, noNaN: true }), { minLength: 1, maxLength: 12 });
const someFrameSeconds = fc.constantFrom(1 / 24, 0.0333333, 0.0083333, 0.008, 0.01, 1, 7);

describe('finding the frame of a time', () => {
  it('finding the frame of a time is the whole number of a frame at its time, whatever multiplying and adding did to that', () => {
    fc.assert(
      fc.property(
        someFrameSeconds,
        fc.double({ min: -1000, max: 1000, noNaN: true }),
        fc.nat(99_999),
        (frameSeconds, startSeconds, frame) => {
          const samples = column([0], { frameCount: 100_000, frameSeconds, startSeconds });
          expect(frameAt(samples, startSeconds + frame * frameSeconds)).toBe(frame);
        },
      ),
    );
  });

  it('holds the first and the last frame outside of them', () => {
    const samples = column([1, 2, 3], { startSeconds: 10 });
    expect([9, -Infinity, Number.NaN, 12, Infinity].map((t) => frameAt(samples, t))).toEqual([0, 0, 0, 2, 2]);
    expect(frameAt(column([1]), 0.25)).toBe(0);
  });

  it('reads no more values of a long take than of a short one', () => {
    const readsOf = (frameCount: number, interpolation: Interpolation) => {
      let reads = 0;
      const values = new Proxy(new Float64Array(frameCount), {
        get: (target, key) => {
          reads++;
          return Reflect.get(target, key);
        },
      });
      sampleColumn(column([], { frameCount, values, interpolation }), 0, 0.5 * (0.7 * frameCount));
      return reads;
    };
    for (const interpolation of INTERPOLATIONS) {
      expect(readsOf(1_000_001, interpolation)).toBe(readsOf(11, interpolation));
    }
    expect(INTERPOLATIONS.map((interpolation) => readsOf(1_000_001, interpolation))).toEqual([2, 2, 4]);
  });
});

describe('a column by itself', () => {
  it('a column by itself is its own value at every frame, times the scale, however it is interpolated', () => {
    fc.assert(
      fc.property(
        someValues,
        someFrameSeconds,
        fc.constantFrom(...INTERPOLATIONS),
        (values, seconds, interpolation) => {
          const scales = Float64Array.of(RADIANS_PER_DEGREE);
          const samples = column(values, { frameSeconds: seconds, scales, interpolation });
          const got = values.map((_, frame) => sampleColumn(samples, 0, frame * seconds));
          expect(got).toEqual(values.map((value) => value * RADIANS_PER_DEGREE));
        },
      ),
    );
  });

  it('takes the nearer frame, the later one of two that are as near', () => {
    const samples = column([10, 20, 30], { interpolation: 'nearest' });
    expect([0.24, 0.25, 0.74, 0.76].map((t) => sampleColumn(samples, 0, t))).toEqual([10, 20, 20, 30]);
  });

  it('interpolates numerically from frame to frame, also from 179° to −179°', () => {
    expect(sampleColumn(column([179, -179]), 0, 0.125)).toBe(89.5);
  });

  it('a column by itself is cubic without corners, and straight where the samples are on one line', () => {
    const line = column([1, 3, 5, 7, 9], { interpolation: 'cubic' });
    expectClose(
      [0.1, 0.6, 1.3, 1.9].map((t) => sampleColumn(line, 0, t)),
      [0.1, 0.6, 1.3, 1.9].map((t) => 1 + 4 * t),
      WITHIN.rounding,
    );
    fc.assert(
      fc.property(someValues, fc.nat(10), (values, frame) => {
        fc.pre(frame > 0 && frame < values.length - 1);
        const samples = column(values, { interpolation: 'cubic' });
        const slope = values[frame + 1] - values[frame - 1];
        for (const side of ['in', 'out'] as const) {
          expectClose([columnSlope(samples, 0, 0.5 * frame, side)], [slope], 1e-9);
        }
      }),
    );
  });

  it('a column by itself has the slope that its values have, on either side of a corner', () => {
    const times = fc.double({ min: -1, max: 7, noNaN: true });
    fc.assert(
      fc.property(someValues, times, fc.constantFrom(...INTERPOLATIONS), (values, time, interpolation) => {
        const samples = column(values, { interpolation });
        const step = 1e-6;
        fc.pre(Math.abs(time / 0.25 - Math.round(time / 0.25)) > 1e-4);
        const rise = sampleColumn(samples, 0, time + step) - sampleColumn(samples, 0, time - step);
        for (const side of ['in', 'out'] as const) {
          expect(Math.abs(columnSlope(samples, 0, time, side) - rise / (2 * step))).toBeLessThan(1e-4 * 500);
        }
      }),
    );
    const corner = column([0, 1, 4]);
    const slopes = (time: number) => (['in', 'out'] as const).map((side) => columnSlope(corner, 0, time, side));
    expect([-1, 0, 0.25, 0.5, 1, 2, Number.NaN].map(slopes)).toEqual([
      [0, 0],
      [0, 2],
      [2, 2],
      [2, 6],
      [6, 0],
      [0, 0],
      [0, 0],
    ]);
  });

  it('a column by itself is what its channel is as a curve, until the channel has keys', () => {
    const tangents = { kinds: Uint8Array.of(0), slopes: Float64Array.of(0) };
    const keyed: KeyedChannel = {
      ...{ kind: 'keys', extrapolateIn: 'constant', extrapolateOut: 'constant' },
      ...{ times: Float64Array.of(0), values: Float64Array.of(7), tangentsIn: tangents, tangentsOut: tangents },
    };
    const channels = [restChannel(5), SAMPLED, keyed];
    const samples = column([1, 2, 3, 4], { frameCount: 2, firstChannel: 1, scales: Float64Array.of(1, 1) });
    const take = compileTake({ name: 'mixed', range: [0, 1], channels, samples });
    expect([0, 1, 2].map((c) => evaluateChannel(take, c, 0.25))).toEqual([5, 2, 7]);
    expect([0, 1, 2].map((c) => evaluateSlope(take, c, 0.25, 'out'))).toEqual([0, 4, 0]);
  });
});
