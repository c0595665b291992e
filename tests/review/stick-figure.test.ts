/** Small moving pictures of takes. */
import { describe, expect, it } from 'vitest';
import { guessSpace } from '../../src/evaluate/space/space-guess.ts';
import { positionsMeant, withPositions } from '../../src/model/skeleton/position-channels.ts';
import { digestOf } from '../../src/review/digest.ts';
import { stickFigure } from '../../src/review/stick-figure.ts';
import { ALL_BVH, sharedCaptures } from '../helpers/bvh-files.ts';
import { describeShared } from '../helpers/shared.ts';

describe('pictures of takes', () => {
  it.each(ALL_BVH)('%s fits its picture, head up, and takes a few kilobytes', (file) => {
    for (const { skeleton: read, take } of sharedCaptures(file)) {
      if (!take) continue;
      const skeleton = withPositions(read, positionsMeant(read, take));
      const { points, above, pointCount, frameCount } = stickFigure(skeleton, take, guessSpace(skeleton, take));
      expect(points).toHaveLength(2 * pointCount * frameCount);
      expect(points.byteLength + above.byteLength).toBeLessThan(4000);
      expect(above.every((parent, p) => parent <= p)).toBe(true);
      const [xs, ys] = [0, 1].map((k) => points.filter((_, i) => i % 2 === k));
      const extent = (values: Uint8Array) => Math.max(...values) - Math.min(...values);
      // One of both fills the picture; in place, the width is that of one frame on either side of the middle.
      expect(Math.max(extent(ys), extent(xs))).toBeGreaterThan(120);
    }
  });
});

describeShared('the picture of a real take', () => {
  it('a head is above the feet', () => {
    const [{ skeleton, take }] = sharedCaptures('bandai-namco-bow-normal.bvh');
    if (!take) throw new Error('no take');
    const { points } = stickFigure(skeleton, take, guessSpace(skeleton, take));
    const head = skeleton.joints.findIndex(({ name }) => name === 'Head');
    const foot = skeleton.joints.findIndex(({ name }) => name === 'Foot_L');
    expect(points[2 * head + 1]).toBeLessThan(points[2 * foot + 1] - 100);
  });
});

it('a file without frames says so', () => {
  expect(digestOf('a.bvh', [])).toEqual({ path: 'a.bvh', problem: 'The file has no frames.' });
});
