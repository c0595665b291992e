/** Phone and tablet: nothing overlaps, no number is without a name, nothing is cut, with each panel and without. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';

/** Faults of all controls that are in view: of each, the part that its scrollers show. */
const faults = (page: Page) =>
  page.evaluate(() => {
    const inView = (one: Element) => {
      let { left, top, right, bottom } = one.getBoundingClientRect();
      for (let around = one.parentElement; around; around = around.parentElement) {
        if (getComputedStyle(around).overflow === 'visible') continue;
        const box = around.getBoundingClientRect();
        [left, top] = [Math.max(left, box.left), Math.max(top, box.top)];
        [right, bottom] = [Math.min(right, box.right), Math.min(bottom, box.bottom)];
      }
      return { left, top, right, bottom };
    };
    const all = [...document.querySelectorAll<HTMLElement>('button, input, select, a[href], .tree, .scrubber')]
      // Those that look along an axis are over each other from some sides.
      .filter((one) => !one.closest('[aria-label="Look along an axis"]') && !one.closest('[inert]'))
      .filter((one) => one.checkVisibility({ visibilityProperty: true }) && one.offsetWidth > 1)
      .map((one) => ({ one, name: one.ariaLabel || one.textContent || one.className, box: inView(one) }))
      .filter(({ box }) => box.right - box.left > 1 && box.bottom - box.top > 1);
    const found: string[] = [];
    // A row that is scrolled shows more than a button of it.
    for (const { one } of all) {
      for (let around = one.parentElement; around; around = around.parentElement) {
        const isRow = getComputedStyle(around).overflowX === 'auto' && around.scrollWidth > around.clientWidth + 1;
        if (isRow && around.clientWidth < 120) found.push(`${around.className} shows ${around.clientWidth} pixels`);
      }
    }
    all.forEach(({ one, name, box }, i) => {
      const { left, right } = one.getBoundingClientRect();
      const isScrolled = one.closest('.timeline-tools, .timeline-head, [role=tablist], .lil-gui, .scrolls') !== null;
      if (!isScrolled && (right > innerWidth + 1 || left < -1)) found.push(`${name} is beyond the page`);
      if (one.localName === 'button' && !isScrolled && one.scrollWidth > one.clientWidth + 1)
        found.push(`${name} is cut`);
      for (const other of all.slice(i + 1)) {
        if (one.contains(other.one) || other.one.contains(one)) continue;
        const width = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left);
        const height = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
        if (width > 1 && height > 1) found.push(`${name} overlaps ${other.name}`);
      }
      if (
        one instanceof HTMLInputElement &&
        one.closest('.field') &&
        !one.closest<HTMLElement>('.field')?.innerText.trim()
      ) {
        found.push(`${name} has no visible name`);
      }
    });
    return found;
  });

const inPage = inOnePage({ size: { width: 390, height: 844 }, touch: true, walking: true, firstVisit: true });

inPage(
  'on a phone nothing of transport and ruler overlaps, and every number has a name or a unit',
  async ({ page }) => {
    await page.setViewportSize({ width: 390, height: 780 });
    await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
    const faults = () =>
      page.evaluate(() => {
        const all = [...document.querySelectorAll<HTMLElement>('.transport :is(button, input), .time-row > *')].filter(
          (one) => one.checkVisibility(),
        );
        const boxes = all.map((one) => one.getBoundingClientRect());
        const covered = boxes.flatMap((a, i) =>
          boxes.flatMap((b, j) => {
            const isOver = a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
            return j > i && isOver ? [`${all[i].ariaLabel} ${all[j].ariaLabel}`] : [];
          }),
        );
        const small = boxes.filter(({ width, height }) => width < 44 || height < 44).length;
        const unnamed = [...document.querySelectorAll<HTMLElement>('.times .field')].filter(
          (one) => !/[a-z]/i.test(one.innerText),
        );
        return {
          covered,
          beyond: boxes.filter(({ right }) => right > innerWidth).length,
          small,
          unnamed: unnamed.length,
        };
      });
    await expect.poll(faults).toEqual({ covered: [], beyond: 0, small: 0, unnamed: 0 });
  },
);

for (const [device, width, height] of [
  ['phone', 390, 844],
  ['small phone', 360, 640],
  ['tablet', 768, 1024],
] as const) {
  inPage(`on a ${device} nothing overlaps or is cut, and numbers have names`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
    const check = (message: string) => expect.poll(() => faults(page), { message }).toEqual([]);
    for (const id of ['posing.pose', 'posing.fk', 'posing.ik', 'posing.rig', 'help.firstAnimation']) {
      await page.evaluate((action) => window.marrow.run(action), id);
      await check(id);
    }
    // The panels are sheets: one at a time, up to 60 % of the page, above the bar that opens and closes them.
    const bar = page.getByRole('navigation', { name: 'Panels' });
    const sheets = [
      ['Joints', '.outliner'],
      ['Curves', '.timeline'],
      ['Takes', '.timeline'],
      ['Inspector', '.inspector'],
    ] as const;
    for (const [name, panel] of sheets) {
      await bar.getByRole('button', { name }).tap();
      await expect.poll(() => bar.locator('[aria-pressed=true]').allTextContents()).toEqual([name]);
      await page.locator(panel).waitFor();
      const top = await page.locator(panel).evaluate((sheet) => sheet.getBoundingClientRect().top);
      expect(top / height, name).toBeCloseTo(0.4, 1);
      await check(name);
    }
    await bar.getByRole('button', { name: 'Inspector' }).tap();
    await page.locator('.inspector').waitFor({ state: 'hidden' });
    await page.getByRole('button', { name: 'Play' }).waitFor();
    // What has no room in the bars is in their menus.
    await page.getByRole('button', { name: 'Show', exact: true }).tap();
    await page.getByRole('menuitem', { name: 'Camera' }).waitFor();
    const styles = page.getByRole('menuitem', { name: 'Skin: Textured' });
    await expect.poll(() => styles.count()).toBe(width < 480 ? 1 : 0);
    await page.keyboard.press('Escape');
    if (width > 600) return;
    await page.getByRole('button', { name: /^Mode: / }).tap();
    await page.getByRole('menuitemradio', { name: /^Inverse kinematics/ }).tap();
    await page.getByRole('button', { name: 'Mode: IK' }).waitFor();
  });
}
