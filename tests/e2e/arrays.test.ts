/** Arrays of numpy are dropped, played, taken out of zips, and reviewed by the hundred. */
import { zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { type MadeArray, npyOf, npzOf } from '../helpers/numpy.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const FRAMES = 12;

function wave(...shape: readonly number[]): MadeArray {
  const count = shape.reduce((product, n) => product * n, 1);
  return [shape, Float32Array.from({ length: count }, (_, i) => 0.3 * Math.sin(i))];
}

/** A body that walks off, as AMASS has it. */
const WALK = npzOf({ poses: wave(FRAMES, 156), trans: wave(FRAMES, 3), mocap_framerate: [[], Float64Array.of(20)] });

const namesIn = (page: Page) => page.evaluate(() => window.marrow?.characters().map(({ name }) => name));
const rootAt = (page: Page, seconds: number) =>
  page.evaluate((time) => {
    window.marrow.seek(time);
    return window.marrow.worldMatrices()[0].slice(12, 15);
  }, seconds);

const inPage = inOnePage();

inPage('arrays of numpy are played, and taken out of zips; a broken one changes nothing', async ({ page }) => {
  await startOver(page);
  await dropFiles(page, [{ name: 'walk.npz', bytes: WALK }]);
  await expect.poll(() => namesIn(page)).toEqual(['walk']);
  const [first, later] = [await rootAt(page, 0), await rootAt(page, 0.3)];
  expect(later).not.toEqual(first);

  await dropFiles(page, [
    { name: 'more.zip', bytes: zipSync({ 'a/people.npy': npyOf(wave(FRAMES, 17, 3)), 'a/again.npz': WALK }) },
  ]);
  await expect.poll(() => namesIn(page)).toEqual(expect.arrayContaining(['walk', 'people', 'again']));

  await dropFiles(page, [{ name: 'weights.npz', bytes: npzOf({ weights: wave(2, 5) }) }]);
  await expect.poll(() => page.getByText(/Found weights \(2, 5\)/).count()).toBeGreaterThan(0);
  await expect.poll(() => namesIn(page).then((names) => names?.length)).toBe(3);
});

inPage('a folder of arrays is reviewed', async ({ page }) => {
  await startOver(page);
  await dropFiles(
    page,
    Array.from({ length: 24 }, (_, i) => ({ name: `take${i + 1}.npz`, bytes: WALK })),
  );
  await expect.poll(() => page.locator('.review-count').textContent()).toBe('24 takes');
  const row = page.getByRole('grid', { name: 'Takes in review' }).getByRole('row').filter({ hasText: 'take2' });
  await expect.poll(() => row.first().textContent()).toContain('12');
});
