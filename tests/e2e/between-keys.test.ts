/** Blocking and values between keys, with keys and mouse: auto tangents, steps, the stepped preview, the tween bar. */
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
