/**
 * A take from scratch, by mouse and keyboard: keyed, dragged, edited, cycled, undone, redone, saved, and played by the
 * command.
 */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { afterAll, expect, it } from 'vitest';
import { HANDLE_PIXELS } from '../../src/ui/editors/curves/scene/handles.ts';
import { expectClose } from '../helpers/close.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';
import { inOnePage, startOver, undoAll } from '../helpers/one-page.ts';
import { type DroppedFile, dropFiles, withPage } from '../helpers/page.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'marrow-keying-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

interface Subject {
  readonly files: readonly DroppedFile[];
  readonly joint: string;
  /** Of the joint's first DOF. */
  readonly channel: number;
}

type Point = { readonly x: number; readonly y: number };

const animText = (page: Page) => page.evaluate(() => window.marrow.save('x.anim'));
const skelText = (page: Page) => page.evaluate(() => window.marrow.save('x.skel'));
const dof = (page: Page, channel: number) =>
  page.evaluate((c) => window.marrow.characters()[0]?.dofs[c] ?? Number.NaN, channel);
const keys = (page: Page, channel: number) => page.evaluate((c) => window.marrow.keys(c), channel);

async function place(page: Page, channel: number, seconds: number, value: number): Promise<Point> {
  const found = await page.evaluate(([c, t, v]) => window.marrow.placeOf(c, t, v), [channel, seconds, value] as const);
  if (!found) throw new Error('The curve editor does not show that channel.');
  return found;
}

async function typeInto(page: Page, name: string, value: number): Promise<void> {
  const field = page.getByRole('textbox', { name: new RegExp(`^${name}\\b`) }).first();
  await field.fill(String(value));
  await field.press('Enter');
}

async function drag(page: Page, from: Point, to: Point, held?: 'Alt'): Promise<void> {
  await page.mouse.move(from.x, from.y);
  if (held) await page.keyboard.down(held);
  await page.mouse.down();
  for (const part of [0.25, 0.5, 0.75, 1]) {
    await page.mouse.move(from.x + part * (to.x - from.x), from.y + part * (to.y - from.y));
  }
  await page.mouse.up();
  if (held) await page.keyboard.up(held);
}

/** Poses the joint at a time and keys the whole pose, as a user would. */
async function keyPoseAt(page: Page, seconds: number, degrees: number): Promise<void> {
  await typeInto(page, 'Time in seconds', seconds);
  await typeInto(page, 'rx', degrees);
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('k');
}

/** Presses the shortcut while there are steps left; returns their number. */
async function pressAll(page: Page, shortcut: string, way: 'undo' | 'redo'): Promise<number> {
  await page.locator('.viewport canvas[role=application]').focus();
  for (let steps = 0; ; steps++) {
    if ((await page.evaluate((w) => window.marrow.steps()[w], way)) === undefined) return steps;
    await page.keyboard.press(shortcut);
  }
}

