/** What is drawn equals what is evaluated: paths are on the curve, columns contain it, and nothing is left out. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type CompiledTake, compileChannels } from '../../../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../../../src/evaluate/curves.ts';
import { NO_COLUMN } from '../../../../../src/evaluate/plot/trace-columns.ts';
import { CURVE, MOVE, type TracedPath, type TraceMap } from '../../../../../src/evaluate/plot/trace-path.ts';
import { type Channel, type KeyedChannel, restChannel } from '../../../../../src/model/takes/take.ts';
import { SMOOTH } from '../../../../../src/model/takes/tangent-kinds.ts';
import { LineTrace, traceLine } from '../../../../../src/ui/editors/curves/scene/trace.ts';
import { anyChannel, anyMap, PLOT } from '../arbitraries.ts';

/** A twentieth, plus rounding to single floats. */
const WITHIN_PIXELS = 0.0501;
/** Single floats, and rounding of a period's start. */
const ASIDE_PIXELS = 0.02;
const FAR = 4096;

interface Piece {
  readonly x0: number;
  readonly x1: number;
  /** Height for u from 0 to 1, from x0 to x1. */
  at(u: number): number;
}

/** The pieces of a path that aren't vertical. */
function pieces({ verbs, points, verbCount }: TracedPath): Piece[] {
  const found: Piece[] = [];
  let p = 0;
  let x = 0;
  let y = 0;
  for (let v = 0; v < verbCount; v++) {
    const [x0, y0] = [x, y];
    if (verbs[v] === CURVE) {
      const [x1, y1, x2, y2, x3, y3] = points.subarray(p, p + 6);
      p += 6;
      // Time is linear along a segment, since its control points are at thirds.
      expect(x1).toBeCloseTo(x0 + (x3 - x0) / 3, 2);
      expect(x2).toBeCloseTo(x0 + (2 * (x3 - x0)) / 3, 2);
      const at = (u: number) => (1 - u) ** 3 * y0 + 3 * u * (1 - u) ** 2 * y1 + 3 * u * u * (1 - u) * y2 + u ** 3 * y3;
      found.push({ x0, x1: x3, at });
      [x, y] = [x3, y3];
      continue;
    }
    [x, y] = points.subarray(p, p + 2);
    p += 2;
    const end = y;
    if (verbs[v] === MOVE || x === x0) continue;
    // Extrapolation to the left is drawn from the first key.
    if (x > x0) found.push({ x0, x1: x, at: (u) => y0 + u * (end - y0) });
    else found.push({ x0: x, x1: x0, at: (u) => end + u * (y0 - end) });
  }
  return found;
}

/** Ever closer: next to a jump both sides count, and on a steep curve only the immediate neighbourhood. */
const BESIDE = [-1, -0.3, -0.1, -0.03, -0.01, -0.001, 0, 0.001, 0.01, 0.03, 0.1, 0.3, 1];

/** Heights of the curve about x, within a pixel at most. */
function heightsBeside(
  curves: CompiledTake,
  map: TraceMap,
  x: number,
  [from, to] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY],
): number[] {
  return BESIDE.map((part) => {
    const time = map.left + Math.min(to, Math.max(from, x + ASIDE_PIXELS * part)) / map.perSecond;
    return map.bottom - (evaluateChannel(curves, 0, time) - map.low) * map.perUnit;
  });
}

/** Smallest and largest height of the curve about x, clipped like the drawing; wider where it is nearly vertical. */
function heightsAbout(curves: CompiledTake, map: TraceMap, x: number): [number, number] {
  const heights = heightsBeside(curves, map, x);
  const between = Math.max(...heights.slice(1).map((y, i) => Math.abs(y - heights[i])));
  const cut = (y: number) => Math.min(map.bottom + FAR, Math.max(map.top - FAR, y));
  return [cut(Math.min(...heights) - between), cut(Math.max(...heights) + between)];
}

function trace(channel: Channel, map: TraceMap, columnsPerPixel = 1) {
  const curves = compileChannels([channel]);
  const line = new LineTrace();
  traceLine(curves, 0, channel, map, columnsPerPixel, line);
  return { curves, line };
}

const uneven = fc.double({ min: 0, max: 1, noNaN: true });

