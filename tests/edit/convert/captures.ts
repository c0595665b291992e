/** Characters of BVH of any shape, for fast-check. */
import fc from 'fast-check';
import type { Capture } from '../../../src/model/files.ts';
import type { BvhChannel, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';

const CHANNELS: readonly BvhChannel[] = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'];

const length = fc.double({ min: -100, max: 100, noNaN: true });
const vec3 = fc.tuple(length, length, length);

/** Joints in pre-order, with any channels in any order, and End Sites. */
export const anySkeleton: fc.Arbitrary<Skeleton> = fc
  .array(
    fc.record({
      up: fc.nat(5),
      channels: fc.shuffledSubarray([...CHANNELS]),
      offset: vec3,
      endSites: fc.array(vec3, { maxLength: 2 }),
      name: fc.constantFrom('Hips', 'mixamorig:Spine.001', 'Neck (upper) #2', 'TORSO#', 'Größe', '骨', ''),
    }),
    { minLength: 1, maxLength: 8 },
  )
  .map((all) => {
    const parents: number[] = [];
    return {
      name: 'x',
      joints: all.map(({ up, channels, offset, endSites, name }, j) => {
        let parent = j - 1;
        for (let u = 0; u < up && parent > 0; u++) parent = parents[parent];
        parents.push(parent);
        return bvhJoint(parent, channels, { name, offset, ...(endSites.length && { endSites }) });
      }),
    };
  });

/** With the values that a `.bvh` can hold. */
export function anyCapture(value: fc.Arbitrary<number>): fc.Arbitrary<Capture> {
  return fc
    .tuple(anySkeleton, fc.integer({ min: 1, max: 5 }), fc.constantFrom(0.04, 1 / 30, 0.0083333))
    .chain(([skeleton, frames, frameSeconds]) => {
      const width = skeleton.joints.reduce((sum, { pose }) => sum + pose.length, 0);
      const row = fc.array(value, { minLength: width, maxLength: width });
      return fc
        .array(row, { minLength: frames, maxLength: frames })
        .map((rows) => captureOf(skeleton, rows, frameSeconds));
    });
}
