/** Columns of pixels as an image: what is covered, how far, and what lies over what. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ColumnRaster } from '../../../src/evaluate/plot/raster.ts';
import { DOTTED_COLUMN, SOLID_COLUMN, TracedColumns } from '../../../src/evaluate/plot/trace-columns.ts';

/** One column, at x = 1, from one height to another. */
function columnsOf(top: number, bottom: number, kind = SOLID_COLUMN): TracedColumns {
  const columns = new TracedColumns();
  columns.tops = Float32Array.of(0, top, 0);
  columns.bottoms = Float32Array.of(0, bottom, 0);
  columns.kinds = Uint8Array.of(0, kind, 0);
  columns.from = 1;
  columns.to = 2;
  return columns;
}

function painted(lines: readonly { columns: TracedColumns; colour: string }[], ratio = 1) {
  const raster = new ColumnRaster();
  const painting = raster.painting(
    lines.map((l) => ({ ...l, width: 1 })),
    3,
    40,
    ratio,
  );
  while (!painting.next().done);
  return (x: number, y: number) => [...raster.pixels.subarray(4 * (y * 3 + x), 4 * (y * 3 + x) + 4)];
}

describe('painted columns', () => {
  it('cover the curve and half the line beyond it, the last pixels by their part', () => {
    const at = painted([{ columns: columnsOf(5, 8.25), colour: '#336699' }]);
    expect(at(1, 3)).toEqual([0, 0, 0, 0]);
    // Within a step of each byte: a half covered colour is kept multiplied by that half.
    for (const [i, byte] of [0x33, 0x66, 0x99, 128].entries()) expect(Math.abs(at(1, 4)[i] - byte)).toBeLessThan(3);
    expect(at(1, 6)).toEqual([0x33, 0x66, 0x99, 255]);
    expect(Math.abs(at(1, 8)[3] - 191)).toBeLessThan(3);
    expect(at(0, 6)).toEqual([0, 0, 0, 0]);
    expect(at(2, 6)).toEqual([0, 0, 0, 0]);
  });

  it('painted columns are as thick as the line where the curve lies flat', () => {
    const at = painted([{ columns: columnsOf(5.5, 5.5), colour: '#336699' }]);
    expect([at(1, 4)[3], at(1, 5)[3], at(1, 6)[3]]).toEqual([0, 255, 0]);
  });

  it('painted columns are laid over one another in order, and mix at their edges', () => {
    const at = painted([
      { columns: columnsOf(2, 30), colour: '#ff0000' },
      { columns: columnsOf(5, 8.25), colour: '#0000ff' },
    ]);
    expect(at(1, 6)).toEqual([0, 0, 255, 255]);
    expect(at(1, 20)).toEqual([255, 0, 0, 255]);
    const [red, , blue, alpha] = at(1, 4);
    expect(alpha).toBe(255);
    expect(Math.abs(red - blue)).toBeLessThan(3);
  });

  it('painted columns are what laying each over those behind it gives, however many hide one another', () => {
    const height = fc.double({ min: -3, max: 43, noNaN: true });
    const line = fc.record({ a: height, b: height, grey: fc.integer({ min: 0, max: 255 }) });
    fc.assert(
      fc.property(fc.array(line, { minLength: 1, maxLength: 12 }), (list) => {
        const ends = ({ a, b }: { a: number; b: number }) => [Math.min(a, b), Math.max(a, b)] as const;
        const at = painted(
          list.map((l) => {
            const byte = l.grey.toString(16).padStart(2, '0');
            return { columns: columnsOf(...ends(l)), colour: `#${byte}${byte}${byte}` };
          }),
        );
        for (let y = 0; y < 40; y++) {
          let alpha = 0;
          let grey = 0;
          for (const l of list) {
            const [top, bottom] = ends(l);
            const part = Math.max(0, Math.min(y + 1, bottom + 0.5) - Math.max(y, top - 0.5));
            alpha = part + alpha * (1 - part);
            grey = l.grey * part + grey * (1 - part);
          }
          const [shade, , , cover] = at(1, y);
          const isCovered = Math.abs(cover - 255 * alpha) < 2 + list.length;
          if (isCovered && Math.abs((shade * cover) / 255 - grey) < 3 + list.length) continue;
          expect.fail(`row ${y} is ${shade} by ${cover}, where ${grey} by ${alpha} is meant`);
        }
      }),
    );
  });

  it('painted columns are cut off at the edges of the image, and every other square of extrapolation is left out', () => {
    const at = painted([{ columns: columnsOf(-5000, 5000, DOTTED_COLUMN), colour: '#ffffff' }]);
    const alphas = Array.from({ length: 40 }, (_, y) => at(1, y)[3]);
    expect(alphas.slice(0, 8)).toEqual([255, 255, 0, 0, 255, 255, 0, 0]);
    expect(alphas[39]).toBe(0);
  });
});
