import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { gridLabel, roundStep, subdivisions, wholeNumbers } from '../../src/math/round-steps.ts';

describe('the grid', () => {
  it.each([
    [0.9, 1],
    [1, 1],
    [1.01, 2],
    [2.5, 5],
    [5.1, 10],
    [0.0011, 0.002],
    [1.7e308, 1e308],
    [5e-324, 5e-324],
    [0.3, 0.5],
    [70, 100],
    [1e-9, 1e-9],
  ])('whose lines are to be %d apart at least has them %d apart', (atLeast, spacing) => {
    expect(roundStep(atLeast)).toBe(spacing);
  });

  it('the grid is never finer than asked for, and never more than 2.5 times as coarse', () => {
    fc.assert(
      fc.property(fc.double({ min: 1e-12, max: 1e12, noNaN: true }), (atLeast) => {
        const spacing = roundStep(atLeast);
        expect(spacing).toBeGreaterThanOrEqual(atLeast * (1 - 1e-8));
        expect(spacing).toBeLessThanOrEqual(atLeast * 2.5);
      }),
    );
  });

  it('the grid has a spacing of 1 where the camera sees nothing', () => {
    for (const size of [0, -1, Number.NaN, Infinity]) expect(roundStep(size)).toBe(1);
  });

  it('divides its cells into round numbers', () => {
    expect([1, 2, 5, 0.1, 0.02, 500].map((s) => s / subdivisions(s))).toEqual([0.2, 0.5, 1, 0.02, 0.005, 100]);
  });

  it('the grid writes numbers as people do, with a true minus sign', () => {
    expect([-2, -1, 0, 1, 3].map((i) => gridLabel(i, 0.05))).toEqual(['−0.10', '−0.05', '0', '0.05', '0.15']);
    expect(gridLabel(3, 0.1)).toBe('0.3');
    expect(gridLabel(7, 20)).toBe('140');
    expect(gridLabel(3, 0.002)).toBe('0.006');
  });

  it('writes very large and very small numbers short', () => {
    expect(gridLabel(5, 1e-6)).toBe('5e−6');
    expect(gridLabel(3, 5e6)).toBe('1.5e7');
    expect(gridLabel(-12, 2e-7)).toBe('−2.4e−6');
    expect(gridLabel(4, 5e6)).toBe('2.0e7');
  });

  it('tells neighbouring lines apart far from the origin', () => {
    expect([1234567, 1234568].map((i) => gridLabel(i, 1))).toEqual(['1234567', '1234568']);
  });
});

describe('multiples of a step', () => {
  it('multiples of a step are counted from the first to the last, and no more than asked for', () => {
    expect(wholeNumbers(-1.5, 2.5, 10)).toEqual([-1, 0, 1, 2]);
    expect(wholeNumbers(0, 1e9, 3)).toEqual([0, 1, 2]);
    expect(wholeNumbers(2, 1, 10)).toEqual([]);
  });

  it('multiples of a step that can not be told apart are none, and none are waited for', () => {
    for (const far of [2 ** 53, 1e16, 1.7e21, 1e300, Infinity, -1e16, Number.NaN]) {
      expect(wholeNumbers(far, far, 10)).toEqual([]);
      expect(wholeNumbers(far, far + 1e20, 10)).toEqual([]);
    }
    expect(wholeNumbers(0, Infinity, 2)).toEqual([0, 1]);
  });
});
