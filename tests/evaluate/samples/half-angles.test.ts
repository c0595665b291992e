import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HalfAngles } from '../../../src/evaluate/samples/half-angles.ts';

/** Of 1, as a few last digits. */
const LAST_DIGITS = 4e-16;

function read(values: readonly number[], factor: number): HalfAngles {
  const made = new HalfAngles();
  const columns = Int32Array.from(values, (_, i) => values.length - 1 - i);
  made.read(
    Float64Array.from([9, 9, ...values.toReversed()]),
    2,
    columns,
    new Float64Array(values.length).fill(factor),
  );
  return made;
}

describe('half angles of a row', () => {
  it('half angles of a row are the numbers in their columns times the factors, with sines and cosines to the last digits', () => {
    const degrees = fc.double({ min: -400, max: 400, noNaN: true });
    fc.assert(
      fc.property(fc.array(degrees, { minLength: 1, maxLength: 30 }), (values) => {
        const factor = Math.PI / 360;
        const { halves, turned } = read(values, factor);
        values.forEach((value, i) => {
          expect(halves[i]).toBe(value * factor);
          expect(Math.abs(turned[2 * i] - Math.sin(halves[i]))).toBeLessThan(LAST_DIGITS);
          expect(Math.abs(turned[2 * i + 1] - Math.cos(halves[i]))).toBeLessThan(LAST_DIGITS);
        });
      }),
    );
  });
});
