/**
 * Distances of two takes of 3,000 frames and 60 joints, as measured for comparison: poses both at every frame, and
 * measures each pair of joints. Against only posing both, which is needed anyway. Goal: at most 1.5 times that.
 */
import { bench, describe } from 'vitest';
import { commonFrames, measureDistances } from '../../src/evaluate/compare/distance.ts';
import { matchJoints } from '../../src/evaluate/compare/joint-match.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { runToEnd } from '../../src/evaluate/steps.ts';
import { RADIANS_PER_DEGREE } from '../../src/math/degrees.ts';
import { restChannel, SAMPLED, type Take } from '../../src/model/takes/take.ts';
import { character, joint } from '../helpers/builders.ts';

const JOINTS = 60;
const FRAMES = 3000;
const WIDTH = 3 * JOINTS;
const FRAME_SECONDS = 1 / 120;

const skeleton = {
  name: 'hero',
  joints: Array.from({ length: JOINTS }, (_, j) =>
    joint(j === 0 ? -1 : Math.floor((j - 1) / 2), {
      motion: { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' },
    }),
  ),
};

/** Oscillating degrees, each DOF at its own pace. */
function sway(phase: number): Take {
  const values = Float64Array.from(
    { length: WIDTH * FRAMES },
    (_, i) => 30 * Math.sin(phase + (i % WIDTH) + Math.floor(i / WIDTH) / 40),
  );
  return {
    name: 'sway',
    range: [0, (FRAMES - 1) * FRAME_SECONDS],
    channels: Array.from({ length: 3 + WIDTH }, (_, c) => (c < 3 ? restChannel() : SAMPLED)),
    samples: {
      frameCount: FRAMES,
      frameSeconds: FRAME_SECONDS,
      startSeconds: 0,
      firstChannel: 3,
      values,
      scales: new Float64Array(WIDTH).fill(RADIANS_PER_DEGREE),
      interpolation: 'linear',
    },
  };
}

const [a, b] = [0, 0.3].map((phase, i) =>
  character({ id: `c${i}`, skeleton, takes: [sway(phase)], shownTake: 0, timeOffsetSeconds: 0.003 * i }),
);
const match = matchJoints(skeleton, skeleton);
const times = commonFrames(a, b, 30, JOINTS);
if (!times) throw new Error('the takes have no time in common');
const compiled = compileSkeleton(skeleton);
const dofs = new Float64Array(dofCountOf(a));
const world = new Float64Array(16 * JOINTS);

describe('distances of two takes, 3,000 frames of 60 joints', () => {
  bench('posing both, and nothing else', () => {
    for (let f = 0; f < times.frameCount; f++) {
      const time = times.startSeconds + f * times.frameSeconds;
      for (const one of [a, b]) {
        poseAt(one, time, dofs);
        worldMatrices(compiled, dofs, world);
      }
    }
  });

  bench('measuring them', () => {
    runToEnd(measureDistances(a, b, match, times, 'turned'));
  });
});
