import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { Shelves } from '../../../src/view/names/shelves.ts';

const WIDTH = 100;
const HEIGHT = 60;
const SHELF = 20;

/** Places strips until one doesn't fit. */
function placed(widths: readonly number[]): { x: number; y: number; width: number }[] {
  const shelves = new Shelves(WIDTH, HEIGHT, SHELF);
  const corner = new Float64Array(2);
  const all = [];
  for (const width of widths) {
    if (!shelves.place(width, corner)) break;
    all.push({ x: corner[0], y: corner[1], width });
  }
  return all;
}

describe('shelves', () => {
  it('put strips side by side, and go on below where one does not fit any more', () => {
    expect(placed([60, 40, 30, 80])).toEqual([
      { x: 0, y: 0, width: 60 },
      { x: 60, y: 0, width: 40 },
      { x: 0, y: 20, width: 30 },
      { x: 0, y: 40, width: 80 },
    ]);
  });

  it('give no room over another strip, nor beyond the picture', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 1, max: WIDTH }), { maxLength: 30 }), (widths) => {
        const all = placed(widths);
        for (const [i, a] of all.entries()) {
          expect(a.x + a.width).toBeLessThanOrEqual(WIDTH);
          expect(a.y + SHELF).toBeLessThanOrEqual(HEIGHT);
          for (const b of all.slice(0, i)) {
            expect(a.y !== b.y || a.x >= b.x + b.width || b.x >= a.x + a.width).toBe(true);
          }
        }
      }),
    );
  });

  it('shelves have no room when they are full, nor ever for what is wider than they are, and all of it when cleared', () => {
    const shelves = new Shelves(WIDTH, HEIGHT, SHELF);
    const corner = new Float64Array(2);
    expect(shelves.place(WIDTH + 1, corner)).toBe(false);
    for (let i = 0; i < 3; i++) expect(shelves.place(WIDTH, corner)).toBe(true);
    expect(shelves.place(1, corner)).toBe(false);
    shelves.clear();
    expect(shelves.place(1, corner)).toBe(true);
    expect([...corner]).toEqual([0, 0]);
  });
});
