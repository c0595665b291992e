/** FK by hand on the built page: rings, bones, keys, and limits. */
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { testAll } from '../helpers/check.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { dofs, middle, openArm, POSING, type Point, pressAndGo, undo } from './checks/posing.ts';

/** Page position of a point beside the arm: differs for every camera orientation. */
const turnOfView = (page: Page) => page.evaluate(() => window.marrow.pointOnPage([1, 0, 0])?.x ?? Number.NaN);

const readout = (page: Page) =>
  page.evaluate(() => {
    const line = document.querySelector<HTMLElement>('.hand-readout');
    return line && !line.hidden ? (line.textContent ?? '') : '';
  });

/** Searches for a handle from the centre outwards, until the readout shows its name. */
async function feelFor(page: Page, name: string): Promise<Point> {
  const centre = await middle(page);
  const places = await page.evaluate(
    ([x, y, handle, enough]) => {
      const found: Point[] = [];
      const canvas = document.querySelector('.viewport canvas[role=application]');
      for (let angle = 0.3; angle < 2 * Math.PI; angle += 0.6) {
        for (let radius = 20; radius <= 110; radius += 3) {
          const at = { x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle) };
          // In the page: moving the mouse itself waits for a frame each time.
          const init = { clientX: at.x, clientY: at.y, bubbles: true, isPrimary: true };
          canvas?.dispatchEvent(new PointerEvent('pointermove', init));
          const line = document.querySelector<HTMLElement>('.hand-readout');
          if (line && !line.hidden && line.textContent?.startsWith(`${handle} `)) found.push(at);
          // As many as may yield.
          if (found.length === enough) return found;
        }
      }
      return found;
    },
    [centre.x, centre.y, name, 12] as const,
  );
  for (const at of places) {
    // Once the joint under it is known, a handle may yield to that.
    await page.mouse.move(at.x, at.y);
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    if ((await readout(page)).startsWith(`${name} `)) return at;
  }
  throw new Error(`There is no handle ${name} to be felt.`);
}

function around(centre: Point, from: Point, degrees: number): Point[] {
  const [dx, dy] = [from.x - centre.x, from.y - centre.y];
  return Array.from({ length: 12 }, (_, i) => {
    const angle = ((i + 1) / 12) * degrees * (Math.PI / 180);
    return {
      x: centre.x + dx * Math.cos(angle) - dy * Math.sin(angle),
      y: centre.y + dx * Math.sin(angle) + dy * Math.cos(angle),
    };
  });
}

const inPage = inOnePage();

const WALKER = ['walker.skel', 'walker.skin', 'walker_walk.anim'].map((name) => ({
  name,
  bytes: readFileSync(new URL(`../../public/samples/${name}`, import.meta.url)),
}));

inPage('turns a DOF by its ring, stops at its limit and says so, in one step', async ({ page }) => {
  await openArm(page);
  const before = await dofs(page);
  const ring = await feelFor(page, 'rx');
  const centre = await middle(page);
  await pressAndGo(page, ring, around(centre, ring, 170));
  await expect.poll(() => readout(page)).toMatch(/^rx .*limit (42.97|−28.65)°$/);
  await page.mouse.up();
  const after = await dofs(page);
  expect([-0.5, 0.75]).toContain(after[6]);
  expect(after.filter((v, i) => v !== before[i])).toHaveLength(1);
  await expect.poll(() => readout(page)).toBe('');
  await expect.poll(() => undo(page)).toBe('Rotate elbow');
  await page.keyboard.press('Control+z');
  await expect.poll(() => dofs(page)).toEqual(before);
});

