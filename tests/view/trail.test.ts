import { describe, expect, it } from 'vitest';
import { samplePath, Trail } from '../../src/view/trail.ts';
import { character, clip, skeleton } from '../helpers/builders.ts';

describe('the trail of a joint', () => {
  const still = character({ skeleton: skeleton(2), clips: [], shownClip: -1 });
  const pose = still.pose.map((value, dof) => (dof === 0 ? 3 : value));

  it('the motion path is where the joint is at each time', () => {
    const path = samplePath({ ...still, pose }, 0, [0, 1], 4, false);
    expect(path).toHaveLength(12);
    for (let i = 0; i < 4; i++) expect(path[3 * i]).toBeCloseTo(3, 12);
  });

  it('leaves out the root motion in place', () => {
    const path = samplePath({ ...still, pose }, 0, [0, 1], 2, true);
    expect(path[0]).toBeCloseTo(0, 12);
  });

  it('covers the range, both ends included', () => {
    const moving = { ...still, clips: [clip('walk', [0, 8])], shownClip: 0 };
    const one = samplePath(moving, 0, [0, 1], 5, false);
    const ends = samplePath(moving, 0, [0, 1], 2, false);
    expect(Array.from(one.subarray(0, 3))).toEqual(Array.from(ends.subarray(0, 3)));
    expect(Array.from(one.subarray(12))).toEqual(Array.from(ends.subarray(3)));
  });

  it('a path over all of time to where no 32-bit float reaches is drawn without complaint', () => {
    const away = clip('away', [1e308, -1e308]);
    const moving = character({ skeleton: skeleton(2), clips: [away], shownClip: 0 });
    expect(samplePath(moving, 0, [-1e308, 1e308], 5, false).every((value) => !Number.isNaN(value))).toBe(true);
    const trail = new Trail();
    trail.show(moving, 0, [0, 1], false);
    // three.js has no need to compute it, and to find that it isn't one.
    expect(trail.object.geometry.boundingSphere?.radius).toBe(-1);
  });
});
