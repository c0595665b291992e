/** Fingers on a phone: pinches, swipes through menus, and that dialogs and compared takes fit. One page for all. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

const WIDTH = 390;

const SKEL = `balljoint shoulder {
  boxmin -0.3 0 -0.3 boxmax 0.3 0.8 0.3
  balljoint elbow { offset 0 0.8 0 boxmin -0.3 0 -0.3 boxmax 0.3 0.8 0.3 }
}
`;
/** Of another rotation of the shoulder; the second is half as long. */
const anim = (angle: number, seconds: number) => `animation {
  range 0 ${seconds}
  numchannels 9
  ${`channel { extrapolate constant constant keys 1 { 0 0 flat flat } }\n`.repeat(3)}
  channel { extrapolate constant constant keys 2 { 0 0 smooth smooth ${seconds} ${angle} smooth smooth } }
  ${`channel { extrapolate constant constant keys 1 { 0 0 flat flat } }\n`.repeat(5)}
}
`;
const FILES = [
  { name: 'first.skel', bytes: SKEL },
  { name: 'first.anim', bytes: anim(0.4, 2) },
  { name: 'second.skel', bytes: SKEL.replaceAll('0.8', '0.6') },
  { name: 'second.anim', bytes: anim(0.8, 1) },
];

type Point = readonly [x: number, y: number];

/** Fingers are told apart by their place in the list. */
async function fingers(page: Page) {
  const cdp = await page.context().newCDPSession(page);
  return (type: 'touchStart' | 'touchMove' | 'touchEnd' | 'touchCancel', ...points: Point[]) =>
    cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
}

const run = (page: Page, id: string) => page.evaluate((command) => window.marrow.run(command), id);

/** What a pinch may not change, and the length of a bone in pixels, which it does. */
const scene = (page: Page) =>
  page.evaluate(() => {
    const from = window.marrow.pointOnPage([0, 0.2, 0], 'first');
    const to = window.marrow.pointOnPage([0, 0.6, 0], 'first');
    if (!from || !to) throw new Error('The arm is out of view.');
    const kept = [window.marrow.worldMatrices('first'), window.marrow.pins('first'), window.marrow.steps()];
    return { kept, from, to, length: Math.hypot(to.x - from.x, to.y - from.y) };
  });

