/** The motion path by mouse: diamonds are dragged, at other times than the current one. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { dropFiles } from '../helpers/page.ts';

const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
const saved = (page: Page, name: string) => page.evaluate((of) => window.marrow.save(of), name);
const position = (page: Page, joint: string) =>
  page.evaluate((name) => {
    const index = window.marrow.characters()[0].joints.findIndex((one) => one.name === name);
    const world = window.marrow.worldMatrices()[index];
    return [world[12], world[13], world[14]] as const;
  }, joint);

/** Selects a joint in the outliner, shows its path, and goes to a time. */
async function showPath(page: Page, joint: string, seconds: number): Promise<void> {
  await page.evaluate(() => window.marrow.run('posing.selectTool'));
  await page
    .getByRole('treeitem', { name: new RegExp(`^${joint}`) })
    .first()
    .click();
  await page.evaluate(() => window.marrow.run('draw.trail'));
  await page.evaluate((to) => window.marrow.seek(to), seconds);
}

/** Where the path is on the page at another time than the current one, which is kept. */
async function onPath(page: Page, joint: string, at: number, now: number): Promise<{ x: number; y: number }> {
  await page.evaluate((to) => window.marrow.seek(to), at);
  const place = await position(page, joint);
  // The camera may follow the root, with the next frame.
  await page.evaluate((to) => window.marrow.seek(to), now);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const found = await page.evaluate((point) => window.marrow.pointOnPage(point), place);
  if (!found) throw new Error('The path is in view.');
  // The script of the path comes with the first move over it.
  const cursorThere = async () => {
    await page.mouse.move(found.x - 30, found.y);
    await page.mouse.move(found.x, found.y);
    return page.evaluate(() => document.querySelector('canvas')?.style.cursor);
  };
  await expect.poll(cursorThere).toBe('grab');
  return found;
}

async function drag(page: Page, { x, y }: { x: number; y: number }, by: readonly [number, number]): Promise<void> {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by[0], y + by[1], { steps: 4 });
}

const inPage = inOnePage({ walking: true });

inPage('a diamond is dragged in one step, Escape cancels, and a click goes to its time', async ({ page }) => {
  await startOver(page);
  const [file, joint, now] = ['walker_walk.anim', 'hand_l', 0.2] as const;
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await showPath(page, joint, now);
  const channel = await page.evaluate(
    (name) => 3 + 3 * window.marrow.characters()[0].joints.findIndex((one) => one.name === name),
    'upper_arm_l',
  );
  const times = await page.evaluate((of) => window.marrow.keys(of).map(({ time }) => time), channel);
  const time = times.find((one) => one > 0.3) ?? 0;
  const before = await saved(page, file);
  const handle = await onPath(page, joint, time, now);
  await drag(page, handle, [20, -30]);
  await expect.poll(() => saved(page, file)).not.toBe(before);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await expect.poll(() => saved(page, file)).toBe(before);

  await drag(page, handle, [20, -30]);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe(`Move ${joint} on its path`);
  const after = await page.evaluate((of) => window.marrow.keys(of).map((key) => key.time), channel);
  expect(after).toEqual(times);
  // It is where it was dragged to.
  const moved = await onPath(page, joint, time, now);
  expect(Math.hypot(moved.x - handle.x - 20, moved.y - handle.y + 30)).toBeLessThan(2);
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => saved(page, file)).toBe(before);

  const old = await position(page, joint);
  await page.mouse.click(handle.x, handle.y);
  await expect.poll(() => position(page, joint)).not.toEqual(old);
  // Off again.
  await page.evaluate(() => window.marrow.run('draw.trail'));
});

inPage('a frame of a capture is dragged, and one line of the file changes', async ({ page }) => {
  await startOver(page);
  const name = 'own-walk.bvh';
  await dropFiles(page, [{ name, bytes: OWN_CAPTURES.get(name) ?? new Uint8Array() }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.joints.length > 5);
  await showPath(page, 'LeftFoot', 0.5);
  const before = (await saved(page, name)).split('\n');
  await drag(page, await onPath(page, 'LeftFoot', 1.2, 0.5), [15, -15]);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Move LeftFoot on its path');
  const after = (await saved(page, name)).split('\n');
  expect(after.filter((line, i) => line !== before[i])).toHaveLength(1);
});
