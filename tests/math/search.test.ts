import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { firstNotBelow, lastNotAbove } from '../../src/math/search.ts';

describe('searching sorted numbers', () => {
  it('finds what looking at each would find', () => {
    const number = fc.integer({ min: -10, max: 10 });
    fc.assert(
      fc.property(fc.array(number, { minLength: 1, maxLength: 40 }), fc.nat(3), number, (list, first, x) => {
        const sorted = Float64Array.from([...Array(first).fill(99), ...list.sort((a, b) => a - b), -99]);
        const slow = list.findLastIndex((entry) => entry <= x);
        expect(lastNotAbove(sorted, first, first + list.length, x)).toBe(first + Math.max(0, slow));
      }),
    );
  });

  it('ends at the first for NaN', () => {
    expect(lastNotAbove(Float64Array.of(1, 2, 3), 0, 3, Number.NaN)).toBe(0);
  });

  it('finds where entries end that are less', () => {
    const number = fc.integer({ min: -10, max: 10 });
    fc.assert(
      fc.property(fc.array(number, { maxLength: 40 }), fc.nat(3), number, (list, first, x) => {
        const sorted = [...Array(first).fill(99), ...list.sort((a, b) => a - b), -99];
        const less = list.filter((entry) => entry < x).length;
        expect(firstNotBelow(sorted, x, first, first + list.length)).toBe(first + less);
        expect(firstNotBelow(Float64Array.from(list), x)).toBe(less);
      }),
    );
  });
});
