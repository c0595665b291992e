import { describe, expect, it } from 'vitest';
import { lookOf } from '../../../src/view/gizmo/gizmo-look.ts';
import { hasArc, isAllowed, layOut, type Projection, ringRadius } from '../../../src/view/gizmo/shapes.ts';
import { STAGE_THEMES } from '../../../src/view/theme.ts';
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
    expect(radius(1)).toBeCloseTo(90, 9);
    expect(radius(0.6)).toBeCloseTo(54, 9);
    expect([radius(0), radius(0.01), radius(100)]).toEqual([44, 44, 110]);
    expect(radius(1, 0.5)).toBeCloseTo(45, 9);
    expect(radius(100, 1.25)).toBeCloseTo(137.5, 9);
    // Never most of a small viewport.
    expect(radius(100, 2, { ...view, height: 200 })).toBeCloseTo(48, 9);
  });

  it('a gizmo on the screen is smaller where its joint is farther away', () => {
    const far: Projection = { ...view, unitsPerPixel: () => 0.02 };
    expect(ringRadius(joint([facing]), far, 1)).toBeCloseTo(45, 9);
    expect(ringRadius(joint([facing], false, 2), far, 1)).toBeCloseTo(90, 9);
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

describe('the parts of a gizmo', () => {
  it('arrows end outside the rings, at 1.35 radii, and nothing is outside the canvas', () => {
    const layout = laid([facing, handle(3, 'slide', [1, 0, 0], [0, 1, 0])], true);
    const arrow = layout.shapes.find(({ form }) => form === 'arrow');
    expect(arrow && arrow.points[2] - layout.pivot[0]).toBeCloseTo(1.35 * layout.radius, 9);
    expect(layout.outer).toBeCloseTo(1.2 * layout.radius, 9);
    expect(laid([facing]).outer).toBe(laid([facing]).radius);
  });

  it('turns and moves along one axis have different colours, and what is active is orange', () => {
    const layout = laid([facing, handle(3, 'slide', [1, 0, 0], [0, 1, 0])]);
    const state = { active: undefined, hovered: undefined, dragged: undefined };
    for (const theme of Object.values(STAGE_THEMES)) {
      const [ring, arrow] = layout.shapes.map((shape) => lookOf(shape, state, theme).color);
      expect([ring, arrow]).toEqual([theme.axisX, theme.moveX]);
      const active = layout.shapes.map((shape) => lookOf(shape, { ...state, active: { kind: 'dof', dof: 1 } }, theme));
      expect(active.map(({ color }) => color)).toEqual([theme.selected, theme.moveX]);
    }
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
