/** Restoring work, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles, openFiles } from '../../helpers/page.ts';

export const ARM = `balljoint shoulder {
	boxmin -0.1 0 -0.1
	boxmax 0.1 1 0.1
	balljoint elbow { offset 0 1 0 boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 }
}`;

export const ready = (page: Page) => page.waitForFunction(() => window.marrow?.characters().length);
export const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);
export const kept = (page: Page) => page.waitForFunction(() => document.documentElement.dataset.autosave === 'kept');
export const dofs = (page: Page) => page.evaluate(() => [...window.marrow.characters()[0].dofs]);
export const setDof = (page: Page, index: number, value: number) =>
  page.evaluate(([i, v]) => window.marrow.run('pose.setDofs', { dofs: [{ index: i, value: v }] }), [index, value]);
export const offer = (page: Page) => page.getByRole('region', { name: 'Unsaved work' });
export const restore = (page: Page) => offer(page).getByRole('button', { name: 'Restore' }).click();
export const openArm = async (page: Page) => {
  await ready(page);
  // Resolves once it is open, where an arm of before is replaced too.
  await openFiles(page, [{ path: 'arm.skel', blob: new Blob([ARM]) }]);
};

/** Small, since many pages are opened here, each drawn in software. */
export const SMALL = { size: { width: 960, height: 600 } } as const;

export const RESTORING: readonly Check[] = [
  {
    name: 'work that is restored over other work is one step, that undo takes back; with all undone nothing is kept',
    options: SMALL,
    async run({ page }) {
      await openArm(page);
      await setDof(page, 6, 0.5);
      await kept(page);
      await page.reload();
      await ready(page);
      await dropFiles(page, [{ name: 'other.skel', bytes: ARM }]);
      await shown(page, 'other');
      await offer(page)
        .getByText(/^Work from/)
        .waitFor();
      await restore(page);
      await shown(page, 'arm');
      const hasUndone = await page.evaluate(() => window.marrow.undo());
      expect(hasUndone).toBe(true);
      await shown(page, 'other');
      await undoAll(page);
      await page.waitForFunction(() => document.documentElement.dataset.autosave === 'nothing');
    },
  },
];
