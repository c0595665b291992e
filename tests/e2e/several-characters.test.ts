/** Two characters in the selection: their keys are dragged together in the dope sheet, and undone together. */
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';
import { ready, shown } from './checks/autosave.ts';

const sample = (name: string) => ({
  name,
  bytes: readFileSync(new URL(`../../public/samples/${name}`, import.meta.url)),
});
const FILES = ['walker.skel', 'walker_walk.anim', 'crawler.skel', 'crawler_walk.anim'].map(sample);
/** Seconds into its take at which the crawler starts. */
const OFFSET = 0.25;

const takes = (page: Page) =>
  page.evaluate(() => Promise.all(['walker_walk.anim', 'crawler_walk.anim'].map((name) => window.marrow.save(name))));
const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
/** Rows that are out of view are not in the page. */
async function pick(page: Page, name: string, modifiers: 'Control'[]): Promise<void> {
  const search = page.getByPlaceholder('Search outliner');
  await search.fill(name);
  await page.locator('.row-character').filter({ hasText: name }).click({ modifiers });
  await search.fill('');
}

async function box(page: Page, selector: string) {
  const found = await page.locator(selector).boundingBox();
  if (!found) throw new Error(`${selector} is not visible.`);
  return found;
}

async function drag(page: Page, from: readonly [number, number], to: readonly [number, number]): Promise<void> {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
  await page.mouse.move(...to, { steps: 3 });
  await page.mouse.up();
}

it('keys of two characters are selected by one box, dragged in one step, and undo gives back their files to the byte', () =>
  withPage(
    async ({ page }) => {
      await ready(page);
      await dropFiles(page, FILES);
      await shown(page, 'crawler');
      await page.evaluate((seconds) => {
        window.marrow.pause();
        const of = window.marrow.characters().find(({ name }) => name === 'crawler');
        window.marrow.run('character.setTimeOffset', { characterId: of?.id, seconds });
        window.marrow.run('page.tab.dope');
      }, OFFSET);
      await pick(page, 'walker', []);
      await pick(page, 'crawler', ['Control']);
      await page.getByRole('searchbox', { name: 'Filter rows by name' }).fill('root trans');
      await expect.poll(() => page.locator('.dope-row-character').count()).toBe(2);

      const before = await takes(page);
      const label = await undoLabel(page);
      const sheet = await box(page, '.dope-sheet');
      const last = await box(page, '.dope-space > .dope-row:last-child');
      await drag(page, [sheet.x + 5, sheet.y + 36], [sheet.x + sheet.width - 5, last.y + last.height + 6]);
      const selected = page.locator('.dope-row-character .dope-count.some');
      await expect.poll(() => selected.count()).toBe(2);

      // The bar of the selection.
      await drag(page, [sheet.x + 300, sheet.y + 4], [sheet.x + 340, sheet.y + 4]);
      await expect.poll(() => undoLabel(page)).toBe('Move keys of 2 characters');
      const moved = await takes(page);
      expect(moved.map((text, i) => text !== before[i])).toEqual([true, true]);

      await page.locator('.dope-sheet').focus();
      await page.keyboard.press('Control+z');
      await expect.poll(() => takes(page)).toEqual(before);
      await expect.poll(() => undoLabel(page)).toBe(label);
      await expect.poll(() => selected.count()).toBe(2);
    },
    { size: { width: 1280, height: 800 } },
  ));
