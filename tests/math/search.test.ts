import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { lastNotAbove } from '../../src/math/search.ts';

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
});
