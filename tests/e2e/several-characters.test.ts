/**
 * A sword in a walker's hand, as someone works with it: attached by the dialog, put down, and saved. And two characters
 * in the selection: their keys are dragged together in the dope sheet, and undone together.
 */
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { shown } from './checks/autosave.ts';

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

const inPage = inOnePage();

const SWORD = `balljoint hilt {
	offset 0.45 0.02 0.3
	boxmin -0.02 -0.02 -0.08
	boxmax 0.02 0.02 0.7
}
`;
const WALKER = ['walker.skel', 'walker.skin', 'walker_walk.anim'].map(sample);
const seek = (page: Page, time: number) =>
  page.evaluate((seconds) => {
    window.marrow.pause();
    window.marrow.seek(seconds);
  }, time);
const matrix = (page: Page, name: string, joint: string) =>
  page.evaluate(
    ([of, wanted]) => {
      const { joints } = window.marrow.characters().find((one) => one.name === of) ?? { joints: [] };
      return window.marrow.worldMatrices(of)[joints.findIndex((one) => one.name === wanted)];
    },
    [name, joint] as const,
  );
const sword = (page: Page) => page.getByRole('treeitem').filter({ hasText: 'follows walker' });
/** Rows that are out of view are not in the page. */
async function topRows(page: Page): Promise<void> {
  await page.getByRole('tree').evaluate((tree) => tree.scrollTo(0, 0));
}

/** Where the sword's root is in the space of the hand. */
async function inHand(page: Page, time: number): Promise<readonly number[]> {
  await seek(page, time);
  const [hand, hilt] = [await matrix(page, 'walker', 'hand_r'), await matrix(page, 'sword', 'hilt')];
  const from = [12, 13, 14].map((k) => hilt[k] - hand[k]);
  return [0, 4, 8].map((c) => from[0] * hand[c] + from[1] * hand[c + 1] + from[2] * hand[c + 2]);
}

async function clickHand(page: Page): Promise<void> {
  const [x, y, z] = (await matrix(page, 'walker', 'hand_r')).slice(12);
  const at = await page.evaluate((point) => window.marrow.pointOnPage(point, 'walker'), [x - 0.08, y, z] as const);
  if (!at) throw new Error('The hand is not seen.');
  await page.mouse.click(at.x, at.y);
  await page.getByRole('treeitem', { name: /^hand_r/, selected: true }).waitFor();
}

async function openBoth(page: Page): Promise<void> {
  await startOver(page);
  await dropFiles(page, [...WALKER, { name: 'sword.skel', bytes: Buffer.from(SWORD) }]);
  await shown(page, 'sword');
}

inPage(
  'a sword is attached to the selected hand, follows it, is put down, and stays when its walker goes',
  async ({ page }) => {
    await openBoth(page);
    await seek(page, 0.5);
    const lies = await matrix(page, 'sword', 'hilt');
    await clickHand(page);
    await page.evaluate(() => window.marrow.run('character.attach'));
    const dialog = page.getByRole('dialog', { name: 'Attach to…' });
    await dialog.getByText(/^sword follows hand_r of walker from 0.5 s/).waitFor();
    await dialog.getByRole('button', { name: 'Apply' }).click();
    await expect.poll(() => undoLabel(page)).toBe('Attach sword to hand_r');
    await topRows(page);
    await sword(page).waitFor();
    const held = await inHand(page, 0.5);
    for (const time of [0.9, 1.4]) {
      const at = await inHand(page, time);
      at.forEach((value, k) => {
        expect(value).toBeCloseTo(held[k], 9);
      });
    }
    const moved = await matrix(page, 'sword', 'hilt');
    expect(moved[13]).not.toBeCloseTo(lies[13], 3);

    await seek(page, 1.4);
    const before = await matrix(page, 'sword', 'hilt');
    await sword(page).click();
    await sword(page).click({ button: 'right' });
    await page.getByRole('menuitem', { name: 'Put down' }).click();
    await expect.poll(() => undoLabel(page)).toBe('Put down sword');
    await seek(page, 2.5);
    const after = await matrix(page, 'sword', 'hilt');
    after.forEach((value, k) => {
      expect(value).toBeCloseTo(before[k], 9);
    });
    await page.getByRole('tab', { name: 'Dope sheet' }).click();
    await page.getByText('Follows hand_r of walker').waitFor();
    await page.getByRole('tab', { name: 'Dope sheet' }).click();

    const json = await page.evaluate(async () => JSON.parse(await window.marrow.save('sword_anim.attach.json')));
    expect(json).toMatchObject({ attached: [{ character: 'walker', joint: 'hand_r', span: [0.5, 1.4] }] });
    const again = await inHand(page, 1.2);
    again.forEach((value, k) => {
      expect(value).toBeCloseTo(held[k], 9);
    });
    // Removed, it leaves the sword as it moved with it.
    const last = await matrix(page, 'sword', 'hilt');
    await clickHand(page);
    await page.evaluate(() => window.marrow.run('character.remove'));
    await expect.poll(() => page.evaluate(() => window.marrow.characters().length)).toBe(1);
    const left = await matrix(page, 'sword', 'hilt');
    expect(left).toEqual(last);
  },
);

inPage(
  'keys of two characters are selected by one box, dragged in one step, and undo gives back their files to the byte',
  async ({ page }) => {
    await startOver(page);
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
);
