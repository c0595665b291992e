/** Posing by FK, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles } from '../../helpers/page.ts';

export type Point = { readonly x: number; readonly y: number };

/** Three ball joints; the elbow has limits about x. */
const ARM = `balljoint shoulder {
  offset 0 0 0
  boxmin -0.1 0 -0.1
  boxmax 0.1 1 0.1
  balljoint elbow {
    offset 0 1 0
    boxmin -0.1 0 -0.1
    boxmax 0.1 1 0.1
    rotxlimit -0.5 0.75
  }
}
`;

export const dofs = (page: Page) => page.evaluate(() => window.marrow.characters()[0]?.dofs ?? []);
export const undo = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
/** Opens the arm in FK, in place of all that was done, selects its elbow, and waits for its gizmo. */
export async function openArm(page: Page, joint = 'elbow'): Promise<void> {
  await undoAll(page);
  await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'arm');
  await page.evaluate(() => window.marrow.run('posing.fk'));
  await page
    .getByRole('treeitem', { name: new RegExp(`^${joint}`) })
    .first()
    .click();
  await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
  await page.getByRole('radio', { name: 'rx', exact: true }).waitFor();
}

/** Page position of the joint: the centre of its gizmo, which comes to it with the next frame. */
export const middle = (page: Page): Promise<Point> =>
  page.evaluate(async () => {
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    const box = document.querySelector('.joint-gizmo')?.getBoundingClientRect();
    return box ? { x: box.x + box.width / 2, y: box.y + box.height / 2 } : { x: Number.NaN, y: Number.NaN };
  });

/** Presses and moves along points. */
export async function pressAndGo(page: Page, from: Point, way: readonly Point[]): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (const { x, y } of way) await page.mouse.move(x, y);
}

export const POSING: readonly Check[] = [
  {
    name: 'turns the active DOF by dragging the bone up and down, and cancels at Escape',
    async run({ page }) {
      await openArm(page);
      await page.getByRole('radio', { name: 'rz', exact: true }).click();
      const bone = await middle(page);
      // Two pixels per degree.
      await pressAndGo(page, bone, [
        { x: bone.x, y: bone.y - 30 },
        { x: bone.x, y: bone.y - 60 },
      ]);
      await expect.poll(async () => (await dofs(page))[8]).toBeCloseTo(Math.PI / 6, 9);
      await page.keyboard.press('Escape');
      await page.mouse.up();
      await expect.poll(async () => (await dofs(page))[8]).toBe(0);
      await expect.poll(() => undo(page)).toMatch(/^Open/);
      await pressAndGo(page, bone, [{ x: bone.x, y: bone.y + 40 }]);
      await page.mouse.up();
      await expect.poll(async () => (await dofs(page))[8]).toBeCloseTo(-Math.PI / 9, 9);
      await expect.poll(() => undo(page)).toBe('Rotate elbow');
      await page.getByRole('radio', { name: 'rx', exact: true }).click();
    },
  },
];
