/** Characters without a skin: what their body of bones shows. */
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { glbOf, inThree } from '../../helpers/glb.ts';

const HAND = 16;

describe('the body of bones in a GLB file', () => {
  it.each(['linear', 'cubic'] as const)('a last joint turns with %s keys as it does here', async (keys) => {
    const own = skeleton(2);
    const rest = takeOfValues(
      'wave',
      Array.from({ length: 9 }, () => 0),
      [0, 3],
    );
    const [turn, swing] = [0.8, 2.4].map((value) => ({
      ...rest.channels[0],
      times: Float64Array.of(0, 0.5, 1.2, 2, 3),
      values: Float64Array.of(0, value, -value, value / 2, 0),
      tangentsIn: { kinds: new Uint8Array(5).fill(2), slopes: new Float64Array(5) },
      tangentsOut: { kinds: new Uint8Array(5).fill(2), slopes: new Float64Array(5) },
    }));
    const channels = rest.channels.map((each, i) => (i === 6 ? turn : i === 7 ? swing : each));
    const hero = character({ skeleton: own, takes: [{ ...rest, channels }], shownTake: 0 });
    const glb = glbOf(hero, { keys });
    const play = await inThree(glb);
    const dofs = new Float64Array(dofCountOf(hero));
    const world = new Float64Array(32);
    for (let i = 0; i < 50; i++) {
      const time = (i + 0.37) * 0.06;
      poseAt(hero, time, dofs);
      worldMatrices(compileSkeleton(own), dofs, world);
      const { matrices } = play(0, time);
      for (const o of [0, 4, 8].map((column) => HAND + column)) {
        const off = Math.hypot(...[0, 1, 2].map((k) => matrices[o + k] - world[o + k]));
        // The bone of the hand is 0.3 long: a corner of it is within the tolerance of 1/2000.
        expect(off, `at ${time}`).toBeLessThan(0.02);
      }
    }
  });
});
