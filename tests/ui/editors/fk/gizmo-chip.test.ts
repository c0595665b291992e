import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { chipPlace } from '../../../../src/ui/editors/fk/gizmo-chip.ts';

const at = (x: number, y: number, outer = 60) => chipPlace({ pivot: [x, y], outer }, [120, 40], [800, 600]);

describe('the chip beside a gizmo', () => {
  it('is 18 pixels right of the rings, or left of them where there is no room', () => {
    expect(at(400, 300)[0]).toBe(400 + 60 + 18);
    expect(at(700, 300)[0]).toBe(700 - 60 - 18 - 120);
  });

  it('is never within the rings, and within the viewport where either side has room', () => {
    const place = fc.double({ min: 0, max: 1, noNaN: true });
    fc.assert(
      fc.property(place, place, fc.double({ min: 44, max: 132, noNaN: true }), (u, v, outer) => {
        const [x, y] = [800 * u, 600 * v];
        const [left, top] = at(x, y, outer);
        expect(left >= x + outer || left + 120 <= x - outer).toBe(true);
        expect(left + 120 <= 800 && left >= 0 && top >= 0 && top + 40 <= 600).toBe(true);
      }),
    );
  });
});
