/** Handles of a pin on the built page, by real mouse: it moves along an axis or in a plane, or turns, and undo goes back. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { transformVector } from '../../src/math/vec3.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { apart, drawn, intoIk, onPage, type Point, pins, standing, undoLabel } from './checks/ik.ts';
import { ontoHandle, shown } from './checks/limb-drag.ts';

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
async function drag(
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

const inPage = inOnePage({ walking: true });

inPage(
  'an arrow moves a pin along its axis alone, a square in its plane, while the other pins hold; undo gives every number back',
  async ({ page }) => {
    await startOver(page);
    await pinned(page);
    await drag(page, [0, -1], /^along y$/, [6, -30], async ([x, y, z], chip) => {
      expect(y).toBeGreaterThan(0.02);
      expect(Math.hypot(x, z)).toBeLessThan(ALONG);
      expect(chip).toBe(`y +${y.toFixed(3)} units`);
    });
    // The square between both arrows that are seen.
    await drag(page, [0.7, -0.7], /^along x and y$/, [-12, -20], async ([x, y, z]) => {
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
    await drag(page, [to.x - from.x, to.y - from.y], /^along x$/, [0, -12], async (way) => {
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
  await drag(page, [0.8, 0.6], /^about z$/, [7, -10], async (way, chip) => {
    expect(Math.hypot(...way)).toBeLessThan(ALONG);
    const now = (await shown(page)).worlds[hand];
    const angle = (m: readonly number[]) => Math.atan2(m[1], m[0]);
    const turned = ((angle(now) - angle(worlds[hand])) * 180) / Math.PI;
    expect(Math.abs(turned)).toBeGreaterThan(2);
    expect(Number.parseFloat(chip.replace(/^z /, '').replace('−', '-'))).toBeCloseTo(turned, 0);
  });
});
