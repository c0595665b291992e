/**
 * What a drag in IK mode moves on the built page, by real mouse: limbs, the whole body, and nothing else; limbs with a
 * goal; and pins by their handles.
 */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { transformVector } from '../../src/math/vec3.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { apart, drawn, intoIk, onPage, type Point, pins, standing, undoLabel } from './checks/ik.ts';
import { dragUp, expectArmOnly, type Hold, limbFrom, ontoHandle, place, shown } from './checks/limb-drag.ts';

const inPage = inOnePage({ walking: true });

inPage(
  'moves nothing but the arm when the walker’s hand is dragged up, and its feet hold under Full body',
  async ({ page }) => {
    await startOver(page);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
    await intoIk(page);
    const { names } = await shown(page);
    const hand: Hold = { joint: names.indexOf('hand_l'), point: [0.07, 0, 0], by: [0, -30] };
    const text = () => page.evaluate(() => Promise.all(['walker.skel', 'walker_walk.anim'].map(window.marrow.save)));
    const files = await text();
    await expectArmOnly(page, hand, await limbFrom(page, 'upper_arm_l'));
    await expect.poll(text).toEqual(files);

    await page.getByRole('button', { name: 'Reach: Limb' }).click();
    await page.getByRole('menuitemradio', { name: /^Full body/ }).click();
    await page.getByRole('button', { name: 'Reach: Full body' }).waitFor();
    const before = await shown(page);
    const feet = ['foot_l', 'foot_r', 'toe_l', 'toe_r'].map((name) => names.indexOf(name));
    const low = (j: number) => place(before, j)[1];
    const [lower] = feet.slice(2).sort((a, b) => low(a) - low(b));
    await dragUp(page, hand, async () => {
      const now = await shown(page);
      expect(apart(place(now, lower), place(before, lower))).toBeLessThan(1e-3);
      expect(apart(place(now, names.indexOf('hips')), place(before, names.indexOf('hips')))).toBeGreaterThan(1e-4);
    });
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(text).toEqual(files);

    // A root that is fixed keeps position and turn, wherever the hand goes.
    await page.getByRole('button', { name: 'Root moves', pressed: true }).click();
    await page.getByRole('button', { name: 'Root moves', pressed: false }).waitFor();
    const root = names.indexOf('root');
    await dragUp(page, hand, async () => {
      const now = await shown(page);
      expect(now.worlds[root]).toEqual(before.worlds[root]);
      expect(apart(now.worlds[names.indexOf('chest')], before.worlds[names.indexOf('chest')])).toBeGreaterThan(1e-4);
    });
    await page.evaluate(() => window.marrow.undo());
    const from = await onPage(page, place(before, root));
    await page.getByRole('treeitem', { name: /^root/ }).first().click();
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x, from.y - 30, { steps: 4 });
    await drawn(page);
    await expect.poll(() => shown(page)).toEqual(before);
    await page.mouse.up();
    await page.evaluate(() => window.marrow.run('ik.setReach', { reach: 'limb' }));
  },
);

const limbs = (page: Page) => page.evaluate(() => window.marrow.limbs());
const section = (page: Page) => page.locator('[data-section="limb"]');

/** By a set of it, since the outliner shows no joint that deep. */
const selectFoot = (page: Page) =>
  page.evaluate(async () => {
    const { joints } = window.marrow.characters()[0];
    await window.marrow.run('sets.add', {
      name: 'foot',
      joints: joints.filter(({ name }) => name === 'foot_l').map(({ index }) => index),
    });
    await window.marrow.run('sets.select', { set: 0 });
  });

