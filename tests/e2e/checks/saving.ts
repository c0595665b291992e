/** Saving by download, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { dropFiles } from '../../helpers/page.ts';

export const SKEL = `balljoint root {
	offset 0 1 0
	balljoint tip {
		offset 0 1 0
	}
}
`;
const key = (time: number, value: number) => `\t\t\t${time} ${value} smooth smooth\n`;
const channel = (value: number) =>
  `\tchannel {\n\t\textrapolate cycle cycle\n\t\tkeys 2 {\n${key(0, 0)}${key(2, value)}\t\t}\n\t}\n`;
export const anim = (value: number) =>
  `animation {\n\trange 0 2\n\tnumchannels 9\n${new Array(9).fill(channel(value)).join('')}}\n`;
export const HERO = [
  { name: 'hero.skel', bytes: SKEL },
  { name: 'hero_walk.anim', bytes: anim(0.5) },
];

/** Browsers without dialogs for files: they download. */
export function noDisk(): void {
  delete window.showOpenFilePicker;
  delete window.showSaveFilePicker;
}

export const shown = (page: Page, name = 'hero') =>
  page.waitForFunction((n) => window.marrow?.characters().some((c) => c.name === n), name);
export const titled = (page: Page, title: string) => page.waitForFunction((wanted) => document.title === wanted, title);
export const setRange = (page: Page, end: number) =>
  page.evaluate((seconds) => window.marrow.run('take.setRange', { range: [0, seconds] }), end);
export const firstName = async (page: Page) => {
  await page.waitForFunction(() => (window.marrow?.characters().length ?? 0) > 0);
  return page.evaluate(() => window.marrow.characters()[0].name);
};

export const BY_DOWNLOAD: readonly Check[] = [
  {
    name: 'saves as a download',
    options: { before: noDisk },
    async run({ page, download }) {
      await firstName(page);
      await dropFiles(page, HERO);
      await shown(page);
      await setRange(page, 3);
      const { name, text } = await download(() => page.keyboard.press('Control+s'));
      expect(name).toBe('hero_walk.anim');
      expect(text).toContain('range 0 3');
      await titled(page, 'Marrow');
      // What the file has and loses is told before it is saved.
      await page.evaluate(() => window.marrow.run('save.glb'));
      const save = page.locator('.exchange-dialog button[type=submit]');
      await expect.poll(() => save.isEnabled(), { timeout: 20_000 }).toBe(true);
      await expect.poll(() => page.locator('.exchange-dialog').textContent()).toMatch(/2 joints.*hero_walk: \d+ keys/s);
      const glb = await download(() => save.click());
      expect(glb.name).toBe('hero.glb');
      expect(glb.text.slice(0, 4)).toBe('glTF');
      // The same dialog serves FBX, without what means nothing there.
      await page.evaluate(() => window.marrow.run('save.fbx'));
      await expect.poll(() => page.locator('.exchange-dialog h2').textContent()).toBe('Save as FBX');
      await expect.poll(() => save.isEnabled(), { timeout: 20_000 }).toBe(true);
      const fbx = await download(() => save.click());
      expect(fbx.name).toBe('hero.fbx');
      expect(fbx.text.slice(0, 18)).toBe('Kaydara FBX Binary');
      // No humanoid has two joints: the bones that are missing are named.
      await page.evaluate(() => window.marrow.run('save.vrma'));
      await expect.poll(() => page.locator('.exchange-dialog').textContent()).toMatch(/has none for .*leftHand/);
      await expect.poll(() => save.isEnabled()).toBe(false);
      await page.keyboard.press('Escape');
    },
  },
];
