/** Lines through values at evenly spaced frames, at any zoom. */
import { describe, expect, it } from 'vitest';
import { traceFrames } from '../../../../src/ui/editors/timeline/trace-frames.ts';

const FRAMES = { startSeconds: 0, frameSeconds: 0.01, frameCount: 2001 };
/** Values are drawn as they are. */
const traced = (values: ArrayLike<number>, width: number, gaps: number[] = []) => {
  const points: (readonly [number, number])[] = [];
  const lineTo = (x: number, y: number) => void points.push([x, y]);
  const moveTo = (x: number, y: number) => {
    gaps.push((x / width) * 20);
    lineTo(x, y);
  };
  const g = { lineTo, moveTo, arc: () => undefined };
  const view = { window: { from: 0, to: 20 }, width, range: [0, 20] as const, framesPerSecond: 100, inFrames: false };
  traceFrames(g, view, FRAMES, values, (value) => value);
  return points.map(([x, y]) => [(x / width) * 20, y] as const);
};

describe('the line of a take in a plot', () => {
  it.each([100, 300, 800, 4000])('goes through frames at their times, without steps, %i pixels wide', (width) => {
    const values = Float64Array.from({ length: 2001 }, (_, f) => Math.sin(f / 100));
    const points = traced(values, width);
    expect(points.filter(([seconds, value]) => !(Math.abs(value - Math.sin(seconds)) < 5e-10))).toEqual([]);
    // From left to right, so that it rises and falls only as the values do.
    expect(points.filter(([seconds], i) => i > 0 && !(seconds >= points[i - 1][0]))).toEqual([]);
    expect([points[0][0], points.at(-1)?.[0]]).toEqual([0, expect.closeTo(20, 9)]);
  });

  it.each([100, 4000])('has a gap where values are missing, and ends where they do, %i pixels wide', (width) => {
    const gaps: number[] = [];
    const values = Float64Array.from({ length: 2001 }, (_, f) => (f >= 800 && f < 1200 ? Number.NaN : f));
    const points = traced(values, width, gaps);
    expect(gaps).toEqual([expect.closeTo(12, 9)]);
    expect(points.some(([seconds, value]) => Number.isNaN(value) || (seconds > 8 && seconds < 11.99))).toBe(false);
  });

  it('keeps a peak of one frame at any zoom', () => {
    for (const at of [0, 777, 1500, 2000]) {
      const values = Float64Array.from({ length: 2001 }, (_, f) => (f === at ? 5 : f === at + 1 ? -5 : 0));
      const drawn = traced(values, 200).map(([, value]) => value);
      expect(Math.max(...drawn)).toBe(5);
      if (at < 2000) expect(Math.min(...drawn)).toBe(-5);
    }
  });
});