async function makeTake(page: Page, { files, joint, channel }: Subject): Promise<void> {
  await startOver(page);
  await dropFiles(page, files);
  const name = files[0].name.replace(/\.skel$/, '');
  await page.waitForFunction((n) => window.marrow.characters()[0]?.name === n, name);
  await page
    .getByRole('treeitem', { name: new RegExp(`^${joint}`) })
    .first()
    .click();

  await keyPoseAt(page, 0, 10);
  await keyPoseAt(page, 1, 50);
  await expect.poll(async () => (await keys(page, channel)).map((k) => k.time)).toEqual([0, 1]);
  const keyed = await keys(page, channel);
  expect(keyed[1].value).toBeCloseTo((50 * Math.PI) / 180, 9);

  // Drags a key upwards; the character follows during the drag.
  await page.locator('.curve-plot').focus();
  await page.keyboard.press('a');
  await page.evaluate(() => new Promise(requestAnimationFrame));
  const key = await place(page, channel, 1, keyed[1].value);
  await drag(page, key, { x: key.x, y: key.y - 30 });
  const dragged = await keys(page, channel);
  expect(dragged[1].time).toBe(1);
  expect(dragged[1].value).toBeGreaterThan(keyed[1].value + 0.01);
  await expect.poll(() => dof(page, channel)).toBeCloseTo(dragged[1].value, 9);

  // Its left handle is dragged down alone: the tangent breaks.
  const at = await place(page, channel, 1, dragged[1].value);
  const slope = await place(page, channel, 0.9, dragged[1].value - 0.1 * dragged[1].slopeIn);
  const length = Math.hypot(slope.x - at.x, slope.y - at.y);
  const handle = {
    x: at.x + ((slope.x - at.x) / length) * HANDLE_PIXELS,
    y: at.y + ((slope.y - at.y) / length) * HANDLE_PIXELS,
  };
  await drag(page, handle, { x: handle.x, y: at.y + 30 }, 'Alt');
  const broken = await keys(page, channel);
  expect(broken[1].slopeIn).not.toBeCloseTo(dragged[1].slopeIn, 3);
  expect(broken[1].slopeOut).toBeCloseTo(dragged[1].slopeOut, 12);

  // Its kinds are seen on the buttons, in the menu, and by scripts.
  expect(broken[1]).toMatchObject({ tangentIn: 'fixed', tangentOut: 'smooth' });
  await expect.poll(() => page.evaluate(() => window.marrow.keys())).toEqual([broken[1]]);
  const pressed = () =>
    page.locator('.tangent-tools [aria-pressed]').evaluateAll((all) => all.map((one) => one.ariaPressed));
  await expect.poll(pressed).toEqual(['false', 'false', 'mixed', 'mixed', 'false', 'false']);
  await page.getByRole('menuitem', { name: 'Keys', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Tangents', exact: true }).hover();
  for (const [name, checked] of [
    ['Smooth', 'mixed'],
    ['Fixed slope, before the key', 'true'],
    ['Smooth, before the key', 'false'],
  ]) {
    const item = page.getByRole('menuitemcheckbox', { name, exact: true });
    await expect.poll(() => item.getAttribute('aria-checked'), { message: name }).toBe(checked);
  }
  await page.getByRole('menuitemcheckbox', { name: 'Smooth', exact: true }).click();
  await expect.poll(pressed).toEqual(['false', 'false', 'true', 'false', 'false', 'false']);

  // Extrapolation from the menu, for all keys.
  await page.locator('.curve-plot').focus();
  await page.keyboard.press('Control+a');
  await page.getByRole('menuitem', { name: 'Keys', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Extrapolation' }).hover();
  await page.getByRole('menuitemradio', { name: 'Cycle with offset', exact: true }).click();
  const made = await animText(page);
  expect(made).toContain('extrapolate cycle_offset cycle_offset');
  const skeleton = await skelText(page);

  // Undoes everything, back to a character without a take, and redoes it.
  const steps = await pressAll(page, 'Control+z', 'undo');
  expect(steps).toBeGreaterThanOrEqual(7);
  await expect.poll(() => page.evaluate(() => window.marrow.characters()[0]?.name)).not.toBe(name);
  const redone = await pressAll(page, 'Control+Shift+z', 'redo');
  expect(redone).toBe(steps);
  await expect.poll(() => animText(page)).toBe(made);
  await expect.poll(() => skelText(page)).toBe(skeleton);

  // Saved by Ctrl+S and played by the command: the same numbers as in the page.
  await page.evaluate(() => Object.assign(window, { showSaveFilePicker: undefined }));
  const download = page.waitForEvent('download');
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('Control+s');
  const saved = await download;
  expect(saved.suggestedFilename()).toMatch(/\.anim$/);
  const path = join(folder, saved.suggestedFilename());
  await saved.saveAs(path);
  expect(readFileSync(path, 'utf8')).toBe(made);
  for (const { name, bytes } of files) writeFileSync(join(folder, name), bytes);
  const [skel] = files;
  for (const time of [0, 0.37, 1, 2.5, -0.8]) {
    const shown = await page.evaluate((t) => {
      window.marrow.seek(t);
      return { dofs: window.marrow.characters()[0].dofs, world: window.marrow.worldMatrices() };
    }, time);
    const args = ['pose', join(folder, skel.name), path, '--time', String(time)];
    const pose = await commandJson<PoseJson>(args);
    const { root, joints } = pose.characters[0];
    expectClose([...root, ...joints.flatMap((j) => j.dofs)], shown.dofs, 1e-9);
    expectClose(
      joints.flatMap((j) => j.world),
      shown.world.flat(),
      1e-9,
    );
  }
}

const inStill = inOnePage();

/** With the reference files a character of theirs, which has more joints. */
const WITHOUT_TAKE = hasShared
  ? {
      files: ['wasp.skel', 'wasp.skin'].map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) })),
      joint: 'head',
    }
  : {
      files: ['crawler.skel', 'crawler.skin'].map((name) => ({ name, bytes: readFileSync(join(SAMPLES, name)) })),
      joint: 'body',
    };