inPage(
  'several joints are selected in the tree and the viewport, and turned, typed and undone together',
  async ({ page }) => {
    await openArm(page, 'shoulder');
    const row = (name: string) => page.getByRole('treeitem', { name: new RegExp(`^${name}`) }).first();
    const selected = () =>
      page.locator('.tree [aria-selected=true]').evaluateAll((rows) => rows.map((one) => one.textContent ?? ''));
    const title = page.locator('.inspector .is-selected').first();
    await expect.poll(() => page.getByRole('tree').getAttribute('aria-multiselectable')).toBe('true');
    await page.getByRole('tree').focus();
    await page.keyboard.press('Shift+ArrowDown');
    await expect.poll(() => selected()).toHaveLength(2);
    await title.getByText('2 joints').waitFor();
    await page.keyboard.press('Control+Space');
    await expect.poll(() => selected()).toHaveLength(1);
    await page.keyboard.press('Control+a');
    await expect.poll(() => selected()).toHaveLength(2);
    await page.keyboard.press('Escape');
    await expect.poll(() => selected()).toHaveLength(1);
    await row('shoulder').click();
    await row('elbow').click({ modifiers: ['Control'] });
    await expect.poll(() => selected()).toHaveLength(2);

    // A ring of the active joint turns both, and the elbow's limit holds only there.
    const before = await dofs(page);
    const ring = await feelFor(page, 'rx');
    await pressAndGo(page, ring, around(await middle(page), ring, 20));
    await page.mouse.up();
    const turned = async (dof: number) => (await dofs(page))[dof] - before[dof];
    await expect.poll(async () => Math.abs(await turned(6))).toBeGreaterThan(0.1);
    await expect.poll(async () => (await turned(3)) - (await turned(6))).toBeCloseTo(0, 12);
    await expect.poll(() => undo(page)).toBe('Rotate 2 joints');
    await expect.poll(() => selected()).toHaveLength(2);
    await page.keyboard.press('Control+z');
    await expect.poll(() => dofs(page)).toEqual(before);

    // Typed: a number for both, and from there on by the same amount.
    const field = page.getByRole('textbox', { name: /^ry of 2 joints/ });
    await field.fill('30');
    await field.press('Enter');
    await expect.poll(async () => (await dofs(page))[4]).toBeCloseTo(Math.PI / 6, 9);
    await expect.poll(async () => (await dofs(page))[7]).toBeCloseTo(Math.PI / 6, 9);
    await field.fill('+=15');
    await field.press('Enter');
    await expect.poll(async () => (await dofs(page))[4]).toBeCloseTo(Math.PI / 4, 9);
    await expect.poll(async () => (await dofs(page))[7]).toBeCloseTo(Math.PI / 4, 9);
    await expect.poll(() => undo(page)).toMatch(/^Rotate 2 joints/);

    // Shift+click on the active joint removes it from the selection.
    const { x, y } = await middle(page);
    await page.mouse.move(x, y);
    await page.keyboard.down('Shift');
    await page.mouse.click(x, y);
    await page.keyboard.up('Shift');
    await expect.poll(() => selected()).toHaveLength(1);

    // Ctrl+drag from beside the arm takes in all of it; Escape gives the selection back, and a click there keeps it.
    await page.keyboard.down('Control');
    await pressAndGo(page, { x: x - 150, y: y - 120 }, [
      { x, y },
      { x: x + 150, y: y + 200 },
    ]);
    await expect.poll(() => page.locator('.box-select').count()).toBe(1);
    await expect.poll(() => selected()).toHaveLength(2);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await expect.poll(() => selected()).toHaveLength(1);
    await pressAndGo(page, { x: x - 150, y: y - 120 }, [{ x: x + 150, y: y + 200 }]);
    await page.mouse.up();
    await expect.poll(() => selected()).toHaveLength(2);
    await page.mouse.click(x - 150, y - 120);
    await page.keyboard.up('Control');
    await expect.poll(() => selected()).toHaveLength(2);
    await expect.poll(() => page.locator('.box-select').count()).toBe(0);
  },
);

inPage('goes past a limit while the character’s switch is off', async ({ page }) => {
  await openArm(page);
  const limits = page.getByRole('button', { name: 'Limits', exact: true });
  await expect.poll(() => limits.getAttribute('aria-pressed')).toBe('true');
  await limits.click();
  await expect.poll(() => limits.getAttribute('aria-pressed')).toBe('false');
  const ring = await feelFor(page, 'rx');
  await pressAndGo(page, ring, around(await middle(page), ring, 170));
  await expect.poll(() => readout(page)).toContain('past its limit');
  await page.mouse.up();
  await expect.poll(async () => Math.abs((await dofs(page))[6])).toBeGreaterThan(0.8);
});

testAll(POSING, inPage);

inPage('leaves what it has no use for to the camera', async ({ page }) => {
  await openArm(page);
  const view = await turnOfView(page);
  const before = await dofs(page);
  const { x, y } = await middle(page);
  await pressAndGo(page, { x: x + 150, y }, [{ x: x + 190, y: y + 5 }]);
  await page.mouse.up();
  await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
  await expect.poll(() => dofs(page)).toEqual(before);
});

