import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  acrossOf,
  add,
  cross,
  dot,
  normalizeAt,
  scaled,
  subtract,
  transformPoint,
  transformVector,
  unit,
  type Vec3,
} from '../../src/math/vec3.ts';

/** Of numbers around 1. */
const NEAR = 1e-12;

const coordinate = fc.double({ min: -3, max: 3, noNaN: true });
const vector: fc.Arbitrary<Vec3> = fc.tuple(coordinate, coordinate, coordinate);
const direction = vector.filter((v) => Math.hypot(...v) > 1e-3).map((v) => scaled(v, 1 / Math.hypot(...v)));

describe('three numbers', () => {
  it('three numbers are added, as often as one says, and taken away', () => {
    expect(add([1, 2, 3], [10, 20, 30])).toEqual([11, 22, 33]);
    expect(add([1, 2, 3], [10, 20, 30], 2)).toEqual([21, 42, 63]);
    expect(subtract([1, 2, 3], [10, 20, 30])).toEqual([-9, -18, -27]);
  });

  it('three numbers have a cross product at right angles to both, by the right-hand rule', () => {
    expect(cross([1, 0, 0], [0, 1, 0])).toEqual([0, 0, 1]);
    fc.assert(
      fc.property(vector, vector, (a, b) => {
        const c = cross(a, b);
        expect(Math.abs(dot(a, c))).toBeLessThan(100 * NEAR);
        expect(Math.abs(dot(b, c))).toBeLessThan(100 * NEAR);
        // Lagrange: |a × b|² + (a · b)² = |a|² |b|².
        expect(Math.abs(dot(c, c) + dot(a, b) ** 2 - dot(a, a) * dot(b, b))).toBeLessThan(1000 * NEAR);
      }),
    );
  });

  it('three numbers have a length of 1 where they have a direction', () => {
    expect(unit([0, -4, 0])).toEqual([0, -1, 0]);
    expect(unit([0, 0, 0])).toBeUndefined();
    expect(unit([Infinity, 0, 0])).toBeUndefined();
    expect(unit([Number.NaN, 0, 0])).toBeUndefined();
  });

  it('three numbers have another direction across', () => {
    fc.assert(
      fc.property(direction, (axis) => {
        const across = acrossOf(axis);
        expect(Math.abs(dot(axis, across))).toBeLessThan(NEAR);
        expect(Math.abs(Math.hypot(...across) - 1)).toBeLessThan(NEAR);
      }),
    );
  });

  it('three numbers go through a matrix as a point, and as a difference of points', () => {
    // x goes to 2 y, y to −x, z stays; then 10 20 30 further. Behind another matrix.
    const m = new Float64Array(32);
    m.set([0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1], 16);
    expect(transformPoint(m, [1, 2, 3], 16)).toEqual([8, 22, 33]);
    expect(transformVector(m, [1, 2, 3], 16)).toEqual([-2, 2, 3]);
    expect(transformPoint(m.slice(16), [1, 2, 3])).toEqual([8, 22, 33]);
    expect(transformVector(m.slice(16), [1, 2, 3])).toEqual([-2, 2, 3]);
  });

  it('three numbers are made a vector of length 1 in place, however long or short', () => {
    for (const size of [1e-160, 1e-3, 1, 1e300]) {
      const a = Float64Array.of(9, 3 * size, 0, -4 * size);
      expect(normalizeAt(a, 1)).toBe(true);
      [9, 0.6, 0, -0.8].forEach((wanted, k) => {
        expect(Math.abs(a[k] - wanted)).toBeLessThan(NEAR);
      });
    }
    const nothing = Float64Array.of(0, 0, 0);
    expect(normalizeAt(nothing, 0)).toBe(false);
    expect([...nothing]).toEqual([0, 0, 0]);
  });
});
