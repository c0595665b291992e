import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { GAP, isOnTooltip, MARGIN, placeTooltip } from '../../../../src/ui/widgets/tooltip/tooltip-placement.ts';

const room = { width: 1000, height: 600 };
const size = { width: 200, height: 40 };

describe('a tooltip', () => {
  it('a tooltip lies below its element, centred on it', () => {
    expect(placeTooltip({ left: 400, top: 100, width: 20, height: 24 }, size, room)).toEqual({ left: 310, top: 130 });
  });

  it('flips above an element at the lower edge of the window', () => {
    expect(placeTooltip({ left: 400, top: 570, width: 20, height: 24 }, size, room).top).toBe(570 - GAP - 40);
  });

  it('a tooltip stays inside the window beside its left and right edge', () => {
    expect(placeTooltip({ left: 0, top: 100, width: 20, height: 24 }, size, room).left).toBe(MARGIN);
    expect(placeTooltip({ left: 980, top: 100, width: 20, height: 24 }, size, room).left).toBe(1000 - 200 - MARGIN);
  });

  it('begins where a wider element does', () => {
    expect(placeTooltip({ left: 120, top: 100, width: 500, height: 24 }, size, room).left).toBe(120);
  });

  it('a tooltip is inside every window that has room for it, and off its element where there is room above or below', () => {
    const pixels = (least: number, most: number) => fc.integer({ min: least, max: most });
    fc.assert(
      fc.property(
        pixels(-50, 1000),
        pixels(-50, 600),
        pixels(1, 400),
        pixels(1, 200),
        pixels(10, 320),
        pixels(10, 80),
        (left, top, width, height, tipWidth, tipHeight) => {
          const at = placeTooltip({ left, top, width, height }, { width: tipWidth, height: tipHeight }, room);
          expect(at.left).toBeGreaterThanOrEqual(MARGIN);
          expect(at.top).toBeGreaterThanOrEqual(MARGIN);
          expect(at.left + tipWidth).toBeLessThanOrEqual(room.width - MARGIN);
          expect(at.top + tipHeight).toBeLessThanOrEqual(room.height - MARGIN);
          const isBelow = at.top >= Math.min(room.height, top + height);
          const isAbove = at.top + tipHeight <= Math.max(0, top);
          const needed = tipHeight + GAP + MARGIN;
          if (top + height + needed <= room.height || top >= needed) expect(isBelow || isAbove).toBe(true);
        },
      ),
    );
  });

  it('a tooltip has the pointer also on the way from its element', () => {
    const tooltip = { left: 310, top: 130, width: 200, height: 40 };
    expect(isOnTooltip(400, 150, tooltip)).toBe(true);
    expect(isOnTooltip(400, 130 - GAP, tooltip)).toBe(true);
    expect(isOnTooltip(400, 130 - GAP - 1, tooltip)).toBe(false);
    expect(isOnTooltip(309, 150, tooltip)).toBe(false);
  });
});
