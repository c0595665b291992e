/** Which part of the page a key is for: by the focus, else by the mouse; and what becomes of a focus that vanishes. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { GUTTER } from '../../src/ui/widgets/time/time-window.ts';
import { inOnePage } from '../helpers/one-page.ts';

const ARM = { joint: 'upper_arm_l', rz: 38 } as const;
const FRAME = 1 / 30;

const keys = (page: Page) => page.evaluate((channel) => window.marrow.keys(channel), ARM.rz);
const time = (page: Page) =>
  page.evaluate(() => Number(document.querySelector('.scrubber')?.getAttribute('aria-valuenow')));
const turnOfView = (page: Page) => page.evaluate(() => window.marrow.pointOnPage([1, 0, 0])?.x ?? Number.NaN);
/** Name of the selected joint, without what else its row tells. */
const selected = async (page: Page) =>
  (await page.locator('.tree [aria-selected=true]').first().textContent())?.replace(/\d*$/, '');
/** What single keys switch: buttons that are pressed, panels that are open, and the current time. */
const switched = (page: Page) =>
  page.evaluate(() => {
    const pressed = [...document.querySelectorAll('button[aria-pressed=true],[role=radio][aria-checked=true]')];
    const open = [...document.querySelectorAll('[data-region]:not([inert],[hidden])')];
    const now = document.querySelector('.scrubber')?.getAttribute('aria-valuenow');
    return [...pressed.map((one) => one.ariaLabel ?? one.textContent), ...open.map((one) => one.className), now];
  });
/** The part of the page that has the focus, and the element. */
const focused = (page: Page) =>
  page.evaluate(() => {
    const { activeElement } = document;
    const region = activeElement?.closest('[data-region]')?.getAttribute('data-region');
    return `${region ?? 'page'} ${activeElement?.getAttribute('role') ?? activeElement?.localName}`;
  });
const leave = (page: Page) =>
  page.evaluate(() => document.activeElement instanceof HTMLElement && document.activeElement.blur());

async function openWalker(page: Page): Promise<void> {
  await page.evaluate(() => window.marrow.seek(0));
  await page.getByRole('treeitem', { name: new RegExp(`^${ARM.joint}`) }).click();
  await page.getByRole('textbox', { name: /^rx\b/ }).first().waitFor();
}

async function point(page: Page, selector: string, x = 0.5, y = 0.5): Promise<void> {
  const box = await page.locator(selector).boundingBox();
  if (!box) throw new Error(`${selector} has no place.`);
  await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
}

const inPage = inOnePage({ walking: true }, async ({ page }) => {
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  // Where the camera looks from is measured while time goes on.
  await page.evaluate(() => window.marrow.run('draw.followRoot'));
});

inPage('arrow keys step frames after a click in the viewport, and orbit with Ctrl', async ({ page }) => {
  await openWalker(page);
  await point(page, '.stage', 0.9, 0.8);
  await page.mouse.down();
  await page.mouse.up();
  const view = await turnOfView(page);
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowLeft']) await page.keyboard.press(key);
  await expect.poll(() => time(page)).toBeCloseTo(FRAME, 9);
  await expect.poll(() => turnOfView(page)).toBeCloseTo(view, 3);
  await page.keyboard.press('Control+ArrowRight');
  await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
  await page.keyboard.press('Control+ArrowLeft');
  await expect.poll(() => turnOfView(page)).toBeCloseTo(view, 3);
  await expect.poll(() => time(page)).toBeCloseTo(FRAME, 9);
});

