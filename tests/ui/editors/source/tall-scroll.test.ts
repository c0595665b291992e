import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  MAX_HEIGHT,
  scrollHeight,
  scrollTopOf,
  topAt,
  topToReveal,
} from '../../../../src/ui/editors/source/tall-scroll.ts';

const anyList = fc.record({
  lines: fc.integer({ min: 1, max: 100_000_000 }),
  lineHeight: fc.constant(18),
  room: fc.integer({ min: 40, max: 1200 }),
});

describe('scrolling through lines', () => {
  it('never makes an element higher than browsers allow, and leads to the last line', () => {
    fc.assert(
      fc.property(anyList, (list) => {
        expect(scrollHeight(list)).toBeLessThanOrEqual(MAX_HEIGHT);
        const bottom = Math.max(0, scrollHeight(list) - list.room);
        const last = topAt(list, bottom) + list.room / list.lineHeight;
        expect(last).toBeGreaterThanOrEqual(list.lines - 1e-6);
        expect(topAt(list, 0)).toBe(0);
      }),
    );
  });

  it('a position of the scroll bar and its top line belong together', () => {
    fc.assert(
      fc.property(anyList, fc.double({ min: 0, max: 1, noNaN: true }), (list, share) => {
        const top = topAt(list, share * Math.max(0, scrollHeight(list) - list.room));
        expect(topAt(list, scrollTopOf(list, top))).toBeCloseTo(top, 4);
      }),
    );
  });

  it('a line that is revealed is in view, and one in view moves nothing', () => {
    fc.assert(
      fc.property(anyList, fc.nat(), fc.nat(), (list, a, b) => {
        const top = topAt(list, a % (scrollHeight(list) + 1));
        const line = b % list.lines;
        const to = topToReveal(list, top, line);
        expect(line).toBeGreaterThanOrEqual(to - 1e-6);
        expect(line + 1).toBeLessThanOrEqual(to + list.room / list.lineHeight + 1e-6);
        expect(topToReveal(list, to, line)).toBeCloseTo(to, 6);
      }),
    );
  });
});
