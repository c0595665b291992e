import fc from 'fast-check';
import { expect, it } from 'vitest';
import {
  fitWindow,
  isMostly,
  panWindow,
  pinchWindow,
  revealTime,
  snapTime,
  zoomWindow,
} from '../../../../src/ui/widgets/time/time-window.ts';

it('shows the range with room on both sides', () => {
  const { from, to } = fitWindow([0, 10]);
  expect(from).toBeLessThan(0);
  expect(to).toBeGreaterThan(10);
});

it('shows a range of no length, too', () => {
  const { from, to } = fitWindow([2, 2]);
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
      let window = fitWindow([start, Math.min(Number.MAX_VALUE, start + length)]);
      for (const factor of [1, 0.5, 0.1, 0.01, 1e-9, 3, 1e9]) {
        window = zoomWindow(window, window.from + (window.to - window.from) / 2, factor);
        const { from, to } = window;
        expect([start, length, factor, Number.isFinite(to - from) && to > from]).toEqual([start, length, factor, true]);
        expect(from + (to - from) / 2).toBeGreaterThan(from);
      }
    }
  }
});

it('a window is mostly the times of a range if neither is twice as long, and they overlap', () => {
  const window = { from: 0, to: 2 };
  expect(isMostly(window, [0, 2])).toBe(true);
  expect(isMostly(window, [0.2, 1.5])).toBe(true);
  expect(isMostly(window, [0, 0.5])).toBe(false);
  expect(isMostly(window, [0, 5])).toBe(false);
  expect(isMostly(window, [5, 7])).toBe(false);
  expect(isMostly(window, [1, 1])).toBe(false);
});
