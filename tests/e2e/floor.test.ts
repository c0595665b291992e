/** The floor under characters whose origin is in their middle, and the way back. */
import { expect, it } from 'vitest';
import { dropFiles, readPixels, withPage } from '../helpers/page.ts';

const SUNK = 'balljoint body { boxmin -0.2 -1 -0.2 boxmax 0.2 1 0.2 }';

it('a character with its origin in its middle stands on a floor below 0, and one click has the floor at 0 again', () =>
  withPage(
    async ({ page }) => {
      await dropFiles(page, [{ name: 'middle.skel', bytes: SUNK }]);
      const told = page.getByText('middle’s origin is in its middle, so the floor is at the lowest point, y = −1.');
      await told.filter({ visible: true }).first().waitFor();
      // Nothing but the floor has moved.
      const world = () => page.evaluate(() => window.marrow.worldMatrices()[0]?.slice(12, 15));
      await expect.poll(world).toEqual([0, 0, 0]);
      await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).not.toMatch(/floor/i);

      // Beside the character, at the height of its middle, there is only background; with the floor at 0 there is the
      // grid.
      await page.evaluate(() => window.marrow.run('view.front'));
      const take = { x: 700, y: 150, width: 200, height: 400 };
      const before = await readPixels(page, take);
      await page.getByRole('button', { name: 'Floor at 0' }).first().click();
      await expect.poll(async () => Buffer.compare((await readPixels(page, take)).data, before.data)).not.toBe(0);
      await expect.poll(() => told.filter({ visible: true }).count()).toBe(0);

      await page.getByRole('button', { name: 'Show', exact: true }).click();
      const floor = page.getByRole('menuitemcheckbox', { name: 'Floor at lowest point' });
      await expect.poll(() => floor.getAttribute('aria-checked')).toBe('false');
      await floor.click();
      await page.getByRole('button', { name: 'Show', exact: true }).click();
      await expect.poll(() => floor.getAttribute('aria-checked')).toBe('true');
    },
    { drawn: true },
  ));
