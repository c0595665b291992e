/**
 * Layers, as someone works with them: a wave over the walk and a corrected capture by mouse, and their files. And a pose
 * keyed for a moment over a walk and over a capture, as someone does who is told nothing.
 */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { kept, ready, restore } from './checks/autosave.ts';
import { drawn, onPage, standing, undoLabel } from './checks/ik.ts';
import { dofsAt, place, shown } from './checks/limb-drag.ts';

const layers = (page: Page) => page.evaluate(() => window.marrow.layers());
const list = (page: Page) => page.getByRole('grid', { name: /^Layers of / });
const row = (page: Page, name: string) => list(page).getByRole('row').filter({ hasText: name });
const saved = (page: Page, name: string) => page.evaluate((wanted) => window.marrow.save(wanted), name);
const openTakes = (page: Page) => page.evaluate(() => window.marrow.run('page.tab.takes'));

function expectSame(is: readonly (readonly number[])[], was: readonly (readonly number[])[]): void {
  is.flat().forEach((value, i) => {
    expect(value).toBeCloseTo(was.flat()[i], 9);
  });
}

async function front(page: Page, time: number): Promise<void> {
  await page.evaluate(async (seconds) => {
    window.marrow.pause();
    window.marrow.seek(seconds);
    await window.marrow.run('view.front');
  }, time);
  await standing(page);
}

/** Drags a joint by the mouse, from a point of it. */
async function drag(page: Page, name: string, point: readonly [number, number, number], by: readonly [number, number]) {
  const now = await shown(page);
  const at = await onPage(page, place(now, now.names.indexOf(name), point));
  await page.mouse.move(at.x, at.y);
  await drawn(page);
  await page.mouse.down();
  await page.mouse.move(at.x + by[0], at.y + by[1], { steps: 4 });
  await drawn(page);
  await page.mouse.up();
}

/** Undoes steps until that one is the last. */
async function undoTo(page: Page, label: string | undefined): Promise<void> {
  while ((await undoLabel(page)) !== label) await page.evaluate(() => window.marrow.undo());
}

const walker = (page: Page) => page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');

const inPage = inOnePage({ walking: true });

inPage(
  'a wave is laid over the walk by mouse and eased, the walk goes on as it was, and undo is to the byte',
  async ({ page }) => {
    await startOver(page);
    await walker(page);
    await front(page, 2.9);
    const away = [0, 0.4, 1.3, 2.4, 3.4, 4.7, 6.4];
    const before = await dofsAt(page, away, 2.9);
    const text = await saved(page, 'walker_walk.anim');
    const opened = await undoLabel(page);
    await openTakes(page);
    await page.getByRole('button', { name: '+ Layer' }).click();
    await row(page, 'layer').waitFor();
    await expect.poll(() => row(page, 'layer').getAttribute('aria-selected')).toBe('true');
    await page.getByRole('button', { name: 'Take walker_walk, layer layer' }).waitFor();
    await drag(page, 'hand_l', [0.07, 0, 0], [30, -90]);
    const posed = (await shown(page)).dofs;
    await page.keyboard.press('k');
    await page.getByText(/^This is the layer’s only key of/).waitFor();
    await page.getByRole('button', { name: 'Key for a moment…' }).click();
    const dialog = page.getByRole('dialog', { name: 'Key for a moment' });
    await dialog.getByRole('button', { name: 'Key', exact: true }).press('Enter');
    await dialog.waitFor({ state: 'detached' });
    await expect.poll(() => undoLabel(page)).toMatch(/^Key .* for a moment$/);
    expectSame([(await shown(page)).dofs], [posed]);
    expectSame(await dofsAt(page, away, 2.9), before);
    // The base is what it was, and the plain file has the wave.
    await expect.poll(() => saved(page, 'walker_walk.base.anim')).toBe(text);
    await expect.poll(() => saved(page, 'walker_walk.anim')).not.toBe(text);

    // Muted by its button, and heard again; half of it by its weight.
    await page.getByRole('button', { name: 'Mute layer' }).click();
    await expect.poll(async () => (await layers(page))[0].mute).toBe(true);
    expectSame(await dofsAt(page, away, 2.9), before);
    await page.evaluate(() => window.marrow.undo());
    const weight = page.getByRole('slider', { name: 'Weight of layer' });
    const box = await weight.boundingBox();
    if (!box) throw new Error('The weight is not shown.');
    await page.mouse.move(box.x + box.width - 8, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 5 });
    await page.mouse.up();
    await expect.poll(async () => Math.abs((await layers(page))[0].weight - 0.5)).toBeLessThan(0.06);
    await expect.poll(() => undoLabel(page)).toBe('Set layer layer');

    // A name in place, another layer, and its place by drag and by keys.
    await row(page, 'layer').dblclick({ position: { x: 40, y: 10 } });
    const name = page.getByRole('textbox', { name: 'Name of the layer' });
    await name.fill('wave');
    await name.press('Enter');
    await row(page, 'wave').waitFor();
    await page.getByRole('button', { name: '+ Layer' }).click();
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['wave', 'layer']);
    const [top, below] = [await row(page, 'layer').boundingBox(), await row(page, 'wave').boundingBox()];
    if (!top || !below) throw new Error('The rows are not shown.');
    await page.mouse.move(top.x + 40, top.y + top.height / 2);
    await page.mouse.down();
    await page.mouse.move(top.x + 40, below.y + below.height - 2, { steps: 6 });
    await page.mouse.up();
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['layer', 'wave']);
    await list(page).focus();
    await page.keyboard.press('Alt+ArrowUp');
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['wave', 'layer']);
    await page.keyboard.press('Delete');
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['wave']);

    await undoTo(page, opened);
    await expect.poll(() => saved(page, 'walker_walk.anim')).toBe(text);
    await expect.poll(() => layers(page)).toEqual([]);
  },
);

