/**
 * The sample tools on the built page, one after the other on one take: each is one step, undoing all of them restores
 * the dropped bytes, and the saved result plays in the command as on the page. And points: listed, scrubbed past what is
 * missing, cropped, and saved as .trc.
 */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { c3dOf, type PointFrame } from '../helpers/c3d.ts';
import { expectClose } from '../helpers/close.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';
import { inOnePage, startOver, undoAll } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const FRAMES = 241;
const RATE = 60;

/** Moving hips and a swinging arm, with a tenth of a degree of noise. */
function takeText(): string {
  const rows = Array.from({ length: FRAMES }, (_, f) => {
    const t = f / RATE;
    const tremble = f % 2 ? 0.1 : -0.1;
    const swing = 40 * Math.sin(2 * t) + tremble;
    return [10 * t, 90, 0, 5 * Math.sin(t), 0, 20 * t, swing, swing / 2, -swing].map((v) => v.toFixed(4)).map(Number);
  });
  return `HIERARCHY
ROOT Hips
{
\tOFFSET 0 90 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Arm
\t{
\t\tOFFSET 0 40 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 30 0 0
\t\t}
\t}
}
MOTION
Frames: ${FRAMES}
Frame Time: 0.016666666666666666
${rows.map((row) => row.join(' ')).join('\n')}
`;
}

const TAKE = takeText();
const saved = (page: Page) => page.evaluate(() => window.marrow.save('swing.bvh'));
const undoLabel = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
const run = (page: Page, id: string, args: Record<string, unknown>) =>
  page.evaluate(async ([name, given]) => void (await window.marrow.run(name, given)), [id, args] as const);

async function opened(page: Page): Promise<void> {
  await undoAll(page);
  await dropFiles(page, [{ name: 'swing.bvh', bytes: TAKE }]);
  await page.waitForFunction(() => window.marrow?.characters().some(({ name }) => name === 'swing'));
  await page.evaluate(() => window.marrow.pause());
}

/** Finds a command by name and runs it, by keyboard. */
async function find(page: Page, command: string): Promise<void> {
  await page.keyboard.press('Control+k');
  await page.getByRole('combobox', { name: 'Find a command' }).fill(command);
  await page.getByRole('option', { name: command }).first().waitFor();
  await page.keyboard.press('Enter');
}

/** Fills in a dialog and applies it, once it shows its result. */
async function applyTool(page: Page, command: string, fields: Record<string, string>, says: RegExp): Promise<void> {
  await find(page, command);
  const dialog = page.getByRole('dialog', { name: command });
  for (const [label, value] of Object.entries(fields)) await dialog.getByLabel(label).fill(value);
  await dialog.getByText(says).waitFor();
  await expect.poll(() => dialog.getByRole('button', { name: 'Apply' }).isEnabled()).toBe(true);
  await dialog.getByRole('button', { name: 'Apply' }).click();
  await dialog.waitFor({ state: 'hidden' });
}

/** Positions of hips, arm and End Site at a time. */
function points(page: Page, seconds: number): Promise<number[]> {
  return page.evaluate(async (time) => {
    window.marrow.seek(time);
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    const joints = window.marrow.worldMatrices('swing').map((world) => world.slice(12, 15));
    return [...joints, ...window.marrow.endSites('swing').map(({ position }) => position)].flat();
  }, seconds);
}

const inPage = inOnePage();

inPage(
  'crops, smooths, converts to keys and drags one of them, each a step; all undone are the bytes that were dropped',
  async ({ page }) => {
    await opened(page);
    await expect.poll(() => saved(page)).toBe(TAKE);
    const steps: (string | undefined)[] = [await undoLabel(page)];
    const texts: string[] = [await saved(page)];
    const stepMade = async () => {
      // The mouse release may not have been processed yet.
      await page.waitForFunction((before) => window.marrow.steps().undo !== before, steps.at(-1));
      const label = await undoLabel(page);
      steps.push(label);
      texts.push(await saved(page));
      expect(texts.at(-1)).not.toBe(texts.at(-2));
    };

    await run(page, 'samples.crop', { from: 0.5, to: 3.5 });
    await stepMade();
    expect(texts.at(-1)).toContain('Frames: 181');

    await applyTool(page, 'Smooth samples', { 'Width (σ)': '0.04' }, /Hz is halved/);
    await stepMade();

    const smooth = await points(page, 1);
    await applyTool(page, 'Convert to keys', { 'Position tolerance': '0.05', 'Rotation tolerance': '0.2' }, /to 1\./);
    await stepMade();
    expectClose(
      (await points(page, 1)).map((v) => v / 0.05),
      smooth.map((v) => v / 0.05),
      1,
    );
    await expect.poll(() => page.evaluate(() => window.marrow.keys(6).length)).toBeGreaterThan(2);
    await expect.poll(() => page.evaluate(() => window.marrow.keys(6).length)).toBeLessThan(90);

    // The arm's first angle: drags a key in the middle of the take upwards.
    await page.getByRole('treeitem', { name: 'Arm' }).click();
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('a');
    // Keys are hit where they were last drawn.
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    const before = await page.evaluate(() => window.marrow.keys(6));
    const { time, value } = before[Math.floor(before.length / 2)];
    const at = await page.evaluate(([t, v]) => window.marrow.placeOf(6, t, v), [time, value] as const);
    if (!at) throw new Error('The curve editor does not show the arm.');
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x, at.y - 20, { steps: 4 });
    await page.mouse.up();
    await stepMade();
    const after = await page.evaluate(() => window.marrow.keys(6));
    expect(after.some((key, k) => key.value !== before[k]?.value)).toBe(true);

    for (let step = texts.length - 2; step >= 0; step--) {
      await page.keyboard.press('Control+z');
      await expect.poll(() => undoLabel(page)).toBe(steps[step]);
      await expect.poll(() => saved(page)).toBe(texts[step]);
    }
    await expect.poll(() => saved(page)).toBe(TAKE);
    for (let step = 1; step < texts.length; step++) {
      await page.keyboard.press('Control+Shift+z');
      await expect.poll(() => saved(page)).toBe(texts[step]);
    }
  },
);