inPage('with the focus nowhere, keys are for the panel under the mouse, which is marked', async ({ page }) => {
  await openWalker(page);
  const plot = page.locator('.curve-plot');
  await plot.focus();
  await page.keyboard.press('Control+a');
  const before = await keys(page);
  const arm = await selected(page);

  // Over the viewport they aren't the timeline's.
  await point(page, '.stage', 0.9, 0.8);
  await leave(page);
  await expect.poll(() => focused(page)).toBe('page body');
  await expect.poll(() => page.locator('.stage').getAttribute('data-active')).toBe('');
  const view = await turnOfView(page);
  await page.keyboard.press('f');
  await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
  await page.keyboard.press('Delete');
  await expect.poll(() => keys(page)).toEqual(before);

  // In the tree, arrows go from row to row.
  await point(page, '.tree');
  await expect.poll(() => page.locator('.tree').getAttribute('data-active')).toBe('');
  await page.keyboard.press('ArrowDown');
  await expect.poll(() => selected(page)).not.toBe(arm);
  await page.keyboard.press('ArrowUp');
  await expect.poll(() => selected(page)).toBe(arm);
  await expect.poll(() => focused(page)).toBe('page body');

  // In the curves they are those of keys, and no others.
  await plot.focus();
  await page.keyboard.press('Control+a');
  await leave(page);
  await point(page, '.curve-plot', 0.6, 0.3);
  await expect.poll(() => page.locator('.timeline').getAttribute('data-active')).toBe('');
  await page.keyboard.press('ArrowRight');
  await expect.poll(async () => (await keys(page))[1].time).toBeCloseTo(before[1].time + FRAME, 6);
  await expect.poll(() => time(page)).toBe(0);
  await page.keyboard.press('Control+z');
  await expect.poll(() => keys(page)).toEqual(before);
  await page.keyboard.press('Delete');
  await expect.poll(() => keys(page)).toEqual([]);
  await page.keyboard.press('Control+z');
  await expect.poll(() => keys(page)).toEqual(before);
});

inPage('T goes to the outliner, where a name is typed and Escape leads back, and hides nothing', async ({ page }) => {
  await openWalker(page);
  const outliner = page.locator('.outliner-button');
  await leave(page);
  const before = await switched(page);
  await page.keyboard.press('t');
  await expect.poll(() => focused(page)).toBe('outliner tree');
  await page.keyboard.type('foot_r');
  await expect.poll(() => selected(page)).toBe('foot_r');
  // Pressed after a pause, T is a letter there.
  await page.keyboard.press('Home');
  await page.keyboard.type('thigh_r');
  await expect.poll(() => selected(page)).toBe('thigh_r');
  await expect.poll(() => switched(page)).toEqual(before);
  await page.keyboard.press('Escape');
  await expect.poll(() => focused(page)).toBe('stage application');
  await expect.poll(() => selected(page)).toBe('thigh_r');

  // After a click on a row, letters are shortcuts; T makes them letters there, too.
  await page.getByRole('treeitem', { name: new RegExp(`^${ARM.joint}`) }).click();
  await page.keyboard.press('t');
  await page.keyboard.type('head');
  await expect.poll(() => selected(page)).toBe('head');

  // Hidden with the focus in it, it gives the focus back.
  await page.keyboard.press('Escape');
  await page.keyboard.press('Shift+T');
  await expect.poll(() => outliner.getAttribute('aria-pressed')).toBe('false');
  await page.keyboard.press('t');
  await expect.poll(() => outliner.getAttribute('aria-pressed')).toBe('true');
  await expect.poll(() => focused(page)).toBe('outliner tree');
});

inPage(
  'a number typed that is the shown one, or confirmed as it is, is no change to K, and another one is',
  async ({ page }) => {
    await openWalker(page);
    const rx = page.getByRole('textbox', { name: /^rx\b/ }).first();
    const before = await keys(page);
    const dofs = () => page.evaluate(() => window.marrow.characters()[0].dofs);
    // Before the next frame: the number is that of the new time all the same.
    const [focusedNumber, dof] = await rx.evaluate((field: HTMLInputElement) => {
      window.marrow.seek(0.27);
      field.focus();
      return [Number(field.value), Number(field.closest('[data-dof]')?.getAttribute('data-dof'))];
    });
    const pose = await dofs();
    expect(focusedNumber).toBeCloseTo((pose[dof] * 180) / Math.PI, 9);
    await page.keyboard.press('Enter');
    const seen = (await rx.inputValue()).replace('°', '');
    expect(seen).toMatch(/\.\d/);
    await rx.click();
    await page.keyboard.type(seen);
    await page.keyboard.press('Enter');
    await expect.poll(dofs).toEqual(pose);
    await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBeUndefined();
    await rx.click();
    await page.keyboard.type('12');
    await page.keyboard.press('Enter');
    await expect.poll(dofs).not.toEqual(pose);
    await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe(`Rotate ${ARM.joint} (rx)`);
    await page.keyboard.press('Control+z');
    await expect.poll(dofs).toEqual(pose);
    await expect.poll(() => keys(page)).toEqual(before);
  },
);

