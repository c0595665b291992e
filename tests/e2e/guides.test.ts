/**
 * Guided first steps: they tick themselves off by what is done, by real mouse and keyboard. And the dialog of shortcuts:
 * essentials first, search by name and by pressing a key, groups.
 */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const guide = (page: Page, name: string) => page.getByRole('region', { name });
const next = (page: Page, name: string) => guide(page, name).locator('[aria-current=step] b').textContent();

const inPage = inOnePage({ walking: true });

inPage('the first animation is followed from playing to curves', async ({ page }) => {
  await startOver(page);
  const name = 'First animation';
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  // As a newcomer has it.
  await page.evaluate(() => window.marrow.run('page.timeline'));
  await page.getByRole('menuitem', { name: 'Help' }).click();
  await page.getByRole('menuitem', { name: /^First animation/ }).click();
  await expect.poll(() => next(page, name)).toBe('Drag a hand up');
  const drag = async (dx: number, dy: number) => {
    const world = await page.evaluate(() => window.marrow.worldMatrices());
    // The outliner shows only some of them.
    const text = await page.evaluate(() => window.marrow.save('walker.skel'));
    const names: readonly string[] = text.match(/(?<=\w+joint )\w+/g) ?? [];
    const [x, y, z] = (world[names.indexOf('hand_r')] ?? []).slice(12, 15);
    const at = await page.evaluate((point) => window.marrow.pointOnPage(point), [x, y, z] as [number, number, number]);
    if (!at) throw new Error('The hand is out of view.');
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    for (let i = 1; i <= 6; i++) await page.mouse.move(at.x + (i * dx) / 6, at.y + (i * dy) / 6);
    await page.mouse.up();
  };
  await drag(-20, -60);
  await expect.poll(() => next(page, name)).toBe('Key it');
  await page.keyboard.press('k');
  // A cycle may be asked about: bake its repeats.
  const asked = page.getByRole('dialog');
  await expect.poll(async () => (await asked.count()) + ((await next(page, name)) === 'Move on' ? 1 : 0)).toBe(1);
  if ((await asked.count()) > 0) await page.keyboard.press('Enter');
  await expect.poll(() => next(page, name)).toBe('Move on');
  for (let i = 0; i < 3; i++) await page.keyboard.press('ArrowRight');
  await expect.poll(() => next(page, name)).toBe('Pose and key again:');
  await drag(-20, 40);
  await page.keyboard.press('k');
  if ((await asked.count()) > 0) await page.keyboard.press('Enter');
  await expect.poll(() => next(page, name)).toBe('See its curves');
  await guide(page, name).getByRole('button', { name: 'Curve editor' }).click();
  await expect.poll(() => next(page, name)).toBe('Save');
});

inPage('checking a program is followed from the character to the corrected numbers', async ({ page }) => {
  await startOver(page);
  const name = 'Check your program';
  await page.evaluate(() => window.marrow.run('help.checkProgram'));
  await expect.poll(() => next(page, name)).toBe('Open the character');
  await dropFiles(page, [{ name: 'own.skel', bytes: 'balljoint a { balljoint b { offset 0 1 0 } }' }]);
  await expect.poll(() => next(page, name)).toBe('Print your numbers:');
  await guide(page, name).getByRole('button', { name: 'Compare' }).click();
  await expect.poll(() => next(page, name)).toBe('Drop the file here,');
  await dropFiles(page, [
    { name: 'mine.txt', bytes: '1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0 0 2 0 1\n' },
  ]);
  await expect.poll(() => next(page, name)).toBe('Click a joint');
  // It covers neither what was found, beside it or above it, nor the choice of what is drawn.
  const isClear = async () => {
    const boxes = [guide(page, name), page.locator('.compare-banner'), page.locator('.compare-choices')];
    const [card, found, choices] = await Promise.all(boxes.map((each) => each.boundingBox()));
    if (!card || !found || !choices) return false;
    const isBeside = card.x + card.width <= found.x || card.y + card.height <= found.y;
    return isBeside && choices.y + choices.height <= card.y;
  };
  await expect.poll(isClear).toBe(true);
  const size = page.viewportSize();
  await page.setViewportSize({ width: 760, height: 720 });
  await expect.poll(isClear).toBe(true);
  if (size) await page.setViewportSize(size);
  await page.getByRole('treeitem', { name: /^b/ }).click();
  await expect.poll(() => next(page, name)).toBe('Correct your program,');
  await dropFiles(page, [
    { name: 'mine.txt', bytes: '1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0 0 1 0 1\n' },
  ]);
  await guide(page, name).getByText('Done.').waitFor();
  await guide(page, name).getByRole('button', { name: 'Close Check your program' }).click();
  await expect.poll(() => guide(page, name).count()).toBe(0);
});

inPage(
  'shortcuts show the essentials first, and are found by name, by pressing a key, or by group',
  async ({ page }) => {
    await startOver(page);
    await page.keyboard.press('?');
    const dialog = page.getByRole('dialog', { name: 'Shortcuts' });
    const field = dialog.getByRole('searchbox');
    const lines = () => dialog.locator('.shortcut-line > :first-child').allTextContents();
    await expect.poll(() => dialog.getByRole('tab', { selected: true }).textContent()).toBe('Essentials 23');
    await expect.poll(async () => (await lines()).length).toBe(23);

    // The field has the focus: whoever presses ? types on.
    await page.keyboard.press('Control+z');
    await expect.poll(() => field.inputValue()).toBe('Ctrl+Z');
    await expect.poll(lines).toEqual(['Undo']);
    await page.keyboard.press('Space');
    await expect.poll(lines).toEqual(['Play or pause']);
    await page.keyboard.press('k');
    await expect.poll(lines).toEqual(['Key changes (or the selected joints)']);
    // A second character begins a name.
    await page.keyboard.type('ey whole');
    await expect.poll(() => field.inputValue()).toBe('key whole');
    await expect.poll(async () => (await lines())[0]).toBe('Key whole pose');
    await page.keyboard.type(' nonsense');
    await dialog.getByText('No shortcut has this name').waitFor();

    await dialog.getByRole('tab', { name: /^Keys/ }).click();
    await expect.poll(() => field.inputValue()).toBe('');
    await expect.poll(lines).toContain('Delete selected keys');
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => dialog.getByRole('tab', { selected: true }).textContent()).toMatch(/^Curves/);
    // Nothing is beside the page that scrolls.
    const beyond = () => dialog.locator('.shortcut-shown').evaluate((one) => one.scrollWidth - one.clientWidth);
    await expect.poll(beyond).toBe(0);
    await dialog.getByRole('tab', { name: /^Mouse and touch/ }).click();
    await expect.poll(lines).toContain('Orbit');
    await page.keyboard.press('Escape');
    await expect.poll(() => dialog.count()).toBe(0);
  },
);
