import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { hermiteCubic } from '../../src/math/hermite.ts';
import { expectClose } from '../helpers/close.ts';

function cubic(v0: number, m0: number, v1: number, m1: number, h: number): number[] {
  const out = new Float64Array(4);
  hermiteCubic(v0, m0, v1, m1, h, out, 0);
  return [...out];
}

const number = fc.double({ min: -100, max: 100, noNaN: true });

describe('a Hermite cubic', () => {
  it('a Hermite cubic has the values and slopes given at both ends', () => {
    fc.assert(
      fc.property(
        number,
        number,
        number,
        number,
        fc.double({ min: 0.1, max: 10, noNaN: true }),
        (v0, m0, v1, m1, h) => {
          const [a, b, c, d] = cubic(v0, m0, v1, m1, h);
          expectClose([a, b], [v0, m0], 1e-15);
          expectClose([a + h * (b + h * (c + h * d)), b + h * (2 * c + 3 * h * d)], [v1, m1], 1e-8);
        },
      ),
    );
  });

  it('a Hermite cubic is a straight line if the segment is too short for a cubic, and a step if it is shorter still', () => {
    expect(cubic(1, 5, 3, 5, 1e-200)).toEqual([1, 2e200, 0, 0]);
    expect(cubic(1, 5, 3, 5, 1e-320)).toEqual([1, 0, 0, 0]);
    expect(cubic(1, 5, 3, 5, 0)).toEqual([1, 0, 0, 0]);
  });
});