inStill('makes a take for a character that has none', ({ page }) => makeTake(page, { ...WITHOUT_TAKE, channel: 6 }));

/** The walker's left upper arm, by number of its DOFs. */
const ARM = { joint: 'upper_arm_l', rx: 36, rz: 38 } as const;
/** As text from the page: so many numbers one by one take as long as all that is done to them. */
async function worldsAt(page: Page, times: readonly number[]): Promise<{ dofs: number[]; world: number[] }[]> {
  const text = await page.evaluate(
    (all) =>
      JSON.stringify(
        all.map((time) => {
          window.marrow.seek(time);
          return { dofs: window.marrow.characters()[0].dofs, world: window.marrow.worldMatrices().flat() };
        }),
      ),
    times,
  );
  return JSON.parse(text);
}

async function openWalker(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await undoAll(page);
  await page.locator('.viewport canvas[role=application]').focus();
  await page.evaluate(() => window.marrow.seek(0));
  await page.getByRole('treeitem', { name: new RegExp(`^${ARM.joint}`) }).click();
  await page.getByRole('textbox', { name: /^rx\b/ }).first().waitFor();
}

async function turnArm(page: Page, seconds: number, degrees: number): Promise<void> {
  await typeInto(page, 'Time in seconds', seconds);
  await typeInto(page, 'rz', degrees);
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('k');
}

const inPage = inOnePage({ walking: true });

inPage('makes the walker wave, while everything else walks on as it did', async ({ page }) => {
  await openWalker(page);
  const times = Array.from({ length: 65 }, (_, i) => i / 10);
  const before = await worldsAt(page, times);

  // One question, at the first key outside of the cycle; the second and third key are inside of what was baked.
  await turnArm(page, 2, 70);
  const dialog = page.getByRole('dialog', { name: 'Key outside the cycle' });
  await dialog.getByText('upper_arm_l rz repeats every 0.8 s. A key at 2 s would make it repeat').waitFor();
  await page.keyboard.press('Enter');
  await dialog.waitFor({ state: 'detached' });
  await turnArm(page, 2.2, 40);
  await turnArm(page, 2.4, 70);
  await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe(`Key rz of ${ARM.joint}`);
  await expect.poll(() => page.locator('dialog').allTextContents()).toEqual([]);

  const after = await worldsAt(page, times);
  const at = (seconds: number) => ((after[Math.round(seconds * 10)].dofs[ARM.rz] ?? 0) * 180) / Math.PI;
  expect(at(2)).toBeCloseTo(70, 9);
  expect(at(2.2)).toBeCloseTo(40, 9);
  expect(at(2.4)).toBeCloseTo(70, 9);
  // All other DOFs at all times, and the arm itself away from the wave.
  times.forEach((time, i) => {
    const [was, is] = [before[i].dofs, after[i].dofs].map((dofs) =>
      time > 1.75 && time < 2.65 ? dofs.filter((_, d) => d !== ARM.rz) : dofs,
    );
    expectClose(is, was, 1e-9);
  });

  // Three values set and three keys, each one step.
  const steps = await pressAll(page, 'Control+z', 'undo');
  expect(steps).toBe(6);
  await expect.poll(() => worldsAt(page, times)).toEqual(before);
});

