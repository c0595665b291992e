import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { timeWarp } from '../../../src/evaluate/compare/time-warp.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';

const warp = (a: Float64Array, b: Float64Array, width = 3, window = 0.1) => runToEnd(timeWarp(a, b, width, window));

/** A motion of two joints, by a time of 0 to 1. */
function motion(count: number, time: (part: number) => number): Float64Array {
  return Float64Array.from(
    Array.from({ length: count }, (_, f) => {
      const t = time(f / (count - 1));
      return [Math.sin(9 * t), 2 * t, Math.cos(7 * t), Math.cos(11 * t), t * t, 3 * Math.sin(5 * t)];
    }).flat(),
  );
}

const frames = fc
  .array(fc.array(fc.double({ min: -5, max: 5, noNaN: true }), { minLength: 6, maxLength: 6 }), {
    minLength: 1,
    maxLength: 12,
  })
  .map((rows) => Float64Array.from(rows.flat()));

function pairs(path: Int32Array): [number, number][] {
  return Array.from({ length: path.length / 2 }, (_, k) => [path[2 * k], path[2 * k + 1]]);
}

describe('the distance with time warp', () => {
  it('the distance with time warp of a motion and itself is 0, along the diagonal', () => {
    fc.assert(
      fc.property(frames, (a) => {
        const { distance, path } = warp(a, a, 6);
        expect(distance).toBe(0);
        expect(pairs(path)).toEqual(Array.from({ length: a.length / 6 }, (_, f) => [f, f]));
      }),
    );
  });

  it('the distance with time warp is the same in either order, and at most that without', () => {
    fc.assert(
      fc.property(frames, frames, fc.double({ min: 0, max: 1, noNaN: true }), (a, b, window) => {
        const { distance } = warp(a, b, 6, window);
        expect(Math.abs(distance - warp(b, a, 6, window).distance)).toBeLessThan(1e-12);
        if (a.length !== b.length) return;
        let sum = 0;
        for (let k = 0; k < a.length; k += 3) sum += Math.hypot(a[k] - b[k], a[k + 1] - b[k + 1], a[k + 2] - b[k + 2]);
        expect(distance).toBeLessThanOrEqual((3 * sum) / a.length + 1e-12);
      }),
    );
  });

  it('a warp leads from the first frames to the last ones, in order, within its window', () => {
    fc.assert(
      fc.property(frames, frames, fc.double({ min: 0, max: 0.5, noNaN: true }), (a, b, window) => {
        const path = pairs(warp(a, b, 6, window).path);
        const [n, m] = [a.length / 6, b.length / 6];
        expect(path[0]).toEqual([0, 0]);
        expect(path.at(-1)).toEqual([n - 1, m - 1]);
        for (let k = 1; k < path.length; k++) {
          const step = [path[k][0] - path[k - 1][0], path[k][1] - path[k - 1][1]];
          expect(step[0] + step[1]).toBeGreaterThan(0);
          for (const by of step) expect([0, 1]).toContain(by);
        }
        const reach = window * (n - 1) * (m - 1) + Math.max(n, m) - 1;
        for (const [i, j] of path) expect(Math.abs(i * (m - 1) - j * (n - 1))).toBeLessThanOrEqual(reach + 1e-9);
      }),
    );
  });

  it('a motion that is re-timed smoothly is near with the warp and far without', () => {
    const a = motion(400, (t) => t);
    const b = motion(400, (t) => t + 0.07 * Math.sin(Math.PI * t) ** 2);
    const plain = warp(a, b, 6, 0).distance;
    const warped = warp(a, b, 6).distance;
    expect(plain).toBeGreaterThan(0.25);
    expect(warped).toBeLessThan(0.03 * plain);
  });

  it('a motion at another frame rate is near, and one moved aside is about as far as it was moved', () => {
    const a = motion(300, (t) => t);
    const slower = motion(150, (t) => t);
    expect(warp(a, slower, 6).distance).toBeLessThan(0.03);
    // Frames that are higher by themselves are a little nearer.
    const higher = a.map((x, k) => (k % 3 === 1 ? x + 40 : x));
    expect(warp(a, higher, 6).distance).toBeGreaterThan(39);
    expect(warp(a, higher, 6).distance).toBeLessThanOrEqual(40);
  });
});
