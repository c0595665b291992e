import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { middleOfFirstPassage } from '../../src/evaluate/first-passage.ts';
import { add, scaled, subtract, type Vec3 } from '../../src/math/vec3.ts';
import { type Mesh, together, tube } from './weights/meshes.ts';

/** A limb of radius 1 up from y 0 to 10. */
const limb = (z = 0, radius = 1, x = 0) => tube({ around: 48, along: 10, radius, length: 10, at: [x, z] });

const BOX: Mesh = {
  positions: Float64Array.from(
    [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [(i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1]),
  ),
  triangles: Uint32Array.of(
    ...[0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4],
    ...[2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5],
  ),
};

/** All triangles but some. */
const without = ({ positions, triangles }: Mesh, isLeftOut: (middle: Vec3) => boolean): Mesh => ({
  positions,
  triangles: triangles.filter((_, i) => {
    const t = i - (i % 3);
    const corners = [...triangles.subarray(t, t + 3)];
    const middle = [0, 1, 2].map((k) => corners.reduce((sum, v) => sum + positions[3 * v + k] / 3, 0));
    return !isLeftOut([middle[0], middle[1], middle[2]]);
  }),
});

/** The point that is found from there along −z, over 40 units. */
function middle(mesh: Mesh, from: Vec3): Vec3 | undefined {
  const part = middleOfFirstPassage(mesh, from, [0, 0, -40]);
  return part === undefined ? undefined : add(from, [0, 0, -40], part);
}

describe('the middle of what a line of sight passes first', () => {
  it('the middle of a box, through whichever triangles of its sides, also where two of them meet', () => {
    expect(middle(BOX, [0.3, 0.5, 9])?.[2]).toBeCloseTo(0, 12);
    expect(middle(BOX, [0, 0, 9])?.[2]).toBeCloseTo(0, 12);
    expect(middle(BOX, [0.5, -0.5, 9])?.[2]).toBeCloseTo(0, 12);
  });

  it('the middle of a limb is on its axis in front, and as deep as its wall is far from both sides', () => {
    expect(middle(limb(), [0, 5.3, 9])?.[2]).toBeCloseTo(0, 9);
    expect(middle(limb(3), [0.7, 5.3, 9])?.[2]).toBeCloseTo(3, 9);
  });

  it('the nearer one of two limbs behind each other, even where the farther one begins inside it', () => {
    expect(middle(together(limb(0), limb(5)), [0.1, 5.3, 20])?.[2]).toBeCloseTo(5, 9);
    expect(middle(together(limb(0), limb(1.5)), [0.1, 5.3, 20])?.[2]).toBeCloseTo(1.5, 9);
  });

  it('clothes over a limb don’t end it: not between the cloth and the skin', () => {
    expect(middle(together(limb(0), limb(0, 1.1)), [0, 5.3, 9])?.[2]).toBeCloseTo(0.05, 2);
  });

  it('triangles wound inwards are the same limb', () => {
    const { positions, triangles } = together(limb(0), limb(5));
    const inwards = { positions, triangles: triangles.slice().reverse() };
    expect(middle(inwards, [0.1, 5.3, 20])?.[2]).toBeCloseTo(5, 9);
  });

  it('nothing off the mesh, behind the eye, or through a surface that is open behind', () => {
    expect(middle(limb(), [3, 5.3, 9])).toBeUndefined();
    expect(middle(limb(), [0, 5.3, -9])).toBeUndefined();
    expect(
      middle(
        without(limb(), ([, , z]) => z < 0),
        [0.1, 5.3, 9],
      ),
    ).toBeUndefined();
    expect(middle({ positions: new Float64Array(0), triangles: new Uint32Array(0) }, [0, 0, 9])).toBeUndefined();
  });

  it('lines through a box in any direction are halved', () => {
    const coordinate = fc.double({ min: -0.99, max: 0.99, noNaN: true });
    const point = fc.tuple(coordinate, coordinate, coordinate);
    fc.assert(
      fc.property(point, point, (through, towards) => {
        const way = subtract(towards, through);
        const length = Math.hypot(...way);
        fc.pre(length > 1e-3);
        const from = add(through, way, -50 / length);
        const part = middleOfFirstPassage(BOX, from, scaled(way, 100 / length));
        const ends = [-1, 1].map((sign) => {
          const far = way.map((v, k) => (v === 0 ? Infinity : ((sign * v > 0 ? 1 : -1) - through[k]) / v));
          return sign > 0 ? Math.min(...far.filter((t) => t >= 0)) : Math.max(...far.filter((t) => t <= 0));
        });
        const expected = add(through, way, (ends[0] + ends[1]) / 2);
        const found = add(from, way, ((part ?? Number.NaN) * 100) / length);
        expect(Math.hypot(...subtract(found, expected))).toBeLessThan(1e-9);
      }),
    );
  });
});
