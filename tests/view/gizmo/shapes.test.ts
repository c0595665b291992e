import { describe, expect, it } from 'vitest';
import type { Handle, JointHandles } from '../../../src/evaluate/handles/joint-handles.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { BALL_PART, handleAt, hasArc, isAllowed, layOut, type Projection } from '../../../src/view/gizmo/shapes.ts';

/** Looks along −z, a hundred pixels a unit, the origin in the middle of 800 × 600. */
const view: Projection = {
  width: 800,
  height: 600,
  project([x, y, z], out, o) {
    out[o] = 400 + 100 * x;
    out[o + 1] = 300 - 100 * y;
    return z < 10;
  },
  towardsViewer: () => [0, 0, 1],
  unitsPerPixel: () => 0.01,
};
const FREE = { value: 0, min: -Infinity, max: Infinity };

function handle(dof: number, kind: Handle['kind'], axis: Vec3, mark: Vec3, more: Partial<Handle> = {}): Handle {
  const id = { kind: 'dof', dof } as const;
  return { id, dof, name: 'rx', kind, axis, centre: [0, 0, 0], reach: 1, hue: 0, mark, range: FREE, ...more };
}

function joint(handles: readonly Handle[], free = false): JointHandles {
  const freeTurn = free ? { joint: 0, dofs: [0, 1, 2], order: 'xyz' as const } : undefined;
  return { pivot: [0, 0, 0], handles, freeTurn };
}

const laid = (handles: readonly Handle[], free = false) => {
  const layout = layOut(joint(handles, free), view);
  if (!layout) throw new Error('It is in front.');
  return layout;
};
/** Faces the viewer, and stands on edge. */
const facing = handle(1, 'turn', [0, 0, 1], [1, 0, 0]);
const onEdge = handle(2, 'turn', [1, 0, 0], [0, 0, 1]);

describe('a gizmo on the screen', () => {
  it('a gizmo on the screen has rings of the same size at any distance', () => {
    const far: Projection = {
      ...view,
      unitsPerPixel: () => 1,
      project: (p, out, o) => view.project([p[0] / 100, p[1] / 100, 0], out, o),
    };
    for (const sight of [view, far]) {
      const ring = layOut(joint([facing]), sight)?.shapes[0];
      expect(ring && Math.hypot(ring.points[0] - 400, ring.points[1] - 300)).toBeCloseTo(90, 9);
    }
  });

  it('a gizmo on the screen is not there where the joint is behind the viewer', () => {
    expect(layOut({ ...joint([facing]), pivot: [0, 0, 20] }, view)).toBeUndefined();
  });

  it('a gizmo on the screen has the far half of a ring behind, and nothing of one that faces the viewer', () => {
    const layout = laid([facing, onEdge]);
    expect(layout.shapes[0].isBehind.some((b) => b)).toBe(false);
    const behind = layout.shapes[1].isBehind.filter((b) => b).length;
    expect(behind).toBe(layout.shapes[1].isBehind.length / 2);
  });

  it('a gizmo on the screen is taken hold of by the line that is nearest', () => {
    const layout = laid([facing, onEdge], true);
    expect(handleAt(layout, 400 + 90 * Math.SQRT1_2, 300 - 90 * Math.SQRT1_2)).toEqual({ kind: 'dof', dof: 1 });
    expect(handleAt(layout, 403, 330)).toEqual({ kind: 'dof', dof: 2 });
    expect(handleAt(layout, 400 + 108, 300)).toEqual({ kind: 'view' });
    expect(handleAt(layout, 400 + 40, 300)).toEqual({ kind: 'ball' });
    // Between ball and ring is the camera's.
    expect(handleAt(layout, 400 + 90 * BALL_PART + 2, 300)).toBeUndefined();
    expect(handleAt(layout, 400 + 130, 300)).toBeUndefined();
    expect(handleAt(layout, 400 + 118, 300, 10)).toEqual({ kind: 'view' });
  });

  it('a gizmo on the screen has no ball where the joint can’t turn freely', () => {
    expect(handleAt(laid([facing]), 440, 300)).toBeUndefined();
  });

  it('a gizmo on the screen has arrows by their length, and none to drag along the line of sight', () => {
    const layout = laid([handle(0, 'slide', [0, 1, 0], [1, 0, 0]), handle(1, 'slide', [0, 0, 1], [1, 0, 0])]);
    expect(handleAt(layout, 402, 230)).toEqual({ kind: 'dof', dof: 0 });
    expect(layout.shapes[1].isAway).toBe(true);
    // The middle, where all arrows meet, is none's.
    expect(handleAt(layout, 400, 295)).toBeUndefined();
  });

  it('a gizmo on the screen has a handle for what has no axis, and one that goes with a shear', () => {
    const grow = laid([handle(0, 'grow', [1, 0, 0], [0, 1, 0])]).shapes[0];
    expect(grow.points[2]).toBeGreaterThan(400);
    expect(grow.points[3]).toBeLessThan(300);
    const range = { ...FREE, value: 0.5 };
    const shear = laid([handle(0, 'shear', [1, 0, 0], [0, 1, 0], { arm: [0, 1, 0], range })]).shapes[0];
    expect([...shear.points.slice(2)]).toEqual([445, 210]);
    // Another one on the same arm is not in its way.
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
    // The same places a turn on.
    expect(isAllowed(range, 0.4 - 2 * Math.PI)).toBe(true);
    expect(isAllowed(range, 0.6 - 2 * Math.PI)).toBe(false);
  });

  it('the range on a ring is one place where both limits are the same', () => {
    const range = { value: 0.3, min: 0.3, max: 0.3 };
    expect([0, 0.01, -0.01].map((angle) => isAllowed(range, angle))).toEqual([true, false, false]);
  });
});
