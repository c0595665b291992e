import fc from 'fast-check';
import { expect, it } from 'vitest';
import { anglesOf, type JointRotation, putQuaternions } from '../../../src/edit/samples/rotations.ts';

const ORDERS: readonly JointRotation['axes'][] = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
  [2, 1, 0],
  [0, 2, 1],
  [1, 0, 2],
];

function quaternionOf(angles: ArrayLike<number>, axes: JointRotation['axes']): Float64Array {
  const out = new Float64Array(4);
  putQuaternions([Float64Array.of(angles[0]), Float64Array.of(angles[1]), Float64Array.of(angles[2])], axes, out, 0, 1);
  return out;
}

it('finds angles of the same rotation in every order, in and near gimbal lock', () => {
  const angle = fc.double({ min: -3, max: 3, noNaN: true });
  const middle = fc.oneof(
    angle,
    fc.constantFrom(...[0, 1e-9, 1e-5, 1e-3].flatMap((d) => [Math.PI / 2 - d, d - Math.PI / 2])),
  );
  fc.assert(
    fc.property(fc.constantFrom(...ORDERS), angle, middle, angle, angle, angle, (axes, a, b, c, a0, c0) => {
      const q = quaternionOf([a, b, c], axes);
      const again = quaternionOf(anglesOf(q, 0, axes, a0, b, c0).slice(), axes);
      const cosine = q.reduce((sum, v, n) => sum + v * again[n], 0);
      // Nearer than 5e-5 to the lock it is taken for it.
      expect(1 - Math.abs(cosine)).toBeLessThan(1e-8);
    }),
  );
});
