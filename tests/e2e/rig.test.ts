/**
 * Rigging by mouse and keyboard: a creature from scratch, named, mirrored, constrained, saved, read back and undone;
 * and a skin that stays in place while its joints are moved, or follows.
 */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { inOnePage, startOver, undoAll } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

/** Maximum motion of vertices in bind mode, as a part of the character's size. */
const STILL = 1e-9;

const joints = (page: Page) =>
  page.evaluate(() => (window.marrow.characters()[0]?.joints ?? []).map((j) => `${j.name} ${j.parent}`));
const vertices = (page: Page) => page.evaluate(() => window.marrow.vertices());
const text = (page: Page, name: string) => page.evaluate((n) => window.marrow.save(n), name);

async function canvasMiddle(page: Page): Promise<{ x: number; y: number }> {
  const box = await page.locator('.viewport canvas[role=application]').boundingBox();
  if (!box) throw new Error('There is no viewport.');
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Clicks relative to the centre of the viewport; waits for that many joints. */
async function clickAt(page: Page, dx: number, dy: number, count: number): Promise<void> {
  const { x, y } = await canvasMiddle(page);
  await page.mouse.move(x + dx, y + dy);
  await page.mouse.click(x + dx, y + dy);
  await page.waitForFunction((n) => window.marrow.characters()[0]?.joints.length === n, count);
}

/** Finds the middle of a handle by moving the pointer until the cursor changes; retries until they are drawn. */
async function findHandle(page: Page): Promise<{ x: number; y: number }> {
  const found = await page.waitForFunction(() => {
    const canvas = document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]');
    if (!canvas) return undefined;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const isHandle = (clientX: number, clientY: number) => {
      canvas.dispatchEvent(new PointerEvent('pointermove', { clientX, clientY, bubbles: true, isPrimary: true }));
      return canvas.style.cursor === 'move';
    };
    for (let y = top + 0.35 * height; y < top + height - 20; y += 5) {
      for (let x = left + 0.2 * width; x < left + 0.8 * width; x += 5) {
        if (!isHandle(x, y)) continue;
        // The scan meets it at an edge; handles of the box are close to it once it is selected.
        const reach = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
        const middleOf = (at: (offset: number) => boolean) =>
          (reach.filter((d) => at(d)).length - reach.filter((d) => at(-d)).length) / 2;
        const middle = y + middleOf((dy) => isHandle(x, y + dy));
        return { x: x + middleOf((dx) => isHandle(x + dx, middle)), y: middle };
      }
    }
    return undefined;
  });
  const point = await found.jsonValue();
  if (!point) throw new Error('There is no handle in the viewport.');
  return point;
}

async function drag(page: Page, from: { x: number; y: number }, dx: number, dy: number): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (const part of [0.25, 0.5, 0.75, 1]) await page.mouse.move(from.x + part * dx, from.y + part * dy);
  await page.mouse.up();
}

declare global {
  interface Window {
    /** Gives back the frames that a test holds. */
    releaseFrames(): void;
  }
}

const inPage = inOnePage();