inPage('a key outside the cycle is given up by escape, set inside the cycle, or lengthens it', async ({ page }) => {
  await openWalker(page);
  const keyed = () => keys(page, ARM.rz);
  const before = await keyed();
  const dialog = page.getByRole('dialog', { name: 'Key outside the cycle' });
  await turnArm(page, 2, 70);
  await dialog.waitFor();
  // A press beside it, as to look at the pose, loses neither.
  await page.mouse.click(300, 60);
  await expect.poll(() => dialog.isVisible()).toBe(true);
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'detached' });
  await expect.poll(() => keyed()).toEqual(before);
  await expect.poll(() => dof(page, ARM.rz)).toBeCloseTo((70 * Math.PI) / 180, 9);

  await page.keyboard.press('k');
  await dialog.getByRole('button', { name: 'Key inside the cycle' }).click();
  const inside = await keyed();
  expect([inside[0].time, inside[inside.length - 1].time]).toEqual([0, 0.8]);
  await expect.poll(() => dof(page, ARM.rz)).toBeCloseTo((70 * Math.PI) / 180, 9);

  await page.keyboard.press('Control+z');
  await page.keyboard.press('k');
  await dialog.getByRole('button', { name: 'Lengthen the cycle' }).click();
  await expect.poll(async () => (await keyed()).at(-1)?.time).toBe(2);
  await page.getByText('upper_arm_l rz now repeats every 2 s instead of every 0.8 s.').first().waitFor();
});

inPage('a key of another panel than the active one says where it belongs', async ({ page }) => {
  await openWalker(page);
  // A click in the tree has selected an arm, and the focus is there.
  const dofs = () => page.evaluate(() => [...window.marrow.characters()[0].dofs]);
  const before = await dofs();
  await page.keyboard.press('+');
  await page.getByText('Increase active DOF by a step: point at the viewport, or press F6').first().waitFor();
  await expect.poll(dofs).toEqual(before);
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('+');
  await expect.poll(dofs).not.toEqual(before);
});

