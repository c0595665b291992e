/** A real take retargeted to a copy of its own skeleton comes out as itself, to the digit, whatever its file pose and its dialect. */
import { describe, expect, it } from 'vitest';
import type { RetargetOptions } from '../../../src/model/takes/retarget.ts';
import { ALL_BVH } from '../../helpers/bvh-files.ts';
import { captured, departure, frameTimes, retargeted } from './captures.ts';

describe('real takes on a copy of their own skeleton', () => {
  it.each(ALL_BVH)('%s on a copy of its own skeleton is itself, at every frame', (file) => {
    const source = captured(file);
    const times = frameTimes(source);
    const options: Partial<RetargetOptions>[] = [
      {},
      { reference: 'rest', plantsFeet: false },
      { reference: times[Math.floor(times.length / 2)] },
    ];
    // However it was posed before.
    const plain = captured(file, `${file} copy`);
    const copy = { ...plain, pose: plain.pose.map((v, i) => v + 0.3 * Math.sin(i)) };
    for (const own of options) {
      const result = departure(retargeted(source, copy, own), source);
      expect(result.share, `${JSON.stringify(own)}: ${result.point} at ${result.seconds} s`).toBe(0);
    }
  });
});
