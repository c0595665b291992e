import { Matrix4 } from 'three';
import { describe, expect, it } from 'vitest';
import { sphereAround, viewOf } from '../../../../src/ui/editors/compare/frame-both.ts';

const HERE = Float64Array.from(new Matrix4().elements);
const points = (...numbers: number[]) => ({ numbers: Float64Array.from(numbers), stride: 3, first: 0 }) as const;

describe('framing both programs’ numbers', () => {
  it('all places are inside, of matrices and of points', () => {
    const matrices = {
      numbers: Float64Array.from([...new Matrix4().setPosition(3, 0, 0).elements, ...HERE]),
      stride: 16,
      first: 12,
    } as const;
    expect(sphereAround([matrices, points(0, 4, 0)], HERE)).toEqual({ centre: [1.5, 2, 0], radius: 2.5 });
  });

  it('all placements are inside', () => {
    const there = new Matrix4().makeScale(2, 2, 2).setPosition(10, 0, 0);
    const placements = Float64Array.from([...HERE, ...there.elements]);
    expect(sphereAround([points(0, 0, 0, 1, 0, 0)], placements)).toEqual({ centre: [6, 0, 0], radius: 6 });
  });

  it('places that are no numbers count for nothing', () => {
    expect(sphereAround([points(0, 0, 0, 2, 0, 0, Number.NaN, 9, 9)], HERE)?.radius).toBe(1);
    expect(sphereAround([points(Number.NaN, 0, 0)], HERE)).toBeUndefined();
    expect(sphereAround([], HERE)).toBeUndefined();
  });

  it('the camera keeps its direction, and is as far away as the sphere is large', () => {
    const view = { target: [1, 1, 1], azimuth: 0.3, polar: 1.2, distance: 10 } as const;
    // Ten units fit from ten units away; with some room, the sphere of 2 needs 4.4.
    const next = viewOf({ centre: [4, 0, 0], radius: 2 }, view, 10);
    expect(next).toEqual({ ...view, target: [4, 0, 0], distance: expect.closeTo(4.4, 9) });
    expect(viewOf({ centre: [4, 0, 0], radius: 0 }, view, 10).distance).toBe(10);
  });
});
