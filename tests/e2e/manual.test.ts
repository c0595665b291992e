/** The manual in the page, opened from the Help menu and by F1. Its pages alone are read in `offline.test.ts`. */
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { collectProblems, withPage } from '../helpers/page.ts';

const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);

describe('the manual', () => {
  it('the manual has the inspector’s place: from Help its contents, by F1 the page about the panel in use', () =>
    withPage(
      async ({ page, url }) => {
        await shown(page, 'post');
        await page.locator('.inspector .lil-gui').first().waitFor();
        const stage = () => page.locator('.stage').evaluate((one) => one.clientWidth);
        const before = await stage();
        await page.getByRole('menuitem', { name: 'Help', exact: true }).click();
        await page.getByRole('menuitem', { name: /^Manual/ }).click();
        const manual = page.getByRole('region', { name: 'Manual' });
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();
        const { x = 0, width = 0 } = (await manual.boundingBox()) ?? {};
        expect(x + width).toBe(1440);
        expect(width).toBeGreaterThan(390);
        expect(width).toBeLessThan(410);
        await page.locator('.inspector .lil-gui').first().waitFor({ state: 'hidden' });
        await expect.poll(stage).toBeGreaterThan(800);
        // Its links and pictures are its own, and there is a way back.
        await manual.getByRole('link', { name: 'Looking', exact: true }).click();
        await manual.getByRole('heading', { name: 'Looking', level: 1 }).waitFor();
        const isDrawn = () =>
          manual
            .locator('img')
            .first()
            .evaluate((one: HTMLImageElement) => one.naturalWidth > 0);
        await expect.poll(isDrawn).toBe(true);
        await manual.getByRole('button', { name: 'Previous page' }).click();
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();

        await page.getByRole('tree').first().focus();
        await page.keyboard.press('F1');
        await manual.getByRole('heading', { name: 'Looking', level: 1 }).waitFor();
        await page.getByRole('tab', { name: 'Dope sheet' }).click();
        await page.locator('.dope').first().hover();
        await page.keyboard.press('F1');
        const sheet = manual.getByRole('heading', { name: 'Dope sheet', level: 2 });
        await sheet.waitFor();
        // Its heading is at the top of what is read.
        const top = async () => ((await sheet.boundingBox())?.y ?? 0) - ((await manual.boundingBox())?.y ?? 0);
        await expect.poll(top).toBeLessThan(80);
        await page.evaluate(() => window.marrow.run('posing.ik'));
        await page.locator('canvas').first().hover();
        await page.keyboard.press('F1');
        await manual.getByRole('heading', { name: 'IK', level: 2 }).waitFor();

        await manual.getByRole('button', { name: 'Close manual' }).click();
        await page.locator('.inspector .lil-gui').first().waitFor();
        await expect.poll(stage).toBe(before);
        expect(page.context().pages().length).toBe(1);

        // Nothing behind a dialog can be read.
        await page.evaluate(() => window.marrow.run('help.programs'));
        await page.getByRole('dialog').waitFor();
        const [beside] = await Promise.all([page.waitForEvent('popup'), page.keyboard.press('F1')]);
        const problems: string[] = [];
        collectProblems(beside, url, problems);
        await beside.waitForURL('**/manual/guide/other-programs.html#which-program-opens-what');
        await page.getByRole('dialog').waitFor();
        expect(problems).toEqual([]);
      },
      { size: { width: 1440, height: 900 } },
    ));

  it('on a phone the manual is a sheet, and the inspector’s button closes it', () =>
    withPage(
      async ({ page }) => {
        await shown(page, 'post');
        await page.evaluate(() => window.marrow.run('help.manual'));
        const manual = page.getByRole('region', { name: 'Manual' });
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();
        const { y = 0, width = 0 } = (await manual.boundingBox()) ?? {};
        expect(width).toBe(390);
        expect(y / 844).toBeCloseTo(0.4, 1);
        await page.getByRole('button', { name: 'Inspector', exact: true }).tap();
        await manual.waitFor({ state: 'hidden' });
      },
      { size: { width: 390, height: 844 }, touch: true },
    ));
});