inPage('legs are made limbs, planted by a switch, dragged by a foot and by a pole, and keyed', async ({ page }) => {
  await startOver(page);
  await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
  await page.evaluate(async () => {
    window.marrow.pause();
    window.marrow.seek(0.25);
    await window.marrow.run('view.front');
  });
  await standing(page);
  await selectFoot(page);
  await page.evaluate(() => window.marrow.run('limb.make'));
  await expect.poll(async () => (await limbs(page)).map(({ name }) => name)).toEqual(['foot_l', 'foot_r']);
  await section(page).getByRole('button', { name: 'Switch to IK' }).click();
  await expect.poll(async () => (await limbs(page))[0].blend).toBe(1);
  await expect.poll(() => undoLabel(page)).toBe('Switch foot_l to IK');
  await section(page).getByRole('button', { name: 'Switch to FK' }).waitFor();
  await page.getByText('foot_l blend').first().waitFor();

  const before = await shown(page);
  const pivot = place(before, before.names.indexOf('foot_l'), [0, 0, 0]);
  const at = await onPage(page, pivot);
  await page.mouse.move(at.x, at.y);
  await drawn(page);
  await page.mouse.down();
  await page.mouse.move(at.x + 6, at.y - 12, { steps: 6 });
  await drawn(page);
  await page.mouse.up();
  const [moved] = await limbs(page);
  expect(moved.gap).toBeLessThan(1e-4);
  expect(moved.goal?.[1]).toBeGreaterThan(pivot[1]);
  await page.keyboard.press('k');
  await expect.poll(() => undoLabel(page)).toMatch(/^Key/);

  const goal = (await limbs(page))[0].goal;
  const pole = await page.evaluate(async () => {
    const text = String(await window.marrow.save('walker_walk.limbs.json'));
    const { channels } = JSON.parse(text).goals[0];
    return ['px', 'py', 'pz'].map((name): number => channels[name].keys[0][1]);
  });
  const knee = await onPage(page, [pole[0], pole[1], pole[2]]);
  await page.mouse.move(knee.x, knee.y);
  await page.mouse.down();
  await page.mouse.move(knee.x + 25, knee.y - 4, { steps: 6 });
  await drawn(page);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Drag pole of foot_l');
  await expect.poll(async () => (await limbs(page))[0].goal).toEqual(goal);
  await page.keyboard.press('k');
  await expect.poll(() => undoLabel(page)).toMatch(/^Key/);
});

/** A pin that is held: of a walker that is about 1 high. */
const HELD = 1e-4;
/** Across the axis. */
const ALONG = 1e-6;

/** Pins three limbs of the walker, the last by its key, which selects the pin. */
async function pinned(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
  await intoIk(page);
  const { names } = await shown(page);
  await page.evaluate(
    async ([foot, hand]) => {
      await window.marrow.run('view.front');
      await window.marrow.run('ik.pin', { joint: foot, point: [0, 0, 0] });
      await window.marrow.run('ik.pin', { joint: hand, point: [0, 0, 0] });
    },
    [names.indexOf('foot_r'), names.indexOf('hand_r')],
  );
  await page
    .getByRole('treeitem', { name: /^hand_l/ })
    .first()
    .click();
  await page.keyboard.press('y');
  await page.getByRole('button', { name: 'Axes: World' }).waitFor();
  await standing(page);
}

function pointOf({ position: [x, y, z] }: { readonly position: readonly number[] }): Point {
  return [x, y, z];
}

/** Drags a handle of the third pin; how it has moved, while the others hold. Undo restores every number. */
async function dragHandle(
  page: Page,
  toward: readonly [number, number],
  text: RegExp,
  by: readonly [number, number],
  there: (way: Point, chip: string) => Promise<void>,
): Promise<void> {
  const before = await shown(page);
  const from = await pins(page);
  const at = await ontoHandle(page, await onPage(page, pointOf(from[2])), toward, text);
  await page.mouse.down();
  await page.mouse.move(at.x + by[0], at.y + by[1], { steps: 4 });
  await drawn(page);
  const now = await pins(page);
  for (const p of [0, 1]) expect(apart(now[p].position, from[p].position)).toBeLessThan(HELD);
  const [x, y, z] = now[2].position.map((v, k) => v - from[2].position[k]);
  const chip = await page.locator('.gizmo-chip .hand-readout:visible').textContent();
  await there([x, y, z], chip ?? '');
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Drag hand_l');
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => shown(page)).toEqual(before);
}

