/** Pose mode on the built page, by real mouse: limbs by their ends, rings, the dot in their middle, and the camera. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { apart, drawn, jointPlace, onPage, standing, undoLabel } from './checks/ik.ts';
import { dragUp, expectArmOnly, limbFrom, place, shown } from './checks/limb-drag.ts';

const mode = (page: Page) => page.locator('.mode-switch [aria-checked=true]').textContent();
const turnOfView = (page: Page) => page.evaluate(() => window.marrow.pointOnPage([1, 0, 0])?.x ?? Number.NaN);
const texts = (page: Page) =>
  page.evaluate(() => Promise.all(['walker.skel', 'walker_walk.anim'].map(window.marrow.save)));

async function opened(page: Page, name: string): Promise<void> {
  await page.waitForFunction((wanted) => window.marrow.characters()[0]?.name === wanted, name);
  await drawn(page);
}

const inPage = inOnePage({ walking: true });

/** The first of them. */
inPage(
  'the walker’s hand is dragged in the mode that the page opens with: its arm bends, and nothing else',
  async ({ page }) => {
    await opened(page, 'walker');
    await expect.poll(() => mode(page)).toBe('Pose');
    await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
    const files = await texts(page);
    const { names } = await shown(page);
    const hand = { joint: names.indexOf('hand_l'), point: [0.07, 0, 0], by: [0, -30] } as const;
    await expectArmOnly(page, hand, await limbFrom(page, 'upper_arm_l'));
    await expect.poll(() => texts(page)).toEqual(files);

    // A drag on the chest is the camera's, and so is one beside the character; a click selects.
    const before = await shown(page);
    const view = await turnOfView(page);
    const chest = await onPage(page, await jointPlace(page, 'spine'));
    await page.mouse.move(chest.x, chest.y);
    await page.mouse.down();
    await page.mouse.move(chest.x + 60, chest.y, { steps: 5 });
    await page.mouse.up();
    await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
    await expect.poll(() => shown(page)).toEqual(before);
    await page.evaluate(() => window.marrow.run('view.front'));
    await standing(page);

    // The hips by the dot of their rings: the body moves, and the foot that stands holds. One step.
    const hips = names.indexOf('hips');
    await page.getByRole('treeitem', { name: /^hips/ }).click();
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
    await drawn(page);
    const low = (j: number) => place(before, j)[1];
    const [lower] = ['toe_l', 'toe_r'].map((name) => names.indexOf(name)).sort((a, b) => low(a) - low(b));
    await dragUp(page, { joint: hips, point: [0, 0, 0], by: [0, 14] }, async () => {
      const now = await shown(page);
      expect(apart(place(now, hips), place(before, hips))).toBeGreaterThan(1e-3);
      expect(apart(place(now, lower), place(before, lower))).toBeLessThan(1e-3);
    });
    await expect.poll(() => undoLabel(page)).toBe('Drag hips');
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(() => shown(page)).toEqual(before);

    // E leads to IK and on to FK, W back.
    await page.locator('.viewport canvas[role=application]').focus();
    for (const [key, next] of [
      ['e', 'IK'],
      ['e', 'FK'],
      ['w', 'Pose'],
    ] as const) {
      await page.keyboard.press(key);
      await expect.poll(() => mode(page)).toBe(next);
    }
  },
);

describeShared('Pose mode with captures and axis-angle skeletons', () => {
  inPage('the hand of a capture is dragged: its arm bends, and nothing else', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await opened(page, 'walk');
    await expect.poll(() => mode(page)).toBe('Pose');
    const { names } = await shown(page);
    const hand = { joint: names.indexOf('LeftHand'), point: [0, 0, 0], by: [-25, -25] } as const;
    await expectArmOnly(page, hand, await limbFrom(page, 'LeftShoulder'));
  });

  inPage(
    'axis-angle skeletons open in FK; in Pose mode a hand bends its arm, and the next other character is in Pose',
    async ({ page }) => {
      await startOver(page);
      await dropFiles(page, [{ name: 'human.axskel', bytes: sharedBytes('data/axis-skel/human.axskel') }]);
      await opened(page, 'human');
      await expect.poll(() => mode(page)).toBe('FK');
      await page.evaluate(() => window.marrow.run('posing.pose'));
      await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
      await expectArmOnly(page, { joint: 9, point: [0, 0.05, 0], by: [8, -25] }, [5, 6, 7, 8, 9]);
    },
  );
});
