/** Deep trees in the outliner: real layout and real clicks. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

/** A chain of joints with long names. */
function chain(joints: number): string {
  const open = Array.from({ length: joints }, (_, i) => `balljoint tentacle_segment_left_${i} { offset 0 0.1 0\n`);
  return `${open.join('')}${'}'.repeat(joints)}`;
}

/** Rows in view, with their middles, and how far their names are within the panel. */
const inView = (page: Page) =>
  page.locator('.tree').evaluate((list) => {
    const panel = list.getBoundingClientRect();
    return [...list.querySelectorAll<HTMLElement>('.row-joint')].flatMap((row) => {
      const { top, bottom, width } = row.getBoundingClientRect();
      const label = row.querySelector('.label');
      const name = label?.getBoundingClientRect();
      if (!label || !name || top < panel.top || bottom > panel.bottom) return [];
      const middle = { x: panel.left + width / 2, y: (top + bottom) / 2 };
      return [
        { name: label.ariaLabel, isOpen: row.ariaExpanded, middle, width: name.width, room: panel.right - name.right },
      ];
    });
  });

const inPage = inOnePage();

for (const joints of [12, 40]) {
  inPage(
    `of ${joints} joints in a chain each is selected by a click into the middle of its row, and no name is beyond the panel`,
    async ({ page }) => {
      await startOver(page);
      await dropFiles(page, [{ name: 'tentacle.skel', bytes: chain(joints) }]);
      const tree = page.locator('.tree');
      const last = tree.locator(`[aria-label=tentacle_segment_left_${joints - 1}]`);
      await tree.focus();
      const opensOneMore = async () => {
        await page.keyboard.press('ArrowRight');
        return last.count();
      };
      await expect.poll(opensOneMore, { timeout: 30_000, interval: 0 }).toBe(1);
      await expect.poll(async () => (await inView(page)).length).toBeGreaterThan(6);
      const rows = await inView(page);
      for (const { name, isOpen, middle, width, room } of rows) {
        expect(room, `pixels from ${name} to the edge`).toBeGreaterThanOrEqual(0);
        expect(width, `pixels of ${name}`).toBeGreaterThan(40);
        await page.mouse.click(middle.x, middle.y);
        await expect.poll(() => tree.locator('[aria-selected=true] .label').getAttribute('aria-label')).toBe(name);
        await expect.poll(async () => (await inView(page)).find((row) => row.name === name)?.isOpen).toBe(isOpen);
      }
      await expect.poll(() => tree.evaluate((list) => list.scrollWidth - list.clientWidth)).toBe(0);
    },
  );
}
