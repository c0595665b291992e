/** Blocking and values between keys, with keys and mouse: auto tangents, steps, the stepped preview, the tween bar. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';

const ARM = { joint: 'upper_arm_l', rz: 38 } as const;

const keys = (page: Page) => page.evaluate((channel) => window.marrow.keys(channel), ARM.rz);
const arm = (page: Page) => page.evaluate((dof) => window.marrow.characters()[0].dofs[dof], ARM.rz);
const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);

async function openWalker(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await page.evaluate(() => window.marrow.seek(0));
  await page.getByRole('treeitem', { name: new RegExp(`^${ARM.joint}`) }).click();
  await page.getByRole('textbox', { name: /^rx\b/ }).first().waitFor();
}

it('5 makes selected keys auto and 6 makes them steps, each as one step, and undo brings all back', () =>
  withPage(
    async ({ page }) => {
      await openWalker(page);
      const before = await keys(page);
      await page.locator('.curve-plot').focus();
      await page.keyboard.press('Control+a');
      await page.keyboard.press('5');
      await expect.poll(() => keys(page).then((all) => all.every((key) => key.tangentIn === 'auto'))).toBe(true);
      await page.keyboard.press('6');
      await expect.poll(() => keys(page).then((all) => all.length)).toBe(2 * before.length - 1);
      await page.keyboard.press('5');
      await expect.poll(() => keys(page).then((all) => all.length)).toBe(before.length);
      for (let step = 0; step < 3; step++) await page.keyboard.press('Control+z');
      await expect.poll(() => keys(page)).toEqual(before);
    },
    { walking: true },
  ));

it('the stepped preview holds each pose up to the next key, and changes nothing else', () =>
  withPage(
    async ({ page }) => {
      await openWalker(page);
      const [first, second] = await keys(page);
      const label = await undoLabel(page);
      await page.evaluate((time) => window.marrow.seek(time), (first.time + second.time) / 2);
      await page.evaluate(() => window.marrow.run('view.steppedPreview', { on: true }));
      await expect.poll(() => arm(page)).toBeCloseTo(first.value, 9);
      await page.evaluate(() => window.marrow.run('view.steppedPreview', { on: false }));
      await expect.poll(() => arm(page)).not.toBeCloseTo(first.value, 3);
      const labelNow = await undoLabel(page);
      expect(labelNow).toBe(label);
    },
    { walking: true },
  ));

it('the bar takes no room until its key is pressed; a number, a button and a drag are a step each', () =>
  withPage(
    async ({ page }) => {
      await openWalker(page);
      const [first, second] = await keys(page);
      await page.evaluate((time) => window.marrow.seek(time), (first.time + second.time) / 2);
      const bar = page.locator('.tween-bar');
      await expect.poll(() => bar.count()).toBe(0);
      await page.keyboard.press('Shift+W');
      await bar.waitFor();
      await expect.poll(() => page.getByText('nothing to change').count()).toBe(0);
      await page.keyboard.type('0.25');
      await page.keyboard.press('Enter');
      await expect.poll(() => arm(page)).toBeCloseTo(first.value + 0.25 * (second.value - first.value), 9);
      await expect.poll(() => undoLabel(page)).toMatch(/^Tween upper_arm_l/);
      await bar.getByRole('button', { name: '1', exact: true }).click();
      await expect.poll(() => arm(page)).toBeCloseTo(second.value, 9);
      const slider = await bar.locator('.tween-slider').boundingBox();
      if (!slider) throw new Error('The slider has no place.');
      const at = (share: number) => [slider.x + share * slider.width, slider.y + slider.height / 2] as const;
      await page.mouse.move(...at(0.5));
      await page.mouse.down();
      await page.mouse.move(...at(0.3), { steps: 4 });
      await page.mouse.move(...at(0.02), { steps: 4 });
      await page.mouse.up();
      const reach = second.value - first.value;
      await expect.poll(async () => ((await arm(page)) - first.value) / reach).toBeLessThan(0);
      await page.keyboard.press('Control+z');
      await expect.poll(() => arm(page)).toBeCloseTo(second.value, 9);
      await page.keyboard.press('Escape');
      await expect.poll(() => bar.isVisible()).toBe(false);
    },
    { walking: true },
  ));
