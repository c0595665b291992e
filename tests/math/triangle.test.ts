import fc from 'fast-check';
import { expect, it } from 'vitest';
import { areaNormal } from '../../src/math/triangle.ts';
import { cross, subtract } from '../../src/math/vec3.ts';

const normalOf = (...corners: readonly (readonly number[])[]) => {
  const out = new Float64Array(3);
  areaNormal(Float64Array.from(corners.flat()), 0, 3, 6, out);
  return [...out];
};

it('the area normal is twice the area along the side from which the corners run anticlockwise', () => {
  expect(normalOf([0, 0, 0], [2, 0, 0], [0, 3, 0])).toEqual([0, 0, 6]);
  expect(normalOf([0, 0, 0], [0, 3, 0], [2, 0, 0])).toEqual([0, 0, -6]);
  expect(normalOf([1, 1, 1], [2, 2, 2], [4, 4, 4])).toEqual([0, 0, 0]);
});

it('the area normal is the cross product of two sides, wherever the vertices are stored', () => {
  const coordinate = fc.double({ min: -1e3, max: 1e3, noNaN: true });
  const point = fc.tuple(coordinate, coordinate, coordinate);
  fc.assert(
    fc.property(point, point, point, fc.array(point), (a, b, c, others) => {
      const positions = Float64Array.from([...others, c, a, ...others, b].flat());
      const at = 3 * others.length;
      const out = new Float64Array(3);
      areaNormal(positions, at + 3, positions.length - 3, at, out);
      const expected = cross(subtract(b, a), subtract(c, a));
      expect([...out]).toEqual([...expected]);
    }),
  );
});
