import { describe, expect, it } from 'vitest';
import { DEFAULT_RETARGET } from '../../../../src/model/takes/retarget.ts';
import { retargetText } from '../../../../src/ui/editors/retarget/result-text.ts';
import { driverOf, person, takeOfRows } from '../../../evaluate/retarget/people.ts';

const skeleton = person();
const driver = driverOf(skeleton, takeOfRows(skeleton, [[]]), [{ target: 0, source: 0 }]);
const NOTHING = {
  ...{ limbs: 0, limbsMean: 0, limbsWorst: 0, worst: 0, mean: 0, sourceWorst: 0, sourceMean: 0 },
  ...{ contacts: 0, allContacts: 0, lowest: 0, highest: 0, tips: 0, tipsMean: 0, tipsWorst: 0 },
};

describe('what a take on another character comes to', () => {
  it('tells how many joints follow, and that there are no foot contacts', () => {
    expect(retargetText(driver, skeleton, NOTHING)).toBe('1 of 21 joints follow. No foot contacts found.');
  });

  it('tells how far feet slide, and how far the source’s do', () => {
    const feet = { contacts: 5, allContacts: 5, mean: 0.007, worst: 0.0133, sourceMean: 0.007, sourceWorst: 0.0133 };
    const sliding = { ...NOTHING, ...feet };
    expect(retargetText(driver, skeleton, sliding)).toContain(
      'over 5 contacts they slide 0.7 cm on average, 1.3 cm at most',
    );
    expect(retargetText(driver, skeleton, { ...sliding, allContacts: 80 })).toContain('over 5 of 80 contacts');
    const left = { ...driver, options: { ...DEFAULT_RETARGET, plantsFeet: false } };
    expect(retargetText(left, skeleton, sliding)).toContain('Feet are not planted');
  });

  it('tells how well arms and legs point, or how far the joints of the same skeleton are off', () => {
    const limbs = { ...NOTHING, limbs: 4, limbsMean: 1.23, limbsWorst: 17 };
    expect(retargetText(driver, skeleton, limbs)).toContain('within 1.2° of the source’s on average, 17° at most.');
    const tips = { ...limbs, tips: 2, tipsMean: 12.34, tipsWorst: 20 };
    expect(retargetText(driver, skeleton, tips)).toContain('17° at most; feet and hands within 12.3°, 20° at most.');
    const same = retargetText(driver, skeleton, { ...limbs, departure: 0.0123 });
    expect(same).toContain('The skeletons are identical: joints are off by at most 1.2 cm.');
    expect(same).not.toContain('Arms');
  });
});
