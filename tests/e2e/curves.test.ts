/** The drawn curves against the evaluator. */
import { readAnim } from '../../src/formats/anim/read.ts';
import { testAll } from '../helpers/check.ts';
import { inOnePage } from '../helpers/one-page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { CURVES, drop, expectDrawn } from './checks/curves.ts';

const inPage = inOnePage();

testAll(CURVES, inPage);

describeShared('the sample animation of the course', () => {
  inPage('the sample animation of the course is drawn where the evaluator says', async ({ page }) => {
    const bytes = sharedBytes('data/cse169/sample.anim');
    await drop('sample.anim', bytes)(page);
    const take = readAnim(bytes, 'sample.anim').value;
    if (!take) throw new Error('sample.anim could not be read.');
    await expectDrawn(page, take);
  });
});
