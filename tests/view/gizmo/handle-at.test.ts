import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { handleAt as hitAt } from '../../../src/view/gizmo/handle-at.ts';
import { BALL_PART, layOut } from '../../../src/view/gizmo/shapes.ts';
import { facing, handle, joint, laid, onEdge, view } from './on-screen.ts';

const handleAt = (...args: Parameters<typeof hitAt>) => hitAt(...args)?.id;

/** A ring that leans away from the viewer by some radians, about the screen's x. */
const leaning = (dof: number, angle: number) => handle(dof, 'turn', [0, Math.sin(angle), Math.cos(angle)], [1, 0, 0]);

describe('a handle of a gizmo under the pointer', () => {
  it('a handle under the pointer is the line that is nearest', () => {
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

  it('the dot of the active ring comes before the rings that cross it, to a finger too', () => {
    // Both rings meet where the second has its dot, and the first is in front beside it.
    const crossing = handle(2, 'turn', [0, 1, 0], [1, 0, 0]);
    const layout = laid([facing, crossing]);
    const active = { kind: 'dof', dof: 2 } as const;
    const [x, y] = layout.shapes[1].points;
    expect(hitAt(layout, x, y - 6, 0, active)).toMatchObject({ id: active, yields: false });
    expect(hitAt(layout, x, y - 15, 10, active)).toMatchObject({ id: active, yields: false });
    expect(handleAt(layout, x, y - 15, 10)).toEqual({ kind: 'dof', dof: 1 });
    expect(hitAt(layout, x, y - 15, 0, active)?.id).toEqual({ kind: 'dof', dof: 1 });
  });

  it('a handle under the pointer is no ball where the joint can’t turn freely', () => {
    expect(handleAt(laid([facing]), 440, 300)).toBeUndefined();
  });

  it('an arrow is hit by its length, but not in the middle, and not at all along the line of sight', () => {
    const layout = laid([handle(0, 'slide', [0, 1, 0], [1, 0, 0]), handle(1, 'slide', [0, 0, 1], [1, 0, 0])]);
    expect(handleAt(layout, 402, 230)).toEqual({ kind: 'dof', dof: 0 });
    expect(layout.shapes[1].isAway).toBe(true);
    expect(handleAt(layout, 400, 295)).toBeUndefined();
  });

  it('the far half of a ring is not hit, at any lean and with any tolerance', () => {
    fc.assert(
      fc.property(
        fc.double({ min: 0.6, max: 1.2, noNaN: true }),
        fc.double({ min: 0.3, max: Math.PI - 0.3, noNaN: true }),
        (lean, angle) => {
          const layout = laid([leaning(3, lean)]);
          const ring = layout.shapes[0];
          const at = Math.round((angle / (2 * Math.PI)) * 64);
          const opposite = (at + 32) % 64;
          const [near, far] = ring.depths[at] > 0 ? [at, opposite] : [opposite, at];
          const point = (i: number) => [ring.points[2 * i], ring.points[2 * i + 1]] as const;
          expect(handleAt(layout, ...point(near))).toEqual({ kind: 'dof', dof: 3 });
          expect(handleAt(layout, ...point(far))).toBeUndefined();
        },
      ),
    );
  });

  it('a handle of a gizmo under the pointer where lines cross, the one in front is hit, whichever comes first', () => {
    fc.assert(
      fc.property(fc.double({ min: 0.4, max: 1.1, noNaN: true }), fc.boolean(), (lean, isFirst) => {
        const ring = leaning(4, lean);
        // An arrow in the screen's plane, over the near half of the ring, which comes below the middle.
        const arrow = handle(5, 'slide', [0, -1, 0], [1, 0, 0]);
        const layout = laid(isFirst ? [arrow, ring] : [ring, arrow]);
        const shape = layout.shapes[isFirst ? 1 : 0];
        const crossing = [16, 48].find((i) => shape.depths[i] > 0) ?? Number.NaN;
        const [x, y] = [shape.points[2 * crossing], shape.points[2 * crossing + 1]];
        expect(x).toBeCloseTo(400, 9);
        const down = y > 300;
        const toward: Vec3 = [0, down ? -1 : 1, 0];
        const both = laid(isFirst ? [{ ...arrow, axis: toward }, ring] : [ring, { ...arrow, axis: toward }]);
        expect(handleAt(both, x, y)).toEqual({ kind: 'dof', dof: 4 });
        // Beside the ring, the arrow.
        expect(handleAt(both, x, 300 + (y - 300) + (down ? 12 : -12))).toEqual({ kind: 'dof', dof: 5 });
      }),
    );
  });

  it('an arrow that comes toward the viewer is in front of a ring that faces them', () => {
    const toward = handle(5, 'slide', [Math.SQRT1_2, 0, Math.SQRT1_2], [0, 1, 0]);
    const away = handle(5, 'slide', [Math.SQRT1_2, 0, -Math.SQRT1_2], [0, 1, 0]);
    // A ring that the arrow's shaft crosses; its own end is some pixels short of it.
    const ring = { ...facing, centre: [-0.2, 0, 0] as Vec3 };
    const x = 400 + 90 - 20;
    expect(handleAt(laid([ring, toward]), x, 300)).toEqual({ kind: 'dof', dof: 5 });
    expect(handleAt(laid([ring, away]), x, 300)).toEqual({ kind: 'dof', dof: 1 });
  });

  it('near the pivot a ring seen from its edge says so, and nothing else does', () => {
    const layout = laid([facing, onEdge]);
    expect(hitAt(layout, 400, 302)).toEqual({ id: { kind: 'dof', dof: 2 }, yields: false, isAtPivot: true });
    expect(hitAt(layout, 400, 330)).toEqual({ id: { kind: 'dof', dof: 2 }, yields: false, isAtPivot: false });
    expect(hitAt(layout, 490, 300)?.isAtPivot).toBe(false);
  });

  it('free rotation, the margin of a line and the part of a ring beyond limits yield to joints under the pointer', () => {
    const limited = { ...facing, range: { value: 0, min: -1, max: 1 } };
    const layout = laid([limited], true);
    // The ring begins on the right, and turns counterclockwise.
    expect(hitAt(layout, 490, 300)).toMatchObject({ id: { kind: 'dof', dof: 1 }, yields: false });
    expect(hitAt(layout, 310, 300)).toMatchObject({ id: { kind: 'dof', dof: 1 }, yields: true });
    expect(hitAt(laid([facing]), 310, 300)?.yields).toBe(false);
    expect(hitAt(layout, 430, 300)).toMatchObject({ id: { kind: 'ball' }, yields: true });
    expect(hitAt(layout, 292, 300)).toMatchObject({ id: { kind: 'view' }, yields: true });
    expect(hitAt(layout, 494, 300)).toMatchObject({ id: { kind: 'dof', dof: 1 }, yields: true });
  });

  it('a square is hit within it and by its edges, and not where it is seen from its edge', () => {
    const id = { kind: 'across', axis: 2 } as const;
    const square = (v: Vec3) => ({ id, centre: [0, 0, 0], axes: [[1, 0, 0], v], hue: 2 }) as const;
    const facing = layOut({ ...joint([]), planes: [square([0, 1, 0])] }, view, 90);
    const onEdge = layOut({ ...joint([]), planes: [square([0, 0.1, Math.sqrt(0.99)])] }, view, 90);
    if (!facing || !onEdge) throw new Error('Both are in front.');
    const [inside, beside] = [0.53 * 90, 0.7 * 90 + 5];
    expect(handleAt(facing, 400 + inside, 300 - inside)).toEqual(id);
    expect(handleAt(facing, 400 + beside, 300 - inside)).toEqual(id);
    expect(handleAt(facing, 400 + beside + 5, 300 - inside)).toBeUndefined();
    expect(handleAt(facing, 400 - inside, 300 - inside)).toBeUndefined();
    expect(onEdge.shapes[0].isAway).toBe(true);
    expect(handleAt(onEdge, 400 + inside, 300 - 0.1 * inside)).toBeUndefined();
  });
});
