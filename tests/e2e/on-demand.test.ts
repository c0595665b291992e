/** What the page loads later, and what happens if that fails; what it loads first is in `first-load.test.ts`. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { strFromU8, unzipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';
import { dropFiles, withPage } from '../helpers/page.ts';

const DIST = fileURLToPath(new URL('../../dist/', import.meta.url));
const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);

/** One in which a dialog does not come. */
const inPage = inOnePage({ expected: /about-/ });

describe('the page', () => {
  it('the page has writers without readers, and its worker readers without writers until texts are compared', () => {
    const scripts = readdirSync(join(DIST, 'assets')).filter((file) => file.endsWith('.js'));
    const textOf = (file: string) => readFileSync(join(DIST, 'assets', file), 'utf8');
    const having = (text: string) => scripts.filter((file) => textOf(file).includes(text));
    const reading = having('Expected pose NAME { … }, found none.');
    const writing = having('which files belong together');
    // The page's, and the worker's.
    expect([reading.length, writing.length]).toEqual([1, 2]);
    // That of the worker, or what it shares with its parts.
    const [worker = ''] = scripts.filter((file) => file.startsWith('entry-'));
    expect(worker === reading[0] || textOf(worker).includes(`./${reading[0]}`)).toBe(true);
    expect(having(reading[0]).every((file) => !/^(index|rest|three)-/.test(file))).toBe(true);
    expect(writing).not.toContain(reading[0]);
  });

  it('the page keeps what is opened before its panels and its autosave have come', () =>
    withPage(
      async ({ page }) => {
        await shown(page, 'post');
        await dropFiles(page, [{ name: 'arm.skel', bytes: 'balljoint shoulder { }' }]);
        await shown(page, 'arm');
        await page.waitForFunction(() => document.documentElement.dataset.autosave === 'kept');
      },
      {
        early: true,
        // A page that is never idle.
        before: () => {
          window.requestIdleCallback = () => 0;
        },
      },
    ));

  it('shows its character before menus and panels have come, and does then what was pressed meanwhile', () =>
    withPage(
      async ({ page, url }) => {
        let send: (() => void) | undefined;
        const asked = page.waitForRequest('**/rest-*.js');
        await page.route('**/rest-*.js', (route) => {
          send = () => void route.continue();
        });
        await page.goto(url);
        await asked;
        await shown(page, 'walker');
        await expect.poll(() => page.evaluate(() => window.marrow.stats().triangles)).toBeGreaterThan(1000);
        await page.keyboard.press('Space');
        await page.getByText('View', { exact: true }).click({ force: true });
        await expect.poll(() => page.getByRole('menu').count()).toBe(0);
        const scripted = page.evaluate(async () => {
          await window.marrow.run('pose.reset', { to: 'zero' });
          return window.marrow.steps().undo;
        });
        send?.();
        const undone = await scripted;
        expect(undone).toMatch(/^Reset walker/);
        await page.getByRole('menu', { name: 'View' }).waitFor();
        await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
      },
      { blank: true, walking: true, fullMotion: true },
    ));

  it('the page keeps Ctrl+S from the browser, and selects the joint that was tapped, before menus and panels have come', () =>
    withPage(
      async ({ page, url }) => {
        let send: (() => void) | undefined;
        const asked = page.waitForRequest('**/rest-*.js');
        await page.route('**/rest-*.js', (route) => {
          send = () => void route.continue();
        });
        await page.goto(url);
        await asked;
        await shown(page, 'post');
        // The handle comes once the page listens: a key takes another way to the page than scripts, and may overtake
        // one.
        const kept = await page.evaluateHandle(() => ({
          pressed: new Promise<boolean>((resolve) => {
            window.addEventListener('keydown', (event) => event.key === 's' && resolve(event.defaultPrevented));
          }),
        }));
        await page.keyboard.press('Control+s');
        await expect.poll(() => kept.evaluate(({ pressed }) => pressed)).toBe(true);
        const box = await page.locator('canvas').first().boundingBox();
        if (!box) throw new Error('The viewport has no box.');
        await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
        send?.();
        await page.locator('[role=treeitem][aria-selected=true]').filter({ hasText: 'post' }).waitFor();
        await expect.poll(() => page.getByText('Something went wrong').count()).toBe(0);
      },
      { blank: true, touch: true },
    ));

  it('says so where menus and panels do not come', () =>
    withPage(
      async ({ page, url }) => {
        await page.route('**/rest-*.js', (route) => route.abort('connectionrefused'));
        await page.goto(url);
        await page.getByText('Menus and panels could not be loaded').waitFor();
      },
      { blank: true, expected: /rest-/ },
    ));

  it('keys pressed while the search loads go into its field, and none to a panel', () =>
    withPage(
      async ({ page, url }) => {
        let send: (() => void) | undefined;
        const asked = page.waitForRequest('**/command-search-*.js');
        await page.route('**/command-search-*.js', (route) => {
          send = () => void route.continue();
        });
        await page.goto(url);
        await asked;
        await shown(page, 'post');
        const tree = page.getByRole('tree').first();
        await tree.focus();
        await page.keyboard.press('Control+k');
        // T would hide the outliner, D change the units, and the outliner goes to rows by their letters.
        await page.keyboard.type('dark tx');
        await page.keyboard.press('Backspace');
        await page.keyboard.press('Backspace');
        await page.keyboard.type('theme');
        await expect.poll(() => page.getByRole('dialog').count()).toBe(0);
        await page.keyboard.press('Enter');
        send?.();
        await page.locator('[data-theme=dark]').first().waitFor({ state: 'attached' });
        await page.getByRole('dialog').waitFor({ state: 'detached' });
        await expect.poll(() => tree.evaluate((one) => one.contains(document.activeElement))).toBe(true);
      },
      { blank: true },
    ));

  inPage('makes the test kit when it is asked for', async ({ page }) => {
    await shown(page, 'post');
    const download = page.waitForEvent('download');
    await page.evaluate(() => window.marrow.run('kit.save'));
    const saved = await download;
    expect(saved.suggestedFilename()).toBe('marrow-kit.zip');
    const files = unzipSync(new Uint8Array(readFileSync(await saved.path())));
    expect(Object.keys(files)).toEqual(expect.arrayContaining(['marrow-kit/tree.skel', 'marrow-kit/README.md']));
    const answers = JSON.parse(strFromU8(files['marrow-kit/answers.json']));
    expect(answers.sets.length).toBeGreaterThan(5);
  });

  inPage('says so where a dialog does not come, and goes on', async ({ page }) => {
    await shown(page, 'post');
    await page.route('**/about-*.js', (route) => route.abort('connectionrefused'));
    await page.evaluate(() => window.marrow.run('help.about'));
    await page.getByText('The dialog could not be loaded').filter({ visible: true }).first().waitFor();
    await page.evaluate(() => window.marrow.run('help.shortcuts'));
    await page.getByRole('dialog', { name: 'Shortcuts' }).waitFor();
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
  });
});
