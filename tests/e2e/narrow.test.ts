/** Phone and tablet: nothing overlaps, no number is without a name, nothing is cut. Real layout, in several states. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';

/** Faults of what is visible in the bars. */
const faults = (page: Page) =>
  page.evaluate(() => {
    const bars = '.menu-bar, .stage-head, .transport-row, .first-steps, .message-line, .guide';
    const all = [...document.querySelectorAll<HTMLElement>(bars)].flatMap((bar) => [
      ...bar.querySelectorAll<HTMLElement>('button, input, select'),
    ]);
    const seen = all.filter((one) => one.checkVisibility({ visibilityProperty: true }) && one.offsetWidth > 1);
    const name = (one: HTMLElement) => one.ariaLabel || one.textContent || one.className;
    const found: string[] = [];
    seen.forEach((a, i) => {
      const one = a.getBoundingClientRect();
      if (one.right > innerWidth + 1 || one.left < -1) found.push(`${name(a)} is beyond the page`);
      if (!(a instanceof HTMLInputElement) && a.scrollWidth > a.clientWidth + 1) found.push(`${name(a)} is cut`);
      for (const b of seen.slice(i + 1)) {
        if (a.contains(b) || b.contains(a)) continue;
        const other = b.getBoundingClientRect();
        const width = Math.min(one.right, other.right) - Math.max(one.left, other.left);
        const height = Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top);
        if (width > 1 && height > 1) found.push(`${name(a)} overlaps ${name(b)}`);
      }
      if (a instanceof HTMLInputElement && a.closest('.field') && !a.closest<HTMLElement>('.field')?.innerText.trim()) {
        found.push(`${name(a)} has no visible name`);
      }
    });
    return found;
  });

it.each([
  ['phone', 390, 780],
  ['tablet', 768, 1024],
] as const)('on a %s nothing overlaps or is cut, and numbers have names', (_, width, height) =>
  withPage(
    async ({ page }) => {
      await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
      for (const id of ['posing.pose', 'posing.fk', 'posing.ik', 'help.firstAnimation', 'page.tab.curves']) {
        await page.evaluate((action) => window.marrow.run(action), id);
        await expect.poll(() => faults(page), { message: id }).toEqual([]);
      }
      // What has no room in the bar is in its menu.
      await page.getByRole('button', { name: 'Show', exact: true }).tap();
      await page.getByRole('menuitem', { name: 'Camera' }).waitFor();
      const styles = page.getByRole('menuitem', { name: 'Skin: Textured' });
      await expect.poll(() => styles.count()).toBe(width < 480 ? 1 : 0);
    },
    { size: { width, height }, touch: true, walking: true, firstVisit: true },
  ),
);
