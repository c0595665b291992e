import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { facingOf } from '../../../src/view/skin/facing.ts';

/** An octahedron wound outwards, with smooth normals, which equal its corners. */
const CORNERS = Float64Array.of(1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1);
const OUTWARD = Uint32Array.of(0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5);
const UNTURNED = new Float32Array(6);

const facing = (triangles: Uint32Array, normals = CORNERS) => runToEnd(facingOf(triangles, CORNERS, normals));

/** The triangles with the first two corners of some swapped. */
function rewound(which: readonly boolean[]): Uint32Array {
  const out = OUTWARD.slice();
  which.forEach((is, t) => {
    if (is) [out[3 * t], out[3 * t + 1]] = [OUTWARD[3 * t + 1], OUTWARD[3 * t]];
  });
  return out;
}

describe('the facing of a skin', () => {
  it('the facing of a skin is the file’s own, and its own array, where that is consistent', () => {
    const { triangles, turned } = facing(OUTWARD);
    expect(triangles).toBe(OUTWARD);
    expect(turned).toEqual(UNTURNED);
  });

  it('the facing of a skin is the same whichever way each triangle is wound, and keeps last corners and the array given', () => {
    fc.assert(
      fc.property(fc.array(fc.boolean(), { minLength: 8, maxLength: 8 }), (which) => {
        const given = rewound(which);
        const before = given.slice();
        const { triangles, turned } = facing(given);
        expect(triangles).toEqual(OUTWARD);
        expect(turned).toEqual(UNTURNED);
        expect(given).toEqual(before);
      }),
    );
  });

  it('the facing of a skin turns round the few normals that disagree with the many, whatever the winding', () => {
    fc.assert(
      fc.property(fc.nat(5), fc.array(fc.boolean(), { minLength: 8, maxLength: 8 }), (bad, which) => {
        const normals = CORNERS.map((x, i) => (Math.floor(i / 3) === bad ? -x : x));
        const { triangles, turned } = facing(rewound(which), normals);
        expect(triangles).toEqual(OUTWARD);
        expect([...turned]).toEqual([0, 1, 2, 3, 4, 5].map((v) => (v === bad ? 1 : 0)));
      }),
    );
  });

  it('takes each patch by itself: a reversed one beside a right one', () => {
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0);
    const normals = Float64Array.from({ length: 18 }, (_, i) => (i % 3 === 2 ? 1 : 0));
    const { triangles, turned } = runToEnd(facingOf(Uint32Array.of(0, 1, 2, 4, 3, 5), positions, normals));
    expect([...triangles]).toEqual([0, 1, 2, 3, 4, 5]);
    expect(turned).toEqual(UNTURNED);
  });

  it('takes both sides of a sheet, if they are triangles of their own, by their normals', () => {
    // Two triangles, twice each: their common edge belongs to four triangles.
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0);
    const normals = Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    const twice = Uint32Array.of(0, 1, 2, 0, 2, 3, 1, 0, 2, 2, 0, 3);
    const { triangles } = runToEnd(facingOf(twice, positions, normals));
    expect([...triangles]).toEqual([0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3]);
  });

  it('the facing of a skin is the same in whatever order the triangles of a strip come and are joined', () => {
    const count = 24;
    const positions = Float64Array.from({ length: 3 * (count + 2) }, (_, i) => [Math.floor(i / 6), 0, 0][i % 3]);
    for (let v = 1; v < count + 2; v += 2) positions[3 * v + 1] = 1;
    const normals = Float64Array.from(positions, (_, i) => (i % 3 === 2 ? 1 : 0));
    // Below, above, below, above, to the right: a strip.
    const strip = Array.from({ length: count }, (_, t) => (t % 2 ? [t, t + 1, t + 2] : [t + 1, t, t + 2]));
    const turns = fc.array(fc.boolean(), { minLength: count, maxLength: count });
    fc.assert(
      fc.property(fc.shuffledSubarray(strip, { minLength: count }), turns, (right, turn) => {
        const given = right.map(([a, b, c], t) => (turn[t] ? [b, a, c] : [a, b, c]));
        const { triangles } = runToEnd(facingOf(Uint32Array.from(given.flat()), positions, normals));
        expect([...triangles]).toEqual(right.flat());
      }),
    );
  });

  it('the facing of a skin comes to an end for any triangles, degenerate ones and edges of many included', () => {
    fc.assert(
      fc.property(fc.array(fc.tuple(fc.nat(5), fc.nat(5), fc.nat(5)), { maxLength: 30 }), (all) => {
        const { triangles } = facing(Uint32Array.from(all.flat()));
        all.forEach((corners, t) => {
          expect([...triangles.subarray(3 * t, 3 * t + 3)].sort()).toEqual([...corners].sort());
          expect(triangles[3 * t + 2]).toBe(corners[2]);
        });
      }),
    );
  });
});
