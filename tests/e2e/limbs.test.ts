/** Limbs, as someone works with them: made and switched in the page, dragged in IK, and keyed. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';
import { ready } from './checks/autosave.ts';
import { drawn, onPage, standing, undoLabel } from './checks/ik.ts';
import { place, shown } from './checks/limb-drag.ts';

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

it('legs are made limbs, planted by a switch, dragged by a foot and by a pole, and keyed', () =>
  withPage(
    async ({ page }) => {
      await ready(page);
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
    },
    { walking: true },
  ));