it('a joint is found, turned and keyed by keys alone, as the first steps tell whoever uses no mouse', () =>
  withPage(
    async ({ page }) => {
      const steps = page.getByRole('region', { name: 'First steps' });
      await steps.getByText('Drag a hand, a foot or the head').waitFor();
      await page.keyboard.press('Tab');
      await steps.getByText('Press T, type a joint’s name, Enter').waitFor();
      const hasFocus = () => page.evaluate(() => document.activeElement?.getAttribute('aria-label'));
      // The search for commands finds joints, too, and focuses the viewport, whose keys turn them.
      await page.keyboard.press('Control+k');
      await page.keyboard.type('upper_arm_l');
      await page.getByRole('option', { name: 'Select upper_arm_l' }).waitFor();
      await page.keyboard.press('Enter');
      await page.getByRole('treeitem', { name: 'upper_arm_l', selected: true }).waitFor();
      await expect.poll(hasFocus).toBe('Viewport');
      const dofs = () => page.evaluate(() => [...window.marrow.characters()[0].dofs]);
      const before = await dofs();
      for (const key of ['v', '+']) await page.keyboard.press(key);
      await expect.poll(async () => (await dofs()).filter((value, i) => value !== before[i])).toHaveLength(1);
      const after = await dofs();
      const turned = after.findIndex((value, i) => value !== before[i]);
      expect(after[turned] - before[turned]).toBeCloseTo(Math.PI / 180, 9);
      await page.keyboard.press('k');
      await expect.poll(() => steps.isVisible()).toBe(false);

      // A DOF's field and the time are typed into from there, too.
      for (const [typed, field] of [
        ['rz', 'rz of upper_arm_l, degrees'],
        ['go to time', 'Time in seconds'],
      ] as const) {
        await page.keyboard.press('Control+k');
        await page.keyboard.type(typed);
        await page.keyboard.press('Enter');
        await expect.poll(hasFocus).toBe(field);
      }
      await page.keyboard.type('0.5');
      await page.keyboard.press('Enter');
      await expect.poll(() => page.getByRole('textbox', { name: 'Time in seconds' }).inputValue()).toBe('0.5');

      // Enter leads from the outliner into the viewport, and the camera stays where it is.
      const seen = () => page.evaluate(() => window.marrow.pointOnPage([0, 0, 0]));
      const eye = await seen();
      for (const key of ['t', 'ArrowDown', 'Enter']) await page.keyboard.press(key);
      await page.getByRole('treeitem', { name: 'forearm_l', selected: true }).waitFor();
      await expect.poll(hasFocus).toBe('Viewport');
      await expect.poll(seen).toEqual(eye);
    },
    { walking: true, firstVisit: true },
  ));

inPage(
  'a key acts in the panel under the mouse, which is marked, and never on keys that nobody points at',
  async ({ page }) => {
    await openWalker(page);
    const plot = page.locator('.curve-plot');
    const timeline = page.getByRole('region', { name: 'Timeline' });
    const viewport = page.locator('.stage');
    await plot.focus();
    await page.keyboard.press('Control+a');
    const before = await keys(page, ARM.rz);

    const stage = (await viewport.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
    await page.mouse.move(stage.x + 0.8 * stage.width, stage.y + 0.8 * stage.height);
    await expect.poll(() => viewport.getAttribute('data-active')).toBe('');
    await expect.poll(() => timeline.getAttribute('data-active')).toBeNull();
    await page.keyboard.press('Delete');
    await page
      .getByText('Delete selected keys: point at the timeline, or press F6 until it has the focus, to use this key.')
      .first()
      .waitFor();
    await expect.poll(() => keys(page, ARM.rz)).toEqual(before);

    // Back in the timeline it is the timeline's again.
    const box = (await plot.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.3 * box.height);
    await expect.poll(() => timeline.getAttribute('data-active')).toBe('');
    await expect.poll(() => viewport.getAttribute('data-active')).toBeNull();
    await page.keyboard.press('2');
    await expect.poll(() => keys(page, ARM.rz)).not.toEqual(before);
    await page.keyboard.press('Control+z');
    await expect.poll(() => keys(page, ARM.rz)).toEqual(before);
    // A finger in the panel with the focus overrides a mouse that rests in another.
    await page.mouse.move(stage.x + 0.8 * stage.width, stage.y + 0.8 * stage.height);
    await expect.poll(() => viewport.getAttribute('data-active')).toBe('');
    await timeline.dispatchEvent('pointerdown', { pointerType: 'touch', pointerId: 7, bubbles: true });
    await expect.poll(() => timeline.getAttribute('data-active')).toBe('');
    await expect.poll(() => viewport.getAttribute('data-active')).toBeNull();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.3 * box.height);

    // The mouse goes away, and the focus comes back by keyboard: it has the keys again.
    await page.mouse.move(stage.x + 0.8 * stage.width, stage.y + 0.8 * stage.height);
    await expect.poll(() => viewport.getAttribute('data-active')).toBe('');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Shift+Tab');
    await expect.poll(() => timeline.getAttribute('data-active')).toBe('');
    await page.keyboard.press('Delete');
    await expect.poll(() => keys(page, ARM.rz)).toEqual([]);
  },
);