inPage('builds a creature from nothing by clicking, and takes all of it back', async ({ page }) => {
  await startOver(page);
  const before = await joints(page);
  await page.getByRole('menuitem', { name: 'Rig', exact: true }).click();
  await page.getByRole('menuitem', { name: /^New skeleton/ }).click();
  await page.getByRole('button', { name: 'Add joints', pressed: true }).waitFor();
  // Up the spine; back to the root, and down a leg.
  await clickAt(page, 0, -40, 2);
  await clickAt(page, 0, -80, 3);
  await clickAt(page, 0, 0, 3);
  await clickAt(page, 40, 30, 4);
  await clickAt(page, 45, 90, 5);
  await expect.poll(() => joints(page)).toEqual(['root -1', 'joint1 0', 'joint2 1', 'joint3 0', 'joint4 3']);
  // Escape ends adding, but not the mode.
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Add joints', pressed: false }).waitFor();
  await expect
    .poll(() => page.getByRole('radio', { name: 'Rig', exact: true }).getAttribute('aria-checked'))
    .toBe('true');

  await clickAt(page, 40, 30, 5);
  await page.getByText('Rig: joint3').waitFor();
  await page.keyboard.press('F2');
  await page.keyboard.type('leg_l');
  await page.keyboard.press('Enter');
  await page.getByText('Rig: leg_l').waitFor();
  await page.getByRole('combobox', { name: 'Type' }).selectOption({ label: 'Hinge' });
  await page.getByRole('button', { name: 'Axis along z' }).click();
  const lower = page.getByRole('textbox', { name: 'Lower limit of r' });
  await lower.fill('-30');
  await lower.press('Enter');
  await page.getByRole('textbox', { name: 'Offset x' }).fill('0.25');
  await page.getByRole('textbox', { name: 'Offset x' }).press('Enter');
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('Shift+M');
  await page.waitForFunction(() => window.marrow.characters()[0]?.joints.length === 7);

  const saved = await text(page, 'creature.skel');
  const { value, diagnostics } = readSkel(saved, 'creature.skel');
  expect(diagnostics).toEqual([]);
  const read = value?.[0].joints ?? [];
  expect(read.map((j) => `${j.name} ${j.parent}`)).toEqual(await joints(page));
  const [left, right] = ['leg_l', 'leg_r'].map((name) => read.find((j) => j.name === name));
  expect(left).toMatchObject({ motion: { kind: 'hinge', axis: [0, 0, 1] } });
  expect(left?.offset[0]).toBe(0.25);
  expect(left?.limits[0].min).toBeCloseTo(-Math.PI / 6, 12);
  expect(right?.offset[0]).toBe(-0.25);

  await undoAll(page);
  await expect.poll(() => joints(page)).toEqual(before);
});

inPage('adds a child with Ctrl, and removes a joint with Delete so that its children stay', async ({ page }) => {
  await startOver(page);
  await page.evaluate(() => window.marrow.run('rigging.new'));
  await page.getByRole('button', { name: 'Add joints', pressed: true }).waitFor();
  await clickAt(page, 60, 0, 2);
  await page.keyboard.press('Escape');
  await page.keyboard.down('Control');
  await clickAt(page, 120, 0, 3);
  await page.keyboard.up('Control');
  const tip = await page.evaluate(() => window.marrow.worldMatrices()[2].slice(12, 15));
  await clickAt(page, 60, 0, 3);
  await page.keyboard.press('Delete');
  await page.waitForFunction(() => window.marrow.characters()[0]?.joints.length === 2);
  await expect.poll(() => joints(page)).toEqual(['root -1', 'joint2 0']);
  const stayed = await page.evaluate(() => window.marrow.worldMatrices()[1].slice(12, 15));
  stayed.forEach((part, k) => {
    expect(Math.abs(part - tip[k])).toBeLessThan(STILL);
  });
});

/** Scene length of a CSS pixel where a new skeleton starts. */
async function unitsPerPixel(page: Page): Promise<number> {
  const box = await page.locator('.viewport canvas[role=application]').boundingBox();
  return (2 * 5 * Math.tan((16 * Math.PI) / 180)) / (box?.height ?? 1);
}

/** A joint's offset, from the saved file. */
async function offsetOf(page: Page, joint: number): Promise<readonly number[]> {
  const saved = await text(page, 'character.skel');
  return readSkel(saved, 'character.skel').value?.[0].joints[joint].offset ?? [];
}

/** Waits until there is a handle at a point of the page. */
const handleAt = (page: Page, clientX: number, clientY: number) =>
  page.waitForFunction(
    (at) => {
      const canvas = document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]');
      canvas?.dispatchEvent(new PointerEvent('pointermove', { ...at, bubbles: true, isPrimary: true, buttons: 0 }));
      return canvas?.style.cursor === 'move';
    },
    { clientX, clientY },
  );

