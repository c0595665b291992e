import { describe, expect, it } from 'vitest';
import { DEFAULT_RETARGET } from '../../../../src/model/retarget.ts';
import { retargetText } from '../../../../src/ui/editors/retarget/result-text.ts';
import { driverOf, person, take } from '../../../evaluate/retarget/people.ts';

const skeleton = person();
const driver = driverOf(skeleton, take(skeleton, [[]]), [{ target: 0, source: 0 }]);
const NOTHING = { worst: 0, mean: 0, sourceWorst: 0, sourceMean: 0, contacts: 0, lowest: 0, highest: 0 };

describe('what a take on another character comes to', () => {
  it('tells how many joints follow, and that there are no foot contacts', () => {
    expect(retargetText(driver, skeleton, NOTHING)).toBe('1 of 21 joints follow. No foot contacts found.');
  });

  it('tells how far feet slide, and how far the source’s do', () => {
    const sliding = { ...NOTHING, contacts: 5, mean: 0.007, worst: 0.0133, sourceMean: 0.007, sourceWorst: 0.0133 };
    expect(retargetText(driver, skeleton, sliding)).toContain(
      'over 5 contacts they slide 0.7 cm on average, 1.3 cm at most',
    );
    const left = { ...driver, options: { ...DEFAULT_RETARGET, plantsFeet: false } };
    expect(retargetText(left, skeleton, sliding)).toContain('Feet are not planted');
  });
});
