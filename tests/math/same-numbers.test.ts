import { expect, it } from 'vitest';
import { sameNumbers } from '../../src/math/same-numbers.ts';

it('arrays are the same numbers if both length and every number are equal', () => {
  const own = Float64Array.of(1, -2, 0);
  expect(sameNumbers(own, Float64Array.of(1, -2, -0))).toBe(true);
  expect(sameNumbers(own, Float64Array.of(1, -2, 1e-300))).toBe(false);
  expect(sameNumbers(own, own.subarray(0, 2))).toBe(false);
  expect(sameNumbers(Float64Array.of(Number.NaN), Float64Array.of(Number.NaN))).toBe(false);
});
