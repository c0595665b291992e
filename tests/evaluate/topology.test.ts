import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { edgesOf } from '../../src/evaluate/topology.ts';

describe('edges of a mesh', () => {
  it('are each there once', () => {
    expect([...edgesOf(Uint32Array.of(0, 1, 2, 2, 1, 3), 4)]).toEqual([0, 2, 0, 1, 1, 2, 1, 3, 2, 3]);
  });

  it('are those that a set would hold', () => {
    fc.assert(
      fc.property(fc.array(fc.tuple(fc.nat(9), fc.nat(9), fc.nat(9)), { maxLength: 30 }), (triangles) => {
        const sides = triangles
          .flatMap(([a, b, c]) => [
            [a, b],
            [b, c],
            [c, a],
          ])
          .filter(([a, b]) => a !== b);
        const expected = new Set(sides.map((s) => [...s].sort().join()));
        const edges = edgesOf(Uint32Array.from(triangles.flat()), 10);
        const got = Array.from({ length: edges.length / 2 }, (_, e) => `${edges[2 * e]},${edges[2 * e + 1]}`);
        expect(got).toHaveLength(expected.size);
        expect(new Set(got)).toEqual(expected);
      }),
    );
  });
});
