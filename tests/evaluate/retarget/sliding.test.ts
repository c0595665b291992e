/** Feet of real takes, on the walker: what slides, and how much of it the takes slide themselves. */
import { expect, it } from 'vitest';
import { planRetarget } from '../../../src/evaluate/retarget/make-plan.ts';
import { automaticPairs } from '../../../src/evaluate/retarget/match.ts';
import { measureSliding } from '../../../src/evaluate/retarget/sliding.ts';
import { guessSpace } from '../../../src/evaluate/space.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import { WALKER_SKELETON } from '../../../src/samples/walker/skeleton.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { driverOf } from './people.ts';

/** The walker's legs are 0.53, a person's 0.85. Metres. */
const WITHIN = 0.001;

function sliding(file: string, plantsFeet: boolean) {
  const { value } = readBvh(sharedBytes(`data/bvh/${file}`), file);
  const figure = value?.[0];
  if (!figure?.clip) throw new Error(`${file} has no take`);
  const { skeleton, clip } = figure;
  const space = guessSpace(skeleton, clip);
  const pairs = automaticPairs(skeleton, WALKER_SKELETON, space);
  return measureSliding(
    planRetarget(driverOf(skeleton, clip, pairs, { plantsFeet }, space), WALKER_SKELETON, undefined, true),
  );
}

describeShared('feet of real takes on the walker', () => {
  it.each(['cmu-01_01.bvh', 'mixamo-names.bvh', 'perception-neuron-course.bvh', 'cmu-daz-pirouette.bvh'])(
    'planted, slide no further than those of %s',
    (file) => {
      const planted = sliding(file, true);
      expect(planted.contacts).toBeGreaterThan(3);
      expect(planted.worst).toBeLessThan(planted.sourceWorst + WITHIN);
      expect(planted.mean).toBeLessThan(planted.sourceMean + WITHIN);
    },
  );

  it('planted feet are raised where a take stands lower than before: rokoko-dance ends with a foot 13 cm below where it danced', () => {
    const planted = sliding('rokoko-dance.bvh', true);
    expect(planted.contacts).toBeGreaterThan(2);
    expect(planted.lowest).toBeGreaterThan(-0.01);
    expect(planted.worst).toBeLessThan(planted.sourceWorst + WITHIN);
  });

  it('left to the legs, slide further: that is what planting is for', () => {
    expect(sliding('mixamo-names.bvh', false).mean).toBeGreaterThan(2 * sliding('mixamo-names.bvh', true).mean);
  });

  it('feet of a walk on the spot are not planted, since they move all the time', () => {
    expect(sliding('poser-sl-walk.bvh', true).contacts).toBe(0);
  });
});
