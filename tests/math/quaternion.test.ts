import fc from 'fast-check';
import { expect, it } from 'vitest';
import { writeRotation } from '../../src/math/quaternion.ts';

/** Rounding of a few products of numbers up to 1. */
const EXACT = 1e-14;

const part = fc.double({ min: -1, max: 1, noNaN: true });
const quaternion = fc
  .tuple(part, part, part, part)
  .filter((q) => Math.hypot(...q) > 0.1)
  .map((q) => q.map((v) => v / Math.hypot(...q)));

it('turns a vector v as q·v·q* does', () => {
  fc.assert(
    fc.property(quaternion, fc.tuple(part, part, part), ([x, y, z, w], v) => {
      const m = new Float64Array(9);
      writeRotation(x, y, z, w, m, 0, 3);
      // v + 2·u × (u × v + w·v), u = (x, y, z)
      const u = [x, y, z];
      const cross = (a: readonly number[], b: readonly number[]) =>
        [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
      const inner = cross(u, v).map((c, k) => c + w * v[k]);
      const outer = cross(u, inner);
      for (let k = 0; k < 3; k++) {
        const turned = m[k] * v[0] + m[3 + k] * v[1] + m[6 + k] * v[2];
        expect(Math.abs(turned - (v[k] + 2 * outer[k]))).toBeLessThan(EXACT);
      }
    }),
  );
});

it('writes the same columns within a 4×4 matrix, and nothing between them', () => {
  const nine = new Float64Array(9);
  const sixteen = new Float64Array(17).fill(7);
  writeRotation(0.5, -0.5, 0.1, 0.7, nine, 0, 3);
  writeRotation(0.5, -0.5, 0.1, 0.7, sixteen, 1, 4);
  const columns = [0, 1, 2].flatMap((c) => [...sixteen.subarray(1 + 4 * c, 4 + 4 * c)]);
  expect(columns).toEqual([...nine]);
  expect([0, 4, 8, 12, 13, 14, 15, 16].map((at) => sixteen[at])).toEqual(Array(8).fill(7));
});
