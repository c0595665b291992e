/** Motion capture, parsed by the worker, in any browser. */
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { expectClose } from '../../helpers/close.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles } from '../../helpers/page.ts';

export const TAKE = `HIERARCHY
ROOT Hips
{
\tOFFSET 0 90 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Leg
\t{
\t\tOFFSET 0 -45 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0 -45 0
\t\t}
\t}
}
MOTION
Frames: 3
Frame Time: 0.1
0 90 0 0 0 0 0 0 0
5 90 0 10 20 30 0 15 0
10 90 0 0 0 0 90 0 0
`;

export const CAPTURE: readonly Check[] = [
  {
    name: 'opens a take, plays it between its frames, and writes the bytes that it read',
    async run({ page }) {
      await undoAll(page);
      await dropFiles(page, [{ name: 'step.bvh', bytes: TAKE }]);
      await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'step'));
      const ends = () =>
        page.evaluate(async () => {
          await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
          return window.marrow.endSites('step').map(({ position }) => position);
        });
      await page.evaluate(() => window.marrow.seek(0));
      expectClose((await ends()).flat(), [0, 0, 0], 1e-9);
      await page.evaluate(() => window.marrow.seek(0.2));
      expectClose((await ends()).flat(), [55, 45, 0], 1e-9);
      await expect.poll(() => page.evaluate(() => window.marrow.save('step.bvh'))).toBe(TAKE);
    },
  },
];
