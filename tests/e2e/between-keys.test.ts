/**
 * Blocking and values between keys, with keys and mouse: auto tangents, steps, the stepped preview, the tween bar. And
 * posing like a rig: selection sets, locked DOFs, live mirror and paste flipped.
 */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, undoAll } from '../helpers/one-page.ts';

const ARM = { joint: 'upper_arm_l', rz: 38 } as const;

const keys = (page: Page) => page.evaluate((channel) => window.marrow.keys(channel), ARM.rz);
const arm = (page: Page) => page.evaluate((dof) => window.marrow.characters()[0].dofs[dof], ARM.rz);
const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);

async function openWalker(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await undoAll(page);
  await page.evaluate(() => window.marrow.seek(0));
  await page.getByRole('treeitem', { name: new RegExp(`^${ARM.joint}`) }).click();
  await page.getByRole('textbox', { name: /^rx\b/ }).first().waitFor();
}

const inPage = inOnePage({ walking: true });

inPage(
  '5 makes selected keys auto and 6 makes them steps, each as one step, and undo brings all back',
  async ({ page }) => {
    await openWalker(page);
    const before = await keys(page);
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('Control+a');
    await page.keyboard.press('5');
    await expect.poll(() => keys(page).then((all) => all.every((key) => key.tangentIn === 'auto'))).toBe(true);
    await page.keyboard.press('6');
    await expect.poll(() => keys(page).then((all) => all.length)).toBe(2 * before.length - 1);
    // The last keys, which hold nothing, are steps as well; and a step is one key.
    await page.getByRole('button', { name: 'Step', exact: true, pressed: true }).waitFor();
    await page.keyboard.press('5');
    await expect.poll(() => keys(page).then((all) => all.length)).toBe(before.length);
    for (let step = 0; step < 3; step++) await page.keyboard.press('Control+z');
    await expect.poll(() => keys(page)).toEqual(before);
  },
);

inPage('the stepped preview holds each pose up to the next key, and changes nothing else', async ({ page }) => {
  await openWalker(page);
  const [first, second] = await keys(page);
  const label = await undoLabel(page);
  await page.evaluate((time) => window.marrow.seek(time), (first.time + second.time) / 2);
  await page.evaluate(() => window.marrow.run('view.steppedPreview', { on: true }));
  await expect.poll(() => arm(page)).toBeCloseTo(first.value, 9);
  await page.evaluate(() => window.marrow.run('view.steppedPreview', { on: false }));
  await expect.poll(() => arm(page)).not.toBeCloseTo(first.value, 3);
  const field = page.getByRole('textbox', { name: /^rz\b/ }).first();
  // The field comes with a later frame than the document: it shows the pose once both have the same angle.
  const shown = () => field.inputValue().then((text) => Number.parseFloat(text.replace('−', '-')));
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  const smooth = degrees(await arm(page));
  await expect.poll(shown).toBeCloseTo(smooth, 1);
  const isOn = page.getByRole('button', { name: 'Stepped preview is on' });
  await expect.poll(() => isOn.count()).toBe(0);
  const leftOfTime = () =>
    page.getByRole('textbox', { name: 'Time in seconds' }).evaluate((e) => e.getBoundingClientRect().left);
  const before = await leftOfTime();
  await page.keyboard.press('Shift+D');
  await expect.poll(() => arm(page)).toBeCloseTo(first.value, 9);
  await isOn.waitFor();
  await expect.poll(leftOfTime).toBe(before);
  await expect.poll(shown).toBeCloseTo(degrees(first.value), 1);
  await isOn.click();
  await expect.poll(() => arm(page)).not.toBeCloseTo(first.value, 3);
  await expect.poll(shown).toBeCloseTo(smooth, 1);
  await expect.poll(() => isOn.count()).toBe(0);
  const labelNow = await undoLabel(page);
  expect(labelNow).toBe(label);
});

