/** Points are dropped, listed, scrubbed past what is missing, cropped, and saved as .trc. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { c3dOf, type PointFrame } from '../helpers/c3d.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const FRAMES = Array.from(
  { length: 20 },
  (_, f): PointFrame => [[100 + f, 1000, 3], f >= 5 && f < 10 ? null : [4, 500 + f, -6.5], [7, 20, f]],
);
const WALK = c3dOf({ labels: ['LASI', 'Left knee', 'LHEE'], frames: FRAMES });

const namesIn = (page: Page) => page.evaluate(() => window.marrow?.characters().map(({ name }) => name));
const placeOf = (page: Page, seconds: number) =>
  page.evaluate((time) => {
    window.marrow.seek(time);
    return window.marrow.worldMatrices()[0].slice(12, 15);
  }, seconds);

const inPage = inOnePage();

inPage(
  'points are listed with their positions, hidden where they are missing, cropped, and saved as .trc',
  async ({ page, download }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.c3d', bytes: WALK }]);
    await expect.poll(() => namesIn(page)).toEqual(['walk']);
    await expect.poll(() => placeOf(page, 0.1)).toEqual([110, 1000, 3]);
    await page.getByRole('treeitem', { name: /^Points/ }).waitFor();
    await page.getByRole('treeitem', { name: /^Left knee/ }).click();
    const details = page.locator('.facts');
    await expect.poll(() => details.textContent()).toContain('510.000');
    await expect.poll(() => placeOf(page, 0.07)).toEqual([107, 1000, 3]);
    await expect.poll(() => details.textContent()).toContain('missing in this frame');

    await page.evaluate(() => {
      Reflect.deleteProperty(window, 'showSaveFilePicker');
      return window.marrow.run('samples.crop', { from: 0.04, to: 0.06 });
    });
    const saved = await download(() => page.evaluate(() => window.marrow.run('save.trc')));
    expect(saved.name).toBe('walk.trc');
    expect(saved.text.split('\n').slice(3, 9)).toEqual([
      'Frame#\tTime\tLASI\t\t\tLeft knee\t\t\tLHEE\t\t',
      '\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3',
      '',
      '1\t0\t104\t1000\t3\t4\t504\t-6.5\t7\t20\t4',
      '2\t0.01\t105\t1000\t3\t\t\t\t7\t20\t5',
      '3\t0.02\t106\t1000\t3\t\t\t\t7\t20\t6',
    ]);

    const refused = await page.evaluate(async () => {
      try {
        await window.marrow.run('save.bvh');
        return 'saved';
      } catch (error) {
        return String(error);
      }
    });
    expect(refused).toContain('not available');
  },
);

inPage('a table of points is a take, and another one is compared', async ({ page }) => {
  await startOver(page);
  await dropFiles(page, [{ name: 'rows.csv', bytes: 'time,a.x,a.y,a.z\n0,1,2,3\n0.5,2,2,3\n' }]);
  await expect.poll(() => namesIn(page)).toEqual(['rows']);
  await dropFiles(page, [{ name: 'numbers.csv', bytes: '1,2,3\n' }]);
  await expect.poll(() => page.locator('.compare').count()).toBeGreaterThan(0);
});