inPage('a capture’s leg is raised by a layer through the whole take, and its frames stay', async ({ page }) => {
  await startOver(page);
  await dropFiles(page, [{ name: 'take.bvh', bytes: OWN_CAPTURES.get('own-walk.bvh') ?? '' }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'take');
  await front(page, 0.5);
  const times = [0, 0.5, 1, 1.9];
  const before = await dofsAt(page, times, 0.5);
  const text = await saved(page, 'take.bvh');
  const opened = await undoLabel(page);
  await openTakes(page);
  await page.getByRole('button', { name: '+ Layer' }).click();
  await row(page, 'layer').waitFor();
  await drag(page, 'LeftFoot', [0, 0, 0], [30, -40]);
  await page.keyboard.press('k');
  await expect.poll(() => undoLabel(page)).toMatch(/^Key /);
  const after = await dofsAt(page, times, 0.5);
  const raised = after[1].map((value, dof) => value - before[1][dof]);
  expect(raised.filter((by) => Math.abs(by) > 0.1).length).toBeGreaterThan(0);
  // The same through the take, but where limits stop it.
  expectSame(
    after,
    before.map((dofs) => dofs.map((value, dof) => value + raised[dof])),
  );
  // One of them refuses where it has no part, and is named.
  await page.getByRole('button', { name: 'Mute layer' }).click();
  await expect.poll(async () => (await layers(page))[0].mute).toBe(true);
  await drag(page, 'LeftFoot', [0, 0, 0], [10, -20]);
  await page.keyboard.press('k');
  await page.locator('.message-text', { hasText: 'The layer "layer" is muted: keys there would not show' }).waitFor();
  await undoTo(page, opened);
  await expect.poll(() => saved(page, 'take.bvh')).toBe(text);
  expectSame(await dofsAt(page, times, 0.5), before);
});

function expectSameDofs(is: readonly number[], was: readonly number[], digits = 9): void {
  is.forEach((value, dof) => {
    expect(value).toBeCloseTo(was[dof], digits);
  });
}

inPage(
  'a hand dragged up and keyed waves for a moment of the walk, which goes on as it was, and a script does the same',
  async ({ page }) => {
    await startOver(page);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
    await page.evaluate(async () => {
      window.marrow.pause();
      window.marrow.seek(2.9);
      await window.marrow.run('view.front');
    });
    await standing(page);
    const away = [0, 0.4, 1.3, 2.1, 2.4, 2.5, 3.2, 3.6, 4.7, 6.4];
    const before = await dofsAt(page, away, 2.9);
    const walked = (await shown(page)).dofs;
    await drag(page, 'hand_l', [0.07, 0, 0], [30, -90]);
    const posed = (await shown(page)).dofs;
    const dialog = page.getByRole('dialog', { name: 'Key outside the cycle' });
    // From the inspector, where the focus is again once it is closed.
    await page.getByRole('textbox', { name: /^rx\b/ }).first().focus();
    await page.keyboard.press('Enter');
    await page.keyboard.press('k');
    await dialog.waitFor();
    await page.keyboard.press('Escape');
    await dialog.waitFor({ state: 'detached' });
    const focused = () => page.evaluate(() => document.activeElement?.getAttribute('data-region'));
    await expect.poll(focused).toBe('inspector');
    // By the word that one would look for.
    await page.keyboard.press('Control+k');
    await page.getByRole('combobox', { name: 'Find a command' }).fill('wave');
    await page.getByRole('option', { name: 'Key for a moment…' }).waitFor();
    await page.keyboard.press('Enter');
    await page.getByRole('dialog', { name: 'Key for a moment' }).waitFor();
    await page.keyboard.press('Escape');
    await expect.poll(() => page.getByRole('dialog').count()).toBe(0);
    await page.keyboard.press('k');
    await dialog.getByText(/so it comes once every 6.4\u00a0s/).waitFor();
    // The ring of the first answer, which has the focus, isn't below the dialog's head.
    const first = dialog.getByRole('button', { name: 'For a moment' });
    await expect.poll(() => first.evaluate((card) => card.matches(':focus-visible'))).toBe(true);
    const ring = await first.evaluate((card) => {
      const { outlineOffset, outlineWidth } = getComputedStyle(card);
      return Number.parseFloat(outlineOffset) + Number.parseFloat(outlineWidth);
    });
    expect(ring).toBeLessThanOrEqual(0);
    const easeIn = dialog.getByRole('textbox', { name: 'Ease in, seconds' });
    // A refused number applies nothing.
    await easeIn.fill('0');
    await easeIn.press('Enter');
    await page.locator('.message-text', { hasText: 'Ease in must be at least 0.001 s.' }).waitFor();
    await easeIn.fill('0.4');
    await easeIn.press('Enter');
    await dialog.waitFor({ state: 'detached' });
    await expect.poll(() => undoLabel(page)).toMatch(/^Key .* for a moment$/);
    expectSameDofs((await shown(page)).dofs, posed, 12);
    const after = await dofsAt(page, away, 2.9);
    after.forEach((dofs, i) => {
      expectSameDofs(dofs, before[i]);
    });
    // No jump between two frames.
    const frames = await dofsAt(
      page,
      Array.from({ length: 31 }, (_, i) => 2.4 + i / 30),
      2.9,
    );
    const arm = posed.findIndex((value, dof) => Math.abs(value - walked[dof]) > 0.5);
    const most = Math.max(...frames.map((dofs) => Math.abs(dofs[arm] - frames[0][arm])));
    frames.forEach((dofs, i) => {
      if (i > 0) expect(Math.abs(dofs[arm] - frames[i - 1][arm])).toBeLessThan(0.35 * most);
    });

    // What the page did, a script does: the same text.
    const save = () => page.evaluate(() => window.marrow.save('walker_walk.anim'));
    const saved = await save();

    // Its ends are on the ruler: dragged, the moment is eased over another time, in the same step.
    const end = page.getByRole('slider', { name: 'Ease in' });
    const eased = () => end.getAttribute('aria-valuenow').then(Number);
    await expect.poll(eased).toBeCloseTo(0.4, 9);
    const box = await end.boundingBox();
    const other = await page.getByRole('slider', { name: 'Ease out' }).boundingBox();
    if (!box || !other) throw new Error('The band is not shown.');
    const perPixel = 0.7 / (other.x - box.x);
    const grip = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    // Beside an end the ruler is pressed, also where its label is; and a click on an end goes there too.
    const ruler = page.getByRole('slider', { name: 'Time', exact: true });
    const time = () => ruler.getAttribute('aria-valuenow').then(Number);
    for (const [by, y] of [
      [8, grip.y],
      [12, box.y - 5],
      [0, grip.y],
    ] as const) {
      await page.mouse.move(grip.x, grip.y);
      await page.mouse.move(grip.x + by, y);
      await page.mouse.down();
      await page.mouse.up();
      await expect.poll(async () => Math.abs((await time()) - 2.5 - by * perPixel)).toBeLessThan(1 / 59);
      await page.evaluate(() => window.marrow.seek(2.9));
    }
    await expect.poll(save).toEqual(saved);
    const pull = async (by: number) => {
      await page.mouse.move(grip.x, grip.y);
      await page.mouse.down();
      await page.mouse.move(grip.x + by, grip.y, { steps: 3 });
      await drawn(page);
    };
    await pull(-60);
    await expect.poll(eased).toBeGreaterThan(0.6);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await expect.poll(save).toEqual(saved);
    await expect.poll(eased).toBeCloseTo(0.4, 9);
    await pull(-60);
    await page.mouse.up();
    const longer = await eased();
    expect(longer * 30).toBeCloseTo(Math.round(longer * 30), 9);
    await expect.poll(async () => (await dofsAt(page, [2.4], 2.9))[0][arm]).not.toBeCloseTo(before[4][arm], 3);
    expectSameDofs((await shown(page)).dofs, posed, 12);
    await expect.poll(() => undoLabel(page)).toMatch(/^Key .* for a moment$/);
    // By keyboard, a frame a press.
    await end.press('ArrowRight');
    await expect.poll(eased).toBeCloseTo(longer - 1 / 30, 9);
    await end.press('ArrowLeft');
    const again = await save();
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(() => end.count()).toBe(0);
    expectSameDofs((await dofsAt(page, [2.4], 2.9))[0], before[4]);
    await page.evaluate(async (easeIn) => {
      await window.marrow.run('keys.forMoment', { easeIn, easeOut: 0.3, playedRange: [0, 6.4] });
    }, longer);
    await expect.poll(save).toEqual(again);
    await page.evaluate(() => window.marrow.undo());
    await page.evaluate(async () => {
      await window.marrow.run('keys.forMoment', { easeIn: 0.4, easeOut: 0.3, playedRange: [0, 6.4] });
    });
    await expect.poll(save).toEqual(saved);
  },
);

describeShared('a moment of a capture', () => {
  inPage('frames around it are offset and no others, in one step that undo takes back', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walk');
    const time = 120 * 0.0083333;
    await page.evaluate(async (frame) => {
      window.marrow.pause();
      window.marrow.seek(frame);
      await window.marrow.run('view.front');
    }, time);
    await standing(page);
    const away = [0, 0.5, 0.69, 1.31, 2];
    const before = await dofsAt(page, away, time);
    await drag(page, 'LeftHand', [0, 0, 0], [-20, -40]);
    const posed = (await shown(page)).dofs;
    await page.keyboard.press('k');
    await page.getByRole('button', { name: 'Convert to keys and key' }).waitFor();
    await page.getByRole('button', { name: 'Key for a moment…' }).click();
    const dialog = page.getByRole('dialog', { name: 'Key for a moment' });
    // The last one is kept.
    await dialog.getByRole('textbox', { name: 'Ease in, seconds' }).fill('0.3');
    await dialog.getByRole('button', { name: 'Key', exact: true }).press('Enter');
    await dialog.waitFor({ state: 'detached' });
    await expect.poll(() => undoLabel(page)).toMatch(/^Key .* for a moment$/);
    expectSameDofs((await shown(page)).dofs, posed);
    await expect.poll(() => dofsAt(page, away, time)).toEqual(before);
  });
});

