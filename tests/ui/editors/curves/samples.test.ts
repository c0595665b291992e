import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileTake } from '../../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../../src/evaluate/curves.ts';
import { extremesOver, sampleExtremes } from '../../../../src/evaluate/plot/sample-extremes.ts';
import { heightOf, type TraceMap } from '../../../../src/evaluate/plot/trace-path.ts';
import { INTERPOLATIONS, type Samples } from '../../../../src/model/takes/samples.ts';
import { SAMPLED, type Take } from '../../../../src/model/takes/take.ts';
import { LineTrace, traceLine } from '../../../../src/ui/editors/curves/scene/trace.ts';

const samplesOf = (frameCount: number, width: number, value: (i: number) => number): Samples => ({
  frameCount,
  frameSeconds: 0.01,
  startSeconds: 1,
  firstChannel: 0,
  values: Float64Array.from({ length: frameCount * width }, (_, i) => value(i)),
  scales: Float64Array.from({ length: width }, (_, c) => (c % 2 ? -2 : 0.5)),
  interpolation: 'linear',
});
const noise = (i: number) => Math.sin(i * i * 1.7) * 10 + i / 100;

describe('extremes of samples', () => {
  it('extremes of samples are those of the frames, whatever stretch is asked for', () => {
    const samples = samplesOf(1000, 3, noise);
    const plain = sampleExtremes(samples);
    const built = sampleExtremes({ ...samples, values: samples.values.slice() });
    for (const _pause of built.building());
    fc.assert(
      fc.property(fc.nat(999), fc.nat(999), fc.nat(2), (a, b, column) => {
        const [from, to] = [Math.min(a, b), Math.max(a, b)];
        const own = Array.from({ length: to - from + 1 }, (_, k) => samples.values[(from + k) * 3 + column]);
        for (const extremes of [plain, built]) {
          extremes.over(column, from, to);
          expect([extremes.low, extremes.high]).toEqual([Math.min(...own), Math.max(...own)]);
        }
      }),
    );
  });

  it('extremes of samples are in model units over time, with the values at both ends', () => {
    const samples = samplesOf(3, 2, (i) => [0, 0, 10, 10, 0, 0][i]);
    expect({ ...extremesOver(samples, 0, 1.002, 1.018) }).toEqual({ low: expect.closeTo(1), high: 5 });
    expect({ ...extremesOver(samples, 1, 1.002, 1.018) }).toEqual({ low: -20, high: expect.closeTo(-4) });
    expect({ ...extremesOver(samples, 0, -5, 0) }).toEqual({ low: 0, high: 0 });
  });

  it('extremes of samples are recomputed for other values only', () => {
    const samples = samplesOf(100, 1, noise);
    expect(sampleExtremes({ ...samples, startSeconds: 9 })).toBe(sampleExtremes(samples));
    expect(sampleExtremes({ ...samples, values: samples.values.slice() })).not.toBe(sampleExtremes(samples));
  });
});

const mapFrom = (left: number, seconds: number): TraceMap => ({
  left,
  low: -20,
  perSecond: 400 / seconds,
  perUnit: 5,
  width: 400,
  top: 20,
  bottom: 220,
});

describe('a line of samples', () => {
  const takeOf = (samples: Samples): Take => ({
    name: 'take',
    range: [1, 2],
    channels: Array.from(samples.scales, () => SAMPLED),
    samples,
  });

  it.each(INTERPOLATIONS)('a line of samples equals what is evaluated, zoomed in: %s', (interpolation) => {
    const take = takeOf({ ...samplesOf(200, 2, noise), interpolation });
    const curves = compileTake(take);
    const map = mapFrom(1.2, 0.3);
    const out = new LineTrace();
    traceLine(curves, 0, take.channels[0], map, 1, out);
    const { points, verbs, verbCount } = out.solid;
    expect(verbCount).toBeGreaterThan(30);
    let p = 0;
    for (let v = 0; v < verbCount; v++) {
      p += verbs[v] === 2 ? 6 : 2;
      const time = map.left + points[p - 2] / map.perSecond;
      const before = heightOf(map, evaluateChannel(curves, 0, time - 1e-5));
      const after = heightOf(map, evaluateChannel(curves, 0, time + 1e-5));
      const y = points[p - 1];
      expect(Math.min(Math.abs(y - before), Math.abs(y - after))).toBeLessThan(0.5);
    }
    expect(out.columns.from).toBe(out.columns.to);
  });

  it('a line of samples is columns that contain every frame, zoomed out', () => {
    const take = takeOf(samplesOf(5000, 2, noise));
    const { samples } = take;
    const map = mapFrom(0, 60);
    const out = new LineTrace();
    traceLine(compileTake(take), 1, take.channels[1], map, 1, out);
    expect(out.solid.verbCount).toBe(0);
    const { columns } = out;
    for (let f = 0; f < 5000; f++) {
      const column = Math.floor((1 + f * 0.01) * map.perSecond);
      const y = heightOf(map, (samples?.values[2 * f + 1] ?? 0) * -2);
      const holds = [column - 1, column, column + 1].some(
        (c) => columns.tops[c] <= y + 1e-3 && columns.bottoms[c] >= y - 1e-3,
      );
      expect(holds).toBe(true);
    }
  });

  it('a line of samples is constant and dotted before the first frame and after the last one', () => {
    const take = takeOf(samplesOf(50, 1, () => 4));
    const map = mapFrom(0, 4);
    const out = new LineTrace();
    traceLine(compileTake(take), 0, take.channels[0], map, 1, out);
    const ends = Array.from({ length: out.dotted.verbCount }, (_, v) => out.dotted.points[2 * v + 1]);
    expect(ends).toEqual(new Array(4).fill(expect.closeTo(heightOf(map, 2), 3)));
  });
});
