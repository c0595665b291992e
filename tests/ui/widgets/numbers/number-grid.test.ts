import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { cellAfter } from '../../../../src/ui/widgets/numbers/number-grid.ts';

const press = (key: string, more: Partial<KeyboardEvent> = {}) => ({
  key,
  ctrlKey: false,
  metaKey: false,
  shiftKey: false,
  ...more,
});
const MATRIX = { rows: 4, columns: 4 };

describe('the keys of a table of numbers', () => {
  it.each([
    ['ArrowLeft', 5, 4],
    ['ArrowLeft', 4, 4],
    ['ArrowRight', 6, 7],
    ['ArrowRight', 7, 7],
    ['ArrowUp', 6, 2],
    ['ArrowUp', 2, 2],
    ['ArrowDown', 6, 10],
    ['ArrowDown', 14, 14],
    ['Home', 6, 4],
    ['End', 6, 7],
  ])('%s moves from cell %i of a matrix to %i, within row and column', (key, from, to) => {
    expect(cellAfter(press(key), from, MATRIX)).toBe(to);
  });

  it('Ctrl+Home and Ctrl+End, or Command, go to the first and the last cell of a table', () => {
    expect(cellAfter(press('Home', { ctrlKey: true }), 6, MATRIX)).toBe(0);
    expect(cellAfter(press('End', { metaKey: true }), 6, MATRIX)).toBe(15);
  });

  it.each([['a'], ['Enter'], ['Tab'], ['Escape']])('%s moves nowhere in a table', (key) => {
    expect(cellAfter(press(key), 6, MATRIX)).toBeUndefined();
  });

  it('a key of a table always leads to one of its cells, and opposite arrows back unless at an edge', () => {
    const KEYS = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End'];
    const OPPOSITE = new Map([
      ['ArrowLeft', 'ArrowRight'],
      ['ArrowUp', 'ArrowDown'],
    ]);
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 6 }),
        fc.integer({ min: 1, max: 6 }),
        fc.nat(35),
        fc.constantFrom(...KEYS),
        (rows, columns, cell, key) => {
          const from = cell % (rows * columns);
          const to = cellAfter(press(key), from, { rows, columns });
          expect(to).toBeGreaterThanOrEqual(0);
          expect(to).toBeLessThan(rows * columns);
          const back = OPPOSITE.get(key);
          if (to !== undefined && to !== from && back) expect(cellAfter(press(back), to, { rows, columns })).toBe(from);
        },
      ),
    );
  });
});
