import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { determinant3, inverseTranspose3, invertAffine, isSingular, multiplyAffine } from '../../src/math/mat4.ts';
import { normalizeAt } from '../../src/math/vec3.ts';
import { expectClose } from '../helpers/close.ts';

const number = fc.double({ min: -3, max: 3, noNaN: true });
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const affine = fc
  .array(number, { minLength: 12, maxLength: 12 })
  .map((n) => Float64Array.of(n[0], n[1], n[2], 0, n[3], n[4], n[5], 0, n[6], n[7], n[8], 0, n[9], n[10], n[11], 1))
  .filter((m) => Math.abs(determinant3(m)) > 0.05);

describe('affine matrices', () => {
  it('times their inverse are the identity', () => {
    fc.assert(
      fc.property(affine, (m) => {
        const inverse = new Float64Array(16);
        const product = new Float64Array(16);
        invertAffine(m, 0, inverse, 0);
        multiplyAffine(m, 0, inverse, 0, product, 0);
        expectClose(product, IDENTITY, 1e-9);
        invertAffine(inverse, 0, inverse, 0);
        expectClose(inverse, m, 1e-9, 'inverse of the inverse, in place');
      }),
    );
  });

  it('turn normals by the transposed inverse', () => {
    fc.assert(
      fc.property(affine, (m) => {
        const inverse = new Float64Array(16);
        invertAffine(m, 0, inverse, 0);
        const got = new Float64Array(10);
        inverseTranspose3(m, 0, got, 1);
        const expected = [0, 1, 2].flatMap((c) => [0, 1, 2].map((r) => inverse[4 * r + c]));
        expectClose(got.subarray(1), expected, 1e-12);
      }),
    );
  });

  it('affine matrices that flatten still know where normals point', () => {
    const flat = Float64Array.of(2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 5, 5, 5, 1);
    expect(isSingular(flat)).toBe(true);
    const out = new Float64Array(9);
    inverseTranspose3(flat, 0, out, 0);
    expect(out.map((x) => x + 0)).toEqual(Float64Array.of(0, 0, 0, 0, 6, 0, 0, 0, 0));
  });
});

describe('normalising', () => {
  it('works for vectors of any size', () => {
    for (const size of [1, 1e-150, 1e-300, 5e-324, 1e150, 1e300]) {
      const v = Float64Array.of(9, 0, 3 * size, 4 * size);
      expect(normalizeAt(v, 1)).toBe(true);
      expectClose(v, size === 5e-324 ? [9, 0, 0.6, 0.8] : [9, 0, 0.6, 0.8], 1e-15, `of size ${size}`);
    }
  });

  it('leaves alone what has no direction', () => {
    for (const v of [Float64Array.of(0, 0, 0), Float64Array.of(1, Number.NaN, 0), Float64Array.of(0, Infinity, 0)]) {
      const before = v.slice();
      expect(normalizeAt(v, 0)).toBe(false);
      expect(v).toEqual(before);
    }
  });
});
