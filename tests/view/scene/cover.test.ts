import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { skinParts } from '../../../src/evaluate/shapes/skin-parts.ts';
import { Cover } from '../../../src/view/scene/cover.ts';
import { skin } from '../../helpers/builders.ts';

type Point = readonly [number, number, number];
const EYE: Point = [0, 0, 10];

/** A matrix that scales and shifts. */
const at = ([x, y, z]: Point, [sx, sy, sz]: Point): number[] => [sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, sz, 0, x, y, z, 1];

function covering(
  shapes: readonly { readonly at: Point; readonly size: Point; readonly isBox?: boolean }[],
  w: 0 | 1 = 1,
) {
  const cover = new Cover();
  const eye = w === 1 ? EYE : ([0, 0, 1] as const);
  cover.begin(...eye, w);
  for (const { at: place, size, isBox } of shapes) cover.add(at(place, size), 0, isBox ?? false);
  return cover;
}

describe.each([
  ['a perspective', 1],
  ['an orthographic', 0],
] as const)('what covers what for %s camera', (_, w) => {
  const ball = { size: [1, 1, 1] } as const;

  it('a shape in front covers the middle of the one behind it, and not the other way round', () => {
    for (const isBox of [false, true]) {
      const cover = covering(
        [
          { at: [0, 0, 3], ...ball, isBox },
          { at: [0, 0, -3], ...ball, isBox },
        ],
        w,
      );
      expect([cover.coversMiddle(0), cover.coversMiddle(1)]).toEqual([false, true]);
    }
  });

  it('a shape beside another one covers nothing of it', () => {
    const cover = covering(
      [
        { at: [4, 0, 3], ...ball },
        { at: [0, 0, -3], ...ball },
      ],
      w,
    );
    expect([cover.coversMiddle(0), cover.coversMiddle(1)]).toEqual([false, false]);
  });

  it('a shape behind the eye covers nothing', () => {
    const cover = covering(
      [
        { at: [0, 0, 30], ...ball },
        { at: [0, 0, -3], ...ball },
      ],
      1,
    );
    expect(cover.coversMiddle(1)).toBe(false);
  });

  it('a shape never covers itself, wherever in it a joint is', () => {
    const coordinate = fc.double({ min: -1, max: 1, noNaN: true });
    fc.assert(
      fc.property(coordinate, coordinate, coordinate, fc.boolean(), (x, y, z, isBox) => {
        const cover = covering([{ at: [2, 1, 0], size: [1, 2, 3], isBox }], w);
        expect(cover.covers(0, 2 + x, 1 + 2 * y, 3 * z)).toBe(false);
      }),
    );
  });

  it('of two shapes at most one is covered by the other', () => {
    const place = fc.tuple(...([-4, -4, -4] as const).map((min) => fc.double({ min, max: -min, noNaN: true })));
    const size = fc.tuple(...([1, 1, 1] as const).map(() => fc.double({ min: 0.1, max: 2, noNaN: true })));
    const shape = fc.record({ at: place, size, isBox: fc.boolean() });
    fc.assert(
      fc.property(shape, shape, (a, b) => {
        const cover = covering([a as never, b as never], w);
        // Along one line of sight, so that both are asked about the same.
        const [x, y, z] = (a.at as unknown as Point).map((v, k) => (v + b.at[k]) / 2);
        expect(cover.covers(0, x, y, z) && cover.covers(1, x, y, z)).toBe(false);
      }),
    );
  });

  it('shapes that touch don’t cover each other: an upper arm at a chest', () => {
    const cover = covering(
      [
        { at: [0, 0, 0], size: [1, 2, 1] },
        { at: [1.1, 0, 0.1], size: [0.4, 1.5, 0.4] },
      ],
      w,
    );
    expect([cover.coversMiddle(0), cover.coversMiddle(1)]).toEqual([false, false]);
  });
});

it('what covers what is found as by walking along the line of sight', () => {
  const small = fc.double({ min: -3, max: 3, noNaN: true });
  const size = fc.double({ min: 0.2, max: 2, noNaN: true });
  fc.assert(
    fc.property(fc.tuple(small, small, small), fc.tuple(size, size, size), fc.boolean(), (place, by, isBox) => {
      const cover = covering([{ at: place, size: by, isBox }]);
      const point: Point = [0.3, -0.2, -6];
      let isCovered = false;
      let nearest = Infinity;
      for (let t = 0; t < 1; t += 0.002) {
        const u = EYE.map((e, k) => (e + t * (point[k] - e) - place[k]) / by[k]);
        const out = isBox ? Math.max(...u.map(Math.abs)) : Math.hypot(...u);
        nearest = Math.min(nearest, Math.abs(out - 1));
        if (out < 1) isCovered = true;
      }
      fc.pre(nearest > 0.02 || isCovered);
      expect(cover.covers(-1, ...point)).toBe(isCovered);
    }),
  );
});

it('shapes without an extent are left out', () => {
  const cover = new Cover();
  cover.begin(...EYE, 1);
  expect(cover.add(at([0, 0, 0], [1, 0, 1]), 0, true)).toBe(-1);
  expect(cover.add(at([0, 0, 0], [Number.NaN, 1, 1]), 0, true)).toBe(-1);
  expect(cover.isEmpty).toBe(true);
});

describe('the parts of a skin', () => {
  it('the parts of a skin are the ellipsoid that its vertices are on', () => {
    // Evenly over a ball (Fibonacci), stretched and moved.
    const count = 4000;
    const positions = new Float64Array(3 * count);
    for (let v = 0; v < count; v++) {
      const y = 1 - (2 * (v + 0.5)) / count;
      const r = Math.sqrt(1 - y * y);
      const turn = v * Math.PI * (3 - Math.sqrt(5));
      positions.set([5 + 0.5 * r * Math.cos(turn), 2 * y, -1 + r * Math.sin(turn)], 3 * v);
    }
    const start = Uint32Array.from({ length: count + 1 }, (_, v) => v);
    const attachments = { start, joints: new Uint32Array(count), weights: new Float64Array(count).fill(1) };
    const parts = skinParts(skin('ball', 0, { positions, normals: positions, attachments }));
    const [x, y, z, xx, yx, yy, zx, zy, zz] = parts;
    for (const [found, expected] of [
      [x, 5],
      [y, 0],
      [z, -1],
      [xx, 0.5],
      [yx, 0],
      [yy, 2],
      [zx, 0],
      [zy, 0],
      [zz, 1],
    ]) {
      expect(found).toBeCloseTo(expected, 2);
    }
  });

  it('the parts of a skin are not a number for joints that move none of it', () => {
    const parts = skinParts(skin('hero', 2));
    expect(Number.isNaN(parts[0])).toBe(true);
    expect(parts[18]).toBeCloseTo(1 / 3, 9);
  });
});
