import { Matrix4, OrthographicCamera } from 'three';
import { describe, expect, it } from 'vitest';
import { nameLeft, placeName } from '../../../src/view/names/character-names.ts';
import { assignInstances } from '../../../src/view/skeleton/drawn-skeletons.ts';
import { joint } from '../../helpers/builders.ts';

/** Ten world units are a viewport of 1000 × 1000 pixels, with the origin at its centre. */
const camera = new OrthographicCamera(-5, 5, 5, -5, -100, 100);
const toTake = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);

function place(points: readonly (readonly [number, number])[]): number[] | undefined {
  const joints = points.map((_, j) => joint(j - 1, { offset: [0, 1, 0] }));
  const [drawn] = assignInstances([
    {
      characterId: 'c1',
      name: 'dancer',
      skeleton: { name: '', joints },
      world: new Float64Array(16 * joints.length),
      dofs: new Float64Array(0),
      placements: new Float64Array(16),
      hasSkin: false,
    },
  ]);
  const positions = Float64Array.from(points.flatMap(([x, y]) => [x, y, 0]));
  const out = new Float64Array(4);
  return placeName(drawn, positions, toTake, 1000, 1000, out) ? [...out] : undefined;
}

describe('the name of a character', () => {
  it('stands over the middle of its joints, above the highest', () => {
    const [x, y] = place([
      [0, 0],
      [1, 1],
      [2, 2],
    ]) ?? [0, 0];
    expect(x).toBeCloseTo(600, 6);
    expect(y).toBeLessThan(300);
    expect(y).toBeGreaterThan(260);
  });

  it('the name of a character goes with it', () => {
    const there = place([
      [1, 0],
      [1, 2],
    ]);
    const here = place([
      [0, -1],
      [0, 1],
    ]);
    const moved = [100, -100, -100, -100].map((pixels) => expect.closeTo(pixels, 6));
    expect(there?.map((v, i) => v - (here?.[i] ?? 0))).toEqual(moved);
  });

  it('the name of a character is above it even where that is a dot', () => {
    const [x, y, top, bottom] = place([
      [1, 0],
      [1, 0.01],
    ]) ?? [0, 0, 0, 0];
    expect([x, top, bottom]).toEqual([600, expect.closeTo(499, 6), expect.closeTo(500, 6)]);
    expect(y).toBeLessThan(top - 8);
  });

  it('the name of a character is left out where the character is out of the picture', () => {
    expect(
      place([
        [7, 0],
        [7, 2],
      ]),
    ).toBeUndefined();
    for (const y of [6, -9]) {
      expect(
        place([
          [0, y],
          [0, y + 3],
        ]),
      ).toBeUndefined();
    }
  });

  it('the name of a character stays below the upper edge where only the head is out of the picture', () => {
    const [, y] = place([
      [0, 0],
      [0, 9],
    ]) ?? [0, -1];
    expect(y).toBeGreaterThan(0);
  });
});

it('a name is centred on its character, inside the viewport, and beside the axis widget in its upper right corner', () => {
  expect(nameLeft(500, 300, 80, 1000)).toBe(460);
  expect(nameLeft(10, 300, 80, 1000)).toBe(6);
  expect(nameLeft(995, 300, 80, 1000)).toBe(914);
  expect(nameLeft(995, 60, 80, 1000)).toBe(828);
  expect(nameLeft(700, 60, 80, 1000)).toBe(660);
  expect(nameLeft(995, 60, 80, 1000, false)).toBe(914);
  // Too long for the viewport: its beginning is what can be read.
  expect(nameLeft(100, 300, 400, 200)).toBe(6);
});
