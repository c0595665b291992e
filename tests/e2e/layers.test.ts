/** Layers, as someone works with them: a wave over the walk and a corrected capture by mouse, and their files. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { dropFiles } from '../helpers/page.ts';
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

const NAMES = ['walker_walk.base.anim', 'walker_walk.arm.anim', 'walker_walk.anim', 'walker_walk.layers.json'];

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
