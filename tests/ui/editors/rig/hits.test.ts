import { describe, expect, it } from 'vitest';
import { partAt, toSegment } from '../../../../src/ui/editors/rig/hits.ts';
import type { RigScreen } from '../../../../src/view/rig/rig-screen.ts';

const NOTHING = new Float64Array(12).fill(Number.NaN);

/** A chain of three joints from (100, 100) to the right, the second one selected; one more behind the camera. */
function screen(more: Partial<RigScreen> = {}): RigScreen {
  return {
    jointCount: 4,
    nodes: Float64Array.of(100, 100, 200, 100, 300, 100, Number.NaN, Number.NaN),
    starts: Int32Array.of(-1, 0, 1, 2),
    selected: 1,
    arrows: NOTHING,
    faces: NOTHING,
    ...more,
  };
}

const withArrow = () => {
  const arrows = NOTHING.slice();
  arrows.set([216, 100, 278, 100]);
  return arrows;
};

describe('what is under the pointer', () => {
  it('hits the nearest joint', () => {
    expect(partAt(screen(), 104, 103)).toEqual({ kind: 'joint', joint: 0 });
    expect(partAt(screen(), 293, 100)).toEqual({ kind: 'joint', joint: 2 });
  });

  it('hits a bone between joints, as the joint where it starts', () => {
    expect(partAt(screen(), 250, 103)).toEqual({ kind: 'bone', joint: 1 });
  });

  it('hits nothing on the ground, nor behind the camera', () => {
    expect(partAt(screen(), 150, 130)).toBeUndefined();
    expect(partAt(screen(), 400, 100)).toBeUndefined();
  });

  it('hits an arrow before the bone below it, and a joint right at the pointer before the arrow', () => {
    const arrows = withArrow();
    expect(partAt(screen({ arrows }), 250, 102)).toEqual({ kind: 'arrow', axis: 0 });
    const nodes = Float64Array.of(100, 100, 200, 100, 260, 100, Number.NaN, Number.NaN);
    expect(partAt(screen({ arrows, nodes }), 261, 101)).toEqual({ kind: 'joint', joint: 2 });
    expect(partAt(screen({ arrows, nodes }), 268, 100)).toEqual({ kind: 'arrow', axis: 0 });
  });

  it('hits a face of the box before an arrow through it', () => {
    const faces = NOTHING.slice();
    faces.set([180, 100, 220, 100]);
    expect(partAt(screen({ arrows: withArrow(), faces }), 222, 100)).toEqual({ kind: 'face', axis: 0, side: 'max' });
    expect(partAt(screen({ faces }), 181, 104)).toEqual({ kind: 'face', axis: 0, side: 'min' });
  });

  it('what is under the pointer while adding joints, hits only a joint’s dot: beside it a joint would be added', () => {
    const faces = NOTHING.slice();
    faces.set([180, 100, 220, 100]);
    const adding = (x: number, y: number) => partAt(screen({ faces, arrows: withArrow() }), x, y, { isAdding: true });
    expect(adding(206, 100)).toEqual({ kind: 'joint', joint: 1 });
    expect(adding(209, 100)).toBeUndefined();
    expect(adding(220, 100)).toBeUndefined();
    expect(adding(250, 100)).toBeUndefined();
    expect(adding(150, 100)).toBeUndefined();
  });

  it('a click on coincident joints hits the selected one, else the last', () => {
    const nodes = Float64Array.of(100, 100, 100, 100, 100, 100, 100, 100);
    expect(partAt(screen({ nodes }), 100, 100)).toEqual({ kind: 'joint', joint: 1 });
    expect(partAt(screen({ nodes, selected: undefined }), 100, 100)).toEqual({ kind: 'joint', joint: 3 });
  });

  it('what is under the pointer has a larger tolerance for touch', () => {
    expect(partAt(screen(), 100, 118)).toBeUndefined();
    expect(partAt(screen(), 100, 118, { byTouch: true })).toEqual({ kind: 'joint', joint: 0 });
  });
});

describe('the distance to a segment', () => {
  it('the distance to a segment is measured to its ends, and to a point if it has no length', () => {
    expect(toSegment(5, 3, 0, 0, 10, 0)).toBe(3);
    expect(toSegment(-3, 4, 0, 0, 10, 0)).toBe(5);
    expect(toSegment(3, 4, 0, 0, 0, 0)).toBe(5);
  });
});
