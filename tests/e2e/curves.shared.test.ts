/** The drawn curves against the evaluator. */
import { it } from 'vitest';
import { readAnim } from '../../src/formats/anim/read.ts';
import { withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { drop, expectDrawn } from './checks/curves.ts';

describeShared('the sample animation of the course', () => {
  it('the sample animation of the course is drawn where the evaluator says', () =>
    withPage(async ({ page }) => {
      const bytes = sharedBytes('data/cse169/sample.anim');
      await drop('sample.anim', bytes)(page);
      const take = readAnim(bytes, 'sample.anim').value;
      if (!take) throw new Error('sample.anim could not be read.');
      await expectDrawn(page, take);
    }));
});