describe('a traced line', () => {
  it('a traced path equals the evaluator everywhere', () => {
    fc.assert(
      fc.property(anyChannel(8), anyMap(0.001, 40), fc.array(uneven, { minLength: 5, maxLength: 5 }), (c, map, us) => {
        const { curves, line } = trace(c, map);
        for (const piece of [...pieces(line.solid), ...pieces(line.dotted)]) {
          for (const u of [0, ...us, 1]) {
            const x = piece.x0 + u * (piece.x1 - piece.x0);
            const [low, high] = heightsAbout(curves, map, x);
            const y = piece.at(u);
            if (y >= low - WITHIN_PIXELS && y <= high + WITHIN_PIXELS) continue;
            expect.fail(`the path is at ${y} beside ${x}, where the curve goes from ${low} to ${high}`);
          }
        }
      }),
      { numRuns: 350 },
    );
  });

  it('a traced line has no gaps in view and within reach', () => {
    fc.assert(
      fc.property(anyChannel(8), anyMap(0.001, 40), fc.array(uneven, { minLength: 9, maxLength: 9 }), (c, map, us) => {
        const { curves, line } = trace(c, map);
        const drawn = [...pieces(line.solid), ...pieces(line.dotted)];
        for (const u of us) {
          const x = u * PLOT.width;
          const column = Math.min(PLOT.width - 1, Math.floor(x));
          if (line.columns.to > column && line.columns.kinds[column] !== NO_COLUMN) continue;
          // Without margin: a step far out of view is as far as its ends. And only in view: of a step at the very edge,
          // the other side is beyond it.
          const heights = heightsBeside(curves, map, x, [0, PLOT.width - 1e-6]);
          if (Math.max(...heights) < 0 || Math.min(...heights) > PLOT.bottom) continue;
          expect(drawn.some((p) => p.x0 <= x + ASIDE_PIXELS && p.x1 >= x - ASIDE_PIXELS)).toBe(true);
        }
      }),
      { numRuns: 250 },
    );
  });

  it('columns of a traced line contain exactly what the evaluator returns in them', () => {
    const samples = 300;
    fc.assert(
      fc.property(anyChannel(60, 2), anyMap(10, 400), fc.constantFrom(1, 2), (c, map, perPixel) => {
        const { curves, line } = trace(c, map, perPixel);
        for (let i = line.columns.from; i < line.columns.to; i += 7) {
          if (line.columns.kinds[i] === NO_COLUMN) continue;
          // A column at the edge of the keys shares its pixel with a straight line.
          if (line.columns.kinds[i - 1] === NO_COLUMN || line.columns.kinds[i + 1] === NO_COLUMN) continue;
          if (i === line.columns.from || i === line.columns.to - 1) continue;
          let top = Number.POSITIVE_INFINITY;
          let bottom = Number.NEGATIVE_INFINITY;
          for (let s = 0; s <= samples; s++) {
            const time = map.left + (i + s / samples) / perPixel / map.perSecond;
            const y = map.bottom - (evaluateChannel(curves, 0, time) - map.low) * map.perUnit;
            top = Math.min(top, y);
            bottom = Math.max(bottom, y);
          }
          const cut = (y: number) => Math.min(map.bottom + FAR, Math.max(map.top - FAR, y));
          const [drawnTop, drawnBottom] = [line.columns.tops[i], line.columns.bottoms[i]];
          const isIn = drawnTop <= cut(top) + WITHIN_PIXELS && drawnBottom >= cut(bottom) - WITHIN_PIXELS;
          if (!isIn) expect.fail(`column ${i} goes from ${drawnTop} to ${drawnBottom}, not from ${top} to ${bottom}`);
        }
      }),
      { numRuns: 100 },
    );
  });
});

function steady(count: number, value: (i: number) => number, more: Partial<KeyedChannel> = {}): KeyedChannel {
  const tangents = { kinds: new Uint8Array(count).fill(SMOOTH), slopes: new Float64Array(count) };
  return {
    kind: 'keys',
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    times: Float64Array.from({ length: count }, (_, i) => i / 100),
    values: Float64Array.from({ length: count }, (_, i) => value(i)),
    tangentsIn: tangents,
    tangentsOut: tangents,
    ...more,
  };
}

const view = (more: Partial<TraceMap> = {}): TraceMap => ({
  ...PLOT,
  left: 0,
  low: -1,
  perSecond: 100,
  perUnit: 100,
  ...more,
});