inPage(
  'an arrow moves a pin along its axis alone, a square in its plane, while the other pins hold; undo gives every number back',
  async ({ page }) => {
    await startOver(page);
    await pinned(page);
    await dragHandle(page, [0, -1], /^along y$/, [6, -30], async ([x, y, z], chip) => {
      expect(y).toBeGreaterThan(0.02);
      expect(Math.hypot(x, z)).toBeLessThan(ALONG);
      expect(chip).toBe(`y +${y.toFixed(3)} units`);
    });
    // The square between both arrows that are seen.
    await dragHandle(page, [0.7, -0.7], /^along x and y$/, [-12, -20], async ([x, y, z]) => {
      expect(x).toBeLessThan(-0.01);
      expect(y).toBeGreaterThan(0.01);
      expect(Math.abs(z)).toBeLessThan(ALONG);
    });

    // Along the joint's own axes it is another way.
    await page.getByRole('button', { name: 'Axes: World' }).click();
    await page.getByRole('menuitemradio', { name: 'Joint' }).click();
    await page.getByRole('button', { name: 'Axes: Joint' }).waitFor();
    await drawn(page);
    const { names, worlds } = await shown(page);
    const axis = transformVector(Float64Array.from(worlds[names.indexOf('hand_l')]), [1, 0, 0]);
    const middle = pointOf((await pins(page))[2]);
    const [from, to] = await Promise.all(
      [0, 0.2].map((s) => onPage(page, [middle[0] + s * axis[0], middle[1] + s * axis[1], middle[2] + s * axis[2]])),
    );
    await dragHandle(page, [to.x - from.x, to.y - from.y], /^along x$/, [0, -12], async (way) => {
      const along = way.reduce((sum, v, k) => sum + v * axis[k], 0);
      expect(Math.abs(along)).toBeGreaterThan(1e-3);
      expect(Math.hypot(...way.map((v, k) => v - along * axis[k]))).toBeLessThan(ALONG);
    });
    await page.getByRole('button', { name: 'Axes: Joint' }).click();
    await page.getByRole('menuitemradio', { name: 'World' }).click();
  },
);

inPage('a ring turns what a pin holds, which stays where it is', async ({ page }) => {
  await startOver(page);
  await pinned(page);
  await page.getByRole('button', { name: /^Pin orientation of hand_l/ }).click();
  await drawn(page);
  const { names, worlds } = await shown(page);
  const hand = names.indexOf('hand_l');
  await dragHandle(page, [0.8, 0.6], /^about z$/, [7, -10], async (way, chip) => {
    expect(Math.hypot(...way)).toBeLessThan(ALONG);
    const now = (await shown(page)).worlds[hand];
    const angle = (m: readonly number[]) => Math.atan2(m[1], m[0]);
    const turned = ((angle(now) - angle(worlds[hand])) * 180) / Math.PI;
    expect(Math.abs(turned)).toBeGreaterThan(2);
    expect(Number.parseFloat(chip.replace(/^z /, '').replace('−', '-'))).toBeCloseTo(turned, 0);
  });
});

describeShared('captures and axis-angle skeletons', () => {
  inPage('moves nothing but the arm when the hand of a capture is dragged up', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walk');
    await drawn(page);
    await intoIk(page);
    const { names } = await shown(page);
    await expectArmOnly(
      page,
      { joint: names.indexOf('LeftHand'), point: [0, 0, 0], by: [-25, -25] },
      await limbFrom(page, 'LeftShoulder'),
    );
  });

  it('moves nothing but the arm of an axis-angle skeleton once Limb is chosen; before, all up to the root', () =>
    withPage(async ({ page }) => {
      await dropFiles(page, [{ name: 'human.axskel', bytes: sharedBytes('data/axis-skel/human.axskel') }]);
      await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'human');
      await drawn(page);
      await intoIk(page);
      await page.getByRole('button', { name: 'Reach: Chain' }).waitFor();
      await page.evaluate(() => window.marrow.run('ik.setReach', { reach: 'limb' }));
      await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
      await expectArmOnly(page, { joint: 9, point: [0, 0.05, 0], by: [8, -25] }, [5, 6, 7, 8, 9]);
    }));
});
