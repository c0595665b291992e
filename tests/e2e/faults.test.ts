/** What the page does when drawing fails, or an error reaches nobody. */

import { readFileSync } from 'node:fs';
import { unzipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { ARM, dofs, kept, openArm, restore, SMALL, setDof, shown } from './checks/autosave.ts';

const line = (page: Page) => page.locator('.message-line');

async function savedNames(page: Page): Promise<string[]> {
  const saving = page.waitForEvent('download');
  await line(page).getByRole('button', { name: 'Save everything' }).click();
  return Object.keys(unzipSync(readFileSync(await (await saving).path())));
}

/** Messages stay in it until it is loaded again, in the test of data that is cleared. */
const inPage = inOnePage({ ...SMALL, touch: true });

describe('faults', () => {
  inPage(
    'drawing that throws is said once, work is kept and saved meanwhile, and the picture comes back with the next edit',
    async ({ page }) => {
      await undoAll(page);
      await openArm(page);
      await page.evaluate(() => {
        const { prototype } = WebGL2RenderingContext;
        const draws = { elements: prototype.drawElements, arrays: prototype.drawArrays };
        const fail = () => {
          throw new Error('planted by the test');
        };
        Object.assign(prototype, { drawElements: fail, drawArrays: fail });
        Object.assign(window, {
          mend: () => Object.assign(prototype, { drawElements: draws.elements, drawArrays: draws.arrays }),
        });
        for (let i = 0; i < 3; i++) window.marrow.seek(i);
      });
      await line(page)
        .getByText('The viewport can’t be drawn. Your work can still be saved. planted by the test')
        .waitFor();
      await page.evaluate(() => window.marrow.run('pose.setDofs', { dofs: [{ index: 6, value: 0.5 }] }));
      await expect.poll(() => page.evaluate(() => document.documentElement.dataset.autosave)).toBe('kept');
      await expect.poll(() => line(page).getByText('more message').count()).toBe(0);
      await expect.poll(() => savedNames(page)).toContain('marrow/arm/arm.skel');
      await page.evaluate(() => {
        // Put there above.
        (window as unknown as { mend(): void }).mend();
        return window.marrow.run('pose.setDofs', { dofs: [{ index: 6, value: 0.25 }] });
      });
      await expect.poll(() => page.evaluate(() => window.marrow.stats().drawCalls)).toBeGreaterThan(0);
    },
  );

  it('a shader that does not compile is said in the page, and an error that nobody caught once, with a report to copy', () =>
    withPage(
      async ({ page }) => {
        await line(page)
          .getByText(/The viewport can’t be drawn\. .*A shader does not compile/)
          .waitFor();
        await openArm(page);
        await page.evaluate(() => {
          for (let i = 0; i < 3; i++) {
            setTimeout(() => {
              throw new TypeError('planted by the test');
            });
          }
        });
        await line(page).getByText('Something went wrong. Your work is still here. planted by the test').waitFor();
        await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
        await line(page).getByRole('button', { name: 'Copy report' }).click();
        await line(page).getByText('Report copied.').waitFor();
        const report = await page.evaluate(() => navigator.clipboard.readText());
        expect(report).toMatch(/^Marrow .*3 times: Something went wrong.*TypeError: planted by the test/s);

        // A browser that lets nothing be copied.
        await page.evaluate(() => {
          navigator.clipboard.writeText = () => Promise.reject(new DOMException('', 'NotAllowedError'));
          document.execCommand = () => false;
          setTimeout(() => {
            throw new RangeError('planted by the test, too');
          });
        });
        await line(page).getByText('planted by the test, too').waitFor();
        const saving = page.waitForEvent('download');
        await line(page).getByRole('button', { name: 'Copy report' }).click();
        const saved = readFileSync(await (await saving).path(), 'utf8');
        expect(saved).toMatch(/TypeError: .*RangeError: planted by the test, too/s);
        await expect.poll(() => page.getByText('The browser blocked copying.').count()).toBeGreaterThan(0);
      },
      {
        ...SMALL,
        expected: /planted by the test|WebGL/,
        before: () => {
          const { prototype } = WebGL2RenderingContext;
          const { shaderSource } = prototype;
          prototype.shaderSource = function (shader, source) {
            shaderSource.call(this, shader, `${source}\n#error refused by the test`);
          };
        },
      },
    ));

  inPage(
    'a touch anywhere on the page while a mouse button is down on the viewport, as screens with both send it, is no error',
    async ({ page }) => {
      await undoAll(page);
      await openArm(page);
      const session = await page.context().newCDPSession(page);
      await page.mouse.move(400, 300);
      await page.mouse.down();
      for (const point of [
        { x: 450, y: 300 },
        { x: 400, y: 590 },
      ]) {
        await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [point] });
        await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
      }
      await page.mouse.up();
      await expect.poll(() => page.evaluate(() => window.marrow.stats().drawCalls)).toBeGreaterThan(0);
    },
  );

  inPage('a shortcut that is clicked twice before its new key is pressed is changed once', async ({ page }) => {
    await undoAll(page);
    await openArm(page);
    await page.evaluate(() => window.marrow.run('help.shortcuts'));
    const dialog = page.getByRole('dialog', { name: 'Shortcuts' });
    await dialog.getByRole('button', { name: 'K: press to change' }).first().dblclick();
    await page.keyboard.press(';');
    await dialog.getByRole('button', { name: ';: press to change', exact: true }).waitFor();
    await page.keyboard.press('Escape');
    await dialog.waitFor({ state: 'detached' });
  });

  inPage(
    'work is stored again at once when the browser’s data is cleared while the page is open',
    async ({ page, url }) => {
      await undoAll(page);
      await openArm(page);
      await setDof(page, 6, 0.5);
      await kept(page);
      const session = await page.context().newCDPSession(page);
      const { origin } = new URL(url);
      await session.send('Storage.clearDataForOrigin', { origin, storageTypes: 'indexeddb' });
      const stored = () =>
        page.evaluate(async () => (await indexedDB.databases()).some(({ name }) => name === 'marrow-sessions'));
      await expect.poll(stored).toBe(true);
      await kept(page);
      await page.reload();
      await restore(page);
      await shown(page, 'arm');
      await expect.poll(async () => (await dofs(page))[6]).toBe(0.5);
    },
  );

  inPage(
    'a worker that the browser ends, idle or while it reads, is noticed, told once, and replaced',
    async ({ page }) => {
      await undoAll(page);
      await openArm(page);
      const names = () => page.evaluate(() => window.marrow.characters().map(({ name }) => name));
      const end = () => Promise.all(page.workers().map((worker) => worker.evaluate(() => self.close())));
      await expect.poll(() => page.workers().length).toBe(1);
      await end();
      await expect.poll(() => page.workers().length).toBe(0);
      await dropFiles(page, [{ name: 'leg.skel', bytes: ARM }]);
      await expect.poll(names).toEqual(['arm', 'leg']);
      // It reads, and never answers.
      const [worker] = page.workers();
      await worker.evaluate(() => {
        self.onmessage = null;
      });
      await dropFiles(page, [{ name: 'tail.skel', bytes: ARM }]);
      await page.getByRole('button', { name: 'Cancel' }).waitFor();
      await end();
      await line(page).getByText('Nothing was opened. The worker stopped. Try again').waitFor();
      await expect.poll(() => line(page).getByText('more message').count()).toBe(0);
      await dropFiles(page, [{ name: 'tail.skel', bytes: ARM }]);
      await expect.poll(names).toEqual(['arm', 'leg', 'tail']);
    },
  );

  it('a save that fails keeps the mark and says why in a sentence, and is tried again; saving needs no connection', () =>
    withPage(
      async ({ page }) => {
        await openArm(page);
        await setDof(page, 6, 0.5);
        await expect.poll(() => page.title()).toBe('• arm.skel – Marrow');
        await page.evaluate(() => {
          const { createObjectURL } = URL;
          URL.createObjectURL = () => {
            URL.createObjectURL = createObjectURL;
            throw new TypeError('planted by the test');
          };
        });
        const hasScript = (part: string) =>
          page.evaluate((of) => performance.getEntriesByType('resource').some(({ name }) => name.includes(of)), part);
        // Both come once something is unsaved.
        for (const part of ['/saver-', '/zip-character-']) await expect.poll(() => hasScript(part)).toBe(true);
        await page.context().setOffline(true);
        await page.keyboard.press('Control+s');
        await line(page)
          .getByText('arm.skel: Not saved. Something went wrong. Try again. (TypeError: planted by the test)')
          .waitFor();
        await expect.poll(() => page.title()).toBe('• arm.skel – Marrow');
        const saving = page.waitForEvent('download');
        await page.keyboard.press('Control+s');
        const download = await saving;
        expect(download.suggestedFilename()).toBe('arm.skel');
        await expect.poll(() => page.title()).toBe('Marrow');
        await page.keyboard.press('?');
        await line(page)
          .getByText(/could not be loaded.*Part of the page could not be loaded/)
          .waitFor();
        await page.context().setOffline(false);
        await setDof(page, 6, 0.25);
        await expect.poll(async () => (await dofs(page))[6]).toBe(0.25);
      },
      {
        ...SMALL,
        expected: /INTERNET_DISCONNECTED/,
        before: () => Reflect.deleteProperty(window, 'showSaveFilePicker'),
      },
    ));
});
