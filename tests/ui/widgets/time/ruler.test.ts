import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { isClearOf, rulerTicks } from '../../../../src/ui/widgets/time/ruler.ts';

const labels = (scale: Parameters<typeof rulerTicks>[0]) =>
  rulerTicks(scale).flatMap((tick) => (tick.label === undefined ? [] : [tick.label]));

describe('rulerTicks', () => {
  it('rulerTicks labels round seconds', () => {
    const scale = { window: { from: -0.1, to: 2.1 }, width: 600 };
    expect(labels(scale)).toEqual(['0', '0.5', '1', '1.5', '2']);
  });

  it('rulerTicks gives few ticks at finite times for windows of any length, anywhere', () => {
    const time = fc
      .constantFrom(0, 5e-324, 1e-300, 1e-9, 1, 1.7e9, 1.7e15, 1.7e18, 1e154, 1e308, 1.7e308)
      .chain((size) => fc.constantFrom(size, -size));
    const rate = fc.constantFrom(undefined, 24, 1e-300, 1e308);
    fc.assert(
      fc.property(time, time, rate, (fromSeconds, toSeconds, framesPerSecond) => {
        const ticks = rulerTicks({
          window: { from: fromSeconds, to: toSeconds },
          width: 800,
          ...(framesPerSecond && { framesPerSecond }),
        });
        expect(ticks.length).toBeLessThanOrEqual(2000);
        expect(ticks.every(({ timeSeconds }) => Number.isFinite(timeSeconds))).toBe(true);
      }),
    );
  });

  it('labels times before 0 and far away', () => {
    expect(labels({ window: { from: -2, to: 0 }, width: 200 })).toEqual(['−2', '−1', '0']);
    expect(labels({ window: { from: 3600, to: 3700 }, width: 330 })).toEqual([
      '3600',
      '3620',
      '3640',
      '3660',
      '3680',
      '3700',
    ]);
  });

  it('counts frames, and none of them in parts', () => {
    const scale = { window: { from: 0, to: 1 }, width: 600, framesPerSecond: 24 };
    expect(labels(scale)).toEqual(['0', '5', '10', '15', '20']);
    const close = rulerTicks({ ...scale, window: { from: 0, to: 0.125 } });
    expect(close.map((t) => t.label)).toEqual(['0', '1', '2', '3']);
  });

  it('rulerTicks has no ticks where there is no time or no room', () => {
    expect(rulerTicks({ window: { from: 1, to: 1 }, width: 100 })).toEqual([]);
    expect(rulerTicks({ window: { from: 0, to: 1 }, width: 0 })).toEqual([]);
    expect(rulerTicks({ window: { from: 0, to: Number.POSITIVE_INFINITY }, width: 9 })).toEqual([]);
  });

  it('rulerTicks ends at any time, in seconds and in frames', () => {
    for (const from of [1.7e9, 1.7e15, 1.7e18, 1e300, -1e308, 1e-300]) {
      for (const length of [1e-3, 1, 1e6, 1e300]) {
        for (const frames of [{}, { framesPerSecond: 120 }]) {
          const ticks = rulerTicks({ window: { from, to: from + length }, width: 800, ...frames });
          expect(ticks.length).toBeLessThanOrEqual(2000);
        }
      }
    }
  });

  it('rulerTicks keeps labels apart and inside, whatever the stretch of time', () => {
    fc.assert(
      fc.property(
        fc.double({ min: -1e5, max: 1e5, noNaN: true }),
        fc.double({ min: 1e-3, max: 1e5, noNaN: true }),
        fc.integer({ min: 50, max: 4000 }),
        fc.option(fc.integer({ min: 1, max: 240 }), { nil: undefined }),
        (from, size, width, fps) => {
          const scale = { window: { from, to: from + size }, width };
          const ticks = rulerTicks(fps ? { ...scale, framesPerSecond: fps } : scale);
          const slack = size * 1e-6;
          expect(ticks.filter(({ timeSeconds: t }) => !(t >= from - slack && t <= from + size + slack))).toEqual([]);
          let last = Number.NEGATIVE_INFINITY;
          const wrong = ticks.filter(({ timeSeconds, label }) => {
            if (label === undefined) return false;
            const isApart = ((timeSeconds - last) / size) * width >= 64 * (1 - 1e-5);
            last = timeSeconds;
            return !(isApart && Math.abs(Number(label.replace('−', '-')) - timeSeconds * (fps ?? 1)) < 5e-6);
          });
          expect(wrong).toEqual([]);
        },
      ),
    );
  });
});

it('a number is drawn only 12 pixels clear of the playhead’s flag', () => {
  const flag = [100, 140] as const;
  expect([70, 88, 89, 120, 151, 152].map((left) => isClearOf([left, left + 0], flag))).toEqual([
    true,
    true,
    false,
    false,
    false,
    true,
  ]);
  expect(isClearOf([60, 88], flag)).toBe(true);
  expect(isClearOf([60, 89], flag)).toBe(false);
  expect(isClearOf([110, 130], undefined)).toBe(true);
});
