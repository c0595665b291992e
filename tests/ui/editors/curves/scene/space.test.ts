/** Screen positions of times and values, and how the view changes. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { evaluateChannel } from '../../../../../src/evaluate/curves.ts';
import { type Fitted, fit as fitted, timesOf } from '../../../../../src/ui/editors/curves/scene/fit.ts';
import { type CurveSpace, pan, valueAt, yOf, zoom } from '../../../../../src/ui/editors/curves/scene/space.ts';
import { fitWindow, timeAt, timeX } from '../../../../../src/ui/widgets/time/time-window.ts';
import { keyed, line, SPACE, scene } from '../scenes.ts';

/** As the curve editor fits all: the times first, then the values in them. */
const fitAll = (given: Fitted) =>
  fitted({ ...given, space: { ...given.space, window: fitWindow(timesOf(given), given.space.width) } }, 'values');

const number = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const anySpace: fc.Arbitrary<CurveSpace> = fc
  .record({ from: number(-9, 9), seconds: number(0.01, 99), low: number(-9, 9), extent: number(0.01, 99) })
  .map(({ from, seconds, low, extent }) => ({
    ...SPACE,
    window: { from, to: from + seconds },
    axes: { ...SPACE.axes, length: { low, high: low + extent } },
  }));
const metres = line(0, 'length');

describe('the space of the curves', () => {
  it('converts times and values to points and back', () => {
    const normalise = { scale: 0.3, shift: -2 };
    fc.assert(
      fc.property(anySpace, number(0, 400), number(0, 200), fc.constantFrom(undefined, normalise), (s, x, y, n) => {
        expect(timeX(s, timeAt(s, x))).toBeCloseTo(x, 6);
        expect(yOf(s, { axis: 'length', normalise: n }, valueAt(s, { axis: 'length', normalise: n }, y))).toBeCloseTo(
          y,
          6,
        );
      }),
    );
  });

  it('the space of the curves keeps the point under the pointer while zooming', () => {
    fc.assert(
      fc.property(anySpace, number(0, 400), number(0, 200), number(0.2, 5), number(0.2, 5), (s, x, y, ft, fv) => {
        const next = zoom(s, x, y, ft, fv);
        expect(timeX(next, timeAt(s, x))).toBeCloseTo(x, 4);
        expect(yOf(next, metres, valueAt(s, metres, y))).toBeCloseTo(y, 4);
      }),
    );
  });

  it('the space of the curves pans with the pointer', () => {
    const next = pan(SPACE, 30, -12);
    expect(timeX(next, timeAt(SPACE, 100))).toBeCloseTo(130, 9);
    expect(yOf(next, metres, valueAt(SPACE, metres, 100))).toBeCloseTo(88, 9);
  });

  it('the space of the curves keeps a direction that is not zoomed or panned, to the bit', () => {
    expect(zoom(SPACE, 100, 100, 1, 2).window).toBe(SPACE.window);
    expect(zoom(SPACE, 100, 100, 2, 1).axes).toBe(SPACE.axes);
    expect(pan(SPACE, 5, 0).axes).toBe(SPACE.axes);
  });

  it('puts the top of an axis at the top of the plot', () => {
    expect(yOf(SPACE, metres, 1)).toBe(0);
    expect(yOf(SPACE, metres, -1)).toBe(200);
  });
});

describe('fitting', () => {
  // Between its keys the curve exceeds all of them.
  const wave = keyed(
    [
      [1, 0],
      [2, 0],
      [3, 0.5],
    ],
    4,
  );

  it('fitting shows all of the curves, overshoots between keys included, within the plot', () => {
    const given = scene([wave]);
    const space = fitAll(given);
    expect(timeX(space, 0)).toBeGreaterThan(0);
    expect(timeX(space, 4)).toBeLessThan(400);
    const heights = Array.from({ length: 201 }, (_, i) =>
      yOf(space, given.lines[0], evaluateChannel(given.curves, 0, 1 + i / 100)),
    );
    expect(Math.min(...heights.map((_, i) => evaluateChannel(given.curves, 0, 1 + i / 100)))).toBeLessThan(-0.3);
    expect(Math.min(...heights)).toBeGreaterThan(0);
    expect(Math.max(...heights)).toBeLessThan(200);
  });

  it('fitting centres the selected keys', () => {
    const given = scene([wave, keyed([[0, 100]])], { selected: [{ channel: 0, indices: [1, 2] }] });
    const space = fitted(given, 'selected');
    expect(timeX(space, 2) + timeX(space, 3)).toBeCloseTo(400, 6);
    expect(yOf(space, given.lines[0], 0) + yOf(space, given.lines[0], 0.5)).toBeCloseTo(200, 6);
  });

  it('fitting handles each axis separately, and keeps those that show nothing', () => {
    const given = scene(
      [
        keyed([
          [0, -1],
          [4, 1],
        ]),
        keyed([
          [0, 0],
          [4, 50],
        ]),
      ],
      { lines: [line(0), line(1, 'length')] },
    );
    const { axes } = fitAll(given);
    expect(axes.angle.high).toBeLessThan(1.5);
    expect(axes.length.high).toBeGreaterThan(50);
    expect(axes.weight).toBe(SPACE.axes.weight);
  });

  it('fitting keeps the time window on request, and uses the values in it', () => {
    const given = scene([
      keyed(
        [
          [0, 0],
          [10, 10],
        ],
        1,
      ),
    ]);
    const space = fitted(given, 'values');
    expect(space.window).toBe(SPACE.window);
    expect(space.axes.angle.high).toBeGreaterThan(4);
    expect(space.axes.angle.high).toBeLessThan(5.5);
  });

  it('fitting handles a single key, and none', () => {
    for (const channel of [keyed([[1, 0.5]]), { ...keyed([]), rest: 0.5 }]) {
      const { axes, window } = fitAll(scene([channel]));
      expect(axes.angle.low).toBeLessThan(0.5);
      expect(axes.angle.high).toBeGreaterThan(0.5);
      expect(axes.angle.high - axes.angle.low).toBeGreaterThan(0.1);
      expect(window.to).toBeGreaterThan(window.from);
    }
  });
});

it('a view fits keys at any time and value: its ends are told apart', () => {
  for (const far of [1.7e9, 1.7e15, 1.7e18, 1e300, -1e308, 1e-300]) {
    for (const keys of [
      [[far, far]],
      [
        [far, far],
        [far + 1, far * 2],
      ],
      [
        [-far, far],
        [far, -far],
      ],
    ] as const) {
      const { window, axes } = fitAll(scene([keyed(keys)], { range: [-Math.abs(far), Math.abs(far)] }));
      expect([far, window.to > window.from && Number.isFinite(window.to - window.from)]).toEqual([far, true]);
      for (const { low, high } of Object.values(axes)) expect([far, high > low]).toEqual([far, true]);
    }
  }
});
