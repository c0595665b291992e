import { describe, expect, it } from 'vitest';
import { cutPolygon, Effort } from '../../../src/import/fbx/polygons.ts';

const around = (count: number, radius: (i: number) => number, turns = 1) =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * turns * i) / count;
    return [radius(i) * Math.cos(angle), 2, -radius(i) * Math.sin(angle)];
  });

function cut(points: readonly (readonly number[])[]) {
  const effort = new Effort();
  const before = effort.left;
  const out: number[] = [];
  cutPolygon(points.flat(), [...points.keys()], out, effort);
  return {
    triangles: Array.from({ length: out.length / 3 }, (_, t) => out.slice(3 * t, 3 * t + 3)),
    effort: before - effort.left,
  };
}

const fan = (count: number) => Array.from({ length: count - 2 }, (_, t) => [0, t + 1, t + 2]);

/** Seen from above, where x goes right and z down. */
const area = (points: readonly (readonly number[])[], corners: readonly number[]) =>
  corners.reduce((sum, corner, i) => {
    const [a, b] = [points[corner], points[corners[(i + 1) % corners.length]]];
    return sum + (b[0] * a[2] - a[0] * b[2]) / 2;
  }, 0);

describe('polygons', () => {
  it.each([4, 5, 9, 60])('cuts a convex one of %i corners as a fan, without a search', (count) => {
    expect(cut(around(count, () => 3))).toEqual({ triangles: fan(count), effort: 0 });
  });

  it.each([
    [
      'an arrow',
      [
        [0, 0, 0],
        [2, 0, 1],
        [4, 0, 0],
        [2, 0, -6],
      ],
    ],
    ['a star', around(10, (i) => (i % 2 ? 1 : 3))],
    [
      'a comb',
      Array.from({ length: 12 }, (_, i) => [i, 0, i % 2 ? 4 : 1]).concat([
        [11, 0, 9],
        [0, 0, 9],
      ]),
    ],
  ])('cuts %s into triangles that cover it once', (_, points) => {
    const { triangles } = cut(points);
    const whole = area(points, [...points.keys()]);
    expect(triangles).toHaveLength(points.length - 2);
    for (const triangle of triangles) expect(area(points, triangle) * whole).toBeGreaterThan(0);
    expect(triangles.reduce((sum, triangle) => sum + area(points, triangle), 0)).toBeCloseTo(whole, 10);
  });

  it('searches one that turns left at every corner, but twice around', () => {
    expect(cut(around(5, () => 3, 2)).effort).toBeGreaterThan(0);
  });
});