inPage(
  'turns the view by the arrows while nothing plays, and switches modes by Space without a take',
  async ({ page }) => {
    await openArm(page);
    const view = await turnOfView(page);
    await page.locator('.viewport canvas[role=application]').focus();
    await page.keyboard.press('ArrowRight');
    const turned = await turnOfView(page);
    expect(turned).not.toBeCloseTo(view, 0);
    await page.keyboard.press('ArrowLeft');
    await expect.poll(() => turnOfView(page)).toBeCloseTo(view, 3);
    const checked = page.locator('.mode-switch [aria-checked=true]');
    await expect.poll(() => checked.textContent()).toBe('FK');
    await page.keyboard.press('Space');
    await expect.poll(() => checked.textContent()).toBe('IK');
    await page.keyboard.press('Escape');
    await expect.poll(() => checked.textContent()).toBe('IK');
    await page.keyboard.press('Space');
    await expect.poll(() => checked.textContent()).toBe('FK');
  },
);

/** Waits until the inspector shows a joint. */
const showsJoint = (page: Page, name: string) =>
  page.waitForFunction(
    (expected) => document.querySelector('.title-note')?.previousSibling?.textContent === expected,
    name,
    { timeout: 5000 },
  );

inPage(
  'selects and rotates another joint in one drag, which Escape takes back with the selection',
  async ({ page }) => {
    await openArm(page, 'shoulder');
    const before = await dofs(page);
    const place = await page.evaluate(() => window.marrow.pointOnPage([0, 1.8, 0]));
    if (!place) throw new Error('The arm is not shown.');
    await pressAndGo(page, place, [{ x: place.x + 5, y: place.y - 40 }]);
    await showsJoint(page, 'elbow');
    await expect.poll(async () => (await dofs(page))[6]).toBeCloseTo(Math.PI / 9, 5);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await expect.poll(() => dofs(page)).toEqual(before);
    await showsJoint(page, 'shoulder');
    await expect.poll(() => undo(page)).toMatch(/^Open/);

    await pressAndGo(page, place, [{ x: place.x + 5, y: place.y - 40 }]);
    await page.mouse.up();
    await expect.poll(() => undo(page)).toBe('Rotate elbow');
    await showsJoint(page, 'elbow');
    await page.keyboard.press('Control+z');
    await expect.poll(() => dofs(page)).toEqual(before);
    await expect.poll(() => undo(page)).toMatch(/^Open/);

    // Without movement it only selects.
    const other = await page.evaluate(() => window.marrow.pointOnPage([0, 0.3, 0]));
    if (!other) throw new Error('The arm is not shown.');
    await page.mouse.click(other.x, other.y);
    await showsJoint(page, 'shoulder');
    await expect.poll(() => dofs(page)).toEqual(before);
    // The gizmo has the size of the joint that was dragged, where none was selected before.
    await page.evaluate(() => window.marrow.run('select.nothing'));
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden);
    await pressAndGo(page, place, [{ x: place.x + 5, y: place.y - 40 }]);
    await page.mouse.up();
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
    const width = await page.evaluate(() => document.querySelector('.joint-gizmo')?.getBoundingClientRect().width ?? 0);
    expect(width).toBeGreaterThan(90);
    await page.keyboard.press('Control+z');
    // With Alt it is the camera's.
    const view = await turnOfView(page);
    await page.keyboard.down('Alt');
    await pressAndGo(page, place, [{ x: place.x + 40, y: place.y }]);
    await page.mouse.up();
    await page.keyboard.up('Alt');
    await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
    await expect.poll(() => dofs(page)).toEqual(before);
  },
);

/** The middle between two joints of the first character, on the page. */
async function pointBetween(page: Page, from: string, to: string): Promise<Point> {
  const place = await page.evaluate(
    (names) => {
      const { joints } = window.marrow.characters()[0];
      const world = window.marrow.worldMatrices();
      const [a, b] = names.map((name) => world[joints.findIndex((joint) => joint.name === name)].slice(12, 15));
      return window.marrow.pointOnPage([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2]);
    },
    [from, to] as const,
  );
  if (!place) throw new Error(`${from} is not visible.`);
  return place;
}

