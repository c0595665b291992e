/** The manual beside the page: opened from the Help menu and by F1, without the server, without script, in both themes. */
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';

const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);
/** Errors of the manual's own tabs, its policy's too. */
function watch(page: Page, problems: string[]): void {
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(`${page.url()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => problems.push(`${page.url()}: ${error.message}`));
  page.on('response', (response) => {
    if (response.status() >= 400) problems.push(`${response.url()} answered ${response.status()}`);
  });
}

/** Goes through all pages by *Next*; how many there are, and which pictures are broken or pages wider than the window. */
async function readThrough(
  page: Page,
): Promise<{ readonly titles: readonly string[]; readonly faults: readonly string[] }> {
  const titles: string[] = [];
  const faults: string[] = [];
  for (let next: string | null = page.url(); next !== null; ) {
    // Waits until the page has its style and pictures.
    await page.goto(new URL(next, page.url()).href);
    titles.push(await page.locator('h1').innerText());
    const found = await page.evaluate(async () => {
      const broken = await Promise.all(
        [...document.images].map((image) =>
          image.decode().then(
            () => undefined,
            () => image.src,
          ),
        ),
      );
      const { scrollWidth, clientWidth } = document.documentElement;
      const isStyled = getComputedStyle(document.body).margin === '0px';
      return [...broken, scrollWidth > clientWidth && 'wider than the window', !isStyled && 'without its style'];
    });
    faults.push(...found.flatMap((fault) => (fault ? [`${page.url()}: ${fault}`] : [])));
    const link = page.locator('a[rel=next]');
    next = (await link.count()) > 0 ? await link.getAttribute('href') : null;
  }
  return { titles, faults };
}

describe('the manual', () => {
  it('the manual opens from Help at its contents, and by F1 at the page about the panel or dialog in use, in one window', () =>
    withPage(async ({ page }) => {
      await shown(page, 'post');
      await page.getByRole('menuitem', { name: 'Help', exact: true }).click();
      const [manual] = await Promise.all([
        page.waitForEvent('popup'),
        page.getByRole('menuitem', { name: /^Manual/ }).click(),
      ]);
      const problems: string[] = [];
      watch(manual, problems);
      await manual.waitForURL('**/manual/index.html');
      await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();

      await page.getByRole('tree').first().focus();
      await page.keyboard.press('F1');
      await manual.waitForURL('**/manual/guide/looking.html');

      await page.getByRole('tab', { name: 'Dope sheet' }).click();
      await page.locator('.dope').first().hover();
      await page.keyboard.press('F1');
      await manual.waitForURL('**/manual/guide/curves.html#dope-sheet');

      await page.evaluate(() => window.marrow.run('posing.ik'));
      await page.locator('canvas').first().hover();
      await page.keyboard.press('F1');
      await manual.waitForURL('**/manual/guide/posing.html#ik');

      await page.evaluate(() => window.marrow.run('help.programs'));
      await page.getByRole('dialog').waitFor();
      await page.keyboard.press('F1');
      await manual.waitForURL('**/manual/guide/other-programs.html#which-program-opens-what');
      await page.getByRole('dialog').waitFor();
      expect(page.context().pages().length).toBe(2);
      expect(problems).toEqual([]);
    }));

  it('all pages of the manual open offline, once the page is stored', () =>
    withPage(
      async ({ page, url, stopServer }) => {
        await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
        await page.context().setOffline(true);
        await stopServer();
        const manual = await page.context().newPage();
        const problems: string[] = [];
        watch(manual, problems);
        await manual.goto(`${url}manual/`);
        const { titles, faults } = await readThrough(manual);
        expect(titles.length).toBeGreaterThan(20);
        expect(faults).toEqual([]);
        expect(problems).toEqual([]);
      },
      // With the examples that the service worker stores, of which this one draws little.
      { serviceWorker: true, walking: true, query: '?files=samples/cube.skel' },
    ));

  it.each([
    ['on a phone, in the dark theme', { width: 390, height: 844 }, 'dark', 'rgb(33, 36, 39)'],
    ['at a desk, in the light theme', { width: 1280, height: 800 }, 'light', 'rgb(246, 247, 248)'],
  ] as const)('all pages of the manual are read without script, %s', (_where, viewport, colorScheme, ground) =>
    withPage(async ({ page, url }) => {
      const context = await page.context().browser()?.newContext({ viewport, colorScheme, javaScriptEnabled: false });
      if (!context) throw new Error('The page has no browser.');
      try {
        const manual = await context.newPage();
        const problems: string[] = [];
        watch(manual, problems);
        await manual.goto(`${url}manual/index.html`);
        const behind = await manual.locator('html').evaluate((html) => getComputedStyle(html).backgroundColor);
        expect(behind).toBe(ground);
        const { titles, faults } = await readThrough(manual);
        expect(new Set(titles).size).toBe(titles.length);
        expect(faults).toEqual([]);
        expect(problems).toEqual([]);
      } finally {
        await context.close();
      }
    }),
  );
});