describe('a line of many keys', () => {
  it('columns of many keys are no taller than the curve in them', () => {
    const { line } = trace(
      steady(30_001, (i) => Math.sin(i / 3000)),
      view({ perSecond: 1 }),
    );
    expect(line.solid.verbCount).toBe(0);
    for (let i = line.columns.from; i < line.columns.to; i++) {
      const [a, b] = [Math.sin((100 * i) / 3000), Math.sin((100 * (i + 1)) / 3000)];
      const turn = Math.cos((100 * i) / 3000) * Math.cos((100 * (i + 1)) / 3000) < 0;
      if (turn) continue;
      expect(line.columns.tops[i]).toBeCloseTo(122 - 100 * Math.max(a, b), 1);
      expect(line.columns.bottoms[i]).toBeCloseTo(122 - 100 * Math.min(a, b), 1);
    }
    expect([line.columns.from, line.columns.to]).toEqual([0, 300]);
  });

  it('columns show a single outlier among thousands of keys', () => {
    const { line } = trace(
      steady(20_001, (i) => (i === 7_777 ? 1 : 0)),
      view({ perSecond: 1 }),
    );
    expect(line.columns.tops[77]).toBeCloseTo(22, 3);
    expect(line.columns.tops[76]).toBeCloseTo(122, 3);
  });

  it('a line of many keys is a path again when zoomed in', () => {
    const { line } = trace(
      steady(20_001, (i) => Math.sin(i)),
      view({ perSecond: 3000, left: 50 }),
    );
    expect(line.columns.to).toBe(0);
    expect(line.solid.verbCount).toBeGreaterThan(8);
    expect(line.solid.verbCount).toBeLessThan(20);
  });
});

describe('what is extrapolated', () => {
  it('extrapolation with many periods per pixel is a band of all its values', () => {
    const channel = steady(5, (i) => [0, 1, -1, 0.5, 0][i], { extrapolateOut: 'cycle' });
    const { line } = trace(channel, view({ perSecond: 0.01, left: 100 }));
    const own = trace(channel, view({ perSecond: 1e9, left: 0 })).curves;
    let [low, high] = [0, 0];
    for (let s = 0; s <= 2000; s++) {
      const value = evaluateChannel(own, 0, (0.04 * s) / 2000);
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    for (let i = 0; i < 300; i++) {
      expect(line.columns.tops[i]).toBeCloseTo(122 - 100 * high, 2);
      expect(line.columns.bottoms[i]).toBeCloseTo(122 - 100 * low, 2);
    }
  });

  it('extrapolation ends at any time, also where periods can not be counted', () => {
    for (const extrapolateOut of ['cycle', 'cycle_offset', 'bounce', 'linear'] as const) {
      for (const start of [0, 1e9, 1e16, 1.7e18, 1e300]) {
        for (const length of [1e-300, 1, 1e3, 1e18]) {
          const times = Float64Array.of(-length, 0);
          const channel = { ...steady(2, (i) => i, { extrapolateOut }), times };
          for (const perSecond of [1e-18, 1, 1e9]) {
            const { line } = trace(channel, view({ left: start, perSecond }));
            expect(line.dotted.pointCount).toBeLessThan(1e6);
          }
        }
      }
    }
  });

  it('a channel without keys is drawn at its rest, from edge to edge', () => {
    const { line } = trace(restChannel(0.25), view());
    expect(line.solid.verbCount).toBe(0);
    expect(line.dotted.verbCount).toBe(2);
    const [x0, y0, x1, y1] = line.dotted.points;
    expect([y0, y1]).toEqual([97, 97]);
    expect(x0).toBeLessThanOrEqual(0);
    expect(x1).toBeGreaterThanOrEqual(300);
  });

  it('a step is drawn as a vertical line between both of its values', () => {
    const channel = { ...steady(3, (i) => [0, 0, 1][i]), times: Float64Array.of(0, 1, 1) };
    const { line } = trace(channel, view());
    const { points, pointCount } = line.solid;
    const all = Array.from({ length: pointCount / 2 }, (_, i) => [points[2 * i], points[2 * i + 1]]);
    expect(all).toContainEqual([100, 122]);
    expect(all).toContainEqual([100, 22]);
  });

  it('tracing a whole day at a millisecond stays exact to a twentieth of a pixel', () => {
    const channel = { ...steady(2, (i) => i), times: Float64Array.of(0, 86_400) };
    const map = view({ left: 43_200, perSecond: 300_000, perUnit: 1e9, low: 0.4999999 });
    const { curves, line } = trace(channel, map);
    const [piece] = pieces(line.solid);
    const [low, high] = heightsAbout(curves, map, 150);
    const y = piece.at((150 - piece.x0) / (piece.x1 - piece.x0));
    expect(y).toBeGreaterThan(low - WITHIN_PIXELS);
    expect(y).toBeLessThan(high + WITHIN_PIXELS);
  });
});
