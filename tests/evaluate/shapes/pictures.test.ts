import { describe, expect, it } from 'vitest';
import { frontOf, sideByRole } from '../../../src/evaluate/shapes/front.ts';
import { look } from '../../../src/evaluate/shapes/look.ts';
import { rasterise } from '../../../src/evaluate/shapes/rasterise.ts';
import { solidOf } from '../../../src/evaluate/shapes/solids.ts';
import { character, joint, skeleton, skin } from '../../helpers/builders.ts';

const dark = { r: 0, g: 0, b: 0 };
const bright = { r: 200, g: 100, b: 50 };

/** Of a picture, as rows of `#` and blanks. */
function shapeOf(pixels: Uint8ClampedArray, width: number): string[] {
  const rows: string[] = [];
  for (let at = 0; at < pixels.length; at += 4 * width) {
    rows.push(Array.from({ length: width }, (_, x) => (pixels[at + 4 * x + 3] ? '#' : ' ')).join(''));
  }
  return rows;
}

describe('triangles on a small picture', () => {
  const half = Float64Array.of(0, 0, 0, 4, 0, 0, 0, 4, 0);

  it('cover the pixels whose middles are in them, whichever way they are wound', () => {
    const light = Float64Array.of(1, 1, 1);
    for (const triangles of [
      [0, 1, 2],
      [0, 2, 1],
    ]) {
      const pixels = rasterise({ points: half, light, triangles }, 5, 4, dark, bright);
      expect(shapeOf(pixels, 5)).toEqual(['#### ', '###  ', '##   ', '#    ']);
      expect([...pixels.subarray(0, 4)]).toEqual([200, 100, 50, 255]);
    }
  });

  it('hide what is behind them, whatever their order', () => {
    const points = Float64Array.of(0, 0, 1, 8, 0, 1, 0, 8, 1, 0, 0, 2, 8, 0, 2, 0, 8, 2);
    const light = Float64Array.of(0, 0, 0, 1, 1, 1);
    for (const triangles of [
      [0, 1, 2, 3, 4, 5],
      [3, 4, 5, 0, 1, 2],
    ]) {
      expect(rasterise({ points, light, triangles }, 4, 4, dark, bright)[0]).toBe(200);
    }
  });

  it('rasterised triangles are lit evenly from corner to corner, and left out if degenerate', () => {
    const pixels = rasterise(
      {
        points: Float64Array.of(0, 0, 0, 10, 0, 0, 0, 10, 0, Number.NaN, 0, 0),
        light: Float64Array.of(0, 1, 0, 1),
        triangles: [0, 1, 2, 0, 1, 3, 0, 0, 1],
      },
      10,
      10,
      dark,
      bright,
    );
    const reds = [0, 2, 4, 6, 8].map((x) => pixels[4 * x]);
    expect(reds).toEqual([10, 50, 90, 130, 170]);
  });
});

describe('a character as solid', () => {
  it('a character as solid is its skin as it is deformed, else bones, else nothing', () => {
    const skinned = character({ skeleton: skeleton(), skins: [skin()], shownSkin: 0 });
    const solid = solidOf(skinned, [0, 5, 0, 0, 0, 0, 0, 0, 0]);
    expect(solid?.triangles).toBe(skinned.skins[0].triangles);
    const rest = solidOf(skinned, [0, 0, 0, 0, 0, 0, 0, 0, 0]);
    expect(solid?.points[1]).toBe((rest?.points[1] ?? 0) + 5);
    const bones = solidOf(character({ skeleton: skeleton() }), []);
    expect(bones?.triangles.length).toBeGreaterThan(12);
    const { skeleton: _none, ...nothing } = character();
    expect(solidOf(nothing, [])).toBeUndefined();
  });

  it('fills the picture, with a margin, wherever it is', () => {
    const who = character({ skeleton: skeleton() });
    for (const away of [0, 1e4]) {
      const solid = solidOf(who, [away, away, 0]);
      if (!solid) throw new Error('Nothing to see.');
      const { points, light } = look(solid, 'y', [0, 1], 100, 60);
      const xs = Array.from(points).filter((_, i) => i % 3 === 0);
      const ys = Array.from(points).filter((_, i) => i % 3 === 1);
      expect(Math.min(...xs)).toBeGreaterThan(6);
      expect(Math.max(...xs)).toBeLessThan(94);
      expect(Math.max(Math.max(...xs) - Math.min(...xs) - 86, Math.max(...ys) - Math.min(...ys) - 51.6)).toBeCloseTo(
        0,
        6,
      );
      expect(Math.min(...light)).toBeGreaterThanOrEqual(0);
      expect(Math.max(...light)).toBeLessThanOrEqual(1);
    }
  });

  it('a character as solid is looked at from its front, as its left and right tell it', () => {
    const sided = (x: number) => ({
      name: 's',
      joints: [
        joint(-1),
        joint(0, { role: 'leftUpperArm', offset: [x, 0, 0] }),
        joint(0, { role: 'rightUpperArm', offset: [-x, 0, 0] }),
      ],
    });
    expect(frontOf(sided(1), [], 'y', sideByRole)[1]).toBeGreaterThan(0);
    expect(frontOf(sided(-1), [], 'y', sideByRole)[1]).toBeLessThan(0);
    expect(frontOf(skeleton(), [], 'y', sideByRole)).toEqual([0, 1]);
    expect(frontOf(undefined, [], 'y', sideByRole)).toEqual([0, 1]);
  });
});
