/**
 * User input on the page: dropping folders and zips, picking, scrubbing, sliding, in both themes and on a small page.
 */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import { describe, expect } from 'vitest';
import { testAll } from '../helpers/check.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles, dropPaths, readPixels } from '../helpers/page.ts';
import { ARM, BY_HAND, dof, LOOK, openArm, RAISE, ready, shown } from './checks/page.ts';

const inPage = inOnePage();

describe('dropping', () => {
  inPage('takes a folder, and what is in its folders', async ({ page }) => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-arm-'));
    try {
      writeFileSync(join(folder, 'arm.skel'), ARM);
      writeFileSync(join(folder, 'arm_raise.anim'), RAISE);
      await ready(page);
      await undoAll(page);
      await dropPaths(page, [folder]);
      await shown(page, 'arm');
      await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].takes)).toEqual(['arm_raise']);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  inPage('dropping takes a zip', async ({ page }) => {
    await ready(page);
    await undoAll(page);
    const zip = zipSync({ 'arm/arm.skel': strToU8(ARM), 'arm/arm_raise.anim': strToU8(RAISE) });
    await dropFiles(page, [{ name: 'arm.zip', bytes: zip }]);
    await shown(page, 'arm');
    await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].takes)).toEqual(['arm_raise']);
  });

  inPage('shows names and lines of files as text, whatever is in them', async ({ page }) => {
    await ready(page);
    await undoAll(page);
    const trap = '<img src=x onerror=alert(1)>';
    await dropFiles(page, [{ name: `${trap}.skel`, bytes: `balljoint root { offset ${trap} }` }]);
    await page.getByText('onerror=alert(1)').first().waitFor();
    await expect.poll(() => page.locator('img').count()).toBe(0);
  });

  inPage('puts files together that come one after another', async ({ page }) => {
    await openArm(page);
    await dropFiles(page, [{ name: 'raise.anim', bytes: RAISE }]);
    await page.waitForFunction(() => window.marrow.characters()[0].takes.length === 1);
    await page.evaluate(() => window.marrow.seek(1));
    await expect.poll(() => dof(page, 3)).toBeCloseTo(0.5, 9);
  });
});

describe('by hand', () => {
  inPage(
    'a click on a joint selects it, in the tree and in the inspector; on the name of a speck beside a giant, that',
    async ({ page }) => {
      await openArm(page);
      await page.evaluate(() => window.marrow.run('draw.boxes.solid'));
      const selected = page.locator('[role=treeitem][aria-selected=true].row-joint');
      const at = await page.evaluate(async () => {
        // The camera may still be moving to what was opened.
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
        const elbow = window.marrow.worldMatrices('arm')[1];
        return window.marrow.pointOnPage([elbow[12], elbow[13] + 0.5, elbow[14]], 'arm');
      });
      if (!at) throw new Error('The arm is not shown.');
      await page.mouse.click(at.x, at.y);
      await selected.waitFor();
      await expect.poll(() => selected.innerText()).toContain('elbow');

      await dropFiles(page, [{ name: 'giant.skel', bytes: 'balljoint giant { boxmin -90 0 -90 boxmax 90 900 90 }' }]);
      const character = page.locator('[role=treeitem][aria-selected=true].row-character');
      await character.filter({ hasText: 'giant' }).waitFor();
      await page.getByText('tall.').waitFor();
      const dot = await page.evaluate(async () => {
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
        const elbow = window.marrow.worldMatrices('arm')[1];
        return window.marrow.pointOnPage([elbow[12], elbow[13], elbow[14]], 'arm');
      });
      if (!dot) throw new Error('The arm is not shown.');
      await page.mouse.click(dot.x, dot.y - 12);
      await character.filter({ hasText: 'arm' }).waitFor();
      await page.getByRole('button', { name: 'Same height' }).click();
      await page.getByText('tall.').waitFor({ state: 'hidden' });
    },
  );

  inPage(
    'letters typed in the tree go to rows when the focus came by keyboard, also after a right click there',
    async ({ page }) => {
      await openArm(page);
      const tree = page.locator('.tree');
      await page.locator('.row-joint').first().click({ button: 'right' });
      await page.getByRole('menu').waitFor();
      await page.keyboard.press('Escape');
      await page.locator('canvas[role=application]').focus();
      await tree.focus();
      await page.keyboard.press('e');
      await page.locator('[role=treeitem][aria-selected=true]').filter({ hasText: 'elbow' }).waitFor();
      await expect.poll(() => page.locator('.mode-switch [aria-checked=true]').textContent()).toBe('Pose');
    },
  );

  testAll(BY_HAND, inPage);
});

/** CSS pixels from the last tool of a tab to the right edge of the page; undefined until they are shown. */
function roomAfterTools(tab: string): number | undefined {
  const isShown = document.querySelector('.timeline-tab[aria-selected="true"]')?.textContent === tab;
  const tools = [...document.querySelectorAll('.timeline-tools:not([hidden]) :is(button, label, input)')];
  const ends = tools.map((tool) => tool.getBoundingClientRect()).filter((box) => box.width > 0);
  if (!isShown || ends.length === 0) return undefined;
  return innerWidth - Math.max(...ends.map((box) => box.right));
}

describe('the look', () => {
  // three.js logs the lost context.
  const inLook = inOnePage({ walking: true, expected: /Context Lost|context lost/i });

  for (const { name, run } of LOOK) inLook(name, run);

  for (const [colorScheme, width, height] of [
    ['light', 1440, 900],
    ['dark', 1024, 640],
    ['light', 390, 780],
  ] as const) {
    inLook(`fits ${colorScheme} at ${width} × ${height}, without scroll bars of the page`, async ({ page }) => {
      await ready(page);
      await page.emulateMedia({ colorScheme });
      await page.setViewportSize({ width, height });
      // A screenshot waits for a frame.
      await page.evaluate(() => window.marrow.pause());
      const overflow = () =>
        page.evaluate(() => {
          const { scrollWidth, clientWidth, scrollHeight, clientHeight } = document.documentElement;
          return [scrollWidth - clientWidth, scrollHeight - clientHeight];
        });
      await expect.poll(overflow).toEqual([0, 0]);
      const covered = () =>
        page.evaluate(() => {
          const controls = [...document.querySelectorAll('.transport-row :is(button, input)')];
          const boxes = controls.map((one) => one.getBoundingClientRect()).filter(({ width }) => width > 0);
          return boxes.filter((a, i) =>
            boxes.some((b, j) => j > i && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom),
          ).length;
        });
      await expect.poll(covered).toBe(0);
      // Small pages scroll them.
      for (const tab of width > 1000 ? ['Takes', 'Pose library'] : []) {
        await page.evaluate((id) => window.marrow.run(id), `page.tab.${tab === 'Takes' ? 'takes' : 'poses'}`);
        await expect.poll(() => page.evaluate(roomAfterTools, tab), { message: tab }).toBeGreaterThanOrEqual(0);
      }
      const isLight = async () => (await readPixels(page, { x: 2, y: 2, width: 4, height: 4 })).data[0] > 128;
      await expect.poll(isLight).toBe(colorScheme === 'light');
    });
  }
});
