/** The manual: in the page, opened from the Help menu and by F1; and its pages alone, without the server, without script. */
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
  it('the manual has the inspector’s place: from Help its contents, by F1 the page about the panel in use', () =>
    withPage(
      async ({ page }) => {
        await shown(page, 'post');
        await page.locator('.inspector .lil-gui').first().waitFor();
        const stage = () => page.locator('.stage').evaluate((one) => one.clientWidth);
        const before = await stage();
        await page.getByRole('menuitem', { name: 'Help', exact: true }).click();
        await page.getByRole('menuitem', { name: /^Manual/ }).click();
        const manual = page.getByRole('region', { name: 'Manual' });
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();
        const { x = 0, width = 0 } = (await manual.boundingBox()) ?? {};
        expect(x + width).toBe(1440);
        expect(width).toBeGreaterThan(390);
        expect(width).toBeLessThan(410);
        await page.locator('.inspector .lil-gui').first().waitFor({ state: 'hidden' });
        await expect.poll(stage).toBeGreaterThan(800);
        // Its links and pictures are its own, and there is a way back.
        await manual.getByRole('link', { name: 'Looking', exact: true }).click();
        await manual.getByRole('heading', { name: 'Looking', level: 1 }).waitFor();
        const isDrawn = () =>
          manual
            .locator('img')
            .first()
            .evaluate((one: HTMLImageElement) => one.naturalWidth > 0);
        await expect.poll(isDrawn).toBe(true);
        await manual.getByRole('button', { name: 'Previous page' }).click();
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();

        await page.getByRole('tree').first().focus();
        await page.keyboard.press('F1');
        await manual.getByRole('heading', { name: 'Looking', level: 1 }).waitFor();
        await page.getByRole('tab', { name: 'Dope sheet' }).click();
        await page.locator('.dope').first().hover();
        await page.keyboard.press('F1');
        const sheet = manual.getByRole('heading', { name: 'Dope sheet', level: 2 });
        await sheet.waitFor();
        // Its heading is at the top of what is read.
        const top = async () => ((await sheet.boundingBox())?.y ?? 0) - ((await manual.boundingBox())?.y ?? 0);
        await expect.poll(top).toBeLessThan(80);
        await page.evaluate(() => window.marrow.run('posing.ik'));
        await page.locator('canvas').first().hover();
        await page.keyboard.press('F1');
        await manual.getByRole('heading', { name: 'IK', level: 2 }).waitFor();

        await manual.getByRole('button', { name: 'Close manual' }).click();
        await page.locator('.inspector .lil-gui').first().waitFor();
        await expect.poll(stage).toBe(before);
        expect(page.context().pages().length).toBe(1);

        // Nothing behind a dialog can be read.
        await page.evaluate(() => window.marrow.run('help.programs'));
        await page.getByRole('dialog').waitFor();
        const [beside] = await Promise.all([page.waitForEvent('popup'), page.keyboard.press('F1')]);
        const problems: string[] = [];
        watch(beside, problems);
        await beside.waitForURL('**/manual/guide/other-programs.html#which-program-opens-what');
        await page.getByRole('dialog').waitFor();
        expect(problems).toEqual([]);
      },
      { size: { width: 1440, height: 900 } },
    ));

  it('on a phone the manual is a sheet, and the inspector’s button closes it', () =>
    withPage(
      async ({ page }) => {
        await shown(page, 'post');
        await page.evaluate(() => window.marrow.run('help.manual'));
        const manual = page.getByRole('region', { name: 'Manual' });
        await manual.getByRole('heading', { name: 'Manual', level: 1 }).waitFor();
        const { y = 0, width = 0 } = (await manual.boundingBox()) ?? {};
        expect(width).toBe(390);
        expect(y / 844).toBeCloseTo(0.4, 1);
        await page.getByRole('button', { name: 'Inspector', exact: true }).tap();
        await manual.waitFor({ state: 'hidden' });
      },
      { size: { width: 390, height: 844 }, touch: true },
    ));

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
