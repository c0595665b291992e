import { describe, expect, it } from 'vitest';
import { DraggedValue } from '../../../src/evaluate/handles/dragged-value.ts';

const PLAIN = { fine: false, snap: false };
const LIMITS = { min: -1, max: 2, hold: true };
const FREE = { min: -Infinity, max: Infinity, hold: true };

describe('a value that is dragged', () => {
  it('moves as far as the hand, or a tenth of it', () => {
    const dragged = new DraggedValue(0.5, FREE, 0.1, true);
    expect(dragged.by(0.25, PLAIN)).toEqual({ value: 0.75, stop: undefined });
    expect(dragged.by(1, { fine: true, snap: false }).value).toBeCloseTo(0.85, 12);
    expect(dragged.by(-0.35, PLAIN).value).toBeCloseTo(0.5, 12);
  });

  it('stops at a limit, and says at which', () => {
    const dragged = new DraggedValue(0, LIMITS, 0.1, true);
    expect(dragged.by(5, PLAIN)).toEqual({ value: 2, stop: 'max' });
    expect(dragged.by(-10, PLAIN)).toEqual({ value: -1, stop: 'min' });
    expect(dragged.by(4.5, PLAIN)).toEqual({ value: -0.5, stop: undefined });
  });

  it('a value dragged on a ring leaves its limit where the hand met it; dragged by the bone, it reverses with the hand', () => {
    const ring = new DraggedValue(0, LIMITS, 0.1, true);
    const bone = new DraggedValue(0, LIMITS, 0.1, false);
    for (const dragged of [ring, bone]) dragged.by(3, PLAIN);
    expect(ring.by(-0.5, PLAIN)).toEqual({ value: 2, stop: 'max' });
    expect(bone.by(-0.5, PLAIN)).toEqual({ value: 1.5, stop: undefined });
  });

  it('snaps to whole steps, but not past a limit that is none', () => {
    const dragged = new DraggedValue(0.13, { min: -1, max: 0.97, hold: true }, 0.25, true);
    const snap = { fine: false, snap: true };
    expect(dragged.by(0.3, snap).value).toBe(0.5);
    expect(dragged.by(0.5, snap)).toEqual({ value: 0.97, stop: 'max' });
    // Let go of Ctrl, it is where the hand is.
    expect(dragged.by(-0.2, PLAIN).value).toBeCloseTo(0.73, 12);
  });

  it('passes limits that are not enforced, and reports it; crossed ones do not apply', () => {
    const dragged = new DraggedValue(0, { ...LIMITS, hold: false }, 0.1, false);
    expect(dragged.by(3, PLAIN)).toEqual({ value: 3, stop: 'max' });
    const crossed = new DraggedValue(0, { min: 2, max: -2, hold: true }, 0.1, false);
    expect(crossed.by(3, PLAIN)).toEqual({ value: 3, stop: undefined });
  });
});
