/** The display bar, and the one kind of menu that it, the menu bar and selects open. Real mouse and keyboard. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const TRIANGLE = `positions 3 { 0 0 0  1 0 0  0 1 0 }
normals 3 { 0 0 1  0 0 1  0 0 1 }
skinweights 3 { 1 0 1  1 0 1  1 0 1 }
triangles 1 { 0 1 2 }
bindings 1 { matrix { 1 0 0  0 1 0  0 0 1  0 0 0 } }
`;

const menuLabels = (page: Page) => page.locator('.menu .menu-label').allTextContents();

const inPage = inOnePage({ walking: true });

inPage(
  'the display bar has the styles that exist, all switches in one menu, and the camera in another',
  async ({ page }) => {
    const bar = page.getByRole('toolbar', { name: 'Display' });
    await bar.getByRole('button', { name: 'Skin: Textured' }).click();
    await expect.poll(() => menuLabels(page)).toContain('Textured');
    await page.keyboard.press('Escape');
    // No button of the bar is an icon alone.
    const texts = () => bar.getByRole('button').allInnerTexts();
    await expect.poll(texts).toEqual(['Textured', 'Show', 'Camera']);

    await bar.getByRole('button', { name: 'Show', exact: true }).click();
    await page.getByRole('menuitemcheckbox', { name: 'Grid' }).click();
    await bar.getByRole('button', { name: 'Show', exact: true }).click();
    const grid = page.getByRole('menuitemcheckbox', { name: 'Grid' });
    await expect.poll(() => grid.getAttribute('aria-checked')).toBe('false');
    await expect.poll(() => grid.locator('kbd').textContent()).toBe('G');
    await page.keyboard.press('Escape');

    await bar.getByRole('button', { name: 'Camera' }).click();
    const camera = await menuLabels(page);
    expect(camera).toEqual(
      expect.arrayContaining(['Frame selection', 'Front', 'Orthographic', 'Follow root', 'In place']),
    );
    await page.keyboard.press('Escape');
  },
);

inPage(
  'a skin without a texture is solid, a skeleton alone has boxes, and nothing at all has no styles',
  async ({ page }) => {
    const bar = page.getByRole('toolbar', { name: 'Display' });
    const texts = () => bar.getByRole('button').filter({ visible: true }).allInnerTexts();
    await dropFiles(page, [{ name: 'bare.skel', bytes: 'balljoint root { boxmin 0 0 0 boxmax 1 1 1 }' }]);
    await expect.poll(texts).toEqual(['Boxes', 'Show', 'Camera']);
    await dropFiles(page, [
      { name: 'bare.skel', bytes: 'balljoint root { }' },
      { name: 'bare.skin', bytes: TRIANGLE },
    ]);
    await expect.poll(texts).toEqual(['Solid', 'Show', 'Camera']);
    await bar.getByRole('button', { name: 'Skin: Solid' }).click();
    await expect.poll(() => menuLabels(page)).toContain('Wireframe');
    await expect.poll(() => menuLabels(page)).not.toContain('Textured');
  },
);

inPage('a select opens a menu of the page, by mouse and by keys, also in a dialog', async ({ page }) => {
  await page.evaluate(() => window.marrow.run('page.tab.curves'));
  const choice = page.getByRole('combobox', { name: 'Channels listed' });
  await choice.click();
  await page.getByRole('menuitemradio', { name: 'All channels' }).click();
  const chosen = (of: typeof choice) => of.evaluate((e: HTMLSelectElement) => e.selectedOptions[0]?.label);
  await expect.poll(() => chosen(choice)).toBe('All channels');
  // The focus stays where keys have a meaning.
  await expect.poll(() => choice.evaluate((e) => e === document.activeElement)).toBe(false);
  await choice.click();
  await choice.click();
  await expect.poll(() => page.getByRole('menu').count()).toBe(0);

  await choice.focus();
  await page.keyboard.press('Enter');
  const focused = () => page.evaluate(() => document.activeElement?.textContent?.trim());
  await expect.poll(focused).toBe('All channels');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await expect.poll(() => chosen(choice)).not.toBe('All channels');
  await expect.poll(() => choice.evaluate((e) => e === document.activeElement)).toBe(true);

  await page.evaluate(() => void window.marrow.run('save.video'));
  const dialog = page.getByRole('dialog');
  const format = dialog.getByLabel('Format');
  // They come once it is known what the browser can write.
  await expect.poll(() => format.locator('option').count()).toBeGreaterThan(0);
  await format.click();
  const last = page.getByRole('menuitemradio').last();
  const label = await last.innerText();
  // Escape closes the menu alone.
  await page.keyboard.press('Escape');
  await expect.poll(() => page.getByRole('menu').count()).toBe(0);
  await expect.poll(() => dialog.count()).toBe(1);
  await format.click();
  await last.click();
  await expect.poll(() => chosen(format)).toBe(label);
});
