import fc from 'fast-check';
import { expect, it } from 'vitest';
import { revealed, rowAfterKey, windowOf } from '../../../src/ui/widgets/windowed-list.ts';

const scroll = fc.record({
  count: fc.integer({ min: 0, max: 10_000 }),
  rowHeight: fc.integer({ min: 18, max: 40 }),
  room: fc.integer({ min: 1, max: 2000 }),
  part: fc.double({ min: 0, max: 1, noNaN: true }),
});

it('a windowed list draws every row that is in view, and few others', () => {
  fc.assert(
    fc.property(scroll, ({ count, rowHeight, room, part }) => {
      const scrollTop = part * Math.max(0, count * rowHeight - room);
      const [first, end] = windowOf(scrollTop, room, rowHeight, count);
      for (let i = 0; i < count; i++) {
        const isSeen = (i + 1) * rowHeight > scrollTop && i * rowHeight < scrollTop + room;
        if (isSeen) expect(i >= first && i < end).toBe(true);
      }
      expect(end - first).toBeLessThanOrEqual(room / rowHeight + 14);
      expect(first).toBeGreaterThanOrEqual(0);
      expect(end).toBeLessThanOrEqual(count);
    }),
  );
});

it('a windowed list scrolls no farther than a row needs to be in view', () => {
  expect(revealed(100, 200, 120, 24)).toBe(100);
  expect(revealed(100, 200, 90, 24)).toBe(90);
  expect(revealed(100, 200, 290, 24)).toBe(114);
});

it('arrow keys, page keys, Home and End go from row to row and stop at the ends', () => {
  const after = (key: string, from: number) => rowAfterKey(key, from, 10, 4);
  expect(['ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End'].map((key) => after(key, 5))).toEqual([
    4, 6, 1, 9, 0, 9,
  ]);
  expect([after('ArrowUp', 0), after('ArrowDown', 9)]).toEqual([0, 9]);
  // No row yet.
  expect(after('ArrowDown', -1)).toBe(0);
  expect(after('a', 5)).toBeUndefined();
});