inPage(
  'the bar takes no room until its key is pressed; a number, a button and a drag are a step each',
  async ({ page }) => {
    await openWalker(page);
    const [first, second] = await keys(page);
    await page.evaluate((time) => window.marrow.seek(time), (first.time + second.time) / 2);
    const bar = page.locator('.tween-bar');
    await expect.poll(() => bar.count()).toBe(0);
    // Typed on while the bar's script loads.
    await page.keyboard.press('Shift+W');
    await page.keyboard.type('0.25');
    await page.keyboard.press('Enter');
    await expect.poll(() => arm(page)).toBeCloseTo(first.value + 0.25 * (second.value - first.value), 9);
    await expect.poll(() => undoLabel(page)).toMatch(/^Tween upper_arm_l/);
    await expect.poll(() => page.getByText('nothing to change').count()).toBe(0);
    await bar.getByRole('button', { name: '1', exact: true }).click();
    await expect.poll(() => arm(page)).toBeCloseTo(second.value, 9);
    const slider = await bar.locator('.tween-slider').boundingBox();
    if (!slider) throw new Error('The slider has no place.');
    const at = (share: number) => [slider.x + share * slider.width, slider.y + slider.height / 2] as const;
    await page.mouse.move(...at(0.5));
    await page.mouse.down();
    await page.mouse.move(...at(0.3), { steps: 4 });
    await page.mouse.move(...at(0.02), { steps: 4 });
    await page.mouse.up();
    const reach = second.value - first.value;
    await expect.poll(async () => ((await arm(page)) - first.value) / reach).toBeLessThan(0);
    await page.keyboard.press('Control+z');
    await expect.poll(() => arm(page)).toBeCloseTo(second.value, 9);
    await page.keyboard.press('Escape');
    await expect.poll(() => bar.isVisible()).toBe(false);
  },
);

inPage(
  'until a number is begun, keys are the page’s while the bar is open: Space plays, arrows step, letters choose',
  async ({ page }) => {
    await openWalker(page);
    const label = await undoLabel(page);
    const field = page.getByRole('textbox', { name: 'Share' });
    const bar = page.locator('.tween-bar');
    await page.keyboard.press('Shift+W');
    await field.and(page.locator(':focus')).waitFor();
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => page.getByRole('textbox', { name: 'Frame' }).inputValue()).toBe('1');
    await page.keyboard.press('Space');
    await page.getByRole('button', { name: 'Pause' }).waitFor();
    await page.keyboard.press('Space');
    await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
    await page.keyboard.press('Shift+X');
    await bar.getByText('Relax or push').waitFor();
    await expect.poll(() => undoLabel(page)).toBe(label);
    await field.and(page.locator(':focus')).waitFor();
    await page.keyboard.type('0.5');
    await expect.poll(() => field.inputValue()).toBe('0.5');
    await page.keyboard.press('Enter');
    await expect.poll(() => undoLabel(page)).toMatch(/^Relax upper_arm_l/);
    await page.keyboard.press('Shift+X');
    await bar.waitFor({ state: 'hidden' });
    // Where a way changes nothing, the bar says so.
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('Control+a');
    await page.keyboard.press('Shift+U');
    await bar.getByText('No selected key lies between keys that are not selected.').waitFor();
    await page.keyboard.press('Shift+Z');
    await bar.getByText(/^\d+ selected keys$/).waitFor();
  },
);

inPage('a key that is moved takes its auto tangents and the value that it holds along', async ({ page }) => {
  await openWalker(page);
  await page.locator('.curve-plot').focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.press('5');
  const all = await keys(page);
  const move = { channel: ARM.rz, indices: [1] };
  await page.evaluate((key) => window.marrow.run('keys.setTangents', { keys: [key], side: 'out', kind: 'step' }), move);
  await expect.poll(() => keys(page).then((now) => now.length)).toBe(all.length + 1);
  const before = await keys(page);
  const kinds = before.map(({ tangentIn, tangentOut }) => [tangentIn, tangentOut]);
  const raised = { keys: [move], seconds: 0, values: [0.2] };
  await page.evaluate((args) => window.marrow.run('keys.move', args), raised);
  await expect.poll(() => keys(page).then((now) => now[1].value)).toBeCloseTo(before[1].value + 0.2, 9);
  // The held value follows its key, and the kinds are kept.
  const moved = await keys(page);
  expect(moved[2].value).toBe(moved[1].value);
  expect(moved.map(({ tangentIn, tangentOut }) => [tangentIn, tangentOut])).toEqual(kinds);
});

const dofs = (page: Page) => page.evaluate(() => [...window.marrow.characters()[0].dofs]);
const row = (page: Page, name: string) => page.getByRole('treeitem', { name: new RegExp(`^${name}`) });
const selected = (page: Page) => page.locator('.outliner [role=treeitem][aria-selected=true]').allTextContents();
const saved = (page: Page) => page.evaluate(async () => JSON.parse(await window.marrow.save('walker.sets.json')));

async function openAtStart(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await undoAll(page);
  await page.evaluate(() => window.marrow.seek(0));
}

/** The DOF of a joint, by its place among the joint's own. */
const firstDof = (page: Page, joint: string) =>
  page.evaluate((name) => 3 + 3 * window.marrow.characters()[0].joints.findIndex((one) => one.name === name), joint);

inPage(
  'locked DOFs stay while the whole pose is reset, how many is said, and the mark in the inspector unlocks one',
  async ({ page }) => {
    await openAtStart(page);
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
    await openAtStart(page);
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
    await openAtStart(page);
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