it('a pinch on a character zooms in every mode, a swipe scrolls a menu, and dialogs and compared takes fit a phone', () =>
  withPage(
    async ({ page }) => {
      await dropFiles(page, FILES);
      await page.locator('[role=treeitem]', { hasText: 'second' }).first().waitFor({ state: 'attached' });
      const touch = await fingers(page);
      for (const [mode, name] of [
        ['posing.ik', 'IK'],
        ['posing.rig', 'Rig'],
        ['posing.fk', 'FK'],
      ] as const) {
        await run(page, mode);
        await page.getByRole('button', { name: `Mode: ${name}` }).waitFor();
        const before = await scene(page);
        const { from, to } = before;
        await touch('touchStart', [from.x, from.y]);
        await touch('touchStart', [from.x, from.y], [to.x, to.y]);
        for (let i = 1; i <= 5; i++) await touch('touchMove', [from.x, from.y + 2 * i], [to.x, to.y - 2 * i]);
        await touch('touchEnd');
        const growth = async () => (await scene(page)).length / before.length;
        await expect.poll(growth, { message: mode }).toBeGreaterThan(1.1);
        await expect.poll(async () => (await scene(page)).kept, { message: mode }).toEqual(before.kept);
        // The next frame frames.
        await run(page, 'view.frameAll');
        await expect.poll(growth, { message: mode }).toBeLessThan(1.05);
      }

      await page.getByRole('button', { name: 'Menu' }).tap();
      await page.getByRole('menuitem', { name: 'View', exact: true }).tap();
      const gizmo = page.getByRole('menuitem', { name: 'Gizmo' });
      const start = await gizmo.boundingBox();
      if (!start) throw new Error('The menu has no entry for the gizmo.');
      await touch('touchStart', [start.x + 40, start.y + 20]);
      for (let i = 1; i <= 8; i++) await touch('touchMove', [start.x + 40, start.y + 20 - 20 * i]);
      await touch('touchEnd');
      await expect.poll(async () => (await gizmo.boundingBox())?.y).toBeLessThan(start.y - 40);
      await expect.poll(() => page.getByRole('menu').count()).toBe(2);
      await expect.poll(() => page.locator('.menu kbd:visible').count()).toBe(0);
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');

      await run(page, 'retarget.open');
      const beyond = () =>
        page.locator('.retarget-dialog :is(button, select, input, p)').evaluateAll((all) =>
          all
            .filter((one) => one.checkVisibility() && !one.closest('.pairs-scroll'))
            .map((one) => ({ name: one.textContent, box: one.getBoundingClientRect() }))
            .filter(({ box }) => box.right > innerWidth || box.bottom > innerHeight)
            .map(({ name }) => name),
        );
      await page.getByRole('button', { name: 'Apply' }).waitFor();
      await expect.poll(() => beyond()).toEqual([]);
      await page.evaluate(() => window.marrow.seek(1.9));
      await page.locator('.retarget-dialog select').first().selectOption({ label: 'first' });
      await page.getByRole('button', { name: 'Apply' }).tap();
      const time = () => page.getByRole('textbox', { name: 'Time' }).first().inputValue();
      await expect.poll(async () => Number(await time())).toBe(1);
      await page.evaluate(() => window.marrow.undo());

      await run(page, 'page.tab.takes');
      await page.locator('.take-row').nth(1).waitFor();
      await run(page, 'take.compare');
      const parts = page.getByRole('group', { name: 'What to show of the comparison' });
      for (const [part, shown] of [
        ['Joints', '.distance-rows'],
        ['Takes', '.take-table'],
        ['Graph', '.distance .time-chart'],
      ] as const) {
        await parts.getByRole('button', { name: part }).tap();
        const box = await page.locator(shown).boundingBox();
        expect(box?.width, part).toBeGreaterThan(WIDTH - 12);
        expect(box?.height, part).toBeGreaterThan(88);
        await expect
          .poll(() =>
            page.locator('.take-table, .distance-rows, .distance .time-chart').filter({ visible: true }).count(),
          )
          .toBe(1);
      }

      // A slider that the browser takes a finger from goes back, and the next finger doesn't move it.
      await run(page, 'take.compare');
      const dofs = () => page.evaluate(() => [window.marrow.characters()[0].dofs, window.marrow.steps()]);
      await page.evaluate(() => window.marrow.run('page.inspector'));
      const slider = page.locator('[data-dof] .lil-slider').filter({ visible: true }).first();
      await slider.scrollIntoViewIfNeeded();
      const at = await slider.boundingBox();
      if (!at) throw new Error('The inspector has no slider.');
      const [x, y] = [at.x + at.width / 2, at.y + at.height / 2];
      const before = await dofs();
      const slide = async () => {
        await touch('touchStart', [x, y]);
        for (let i = 1; i <= 5; i++) await touch('touchMove', [x + (i * at.width) / 12, y]);
      };
      await slide();
      await expect.poll(dofs).not.toEqual(before);
      await touch('touchCancel');
      await expect.poll(dofs).toEqual(before);
      await touch('touchStart', [20, y]);
      for (let i = 1; i <= 5; i++) await touch('touchMove', [20 + 10 * i, y]);
      await touch('touchEnd');
      await expect.poll(() => page.locator('.lil-active').count()).toBe(0);
      await expect.poll(dofs).toEqual(before);

      // On a tablet tools that have no room are scrolled to.
      await page.setViewportSize({ width: 1180, height: 820 });
      for (const tab of ['curves', 'takes', 'poses']) {
        await run(page, `page.tab.${tab}`);
        const beyond = () =>
          page.locator('.timeline-head').evaluate((head) => {
            for (const part of [head, ...head.querySelectorAll('.curve-tools')]) part.scrollLeft = part.scrollWidth;
            const tools = [...head.querySelectorAll('button, input')].filter((one) => one.checkVisibility());
            return (tools.at(-1)?.getBoundingClientRect().right ?? 0) - innerWidth;
          });
        await expect.poll(beyond, { message: tab }).toBeLessThanOrEqual(0);
      }
    },
    { size: { width: WIDTH, height: 844 }, touch: true },
  ));
