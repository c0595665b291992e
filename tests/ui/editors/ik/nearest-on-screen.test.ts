import { describe, expect, it } from 'vitest';
import { nearestOnScreen } from '../../../../src/ui/editors/ik/nearest-on-screen.ts';

describe('the nearest of some places on the screen', () => {
  const points = [
    { x: 0, y: 0 },
    { x: 10, y: 0 },
    { x: 10, y: 0 },
  ];
  it('the nearest place on the screen is the nearest within reach, of two in one place the first', () => {
    expect(nearestOnScreen(points, { x: 7, y: 1 }, 10)).toBe(1);
    expect(nearestOnScreen(points, { x: 2, y: 1 }, 10)).toBe(0);
  });
  it('no place on the screen is the nearest when all are too far, or unknown', () => {
    expect(nearestOnScreen(points, { x: 40, y: 0 }, 10)).toBe(-1);
    expect(nearestOnScreen([{ x: Number.NaN, y: 0 }], { x: 0, y: 0 }, 10)).toBe(-1);
    expect(nearestOnScreen([], { x: 0, y: 0 }, 10)).toBe(-1);
  });
});
