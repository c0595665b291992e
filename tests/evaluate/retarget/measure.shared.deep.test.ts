/** What retargeted real takes come to, as displayed: how limbs point, what slides, and how much the takes slide themselves. */
import { expect, it } from 'vitest';
import { WALKER_SKELETON } from '../../../examples/characters/walker/skeleton.ts';
import { measureRetarget } from '../../../src/evaluate/retarget/measure.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { character } from '../../helpers/builders.ts';
import { describeShared } from '../../helpers/shared.ts';
import { captured, departure, retargeted } from './captures.ts';

/** The walker's legs are 0.53, a person's 0.85. Metres. */
const WITHIN = 0.001;

const walker = () => character({ id: 'walker', skeleton: WALKER_SKELETON, pose: filePose(WALKER_SKELETON, 0) });

function measured(file: string, plantsFeet: boolean) {
  return measureRetarget(retargeted(captured(file), walker(), { plantsFeet }));
}

describeShared('feet of real takes on the walker', () => {
  it.each(['cmu-01_01.bvh', 'mixamo-names.bvh', 'perception-neuron-course.bvh', 'cmu-daz-pirouette.bvh'])(
    'planted, slide no further than those of %s',
    (file) => {
      const planted = measured(file, true);
      expect(planted.contacts).toBeGreaterThan(3);
      expect(planted.worst).toBeLessThan(planted.sourceWorst + WITHIN);
      expect(planted.mean).toBeLessThan(planted.sourceMean + WITHIN);
    },
  );

  it('planted feet are raised where a take stands lower than before: rokoko-dance ends with a foot 13 cm below where it danced', () => {
    const planted = measured('rokoko-dance.bvh', true);
    expect(planted.contacts).toBeGreaterThan(2);
    expect(planted.lowest).toBeGreaterThan(-0.01);
    expect(planted.worst).toBeLessThan(planted.sourceWorst + WITHIN);
  });

  it('left to the legs, slide further: that is what planting is for', () => {
    expect(measured('mixamo-names.bvh', false).mean).toBeGreaterThan(2 * measured('mixamo-names.bvh', true).mean);
  });

  it('feet of a walk on the spot are not planted, since they move all the time', () => {
    expect(measured('poser-sl-walk.bvh', true).contacts).toBe(0);
  });

  it('is measured on the displayed pose: a leg held by limits doesn’t point like the source’s, and slides', () => {
    const driven = retargeted(captured('mixamo-names.bvh'), walker());
    const before = measureRetarget(driven);
    expect(before.limbs).toBe(4);
    expect(before.limbsMean).toBeLessThan(15);
    const thigh = WALKER_SKELETON.joints.findIndex(({ name }) => name === 'thigh_l');
    const joints = WALKER_SKELETON.joints.map((j, i) =>
      i === thigh ? { ...j, limits: j.limits.map(() => ({ min: 0, max: 0 })) } : j,
    );
    const stiff = measureRetarget({ ...driven, skeleton: { ...WALKER_SKELETON, joints } });
    expect(stiff.limbsWorst).toBeGreaterThan(before.limbsWorst + 10);
    expect(stiff.worst).toBeGreaterThan(before.worst);
  });

  it('measures on a copy of the source’s skeleton how far joints are off, as a comparison of both characters does', () => {
    const source = captured('cmu-01_01.bvh');
    const copy = retargeted(source, captured('cmu-01_01.bvh', 'cmu-01_01.bvh copy'));
    expect(measureRetarget(copy).departure).toBeLessThan(1e-9);
    const pinned = { ...copy, unkeyed: { timeSeconds: 0, dofs: [0], values: [100] } };
    expect(measureRetarget(pinned).departure).toBeCloseTo(departure(pinned, source).metres, 9);
  });

  it('measures feet and hands, whose soles are parallel rather than their bones', () => {
    const result = measureRetarget(retargeted(captured('mixamo-names.bvh'), captured('perception-neuron-course.bvh')));
    expect(result.tips).toBe(2);
    expect(result.tipsWorst).toBeLessThan(1);
    const soles = measureRetarget(retargeted(captured('mixamo-names.bvh'), captured('cmu-01_01.bvh')));
    expect(soles.tips).toBe(2);
    expect(soles.tipsMean).toBeGreaterThan(20);
    expect(soles.tipsWorst).toBeLessThan(31);
  });

  it('measures contacts all over the take if it may not measure all', () => {
    const some = measureRetarget(retargeted(captured('boxing-extra-line.bvh'), walker()), 4);
    expect(some.contacts).toBe(8);
    expect(some.allContacts).toBeGreaterThan(50);
  });
});
