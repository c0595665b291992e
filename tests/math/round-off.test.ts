import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { withoutRoundOff } from '../../src/math/round-off.ts';

describe('withoutRoundOff', () => {
  it.each([
    [0.47259999999999996, 1, 0.4726],
    [0.1 + 0.2, 0.2, 0.3],
    [1 - 0.9974, 1, 0.0026],
    [1e6 + 0.1 - 1e6, 1e6, 0.1],
    [-1e-20, 1, 0],
    [0, 0, 0],
    [1e300, 1, 1e300],
    [Number.POSITIVE_INFINITY, 1, Number.POSITIVE_INFINITY],
  ])('makes %d, of numbers up to %d, %d', (value, size, rounded) => {
    expect(withoutRoundOff(value, size)).toBe(rounded);
  });

  it('withoutRoundOff is off by no more than half of the 15th digit', () => {
    const numbers = fc.double({ min: -1e3, max: 1e3, noNaN: true });
    fc.assert(
      fc.property(numbers, fc.double({ min: 1e-3, max: 1e3, noNaN: true }), (value, size) => {
        const most = Math.max(size, Math.abs(value));
        expect(Math.abs(withoutRoundOff(value, size) - value)).toBeLessThanOrEqual(5.1e-15 * most);
      }),
    );
  });
});