inPage(
  'the scrubber seeks at the range’s first pixel, its handles are outside, and a pause lands on a frame',
  async ({ page }) => {
    await openWalker(page);
    const bar = await page.locator('canvas.scrubber').boundingBox();
    const range = () =>
      page.evaluate(() => {
        const ruler = document.querySelector('.scrubber');
        return [ruler?.ariaValueMin, ruler?.ariaValueMax];
      });
    if (!bar) throw new Error('The scrubber has no place.');
    const before = await range();
    const first = bar.x + GUTTER;
    const press = async (x: number, y: number, to = x) => {
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(to, y, { steps: 3 });
      await page.mouse.up();
    };
    await page.evaluate(() => window.marrow.seek(1));
    await press(first, bar.y + 6);
    await expect.poll(() => time(page)).toBe(0);
    await page.evaluate(() => window.marrow.seek(1));
    await press(first + 1, bar.y + bar.height - 6);
    await expect.poll(() => time(page)).toBe(0);
    await expect.poll(range).toEqual(before);
    await press(first - 4, bar.y + bar.height - 6, first + 100);
    await expect.poll(range).not.toEqual(before);
    await expect.poll(() => time(page)).toBe(0);

    const pose = await page.evaluate(() => window.marrow.characters()[0].dofs[0]);
    await page.locator('.viewport canvas[role=application]').focus();
    await page.keyboard.press(' ');
    await page.waitForFunction((then) => window.marrow.characters()[0].dofs[0] !== then, pose);
    await page.keyboard.press(' ');
    const frame = async () => Number(await page.getByRole('textbox', { name: 'Frame', exact: true }).inputValue());
    await expect.poll(async () => Number.isInteger(await frame())).toBe(true);
  },
);

/** What is drawn around elements: outlines, and marks of panels. Fields that are typed in have one as everywhere. */
const framed = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('body *')].flatMap((one) => {
      const own = getComputedStyle(one);
      const mark = getComputedStyle(one, '::after');
      const isOutlined = own.outlineStyle !== 'none' && Number.parseFloat(own.outlineWidth) > 0;
      const isMarked = mark.content !== 'none' && mark.borderTopWidth === '2px' && mark.position === 'absolute';
      const isField = one instanceof HTMLInputElement && one === document.activeElement;
      return (isOutlined || isMarked) && !isField ? [one.className.toString() || one.localName] : [];
    }),
  );

inPage(
  'presses draw no frames around panels; once a key has moved the focus, a line on top marks the active one',
  async ({ page }) => {
    await openWalker(page);
    for (const [selector, x, y] of [
      ['.stage', 0.9, 0.7],
      ['.curve-plot', 0.5, 0.4],
      ['.tree', 0.5, 0.5],
      ['.scrubber', 0.5, 0.5],
      ['.stage', 0.5, 0.7],
    ] as const) {
      await point(page, selector, x, y);
      await page.mouse.down();
      await page.mouse.up();
      await expect.poll(() => framed(page), { message: selector }).toEqual([]);
    }
    // A shortcut moves no focus.
    await page.keyboard.press('g');
    await expect.poll(() => framed(page)).toEqual([]);
    await page.mouse.move(2, 2);
    await page.keyboard.press('F6');
    await expect.poll(() => page.locator(':root').getAttribute('data-by-key')).toBe('');
    while (!(await focused(page)).startsWith('stage')) await page.keyboard.press('F6');
    await expect.poll(() => framed(page)).toEqual(['stage']);
    await point(page, '.stage', 0.9, 0.8);
    await page.mouse.down();
    await page.mouse.up();
    await expect.poll(() => framed(page)).toEqual([]);
  },
);

/** The last: it takes the search out of the page. */
inPage(
  'what has the focus and vanishes hands it to its panel or the viewport, and the rest of a word runs nothing',
  async ({ page }) => {
    await openWalker(page);
    // The timeline is closed by its key.
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('c');
    await expect.poll(() => focused(page)).toBe('stage application');
    await page.keyboard.press('c');

    // The inspector, by the key of a button in it.
    const rx = page.getByRole('textbox', { name: /^rx\b/ }).first();
    await rx.focus();
    await page.keyboard.press('Enter');
    await expect.poll(() => focused(page)).toBe('inspector section');
    await page.keyboard.press('p');
    await expect.poll(() => focused(page)).toBe('stage application');
    await page.keyboard.press('p');

    // A field that is removed in the middle of a word.
    const before = await switched(page);
    const name = page.getByRole('searchbox', { name: /^Search joints/ });
    await name.focus();
    await page.keyboard.type('sh');
    await name.evaluate((field) => field.remove());
    await page.keyboard.type('in bxgd');
    await expect.poll(() => focused(page)).not.toContain('body');
    await expect.poll(() => switched(page)).toEqual(before);
    await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBeUndefined();
  },
);
