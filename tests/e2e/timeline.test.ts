/** One ruler for all plots, what is seen below it, and the share of the page that the viewport keeps. */
import type { Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import { GUTTER } from '../../src/ui/widgets/time/time-window.ts';
import { inOnePage } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const run = (page: Page, id: string) => page.evaluate((command) => window.marrow.run(command), id);
const time = (page: Page) =>
  page.evaluate(() => Number(document.querySelector('.scrubber')?.getAttribute('aria-valuenow')));
/** Names of the tabs that are seen. */
const seen = (page: Page) => page.locator('.timeline-tab[aria-selected=true]').allTextContents();
const box = async (page: Page, selector: string) => {
  const found = await page.locator(selector).boundingBox();
  if (!found) throw new Error(`${selector} has no place.`);
  return found;
};
const share = async (page: Page) => {
  const { width, height } = await box(page, '.stage .viewport canvas[role=application]');
  const { width: wide, height: high } = page.viewportSize() ?? { width: 1, height: 1 };
  return (width * height) / (wide * high);
};
const walks = (page: Page) => page.waitForFunction(() => window.marrow?.characters()[0]?.dofs.length === 93);

describe('the viewport', () => {
  const asNewcomer = inOnePage({ walking: true, firstVisit: true });

  for (const [width, height, least] of [
    [1440, 900, 0.55],
    [1024, 640, 0.45],
  ]) {
    asNewcomer(
      `has its share of ${width} × ${height} with a take, and nothing in the row below it is cut or overlaps`,
      async ({ page }) => {
        await page.setViewportSize({ width, height });
        await walks(page);
        await expect.poll(() => share(page)).toBeGreaterThanOrEqual(least);
        const faults = () =>
          page.locator('.transport-row').evaluate((row) => {
            const all = [...row.querySelectorAll<HTMLElement>('button, input')].filter((one) => one.checkVisibility());
            const boxes = all.map((one) => one.getBoundingClientRect());
            const cut = all.filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent);
            const covered = boxes.flatMap((a, i) =>
              boxes.flatMap((b, j) =>
                j > i && a.left < b.right - 0.5 && b.left < a.right - 0.5 ? [all[i].textContent] : [],
              ),
            );
            const beyond = boxes.filter(({ right }) => right > innerWidth).length;
            return { cut, covered, beyond };
          });
        await page.evaluate(() => window.marrow.seek(119.496));
        await expect.poll(faults).toEqual({ cut: [], covered: [], beyond: 0 });
      },
    );
  }

  asNewcomer('has nothing below it without a take, until one is begun or a tab is opened', async ({ page }) => {
    await page.setViewportSize({ width: 1440, height: 900 });
    await dropFiles(page, [{ name: 'post.skel', bytes: 'balljoint post { boxmin 0 0 0 boxmax 1 1 1 }' }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'post');
    await expect.poll(() => share(page)).toBeGreaterThanOrEqual(0.65);
    await run(page, 'page.tab.steps');
    await page.locator('.timeline').waitFor();
    await run(page, 'page.timeline');
    await page.locator('.timeline').waitFor({ state: 'hidden' });
    await page.getByRole('button', { name: 'New take', exact: true }).click();
    await page.locator('.scrubber').waitFor();
    await page.getByRole('button', { name: 'New take', exact: true }).waitFor({ state: 'hidden' });
  });
});

const inPage = inOnePage({ walking: true });

inPage(
  'the ruler, curves, dope sheet and charts have each time at the same place, and a press at its first pixel seeks 0',
  async ({ page }) => {
    await walks(page);
    await page.getByRole('treeitem', { name: /^upper_arm_l/ }).click();
    await page.locator('.curve-plot').waitFor();
    for (const [tab, plot] of [
      ['curves', '.curve-plot'],
      ['dope', '.dope-sheet'],
      ['measure', '.measure .time-chart'],
    ] as const) {
      await run(page, `page.tab.${tab}`);
      await page.locator(plot).waitFor();
      const apart = async () => {
        const [place, now] = [await box(page, plot), await box(page, '.scrubber')];
        return Math.max(Math.abs(place.x - now.x), Math.abs(place.width - now.width));
      };
      await expect.poll(apart, { message: tab }).toBeLessThanOrEqual(1);
    }
    await run(page, 'page.tab.curves');
    const ruler = await box(page, '.scrubber');
    await expect.poll(() => page.evaluate(() => window.marrow.placeOf(38, 0, 0)?.x)).toBeCloseTo(ruler.x + GUTTER, 0);
    await page.evaluate(() => window.marrow.seek(2));
    await page.mouse.click(ruler.x + GUTTER, ruler.y + 6);
    await expect.poll(() => time(page)).toBe(0);

    // One window: the wheel over a plot moves the ruler's times too.
    await page.mouse.move(ruler.x + 600, ruler.y + ruler.height + 60);
    await page.mouse.wheel(0, -300);
    await expect.poll(() => page.evaluate(() => window.marrow.placeOf(38, 0, 0)?.x)).toBeLessThan(ruler.x + GUTTER - 5);
    await page.mouse.click(ruler.x + 600, ruler.y + 6);
    // The press is heard with the next frame.
    await expect.poll(() => time(page)).toBeGreaterThan(0);
    const at = await time(page);
    await expect
      .poll(() => page.evaluate((t) => window.marrow.placeOf(38, t, 0)?.x ?? 0, at))
      .toBeGreaterThan(ruler.x + 600 - 30);
    await page.mouse.dblclick(ruler.x + 600, ruler.y + 6);
    await expect.poll(() => page.evaluate(() => window.marrow.placeOf(38, 0, 0)?.x)).toBeCloseTo(ruler.x + GUTTER, 0);
  },
);

inPage(
  'curve editor and dope sheet are seen together, other tabs replace both, and the last one folds; by mouse and by keys',
  async ({ page }) => {
    await page.setViewportSize({ width: 1440, height: 900 });
    await walks(page);
    await run(page, 'page.tab.curves');
    await page.getByRole('treeitem', { name: /^upper_arm_l/ }).click();
    await page.locator('.curve-plot').waitFor();
    await page.getByRole('tab', { name: 'Dope sheet' }).click();
    await page.locator('.dope-sheet').waitFor();
    await expect.poll(() => seen(page)).toEqual(['Curve editor', 'Dope sheet']);
    const [dope, curves] = [await box(page, '.dope-sheet'), await box(page, '.curve-plot')];
    expect(dope.y + dope.height).toBeLessThanOrEqual(curves.y + 1);
    expect([dope.x, dope.width]).toEqual([curves.x, curves.width]);

    // The splitter, by keys.
    const edge = page.getByRole('separator', { name: 'Height of the dope sheet' });
    await edge.focus();
    await page.keyboard.press('ArrowDown');
    await expect.poll(async () => (await box(page, '.dope-sheet')).height).toBeCloseTo(dope.height + 16, 0);

    // Keys are for the one that was worked in last.
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('Control+a');
    await expect.poll(() => page.locator('[id^=curves-selected]').textContent()).not.toBe('');

    await page.getByRole('tab', { name: 'Takes' }).click();
    await expect.poll(() => seen(page)).toEqual(['Takes']);
    // It has the focus once it is loaded, since it was clicked.
    await page.locator('[data-tab="takes"] :focus').waitFor();
    const tab = page.getByRole('tab', { name: 'Curve editor' });
    await tab.focus();
    await page.keyboard.press('Enter');
    await expect.poll(() => seen(page)).toEqual(['Curve editor']);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press(' ');
    await expect.poll(() => seen(page)).toEqual(['Curve editor', 'Dope sheet']);
    await page.keyboard.press(' ');
    await expect.poll(() => seen(page)).toEqual(['Curve editor']);
    await tab.click();
    await expect.poll(() => seen(page)).toEqual([]);
    await page.locator('.scrubber').waitFor();
    await page.locator('.curve-plot').waitFor({ state: 'hidden' });
    await page.setViewportSize({ width: 1280, height: 800 });
  },
);

inPage('at every width of a desk the curve editor’s tools, its numbers and the tabs are whole', async ({ page }) => {
  await walks(page);
  const beyond = (selector: string) =>
    page.locator(selector).evaluate((row) => Math.max(0, row.scrollWidth - row.clientWidth));
  // Before and after each group of tools, or of tabs, goes into a menu, which has the name of the open one.
  for (const width of [1024, 1100, 1106, 1190, 1198, 1256, 1280, 1304, 1440]) {
    await page.setViewportSize({ width, height: 800 });
    await expect.poll(() => page.evaluate(() => window.innerWidth)).toBe(width);
    for (const tab of ['measure', 'curves']) {
      await run(page, `page.tab.${tab}`);
      await expect.poll(() => beyond('.timeline-switches'), { message: `${tab} at ${width} pixels` }).toBe(0);
    }
    await page.locator('.curve-tools').waitFor();
    await expect.poll(() => beyond('.curve-tools'), { message: `${width} pixels` }).toBe(0);
  }
  await page.setViewportSize({ width: 1280, height: 800 });
});

inPage(
  'without a selection there are the curves of the root only, and it is said how to get others',
  async ({ page }) => {
    await walks(page);
    await run(page, 'page.tab.curves');
    await run(page, 'select.nothing');
    await page.getByText('Select a joint to edit its curves').waitFor();
    const joints = () => page.locator('.channel-row .channel-joint').allTextContents();
    await expect.poll(async () => [...new Set(await joints())].every((name) => name.startsWith('root'))).toBe(true);
    await page.getByRole('treeitem', { name: /^upper_arm_l/ }).click();
    await page.getByText('Select a joint to edit its curves').waitFor({ state: 'hidden' });
  },
);
