/**
 * A take from nothing, with the mouse and the keyboard of a person: keyed, dragged, bent, cycled, undone, redone, saved,
 * and played by the command.
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
import { type DroppedFile, dropFiles, withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

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
  const field = page.getByRole('textbox', { name, exact: true }).first();
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

/** Poses the joint at a moment and keys the whole pose, as one does by hand. */
async function keyPoseAt(page: Page, seconds: number, degrees: number): Promise<void> {
  await typeInto(page, 'Time in seconds', seconds);
  await typeInto(page, 'rx', degrees);
  await page.locator('canvas[role=img]').focus();
  await page.keyboard.press('k');
}

/** Presses the key for as long as there is a step to take; gives how many there were. */
async function pressAll(page: Page, shortcut: string, way: 'undo' | 'redo'): Promise<number> {
  await page.locator('canvas[role=img]').focus();
  for (let steps = 0; ; steps++) {
    if ((await page.evaluate((w) => window.marrow.steps()[w], way)) === undefined) return steps;
    await page.keyboard.press(shortcut);
  }
}

async function makeTake({ files, joint, channel }: Subject): Promise<void> {
  await withPage(async ({ page }) => {
    await dropFiles(page, files);
    const name = files[0].name.replace(/\.skel$/, '');
    await page.waitForFunction((n) => window.marrow.characters()[0]?.name === n, name);
    await page
      .getByRole('treeitem', { name: new RegExp(`^${joint}`) })
      .first()
      .click();

    await keyPoseAt(page, 0, 10);
    await keyPoseAt(page, 1, 50);
    expect((await keys(page, channel)).map((k) => k.time)).toEqual([0, 1]);
    const keyed = await keys(page, channel);
    expect(keyed[1].value).toBeCloseTo((50 * Math.PI) / 180, 9);

    // A key is dragged up by hand; the character follows while the mouse is still down.
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('a');
    await page.evaluate(() => new Promise(requestAnimationFrame));
    const key = await place(page, channel, 1, keyed[1].value);
    await drag(page, key, { x: key.x, y: key.y - 30 });
    const dragged = await keys(page, channel);
    expect(dragged[1].time).toBe(1);
    expect(dragged[1].value).toBeGreaterThan(keyed[1].value + 0.01);
    expect(await dof(page, channel)).toBeCloseTo(dragged[1].value, 9);

    // Its left handle goes down, alone: the tangent is broken.
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

    // Extrapolation from the menu, on everything.
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('Control+a');
    await page.getByRole('menuitem', { name: 'Keys', exact: true }).click();
    await page.getByRole('menuitem', { name: 'Extrapolation' }).hover();
    await page.getByRole('menuitemradio', { name: 'Cycle with offset', exact: true }).click();
    const made = await animText(page);
    expect(made).toContain('extrapolate cycle_offset cycle_offset');
    const skeleton = await skelText(page);

    // All the way back, to a character without a take, and all the way forth.
    const steps = await pressAll(page, 'Control+z', 'undo');
    expect(steps).toBeGreaterThanOrEqual(7);
    expect(await page.evaluate(() => window.marrow.characters()[0]?.name)).not.toBe(name);
    expect(await pressAll(page, 'Control+Shift+z', 'redo')).toBe(steps);
    expect(await animText(page)).toBe(made);
    expect(await skelText(page)).toBe(skeleton);

    // Saved by Ctrl+S, and played by the command: the page's numbers.
    await page.evaluate(() => Object.assign(window, { showSaveFilePicker: undefined }));
    const download = page.waitForEvent('download');
    await page.locator('canvas[role=img]').focus();
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
  });
}

it('makes a take for a sample that has none', () =>
  makeTake({
    files: ['crawler.skel', 'crawler.skin'].map((name) => ({ name, bytes: readFileSync(join(SAMPLES, name)) })),
    joint: 'body',
    channel: 6,
  }));

describeShared('the wasp', () => {
  it('the wasp is animated from nothing', () =>
    makeTake({
      files: ['wasp.skel', 'wasp.skin'].map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) })),
      joint: 'head',
      channel: 6,
    }));
});
