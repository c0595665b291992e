/** What is loaded before the first picture of a first visit, that nothing is loaded twice, and what comes next. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { expect, it } from 'vitest';
import { drawNothing } from '../helpers/gl-calls.ts';
import { withPage } from '../helpers/page.ts';

const DIST = fileURLToPath(new URL('../../dist/', import.meta.url));
/** Of all files before the first picture, compressed with brotli. */
const MAX_BYTES = 261_000;

declare global {
  interface Window {
    /** Addresses that were asked for before the first skin was drawn; see `noteFirstPicture`. */
    beforePicture?: readonly string[];
    /** With the character, while the inspector is empty; see `countFrames`. */
    framesBeforeInspector?: number;
  }
}

/** Runs in the page: the first draw of many triangles is that of the character. */
function noteFirstPicture(): void {
  const { prototype } = WebGL2RenderingContext;
  const note = (count: number) => {
    if (count < 3000 || window.beforePicture) return;
    window.beforePicture = performance.getEntriesByType('resource').map(({ name }) => name);
  };
  const { drawElements, drawElementsInstanced } = prototype;
  prototype.drawElements = function (mode, count, type, offset) {
    note(count);
    drawElements.call(this, mode, count, type, offset);
  };
  prototype.drawElementsInstanced = function (mode, count, type, offset, instances) {
    note(count);
    drawElementsInstanced.call(this, mode, count, type, offset, instances);
  };
}

/** Runs in the page. */
function countFrames(): void {
  let isDrawn = false;
  window.framesBeforeInspector = 0;
  const { prototype } = WebGL2RenderingContext;
  const { drawElementsInstanced } = prototype;
  prototype.drawElementsInstanced = function (mode, count, type, offset, instances) {
    isDrawn ||= count >= 3000;
    drawElementsInstanced.call(this, mode, count, type, offset, instances);
  };
  const inFrame = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    inFrame((now) => {
      isDrawn = false;
      callback(now);
      if (isDrawn && !document.querySelector('.inspector .lil-slider')) {
        window.framesBeforeInspector = (window.framesBeforeInspector ?? 0) + 1;
      }
    });
}

const sizeOf = (path: string) => brotliCompressSync(readFileSync(join(DIST, path))).length;

it('a first visit loads at most 261 kB before its first picture, the example without its reader and texts, and nothing twice', () =>
  withPage(
    async ({ page, url, asked }) => {
      await page.waitForFunction(() => window.beforePicture);
      const before = await page.evaluate(() => window.beforePicture ?? []);
      const paths = before.map((address) => address.slice(url.length));
      const kinds = paths.map((path) => path.replace(/-[\w-]{8}(?=\.)/, '')).sort();
      const scripts = ['assets/index.js', 'assets/rolldown-runtime.js', 'assets/three.js'];
      expect(kinds).toEqual(['assets/index.css', ...scripts, 'assets/opening.json'].sort());
      const bytes = ['index.html', ...paths].reduce((sum, path) => sum + sizeOf(path), 0);
      expect(bytes).toBeLessThan(MAX_BYTES);

      // Panels come, and the service worker stores all files.
      await page.locator('.inspector .lil-gui').first().waitFor({ state: 'attached' });
      await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
      // Nothing has to be said of an example that nobody has changed.
      await expect.poll(() => page.evaluate(() => document.querySelector('.message-line')?.textContent)).toBe('');
      const stored = asked().filter((path) => path.startsWith('manual/'));
      expect(stored.length).toBeGreaterThan(10);
      const twice = () => asked().filter((path, i, all) => all.indexOf(path) < i);
      await expect.poll(twice).toEqual([]);
    },
    { walking: true, serviceWorker: true, early: true, before: noteFirstPicture },
  ));

it('the inspector is filled before the fourth frame, and then the example plays', () =>
  withPage(
    async ({ page }) => {
      await page.locator('.inspector .lil-slider').first().waitFor({ state: 'attached' });
      // The first picture, its texture, and what menus and panels have changed.
      const frames = await page.evaluate(() => window.framesBeforeInspector);
      expect(frames).toBeLessThanOrEqual(3);
      const time = page.getByRole('textbox', { name: 'Time in seconds' });
      await expect.poll(async () => Number(await time.inputValue())).toBeGreaterThan(0);
    },
    { walking: true, fullMotion: true, firstVisit: true, early: true, before: [drawNothing, countFrames] },
  ));