inPage('takes hold of the copy that was clicked, and frames that', async ({ page }) => {
  await startOver(page);
  await page.evaluate(() => window.marrow.run('rigging.new'));
  await page.getByRole('button', { name: 'Add joints', pressed: true }).waitFor();
  await page.keyboard.press('Escape');
  const perPixel = await unitsPerPixel(page);
  const aside = Math.round(1 / perPixel);
  const at = [aside * perPixel, 0, 0] as const;
  await page.evaluate((position) => {
    const [{ id }] = window.marrow.characters();
    window.marrow.run('character.addCopy', { characterId: id, placement: { position, turn: [0, 0, 0], scale: 1 } });
  }, at);
  const { x, y } = await canvasMiddle(page);
  const lifted = async (to: number) => {
    const [, now] = await offsetOf(page, 0);
    expect(now).toBeCloseTo(to, 1);
  };
  await page.evaluate(() => window.marrow.run('rigging.snapToGrid'));
  // Without a preceding click, and with one.
  await lifted(1);
  await drag(page, { x: x + aside, y }, 0, -40);
  await lifted(1 + 40 * perPixel);
  await page.mouse.click(x + aside, y - 40);
  await drag(page, { x: x + aside, y: y - 40 }, 0, 40);
  await lifted(1);
  await page.keyboard.press('f');
  // In the centre now, where only that instance's handles are.
  await handleAt(page, x, y);
  await page.evaluate(() =>
    window.marrow.run('character.removeCopy', { characterId: window.marrow.characters()[0].id, index: 1 }),
  );
  await page.mouse.move(x + 1, y);
  await page.waitForFunction(
    () => document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]')?.style.cursor !== 'move',
  );
  // On again.
  await page.evaluate(() => window.marrow.run('rigging.snapToGrid'));
});

/** A closed box about [0, 0, 0.5], 0.4 deep, without a skeleton. */
function boxSkin(): string {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? 0.4 : -0.4, i & 2 ? 1 : -1, i & 4 ? 0.7 : 0.3]);
  const sides = ['0 2 1  1 2 3', '4 5 6  5 7 6', '0 1 4  1 5 4', '2 6 3  3 6 7', '0 4 2  2 4 6', '1 3 5  3 7 5'];
  return `positions 8 { ${corners.flat().join(' ')} }
normals 8 { ${corners.map(() => '0 0 1').join('  ')} }
triangles 12 { ${sides.join('  ')} }
`;
}

