import { describe, expect, it } from 'vitest';
import { hasArc, isAllowed, layOut, type Projection, ringRadius } from '../../../src/view/gizmo/shapes.ts';
import { FREE, facing, handle, joint, laid, onEdge, view } from './on-screen.ts';

describe('a gizmo on the screen', () => {
  it('a gizmo on the screen has rings of the radius that is asked for, at any distance', () => {
    const far: Projection = {
      ...view,
      unitsPerPixel: () => 1,
      project: (p, out, o) => view.project([p[0] / 100, p[1] / 100, 0], out, o),
    };
    for (const sight of [view, far]) {
      const ring = layOut(joint([facing]), sight, 90)?.shapes[0];
      expect(ring && Math.hypot(ring.points[0] - 400, ring.points[1] - 300)).toBeCloseTo(90, 9);
    }
  });

  it('a gizmo on the screen is not there where the joint is behind the viewer', () => {
    expect(layOut({ ...joint([facing]), pivot: [0, 0, 20] }, view, 90)).toBeUndefined();
  });

  it('a gizmo on the screen has the far half of a ring behind, and nothing of one that faces the viewer', () => {
    const layout = laid([facing, onEdge]);
    expect(layout.shapes[0].isBehind.some((b) => b)).toBe(false);
    const behind = layout.shapes[1].isBehind.filter((b) => b).length;
    expect(behind).toBe(layout.shapes[1].isBehind.length / 2);
  });

  it('a gizmo on the screen has the size of its joint, within bounds and times what the user wants', () => {
    const radius = (size: number, scale = 1, sight = view) => ringRadius(joint([facing], false, size), sight, scale);
    expect(radius(1)).toBeCloseTo(60, 9);
    expect(radius(0.6)).toBeCloseTo(36, 9);
    expect([radius(0), radius(0.01), radius(100)]).toEqual([30, 30, 90]);
    expect(radius(1, 0.5)).toBeCloseTo(30, 9);
    expect(radius(100, 1.5)).toBeCloseTo(135, 9);
    // Never most of a small viewport.
    expect(radius(100, 2, { ...view, height: 200 })).toBeCloseTo(48, 9);
  });

  it('a gizmo on the screen is smaller where its joint is farther away', () => {
    const far: Projection = { ...view, unitsPerPixel: () => 0.02 };
    expect(ringRadius(joint([facing]), far, 1)).toBeCloseTo(30, 9);
    expect(ringRadius(joint([facing], false, 2), far, 1)).toBeCloseTo(60, 9);
  });

  it('a gizmo on the screen has a handle for what has no axis, and one that goes with a shear', () => {
    const grow = laid([handle(0, 'grow', [1, 0, 0], [0, 1, 0])]).shapes[0];
    expect(grow.points[2]).toBeGreaterThan(400);
    expect(grow.points[3]).toBeLessThan(300);
    const range = { ...FREE, value: 0.5 };
    const shear = laid([handle(0, 'shear', [1, 0, 0], [0, 1, 0], { arm: [0, 1, 0], range })]).shapes[0];
    expect([...shear.points.slice(2)]).toEqual([445, 210]);
    // Another one on the same arm doesn't overlap.
    const other = laid([handle(0, 'shear', [0, 0, 1], [0, 1, 0], { arm: [0, 1, 0], hue: 1 })]).shapes[0];
    expect(other.points[3]).toBeGreaterThan(210 + 12);
  });
});

describe('the range on a ring', () => {
  it('the range on a ring is drawn where it is less than a whole turn', () => {
    expect(hasArc({ value: 0, min: -1, max: 2 })).toBe(true);
    expect(hasArc({ value: 0, min: -1, max: 1e5 })).toBe(false);
    expect(hasArc({ value: 0, min: -4, max: 4 })).toBe(false);
    expect(hasArc(FREE)).toBe(false);
  });

  it('the range on a ring is counted from where the DOF stands', () => {
    const range = { value: 1, min: -0.5, max: 1.5 };
    expect([-1.6, -1.4, 0, 0.4, 0.6].map((angle) => isAllowed(range, angle))).toEqual([false, true, true, true, false]);
    // The same positions, a full turn away.
    expect(isAllowed(range, 0.4 - 2 * Math.PI)).toBe(true);
    expect(isAllowed(range, 0.6 - 2 * Math.PI)).toBe(false);
  });

  it('the range on a ring is one place where both limits are the same', () => {
    const range = { value: 0.3, min: 0.3, max: 0.3 };
    expect([0, 0.01, -0.01].map((angle) => isAllowed(range, angle))).toEqual([true, false, false]);
  });
});
