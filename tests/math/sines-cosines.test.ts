import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { writeSinesAndCosines } from '../../src/math/sines-cosines.ts';

/** Of 1, as a few last digits. */
const LAST_DIGITS = 4e-16;

function of(angles: readonly number[]): { sines: Float64Array; cosines: Float64Array } {
  const out = new Float64Array(2 * angles.length);
  writeSinesAndCosines(Float64Array.from(angles), angles.length, out);
  return { sines: out.filter((_, k) => k % 2 === 0), cosines: out.filter((_, k) => k % 2 === 1) };
}

function expectTrue(angles: readonly number[]): void {
  const { sines, cosines } = of(angles);
  angles.forEach((angle, i) => {
    expect(Math.abs(sines[i] - Math.sin(angle)), `sine of ${angle}`).toBeLessThan(LAST_DIGITS);
    expect(Math.abs(cosines[i] - Math.cos(angle)), `cosine of ${angle}`).toBeLessThan(LAST_DIGITS);
  });
}

describe('sines and cosines of a row of angles', () => {
  it('sines and cosines are true to the last digits, however often the angle goes round', () => {
    const angle = fc.oneof(
      fc.double({ min: -7, max: 7, noNaN: true }),
      fc.double({ min: -1e5, max: 1e5, noNaN: true }),
      fc.double({ noNaN: true, noDefaultInfinity: true }),
    );
    fc.assert(fc.property(fc.array(angle, { minLength: 1, maxLength: 30 }), expectTrue), { numRuns: 300 });
  });

  it('sines and cosines of a row of angles go over from one quarter to the next without a gap, up to the largest angles', () => {
    const turns = [...Array(9).keys(), 63_660, 63_661, 63_662, 127_323, 127_324];
    const edges = turns.flatMap((n) => [(n * Math.PI) / 4, -n * (Math.PI / 4), (n * Math.PI) / 2]);
    expectTrue(edges.flatMap((x) => [x - 1e-12, x, x + 1e-12]));
    expectTrue([1e5, -1e5, 1e5 + 1e-10, 1e300, -1e300]);
  });

  it('sines and cosines of a row of angles keep the sign of nothing', () => {
    expect([...of([0, -0]).sines]).toEqual([0, -0]);
  });

  it('the sine and cosine of NaN and infinity are NaN', () => {
    const { sines, cosines } = of([Number.NaN, Infinity, -Infinity]);
    for (const value of [...sines, ...cosines]) expect(value).toBeNaN();
  });

  it('leave what is behind the row alone', () => {
    const out = Float64Array.of(7, 7, 7, 7);
    writeSinesAndCosines(Float64Array.of(0, 1), 1, out);
    expect([...out]).toEqual([0, 1, 7, 7]);
  });
});
