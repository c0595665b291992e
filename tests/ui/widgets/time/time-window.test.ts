import fc from 'fast-check';
import { expect, it } from 'vitest';
import {
  fitWindow,
  GUTTER,
  panWindow,
  pinchWindow,
  revealTime,
  snapTime,
  timeAt,
  timeX,
  zoomWindow,
} from '../../../../src/ui/widgets/time/time-window.ts';

it('shows the range with room on both sides', () => {
  const { from, to } = fitWindow([0, 10], 1000);
  expect(from).toBeLessThan(0);
  expect(to).toBeGreaterThan(10);
});

it('shows a range of no length, too', () => {
  const { from, to } = fitWindow([2, 2], 1000);
  expect(to - from).toBeGreaterThan(0.5);
  expect(from).toBeLessThan(2);
});

it('zooms about a time that stays in its place', () => {
  const zoomed = zoomWindow({ from: 0, to: 10 }, 2, 0.5);
  expect(zoomed).toEqual({ from: 1, to: 6 });
});

it('stops zooming before time has no extent', () => {
  let window = { from: 0, to: 1 };
  for (let i = 0; i < 200; i++) window = zoomWindow(window, 0.5, 0.5);
  expect(window.to - window.from).toBeCloseTo(1e-3);
  for (let i = 0; i < 200; i++) window = zoomWindow(window, 0.5, 2);
  expect(window.to - window.from).toBeCloseTo(1e6);
});

it('moves no further than it takes', () => {
  const window = { from: 0, to: 1 };
  expect(revealTime(window, 0.5)).toBe(window);
  expect(revealTime(window, 1.5)).toEqual({ from: 0.5, to: 1.5 });
  expect(panWindow(window, -2)).toEqual({ from: -2, to: -1 });
});

it('scrubs to short decimals, or to whole frames', () => {
  expect(snapTime(1.23456789, 0.004)).toBe(1.235);
  expect(snapTime(1.23456789, 0.05)).toBe(1.23);
  expect(snapTime(123.456, 3)).toBe(123);
  expect(snapTime(1.02, 0.004, 24)).toBeCloseTo(24 / 24);
  expect(snapTime(1e307, 1e304, 60)).toBe(1e307);
});

it('two fingers zoom the window: the times below them stay below them', () => {
  const window = { from: 10, to: 20 };
  fc.assert(
    fc.property(pixels(), pixels(), (from, to) => {
      const zoomed = pinchWindow(window, 500, from, to);
      for (const k of [0, 1]) {
        const before = window.from + (from[k] / 500) * (window.to - window.from);
        const after = zoomed.from + (to[k] / 500) * (zoomed.to - zoomed.from);
        expect(after).toBeCloseTo(before, 6);
      }
    }),
  );
  expect(pinchWindow(window, 500, [100, 300], [100, 300])).toEqual(window);
  // Fingers above each other only move it.
  const above = pinchWindow(window, 500, [100, 101], [150, 149]);
  expect(above.to - above.from).toBeCloseTo(10, 9);
});

/** Two fingers that are far enough apart to zoom. */
function pixels() {
  const at = fc.integer({ min: 0, max: 250 });
  return fc.tuple(at, fc.integer({ min: 30, max: 250 })).map(([a, apart]) => [a, a + apart] as const);
}

/** Seconds, microseconds and nanoseconds since 1970, and the ends of doubles. */
const FAR = [1.7e9, 1.7e15, 1.7e18, 1e308, -1e308, 1e-300, 0];

it('a window at any time has room to tell pixels apart, however often it is zoomed', () => {
  for (const start of FAR) {
    for (const length of [0, 1e-300, 1e-3, 1, 1e9, 1e308]) {
      let window = fitWindow([start, Math.min(Number.MAX_VALUE, start + length)], 1000);
      for (const factor of [1, 0.5, 0.1, 0.01, 1e-9, 3, 1e9]) {
        window = zoomWindow(window, window.from + (window.to - window.from) / 2, factor);
        const { from, to } = window;
        expect([start, length, factor, Number.isFinite(to - from) && to > from]).toEqual([start, length, factor, true]);
        expect(from + (to - from) / 2).toBeGreaterThan(from);
      }
    }
  }
});

it('a time is at one place of all that are as wide and show one window, and back', () => {
  const strip = { window: { from: -0.5, to: 9.5 }, width: 800 };
  expect([-0.5, 0, 9.5].map((seconds) => timeX(strip, seconds))).toEqual([0, 40, 800]);
  fc.assert(
    fc.property(fc.double({ min: -9, max: 9, noNaN: true }), fc.integer({ min: 1, max: 4000 }), (seconds, width) => {
      expect(timeAt({ ...strip, width }, timeX({ ...strip, width }, seconds))).toBeCloseTo(seconds, 9);
    }),
  );
});

it('a fitted range has the same gutter on both sides, whatever the width', () => {
  for (const width of [400, 992, 1224, 3000]) {
    const strip = { window: fitWindow([0, 6.4], width), width };
    expect(timeX(strip, 0)).toBeCloseTo(GUTTER, 9);
    expect(timeX(strip, 6.4)).toBeCloseTo(width - GUTTER, 9);
  }
  expect(timeX({ window: fitWindow([0, 1], 100), width: 100 }, 0)).toBeCloseTo(20, 9);
});
