import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HalfAngles } from '../../src/evaluate/half-angles.ts';

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
  it('are the numbers in their columns times the factors, with sines and cosines to the last digits', () => {
    const degrees = fc.oneof(
      fc.double({ min: -400, max: 400, noNaN: true }),
      fc.double({ min: -1e5, max: 1e5, noNaN: true }),
    );
    fc.assert(
      fc.property(fc.array(degrees, { minLength: 1, maxLength: 30 }), (values) => {
        const factor = Math.PI / 360;
        const { halves, sines, cosines } = read(values, factor);
        values.forEach((value, i) => {
          expect(halves[i]).toBe(value * factor);
          expect(Math.abs(sines[i] - Math.sin(halves[i]))).toBeLessThan(LAST_DIGITS);
          expect(Math.abs(cosines[i] - Math.cos(halves[i]))).toBeLessThan(LAST_DIGITS);
        });
      }),
    );
  });

  it('go over from one series to the next without a gap', () => {
    const { sines, cosines, halves } = read(
      [Math.PI / 4, (3 * Math.PI) / 4, Math.PI / 2, Math.PI].flatMap((x) => [x - 1e-12, x, x + 1e-12, -x]),
      1,
    );
    halves.forEach((x, i) => {
      expect(Math.abs(sines[i] - Math.sin(x))).toBeLessThan(LAST_DIGITS);
      expect(Math.abs(cosines[i] - Math.cos(x))).toBeLessThan(LAST_DIGITS);
    });
  });

  it('of what is no number are none', () => {
    const { sines, cosines } = read([Number.NaN, Infinity], 1);
    for (const value of [...sines, ...cosines]) expect(value).toBeNaN();
  });
});
