import { describe, expect, it } from 'vitest';
import { currentTargets } from '../../../../src/evaluate/ik/drag/current-targets.ts';
import { HeldTargets } from '../../../../src/evaluate/ik/drag/held-targets.ts';
import type { Pin } from '../../../../src/model/ik.ts';

/** One joint at x. */
const worldAt = (x: number) => Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1);
const pin: Pin = { id: 4, joint: 0, point: [0, 1, 0], weight: 1, holdsOrientation: false };
const dofs = Float64Array.of(1, 2, 3);
const HINDRANCE = { binding: [7], holders: [], locks: [], canMove: true, rootStays: false };

function left() {
  const targets = new HeldTargets();
  targets.leave('c1', { pins: [pin] }, dofs, new Map([[4, { position: [9, 9, 9] }]]), HINDRANCE);
  return targets;
}

describe('where pins hold', () => {
  it('targets of pins are their positions, if no drag has left them elsewhere', () => {
    const found = currentTargets(new HeldTargets(), 'c1', { pins: [pin] }, dofs, worldAt(5));
    expect(found.get(4)).toEqual({ position: [5, 1, 0] });
  });

  it('targets of pins are those a drag has left, as long as the pose is unchanged', () => {
    const targets = left();
    const at = (pose: Float64Array) =>
      currentTargets(targets, 'c1', { pins: [pin] }, pose, worldAt(5)).get(4)?.position;
    expect(at(dofs.slice())).toEqual([9, 9, 9]);
    expect(at(Float64Array.of(1, 2, 3.0000001))).toEqual([5, 1, 0]);
    // Undo, and redo.
    expect(at(dofs.slice())).toEqual([9, 9, 9]);
  });

  it('where pins hold is taken anew for a pin that holds another point, or its orientation too; not for another weight', () => {
    const targets = left();
    const at = (change: Partial<Pin>) =>
      currentTargets(targets, 'c1', { pins: [{ ...pin, ...change }] }, dofs, worldAt(5)).get(4)?.position;
    expect(at({ point: [0, 2, 0] })).toEqual([5, 2, 0]);
    expect(at({ holdsOrientation: true })).toEqual([5, 1, 0]);
    expect(at({ weight: 3 })).toEqual([9, 9, 9]);
  });

  it('holds the orientation that the joint has', () => {
    const found = currentTargets(
      new HeldTargets(),
      'c1',
      { pins: [{ ...pin, holdsOrientation: true }] },
      dofs,
      worldAt(0),
    );
    expect(found.get(4)?.orientation?.map((v) => Math.abs(v))).toEqual([0, 0, 0, 1]);
  });

  it('where pins hold where pins hold is forgotten with its character', () => {
    const targets = left();
    targets.keepOnly(new Set(['c1']));
    expect(targets.leftOf('c1', dofs)?.hindrance).toBe(HINDRANCE);
    targets.keepOnly(new Set());
    expect(targets.leftOf('c1', dofs)).toBeUndefined();
  });
});
