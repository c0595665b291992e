/** Posing by IK, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles } from '../../helpers/page.ts';

export type Point = readonly [number, number, number];

/** A leg of three bones hanging down, with knees that bend one way only. */
const LEG = `balljoint hip {
  offset 0 2 0
  boxmin -0.1 -0.8 -0.1
  boxmax 0.1 0 0.1
  balljoint knee_l {
    offset 0 -0.8 0
    boxmin -0.1 -0.5 -0.1
    boxmax 0.1 0 0.1
    rotxlimit 0 2
    rotylimit 0 0
    rotzlimit 0 0
    pose 0.4 0 0
    balljoint foot_l {
      offset 0 -0.8 0
      boxmin -0.1 -0.1 -0.1
      boxmax 0.1 0.1 0.1
    }
  }
}
`;

/** In place of all that was done. */
export async function openLeg(page: Page): Promise<void> {
  await undoAll(page);
  await dropFiles(page, [{ name: 'leg.skel', bytes: LEG }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'leg');
}

export const drawn = (page: Page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 3; i++) await new Promise((next) => requestAnimationFrame(next));
  });

/** Waits until the camera has stopped moving. */
export async function standing(page: Page): Promise<void> {
  const places = () => page.evaluate(() => JSON.stringify([0, 1].map((y) => window.marrow.pointOnPage([y, y, y]))));
  for (let before = '', now = await places(); now !== before; ) {
    before = now;
    await drawn(page);
    now = await places();
  }
}

export async function intoIk(page: Page): Promise<void> {
  await page.evaluate(() => window.marrow.run('posing.ik'));
  await page.getByRole('button', { name: 'Unpin all' }).waitFor();
}

export const jointPlace = (page: Page, name: string): Promise<Point> =>
  page.evaluate((wanted) => {
    const at = window.marrow.characters()[0].joints.findIndex((joint) => joint.name === wanted);
    const [x, y, z] = window.marrow.worldMatrices()[at].slice(12, 15);
    return [x, y, z] as const;
  }, name);

export async function onPage(page: Page, point: Point): Promise<{ x: number; y: number }> {
  const place = await page.evaluate((p) => window.marrow.pointOnPage(p), point);
  if (!place) throw new Error('The character is not shown.');
  return place;
}

export async function click(page: Page, point: Point): Promise<void> {
  const { x, y } = await onPage(page, point);
  await page.mouse.click(x, y);
  await drawn(page);
}

export const pins = (page: Page) => page.evaluate(() => window.marrow.pins());
export const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
export const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((v, k) => v - b[k]));

export const IK: readonly Check[] = [
  {
    name: 'pins a joint by a click, lets it go by another, and drags it as one undo step',
    async run({ page }) {
      await openLeg(page);
      await drawn(page);
      await intoIk(page);
      const foot = await jointPlace(page, 'foot_l');
      await click(page, foot);
      await expect
        .poll(async () => (await pins(page)).map(({ joint, point }) => [joint, ...point]))
        .toEqual([[2, 0, 0, 0]]);
      await expect.poll(() => undoLabel(page)).toBe('Pin foot_l');
      await click(page, foot);
      await expect.poll(() => pins(page)).toEqual([]);

      await click(page, foot);
      const from = await onPage(page, foot);
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(from.x + 20, from.y - 15, { steps: 5 });
      await page.mouse.move(from.x + 30, from.y - 30, { steps: 5 });
      await drawn(page);
      const there = await onPage(page, await jointPlace(page, 'foot_l'));
      expect(Math.hypot(there.x - from.x - 30, there.y - from.y + 30)).toBeLessThan(1.5);
      await page.mouse.up();
      await expect.poll(() => undoLabel(page)).toBe('Drag foot_l');
      await page.evaluate(() => window.marrow.undo());
      await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(1e-9);
      await expect.poll(() => undoLabel(page)).toBe('Pin foot_l');
    },
  },
];
