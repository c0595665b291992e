import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  alongLine,
  boxWithFace,
  offsetMoved,
  parentToScene,
  snapped,
  withoutDust,
} from '../../../src/edit/rig/dragged-places.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { add, scaled, subtract, transformPoint, type Vec3 } from '../../../src/math/vec3.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { skeleton } from '../../ui/builders.ts';

/** Of lengths around 1. */
const NEAR = 1e-9;

const coordinate = fc.double({ min: -3, max: 3, noNaN: true });
const point: fc.Arbitrary<Vec3> = fc.tuple(coordinate, coordinate, coordinate);

function expectPoint(found: Vec3 | undefined, wanted: Vec3): void {
  expect(found).toBeDefined();
  for (let k = 0; k < 3; k++) expect(Math.abs((found ?? [NaN, NaN, NaN])[k] - wanted[k])).toBeLessThan(NEAR);
}

/** Positions of joints in a pose, for a character that is displaced, rotated and half as large. */
const PLACEMENT = Float64Array.of(0, 0, -0.5, 0, 0, 0.5, 0, 0, 0.5, 0, 0, 0, 4, 1, -2, 1);

function worldOf(of: Skeleton, dofs: readonly number[]): Float64Array {
  const world = new Float64Array(16 * of.joints.length);
  worldMatrices(compileSkeleton(of), Float64Array.from(dofs), world);
  return world;
}

const pivot = (world: Float64Array, joint: number): Vec3 =>
  transformPoint(parentToScene(PLACEMENT, world, joint), [0, 0, 0]);