inPage('offers a new skeleton for a skin without one, and puts joints into the middle of it', async ({ page }) => {
  await startOver(page);
  await dropFiles(page, [{ name: 'box.skin', bytes: boxSkin() }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 8);
  await page.evaluate(() => window.marrow.run('view.front'));
  // That its floor is below 0 is said too, and doesn't hide the offer.
  await page.locator('.message-line').getByRole('button', { name: 'New skeleton' }).click();
  await page.getByRole('button', { name: 'Add joints', pressed: true }).waitFor();
  const places = () => page.evaluate(() => window.marrow.worldMatrices().map((world) => world.slice(12, 15)));
  await expect.poll(places).toEqual([[0, 0, 0.5]]);
  await clickAt(page, 20, -50, 2);
  const [, [x, y, z]] = await places();
  expect(x).toBeGreaterThan(0.02);
  expect(y).toBeGreaterThan(0.1);
  expect(z).toBeCloseTo(0.5, 2);
});

inPage('puts a new skeleton into the middle of the picture, however full that is', async ({ page }) => {
  await startOver(page);
  for (let i = 0; i < 3; i++) await page.evaluate(() => window.marrow.run('rigging.new'));
  await page.waitForFunction(() => window.marrow.characters().length === 3);
  const { x, y } = await canvasMiddle(page);
  await handleAt(page, x, y);
  const perPixel = await unitsPerPixel(page);
  const placeOf = (joint: number) =>
    page.evaluate((j) => (window.marrow.worldMatrices(2)[j] ?? []).slice(12, 14), joint);
  // Shift switches the grid off.
  await page.keyboard.down('Shift');
  await page.mouse.click(x, y - 40);
  await page.keyboard.up('Shift');
  const [right, up] = await placeOf(1);
  expect(right).toBeCloseTo(0, 2);
  expect(up).toBeCloseTo(1 + 40 * perPixel, 2);
  await page.mouse.click(x + 67, y - 90);
  const snapped = await placeOf(2);
  expect(Math.abs(snapped[0] - 67 * perPixel)).toBeLessThan(0.11);
  for (const part of snapped) expect(10 * part).toBeCloseTo(Math.round(10 * part), 6);
});

inPage('lets a click on a joint branch, however quickly it comes after another', async ({ page }) => {
  await startOver(page);
  await page.evaluate(() => window.marrow.run('rigging.new'));
  await page.getByRole('button', { name: 'Add joints', pressed: true }).waitFor();
  await clickAt(page, 0, -40, 2);
  const { x, y } = await canvasMiddle(page);
  // Input is faster than frames, which come afterwards.
  await page.evaluate(() => {
    const { requestAnimationFrame } = window;
    const held: FrameRequestCallback[] = [];
    window.requestAnimationFrame = (draw) => held.push(draw);
    window.releaseFrames = () => {
      window.requestAnimationFrame = requestAnimationFrame;
      for (const draw of held) requestAnimationFrame(draw);
    };
  });
  await page.mouse.click(x + 60, y - 80);
  await page.mouse.click(x, y);
  await page.mouse.click(x - 60, y + 40);
  await expect.poll(() => joints(page)).toEqual(['root -1', 'joint1 0', 'joint2 1', 'joint3 0']);
  await page.evaluate(() => window.releaseFrames());
});

inPage('comes to the side that a key asked for, though a click falls on the way', async ({ page }) => {
  await startOver(page);
  const { x, y } = await canvasMiddle(page);
  await page.locator('.viewport canvas[role=application]').focus();
  /** Until the view is along an axis: its arm in the axis widget is then a point. */
  const looksAlong = (axis: 0 | 2) =>
    page.waitForFunction((which) => {
      const arm = document.querySelectorAll('[aria-label="Look along an axis"] line')[which];
      return Math.hypot(Number(arm.getAttribute('x2')), Number(arm.getAttribute('y2'))) < 0.1;
    }, axis);
  await page.keyboard.press('1');
  await looksAlong(2);
  await page.keyboard.press('3');
  await page.mouse.click(x + 200, y + 100);
  await looksAlong(0);
});

describeShared('a skin and its joints', () => {
  const wasp = ['wasp.skel', 'wasp.skin'].map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) }));

  inPage(
    'a skin and its joints stays in bind mode, follows in pose mode, and either is undone to the last letter',
    async ({ page }) => {
      await startOver(page);
      await dropFiles(page, wasp);
      await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'wasp');
      await page.evaluate(() => {
        const dofs = Array.from({ length: 60 }, (_, i) => ({ index: 6 + i, value: 0.1 * Math.sin(i) }));
        window.marrow.run('pose.setDofs', { dofs });
      });
      await page.locator('.viewport canvas[role=application]').focus();
      await page.keyboard.press('Shift+E');
      await page.getByRole('button', { name: 'Add joints' }).waitFor();
      const files = async () => [await text(page, 'wasp.skel'), await text(page, 'wasp.skin')];
      const [before, saved] = [await vertices(page), await files()];
      const size = Math.max(...before.map(Math.abs));
      const moved = async () => {
        const now = await vertices(page);
        return Math.max(...now.map((value, i) => Math.abs(value - before[i]))) / size;
      };
      const handle = await findHandle(page);
      await drag(page, handle, 40, -30);
      await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toMatch(/^Move /);
      await expect.poll(() => moved()).toBeLessThan(STILL);
      const bound = await files();
      expect(bound[0]).not.toBe(saved[0]);
      expect(bound[1]).not.toBe(saved[1]);
      await page.evaluate(() => window.marrow.undo());
      await expect.poll(() => files()).toEqual(saved);

      await page.getByRole('radio', { name: 'Skin: follows' }).click();
      // The selected joint has handles of its box around it, which would be dragged.
      await page.evaluate(() => window.marrow.run('select.nothing'));
      await drag(page, await findHandle(page), 40, -30);
      await expect.poll(() => moved()).toBeGreaterThan(0.01);
      await expect.poll(async () => (await files())[1]).toBe(saved[1]);
      await page.evaluate(() => window.marrow.undo());
      await expect.poll(() => files()).toEqual(saved);
      await expect.poll(() => moved()).toBe(0);
    },
  );
});
