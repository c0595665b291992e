import { describe, expect, it } from 'vitest';
import { commonFrames, measureDistances } from '../../../src/evaluate/compare/distance.ts';
import { matchJoints } from '../../../src/evaluate/compare/joint-match.ts';
import { warpTakes } from '../../../src/evaluate/compare/warped-takes.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { sharedCaptures } from '../../helpers/bvh-files.ts';
import { captured } from '../../helpers/mocap.ts';
import { describeShared } from '../../helpers/shared.ts';

function warped(a: Character, b: Character) {
  const match = matchJoints(a.skeleton ?? skeleton(), b.skeleton ?? skeleton());
  return runToEnd(warpTakes(a, b, match, 'world', 30));
}

/** Its frames, in the order and as often as `at` says, as a take of as many frames. */
function retimed(one: Character, at: (frame: number, count: number) => number): Character {
  const take = one.takes[one.shownTake];
  const { samples } = take;
  if (!samples) throw new Error('The take has no samples.');
  const { frameCount, values } = samples;
  const width = values.length / frameCount;
  const moved = values.slice();
  for (let f = 0; f < frameCount; f++) {
    const from = Math.round(at(f, frameCount));
    for (let k = 0; k < width; k++) moved[f * width + k] = values[from * width + k];
  }
  const changed: Samples = { ...samples, values: moved };
  return { ...one, takes: [{ ...take, samples: changed }], shownTake: 0 };
}

describe('the distance of two takes with time warp', () => {
  it('takes without joints in common, or without a take, have none', () => {
    const made = character({ takes: [takeOfValues('take', [])], shownTake: 0 });
    expect(warped(made, character())).toBeUndefined();
    const none = { first: [], second: [], onlyFirst: [0, 1], onlySecond: [0, 1] };
    expect(runToEnd(warpTakes(made, made, none, 'world', 30))).toBeUndefined();
  });
});

describeShared('the distance of real takes with time warp', () => {
  const [capture] = sharedCaptures('cmu-01_01.bvh');
  const one = () => {
    if (!capture.take) throw new Error('The file has no take.');
    return captured(capture.skeleton, capture.take);
  };

  it('a take is at distance 0 from itself', () => {
    expect(warped(one(), one())?.distance).toBe(0);
  });

  it('a take that is re-timed smoothly is near with the warp and far without', () => {
    const later = retimed(one(), (f, count) => f - 0.02 * count * Math.sin((Math.PI * f) / (count - 1)) ** 2);
    const match = matchJoints(capture.skeleton, capture.skeleton);
    const times = commonFrames(one(), later, 30, match.first.length);
    if (!times) throw new Error('The takes do not overlap.');
    const { mean } = runToEnd(measureDistances(one(), later, match, times, 'world'));
    const plain = mean.reduce((sum, d) => sum + d, 0) / mean.length;
    expect(warped(one(), later)?.distance).toBeLessThan(0.2 * plain);
  });
});
