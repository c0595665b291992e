import { describe, expect, it } from 'vitest';
import { seenPoint } from '../../../../src/evaluate/ik/drag/grip.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { DEFAULT_MOTION, type Joint, type Skeleton, UNLIMITED } from '../../../../src/model/skeleton/skeleton.ts';

const joint = (parent: number, offset: Vec3, half: number): Joint => ({
  name: 'j',
  parent,
  offset,
  box: { min: [-half, -half, -half], max: [half, half, half] },
  motion: DEFAULT_MOTION,
  limits: [UNLIMITED, UNLIMITED, UNLIMITED],
  pose: [0, 0, 0],
});
/** A bone from 0 along +y, of length 2, with a box of side 1 about its first joint. */
const BONE: Skeleton = { name: 'bone', joints: [joint(-1, [0, 0, 0], 0.5), joint(0, [0, 2, 0], 0.5)] };
/** The first is at x = 10, the second above it. */
const WORLD = Float64Array.from([0, 2].flatMap((y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, y, 0, 1]));
const ahead = (x: number, y: number) => ({ origin: [x, y, 5] as const, direction: [0, 0, -1] as const });
const close = (found: Vec3, wanted: Vec3) => {
  for (const k of [0, 1, 2]) expect(found[k]).toBeCloseTo(wanted[k], 12);
};

describe('the point of a joint that is seen', () => {
  it('the point of a joint that is seen is the point of its bone that the line passes, within its ends', () => {
    close(seenPoint(BONE, 0, WORLD, ahead(10.01, 1.3), 0.1, true), [0, 1.3, 0]);
    close(seenPoint(BONE, 0, WORLD, ahead(10.01, 2.7), 2, true), [0, 2, 0]);
  });
  it('the point of a joint that is seen is where the line enters its box, off the bone', () => {
    close(seenPoint(BONE, 0, WORLD, ahead(10.3, 0.2), 0.1, true), [0.3, 0.2, 0.5]);
  });
  it('a drag grips the bone when no box is drawn, or the box is missed', () => {
    close(seenPoint(BONE, 0, WORLD, ahead(10.3, 0.2), 0.1, false), [0, 0.2, 0]);
    close(seenPoint(BONE, 0, WORLD, ahead(11, 0.7), 0.1, true), [0, 0.7, 0]);
  });
  it('the point of a joint that is seen is the pivot of a joint without a bone or a box in the way', () => {
    close(seenPoint(BONE, 1, WORLD, ahead(14, 4), 0.1, true), [0, 0, 0]);
  });
});