const NAMES = ['walker_walk.base.anim', 'walker_walk.arm.anim', 'walker_walk.anim', 'walker_walk.layers.json'];

/** The last: what is restored stays. */
inPage(
  'files of layers are opened, come back after a reload, and are kept where the plain file was edited since',
  async ({ page }) => {
    await startOver(page);
    await walker(page);
    const opened = await undoLabel(page);
    await page.evaluate(async () => {
      window.marrow.pause();
      window.marrow.seek(0.5);
      await window.marrow.run('layers.add', { name: 'arm' });
      await window.marrow.run('pose.setDofs', { dofs: [{ index: 40, value: 0.6 }], key: {} });
    });
    const files = await page.evaluate(
      (names) => Promise.all(names.map(async (name) => ({ name, bytes: await window.marrow.save(name) }))),
      NAMES,
    );
    const skel = { name: 'walker.skel', bytes: await saved(page, 'walker.skel') };
    // Without the morphs, whose files are not among those.
    const joints = 3 + 3 * (await page.evaluate(() => window.marrow.characters()[0].joints.length));
    const moved = (await dofsAt(page, [0.2, 0.5, 2], 0.5)).map((dofs) => dofs.slice(0, joints));
    await undoTo(page, opened);
    await expect.poll(() => layers(page)).toEqual([]);

    await dropFiles(page, [skel, ...files]);
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['arm']);
    expectSame(await dofsAt(page, [0.2, 0.5, 2], 0.5), moved);
    await page.evaluate(() => window.marrow.run('layers.set', { layer: 0, weight: 0.25 }));
    const light = await dofsAt(page, [0.2, 0.5, 2], 0.5);
    await kept(page);
    await page.reload();
    await ready(page);
    await restore(page);
    await expect.poll(async () => (await layers(page)).map((layer) => layer.weight)).toEqual([0.25]);
    expectSame(await dofsAt(page, [0.2, 0.5, 2], 0.5), light);

    const edited = files.map((file) =>
      file.name === 'walker_walk.anim' ? { ...file, bytes: `${file.bytes}\n` } : file,
    );
    await dropFiles(page, [skel, ...edited]);
    await page
      .getByText(/^walker_walk.anim was edited since it was saved with its layers/)
      .first()
      .waitFor();
    await expect.poll(() => layers(page)).toEqual([]);
    await page.getByRole('button', { name: 'Keep the layers' }).first().click();
    await expect.poll(async () => (await layers(page)).map((layer) => layer.name)).toEqual(['arm']);
  },
);