inPage('turns a take around and back to the very numbers', async ({ page }) => {
  await opened(page);
  await find(page, 'Reverse');
  await expect.poll(() => undoLabel(page)).toBe('Reverse swing');
  await expect.poll(() => saved(page)).not.toBe(TAKE);
  await find(page, 'Reverse');
  await expect.poll(() => saved(page)).toBe(TAKE);
});

inPage('saves a trimmed and resampled take, which plays in the command as on the page', async ({ page }) => {
  await opened(page);
  await page.evaluate(() => window.marrow.seek(1));
  await run(page, 'samples.trim', { side: 'start', timeSeconds: 1 });
  await applyTool(page, 'Resample samples', { 'Frames per second': '24' }, /181 → 73 frames/);
  const text = await saved(page);
  expect(text).toContain('Frames: 73');
  const folder = mkdtempSync(join(tmpdir(), 'marrow-samples-'));
  try {
    writeFileSync(join(folder, 'swing.bvh'), text);
    for (const frame of [0, 1, 40, 72]) {
      const pose = await commandJson<PoseJson>(['pose', 'swing.bvh', '--frame', String(frame)], folder);
      const [{ joints, endSites = [] }] = pose.characters;
      const played = [
        ...joints.map(({ world }) => world.slice(12, 15)),
        ...endSites.map(({ position }) => position),
      ].flat();
      expectClose(played, await points(page, 1 + frame / 24), 1e-9);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});

const POINT_FRAMES = Array.from(
  { length: 20 },
  (_, f): PointFrame => [[100 + f, 1000, 3], f >= 5 && f < 10 ? null : [4, 500 + f, -6.5], [7, 20, f]],
);
const WALK = c3dOf({ labels: ['LASI', 'Left knee', 'LHEE'], frames: POINT_FRAMES });

const namesIn = (page: Page) => page.evaluate(() => window.marrow?.characters().map(({ name }) => name));
const placeOf = (page: Page, seconds: number) =>
  page.evaluate((time) => {
    window.marrow.seek(time);
    return window.marrow.worldMatrices()[0].slice(12, 15);
  }, seconds);

inPage(
  'points are listed with their positions, hidden where they are missing, cropped, and saved as .trc',
  async ({ page, download }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.c3d', bytes: WALK }]);
    await expect.poll(() => namesIn(page)).toEqual(['walk']);
    await expect.poll(() => placeOf(page, 0.1)).toEqual([110, 1000, 3]);
    await page.getByRole('treeitem', { name: /^Points/ }).waitFor();
    await page.getByRole('treeitem', { name: /^Left knee/ }).click();
    const details = page.locator('.facts');
    await expect.poll(() => details.textContent()).toContain('510.000');
    await expect.poll(() => placeOf(page, 0.07)).toEqual([107, 1000, 3]);
    await expect.poll(() => details.textContent()).toContain('missing in this frame');

    await page.evaluate(() => {
      Reflect.deleteProperty(window, 'showSaveFilePicker');
      return window.marrow.run('samples.crop', { from: 0.04, to: 0.06 });
    });
    const saved = await download(() => page.evaluate(() => window.marrow.run('save.trc')));
    expect(saved.name).toBe('walk.trc');
    expect(saved.text.split('\n').slice(3, 9)).toEqual([
      'Frame#\tTime\tLASI\t\t\tLeft knee\t\t\tLHEE\t\t',
      '\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3',
      '',
      '1\t0\t104\t1000\t3\t4\t504\t-6.5\t7\t20\t4',
      '2\t0.01\t105\t1000\t3\t\t\t\t7\t20\t5',
      '3\t0.02\t106\t1000\t3\t\t\t\t7\t20\t6',
    ]);

    const refused = await page.evaluate(async () => {
      try {
        await window.marrow.run('save.bvh');
        return 'saved';
      } catch (error) {
        return String(error);
      }
    });
    expect(refused).toContain('not available');
  },
);

inPage('a table of points is a take, and another one is compared', async ({ page }) => {
  await startOver(page);
  await dropFiles(page, [{ name: 'rows.csv', bytes: 'time,a.x,a.y,a.z\n0,1,2,3\n0.5,2,2,3\n' }]);
  await expect.poll(() => namesIn(page)).toEqual(['rows']);
  await dropFiles(page, [{ name: 'numbers.csv', bytes: '1,2,3\n' }]);
  await expect.poll(() => page.locator('.compare').count()).toBeGreaterThan(0);
});
