/** Menus, tabs and files are opened and closed again and again: what the page holds stays level. */
import type { Page } from 'playwright-core';
import { openArm } from '../../e2e/checks/autosave.ts';
import { dropFiles, withPage } from '../../helpers/page.ts';
import { changeText, countResources, type PageResources, resourcesOf } from '../../helpers/page-resources.ts';
import type { Attack } from '../attack.ts';

/** Caches fill, and scripts are fetched. */
const WARM_UP = 3;
/** Growth for each cycle that isn't chance. */
const MAX_GROWTH: Partial<PageResources> = { nodes: 5, listeners: 2, gpuObjects: 1, objectUrls: 0.2, observers: 0.5 };

export const openClose: Attack = {
  name: 'open-close',
  shows:
    'nodes, listeners, observers, object URLs and GPU objects stay level while menus, tabs and files are opened and closed',
  async run(attempt) {
    await withPage(
      async ({ page }) => {
        await openArm(page);
        for (let i = 0; i < WARM_UP; i++) await cycle(page);
        const before = await resourcesOf(page);
        let cycles = 0;
        for (; attempt.goesOn(); cycles++) {
          await cycle(page);
          attempt.tried();
        }
        const after = await resourcesOf(page);
        attempt.note(changeText(before, after));
        for (const [name, most] of Object.entries(MAX_GROWTH)) {
          // Names of the record above.
          const key = name as keyof PageResources;
          const grown = (after[key] - before[key]) / cycles;
          if (cycles >= 5 && grown > most) attempt.gaveWay(`${grown.toFixed(1)} ${name} more after each cycle`);
        }
      },
      { size: { width: 1280, height: 800 }, before: countResources },
    );
  },
};

async function cycle(page: Page): Promise<void> {
  for (const title of await page.locator('.menu-titles [role=menuitem]').all()) {
    await title.click();
    await page.getByRole('menu').first().waitFor();
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  }
  for (const tab of await page.locator('.timeline [role=tab]:not([hidden])').all()) await tab.click();
  await dropFiles(page, [{ name: 'other.skel', bytes: 'balljoint other { boxmin 0 0 0 boxmax 1 3 1 }' }]);
  await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'other'));
  await page.evaluate(() => window.marrow.undo());
}