describe('a joint that is dragged', () => {
  const arm = skeleton(['root', -1], ['shoulder', 0], ['elbow', 1]);

  it('moves to the position of the hand, in any pose', () => {
    fc.assert(
      fc.property(point, fc.array(coordinate, { minLength: 12, maxLength: 12 }), fc.nat(2), (to, dofs, joint) => {
        const world = worldOf(arm, dofs);
        const space = parentToScene(PLACEMENT, world, arm.joints[joint].parent);
        const offset = offsetMoved(arm.joints[joint].offset, space, pivot(world, joint), to);
        if (!offset) throw new Error('No offset leads there.');
        const joints = arm.joints.map((one, j) => (j === joint ? { ...one, offset } : one));
        expectPoint(pivot(worldOf({ ...arm, joints }, dofs), joint), to);
      }),
    );
  });

  it('a dragged joint has its offset moved as far as its pivot, even if its own DOFs move that too', () => {
    const motion = { kind: 'prismatic', axis: [0, 1, 0] } as const;
    const own = arm.joints[1];
    const sliding = { ...own, motion, limits: own.limits.slice(0, 1), pose: [0] };
    const of = { ...arm, joints: [arm.joints[0], sliding] };
    const dofs = [0, 0, 0, 0.3, 0.2, 0.1, 0.7];
    const world = worldOf(of, dofs);
    const to = add(pivot(world, 1), [0.1, -0.2, 0.3]);
    const offset = offsetMoved(own.offset, parentToScene(PLACEMENT, world, 0), pivot(world, 1), to);
    if (!offset) throw new Error('No offset leads there.');
    const moved = { ...of, joints: [of.joints[0], { ...sliding, offset }] };
    expectPoint(pivot(worldOf(moved, dofs), 1), to);
  });

  it('a joint that is dragged does not move in a singular space', () => {
    const flat = Float64Array.of(1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    expect(offsetMoved([0, 0, 0], flat, [0, 0, 0], [1, 1, 1])).toBeUndefined();
  });
});

describe('an arrow', () => {
  it('follows the ray to its nearest point', () => {
    fc.assert(
      fc.property(point, point, point, point, (anchor, direction, origin, way) => {
        const length = Math.hypot(...way);
        fc.pre(Math.hypot(...direction) > 0.1 && length > 0.1);
        const ray = { origin, direction: scaled(way, 1 / length) };
        const along = alongLine(anchor, direction, ray);
        fc.pre(along !== undefined && Math.abs(along) < 1e3);
        const distanceAt = (t: number) => {
          const apart = subtract(add(anchor, scaled(direction, t)), origin);
          const past = apart.reduce((sum, part, k) => sum + part * ray.direction[k], 0);
          return Math.hypot(...subtract(apart, scaled(ray.direction, past)));
        };
        const least = distanceAt(along ?? 0);
        for (const step of [-1e-3, 1e-3]) expect(distanceAt((along ?? 0) + step)).toBeGreaterThanOrEqual(least - NEAR);
      }),
    );
  });

  it('an arrow that points at the viewer is followed by no ray', () => {
    expect(alongLine([0, 0, 0], [0, 0, 2], { origin: [0, 0, 5], direction: [0, 0, -1] })).toBeUndefined();
  });
});

describe('numbers of a drag', () => {
  it('numbers of a drag are whole steps, without digits behind them', () => {
    expect([snapped(0.3000001, 0.1), snapped(-0.04, 0.1), snapped(7.7, 5)]).toEqual([0.3, 0, 10]);
  });

  it('numbers of a drag have no more decimals than a tenth of a pixel', () => {
    expect(withoutDust([0.123456, -1.000049, 2], 0.004)).toEqual([0.1235, -1, 2]);
  });
});

describe('a face of a box', () => {
  const box = { min: [-1, -2, -3], max: [1, 2, 3] } as const;

  it('moves alone, or with the opposite one the other way', () => {
    expect(boxWithFace(box, 1, 'max', 0.5)).toEqual({ min: [-1, -2, -3], max: [1, 2.5, 3] });
    expect(boxWithFace(box, 0, 'min', -0.5, { both: true })).toEqual({ min: [-1.5, -2, -3], max: [1.5, 2, 3] });
  });

  it('stops at the one across, or with both at the middle', () => {
    expect(boxWithFace(box, 2, 'max', -100).max).toEqual([1, 2, -3]);
    expect(boxWithFace(box, 2, 'min', 100, { both: true })).toEqual({ min: [-1, -2, 0], max: [1, 2, 0] });
  });

  it('moves freely if min exceeds max already', () => {
    const crossed = { min: [1, 0, 0], max: [-1, 1, 1] } as const;
    expect(boxWithFace(crossed, 0, 'min', 1).min[0]).toBe(2);
  });

  it('a face of a box has no more decimals than a drag can give, and all of its own if nothing moves', () => {
    const fine = { min: [-0.13, 0, 0], max: [0.13000000000000003, 1, 1] } as const;
    // 0.13 + 0.293 is 0.42300000000000004.
    expect(boxWithFace(fine, 0, 'max', 0.293, { unitsPerPixel: 0.01 }).max[0]).toBe(0.423);
    expect(boxWithFace(fine, 0, 'max', 0.293, { unitsPerPixel: 0.01, both: true }).min[0]).toBe(-0.423);
    expect(boxWithFace(fine, 0, 'max', 0, { unitsPerPixel: 0.01, both: true })).toEqual(fine);
    // Rounding goes past nothing that it stops at.
    const low = { min: [0.1266, 0, 0], max: [1, 1, 1] } as const;
    expect(boxWithFace(low, 0, 'max', -0.8735, { unitsPerPixel: 0.01 }).max[0]).toBeGreaterThanOrEqual(0.1266);
    expect(boxWithFace(low, 0, 'max', -5, { unitsPerPixel: 0.01 }).max[0]).toBe(0.1266);
  });

  it('snaps to round numbers of its own', () => {
    expect(boxWithFace(box, 0, 'max', 0.13, { step: 0.1 }).max[0]).toBe(1.1);
    expect(boxWithFace({ ...box, max: [0.97, 1, 1] }, 0, 'max', 0, { step: 0.1 }).max[0]).toBe(0.97);
  });
});
