/** Links: what an address opens and shows, copied and opened elsewhere, and what is asked of servers for it. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import fc from 'fast-check';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const NAMES = ['crawler.skel', 'crawler.skin', 'crawler_walk.anim'];
const files = Object.fromEntries(NAMES.map((name) => [`given/${name}`, readFileSync(SAMPLES + name)]));
const FILES = `?files=${NAMES.map((name) => `given/${name}`).join(',')}`;

const notes = (page: Page) => page.locator('.message-line').textContent();

/** The viewport alone, once nothing moves any more. */
async function picture(page: Page): Promise<string> {
  await page.locator('.inspector .lil-gui').first().waitFor({ state: 'attached' });
  const canvas = page.locator('.viewport canvas').first();
  let before = '';
  for (;;) {
    const now = (await canvas.screenshot()).toString('base64');
    if (now === before) return now;
    before = now;
  }
}

async function copied(page: Page): Promise<string> {
  await page.evaluate(async () => {
    await navigator.clipboard.writeText('');
    await window.marrow.run('save.link');
  });
  await expect.poll(() => page.evaluate(() => navigator.clipboard.readText())).not.toBe('');
  return page.evaluate(() => navigator.clipboard.readText());
}

it('a link shows what it says; its copy, opened in another page, shows the same pixels, and only what it names is fetched', () =>
  withPage(
    async ({ page, url, asked, openAnother }) => {
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      await page.waitForFunction(() => window.marrow?.characters().length === 1);
      const shown = await page.evaluate(() => {
        const { dofs, takes } = window.marrow.characters()[0];
        return { dofs: dofs.length, takes, theme: document.documentElement.dataset.theme };
      });
      expect(shown).toMatchObject({ takes: ['crawler_walk'], theme: 'light' });
      const own = await picture(page);
      const named = asked().filter((path) => path.startsWith('given/') || path.startsWith('samples/'));
      expect(named.sort()).toEqual([...Object.keys(files).sort(), 'samples/samples.json']);
      const link = await copied(page);
      expect(link.slice(url.length)).toMatch(
        /^\?files=given\/crawler\.skel,.*&time=0\.4&select=.*&camera=.*&theme=light$/,
      );

      const other = await openAnother(link.slice(url.length));
      await other.waitForFunction(() => window.marrow?.characters().length === 1);
      await expect.poll(() => picture(other)).toBe(own);
      const again = await copied(other);
      expect(again).toBe(link);
      await other.close();

      // What was dropped is nobody else's.
      await page.evaluate(async () => {
        await window.marrow.open([{ name: 'mine.skel', content: 'balljoint a { }' }]);
        await window.marrow.run('save.link');
      });
      await expect.poll(() => notes(page)).toContain('and mine.skel did not.');
    },
    {
      files,
      drawn: true,
      size: { width: 960, height: 360 },
      query: `${FILES}&time=0.4&select=root&camera=2,1.5,3,0,0.4,0&show=skin,bones,no-shadow&theme=light&panel=curves`,
    },
  ));

it('a link to an example opens it; what can’t be is one message, and nothing else is fetched', () =>
  withPage(
    async ({ page, asked, problems }) => {
      await page.waitForFunction(() => window.marrow?.characters()[0]?.name === 'cube');
      await expect
        .poll(() => notes(page))
        .toContain('The link asks for what can’t be: time=x (expected seconds); take=dance (expected cube_spin).');
      const outside = asked().filter(
        (path) => !/^(assets|icons|manual|samples)\/|^(\?.*|index\.html|[\w.-]+)?$/.test(path),
      );
      expect(outside).toEqual([]);
      expect(
        asked()
          .filter((path) => path.startsWith('samples/'))
          .sort(),
      ).toEqual(['samples/cube.rig', 'samples/cube.skel', 'samples/cube_spin.anim', 'samples/samples.json'].sort());
      expect(problems).toEqual([]);
    },
    { walking: true, query: '?sample=cube&time=x&take=dance&image=https://example.org/a.png' },
  ));

/** Addresses as someone might send them who wants a page to ask elsewhere: few and long, since each is a page. */
const ANY_ADDRESS = fc
  .array(
    fc
      .tuple(
        fc.constantFrom(
          'sample',
          'take',
          'time',
          'range',
          'select',
          'camera',
          'show',
          'panel',
          'theme',
          'embed',
          'src',
        ),
        fc.oneof(
          fc.constantFrom(
            '//example.org/a',
            'https://example.org/a.skel',
            '../a.skel',
            '..%2f..%2fa',
            'data:,a',
            '1e999',
          ),
          fc.constantFrom('javascript:fetch("/a")', '<img src=/a>', 'url(/a)', '__proto__', '%zz', '0'),
          fc.string({ unit: 'grapheme', maxLength: 12 }).map(encodeURIComponent),
        ),
      )
      .map(([name, value]) => `${name}=${value}`),
    { minLength: 1, maxLength: 12 },
  )
  .map((parts) => `?${parts.join('&')}`);

it('an address of any text asks for nothing but the page’s own files', () =>
  withPage(
    async ({ page, url, asked }) => {
      for (const query of fc.sample(ANY_ADDRESS, 4)) {
        await page.goto(url + query);
        await page.waitForFunction(() => window.marrow !== undefined && !document.querySelector('#app.frame'));
      }
      // The list of examples is one of them.
      const elsewhere = asked().filter(
        (path) => !/^(assets|icons|manual)\/|^samples\/samples\.json$|^(\?.*|index\.html|[\w.-]+)?$/.test(path),
      );
      expect([...new Set(elsewhere)]).toEqual([]);
    },
    { blank: true },
  ));
