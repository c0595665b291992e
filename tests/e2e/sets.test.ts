/** Posing like a rig, with keys and mouse: selection sets, locked DOFs, live mirror and paste flipped. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, undoAll } from '../helpers/one-page.ts';

const dofs = (page: Page) => page.evaluate(() => [...window.marrow.characters()[0].dofs]);
const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
const row = (page: Page, name: string) => page.getByRole('treeitem', { name: new RegExp(`^${name}`) });
const selected = (page: Page) => page.locator('.outliner [role=treeitem][aria-selected=true]').allTextContents();
const saved = (page: Page) => page.evaluate(async () => JSON.parse(await window.marrow.save('walker.sets.json')));

async function openWalker(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await undoAll(page);
  await page.evaluate(() => window.marrow.seek(0));
}

/** The DOF of a joint, by its place among the joint's own. */
const firstDof = (page: Page, joint: string) =>
  page.evaluate((name) => 3 + 3 * window.marrow.characters()[0].joints.findIndex((one) => one.name === name), joint);

const inPage = inOnePage({ walking: true });

inPage(
  'locked DOFs stay while the whole pose is reset, how many is said, and the mark in the inspector unlocks one',
  async ({ page }) => {
    await openWalker(page);
    await row(page, 'upper_arm_l').click();
    const first = await firstDof(page, 'upper_arm_l');
    await page.keyboard.press('Alt+y');
    await expect.poll(() => undoLabel(page)).toBe('Lock upper_arm_l');
    const before = await dofs(page);
    await page.evaluate(() => window.marrow.run('pose.reset', { to: 'zero' }));
    await page.locator('.message-line', { hasText: '3 locked DOFs left alone' }).waitFor();
    const after = await dofs(page);
    expect(after.slice(first, first + 3)).toEqual(before.slice(first, first + 3));
    await page
      .getByRole('button', { name: /^Unlock r\w of upper_arm_l/ })
      .first()
      .click();
    await expect.poll(() => undoLabel(page)).toMatch(/^Unlock r\w of upper_arm_l/);
  },
);

inPage(
  'with live mirror, what is set on one side is set on the other in the same step; a pose is pasted flipped',
  async ({ page }) => {
    await openWalker(page);
    const [left, right] = [await firstDof(page, 'upper_arm_l'), await firstDof(page, 'upper_arm_r')];
    await page.evaluate(() => window.marrow.run('pose.liveMirror', { on: true }));
    const before = await dofs(page);
    await page.evaluate((index) => window.marrow.run('pose.setDofs', { dofs: [{ index, value: 0.6 }] }), left);
    const both = await dofs(page);
    expect(both[left]).toBeCloseTo(0.6, 9);
    expect(both[right]).not.toBe(before[right]);
    expect(Math.abs(both[right])).toBeCloseTo(0.6, 6);
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(() => dofs(page)).toEqual(before);
    await page.evaluate(() => window.marrow.run('pose.liveMirror', { on: false }));
    await row(page, 'upper_arm_l').click();
    await page.evaluate(() => window.marrow.run('pose.copyJoints'));
    await page.keyboard.press('Control+Alt+v');
    await expect.poll(() => undoLabel(page)).toMatch(/^Paste pose flipped/);
    const pasted = await dofs(page);
    expect(pasted.slice(left, left + 3)).toEqual(before.slice(left, left + 3));
    expect(pasted.slice(right, right + 3)).not.toEqual(before.slice(right, right + 3));
  },
);

inPage(
  'a set is made of selected joints, selects them by button and by key, and is saved with the locks',
  async ({ page }) => {
    await openWalker(page);
    await row(page, 'upper_arm_l').click();
    await page.keyboard.press('Alt+Shift+Digit0');
    const strip = page.getByRole('toolbar', { name: 'Selection sets' });
    const button = strip.getByRole('button', { name: 'Select Set 1' });
    await button.waitFor();
    await row(page, 'upper_arm_r').click();
    await expect.poll(() => selected(page).then((all) => all.join())).toContain('upper_arm_r');
    await button.click();
    await expect.poll(() => selected(page).then((all) => all.join())).toContain('upper_arm_l');
    await row(page, 'head').click();
    await page.keyboard.press('Alt+Shift+Digit1');
    await expect.poll(() => selected(page).then((all) => all.join())).toContain('upper_arm_l');
    await page.keyboard.press('Alt+y');
    await expect.poll(() => undoLabel(page)).toBe('Lock upper_arm_l');
    await expect
      .poll(() => saved(page))
      .toMatchObject({
        sets: [{ name: 'Set 1', joints: ['upper_arm_l'] }],
        locked: [{ joint: 'upper_arm_l', dofs: ['rx', 'ry', 'rz'] }],
      });
  },
);