inPage(
  'with the head of the walker selected, drags on six other parts of the body select and rotate those',
  async ({ page }) => {
    await undoAll(page);
    await dropFiles(page, WALKER);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
    await page.evaluate(async () => {
      window.marrow.pause();
      window.marrow.seek(0.3);
      await window.marrow.run('posing.fk');
      await window.marrow.run('view.front');
      await window.marrow.run('posing.select');
    });
    const parts = [
      ['forearm_l', 'hand_l'],
      ['upper_arm_r', 'forearm_r'],
      ['chest', 'chest'],
      ['thigh_l', 'shin_l'],
      ['shin_l', 'foot_l'],
      ['toe_r', 'toe_r'],
    ] as const;
    const shownJoint = () => page.evaluate(() => document.querySelector('.title-note')?.previousSibling?.textContent);
    const places: { readonly at: Point; readonly joint: string }[] = [];
    for (const [from, to] of parts) {
      const at = await pointBetween(page, from, to);
      await page.evaluate(() => window.marrow.run('select.nothing'));
      await page.waitForFunction(() => !document.querySelector('.title-note'));
      // Without the gizmo it is seen what is there: in this pose parts cover each other.
      await page.mouse.click(at.x, at.y);
      await page.waitForFunction(() => document.querySelector('.title-note'));
      places.push({ at, joint: (await shownJoint()) ?? '' });
    }
    expect(places.map(({ joint }) => joint)).not.toContain('head');

    await page.keyboard.press('q');
    await page.getByPlaceholder('Search').fill('head');
    // On the name, which is beside the arrow that folds the row.
    await page.getByRole('treeitem', { name: /^head/ }).first().getByText('head').click();
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
    for (const { at, joint } of places) {
      await pressAndGo(page, at, [{ x: at.x, y: at.y - 10 }]);
      await showsJoint(page, joint);
      await page.keyboard.press('Escape');
      await page.mouse.up();
      await showsJoint(page, 'head');
    }
    await page.getByPlaceholder('Search').fill('');
  },
);

inPage('has a select tool without a gizmo: clicks pick, drags orbit, and a button leads back', async ({ page }) => {
  await openArm(page, 'shoulder');
  const before = await dofs(page);
  await page.locator('.viewport canvas[role=application]').focus();
  await page.keyboard.press('q');
  await page.waitForFunction(() => !document.querySelector('.joint-gizmo'));
  await expect.poll(() => page.getByRole('radio', { name: 'Select' }).getAttribute('aria-checked')).toBe('true');
  const place = await page.evaluate(() => window.marrow.pointOnPage([0, 1.8, 0]));
  if (!place) throw new Error('The arm is not shown.');
  await page.mouse.click(place.x, place.y);
  await showsJoint(page, 'elbow');
  const view = await turnOfView(page);
  await pressAndGo(page, place, [{ x: place.x + 40, y: place.y + 5 }]);
  await page.mouse.up();
  await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
  await expect.poll(() => dofs(page)).toEqual(before);
  await page.getByRole('button', { name: 'Back to FK' }).click();
  await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
});

inPage(
  'a slider blends to a saved pose until the focus leaves, in one step, or Escape; a double click applies it once',
  async ({ page }) => {
    await openArm(page);
    await page.evaluate(async () => {
      await window.marrow.run('pose.setDofs', { dofs: [{ index: 6, value: 0.4 }] });
      await window.marrow.run('pose.keep');
      await window.marrow.run('pose.setDofs', { dofs: [{ index: 6, value: 0 }] });
      await window.marrow.run('page.tab.poses');
    });
    const picture = page.locator('.pose-picture');
    await picture.waitFor();
    const slider = page.getByRole('slider', { name: 'Blend to pose 1' });
    await slider.fill('25');
    await slider.fill('50');
    await expect.poll(async () => (await dofs(page))[6]).toBeCloseTo(0.2, 9);
    await page.keyboard.press('Escape');
    await expect.poll(async () => (await dofs(page))[6]).toBe(0);
    await expect.poll(() => slider.inputValue()).toBe('0');
    await slider.fill('25');
    await slider.fill('75');
    await page.keyboard.press('Tab');
    await expect.poll(async () => (await dofs(page))[6]).toBeCloseTo(0.3, 9);
    await expect.poll(() => undo(page)).toBe('Blend to pose 1');
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(async () => (await dofs(page))[6]).toBe(0);
    await picture.dblclick();
    await expect.poll(async () => (await dofs(page))[6]).toBeCloseTo(0.4, 9);
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(async () => (await dofs(page))[6]).toBe(0);
  },
);

describeShared('the dragon', () => {
  inPage('the dragon has a shoulder that stops where its file says', async ({ page }) => {
    await undoAll(page);
    const bytes = sharedBytes('data/cse169/dragon.skel');
    await dropFiles(page, [{ name: 'dragon.skel', bytes }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'dragon');
    await page.evaluate(() => window.marrow.run('posing.fk'));
    await page.getByPlaceholder('Search').fill('shoulder_right_1');
    await page
      .getByRole('treeitem', { name: /^shoulder_\s?right_1/ })
      .first()
      .click();
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
    await page.locator('.viewport canvas[role=application]').focus();
    const ring = await feelFor(page, 'rx');
    await pressAndGo(page, ring, around(await middle(page), ring, 175));
    await page.mouse.up();
    await expect.poll(async () => Math.abs((await dofs(page))[6])).toBeCloseTo(2, 9);
  });
});
