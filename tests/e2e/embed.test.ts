/** The page in a frame of another one: `?embed=1`. */
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { fileURLToPath } from 'node:url';
import type { Browser, Frame, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { FromEmbedded } from '../../src/app/embed/embed-messages.ts';
import { fillNoPixels, sharedChromium } from '../helpers/page.ts';
import { type StaticServer, serveFolder } from '../helpers/server.ts';

const DIST = fileURLToPath(new URL('../../dist', import.meta.url));

declare global {
  interface Window {
    /** What the frame has said, in `around`. */
    heard?: FromEmbedded[];
  }
}

let browser: Browser;
let server: StaticServer;
/** Another origin, with pages that frame it. */
const around = createServer((request, response) => {
  const frame = new URL(request.url ?? '/', 'http://localhost').searchParams.get('frame') ?? '';
  response.writeHead(200, { 'content-type': 'text/html; charset=utf-8' }).end(`<!doctype html><title>Around</title>
<script>heard = []; addEventListener('message', ({ data, origin }) => heard.push({ ...data, origin }))</script>
<p>A page</p><input><iframe src="${frame.replaceAll('&', '&amp;')}" width="640" height="480"></iframe>`);
});
let origin = '';

beforeAll(async () => {
  browser = await sharedChromium();
  server = await serveFolder(DIST, '/marrow/', 'http:');
  await new Promise<void>((resolve) => around.listen(0, '127.0.0.1', resolve));
  // Listening on a port, so it has one.
  origin = `http://127.0.0.1:${(around.address() as AddressInfo).port}`;
});

afterAll(async () => {
  await server.close();
  around.close();
});

/** Opens a page around the embedded one. @param query besides `embed=1` */
async function embedded(
  query: string,
  body: (page: Page, frame: Frame) => Promise<void>,
  expected?: RegExp,
): Promise<void> {
  server.serve({});
  const page = await browser.newPage({ viewport: { width: 800, height: 600 }, reducedMotion: 'no-preference' });
  try {
    const problems: string[] = [];
    page.on('pageerror', (error) => problems.push(error.message));
    page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
    const address = `${server.url}?embed=1&${query}`;
    await page.addInitScript(fillNoPixels, false);
    await page.goto(`${origin}/?frame=${encodeURIComponent(address)}`);
    const frame = page.frames().find((one) => one.url().startsWith(server.url));
    if (!frame) throw new Error('The page has no frame.');
    await frame.getByRole('link', { name: 'Open in Marrow' }).waitFor();
    await body(page, frame);
    expect(problems.filter((problem) => !expected?.test(problem))).toEqual([]);
  } finally {
    await page.close();
  }
}

const say = (page: Page, message: unknown) =>
  page.evaluate((data) => document.querySelector('iframe')?.contentWindow?.postMessage(data, '*'), message);
const heard = (page: Page, kind: FromEmbedded['marrow']) =>
  page.evaluate((name) => (window.heard ?? []).filter(({ marrow }) => marrow === name), kind);
const last = async <Kind extends FromEmbedded['marrow']>(page: Page, kind: Kind) =>
  // Filtered by its kind.
  (await heard(page, kind)).at(-1) as Extract<FromEmbedded, { readonly marrow: Kind }> | undefined;

describe('the embedded page', () => {
  it('the embedded page shows the link, does what the page around says, and tells it what happens', () =>
    embedded(
      `sample=walker&time=1&embed-origin=${encodeURIComponent(origin)}`,
      async (page, frame) => {
        await expect.poll(() => last(page, 'ready')).toMatchObject({ characters: ['walker'] });
        const time = frame.getByRole('slider', { name: 'Time in seconds' });
        await expect.poll(async () => Number(await time.inputValue())).toBe(1);
        await say(page, { marrow: 'seek', time: 0.5 });
        await expect.poll(() => last(page, 'time')).toMatchObject({ time: 0.5, playing: false });
        await say(page, { marrow: 'play' });
        await expect.poll(async () => (await last(page, 'time'))?.time).toBeGreaterThan(0.6);
        await say(page, { marrow: 'pause' });
        await expect.poll(() => last(page, 'time')).toMatchObject({ playing: false });
        await say(page, { marrow: 'select', joint: 'hand_l' });
        await say(page, { marrow: 'camera', view: [0, 1, 3, 0, 1, 0] });
        await say(page, { marrow: 'select', joint: 'wing' });
        await expect.poll(() => last(page, 'error')).toMatchObject({ message: 'There is no joint wing.' });
        await say(page, { marrow: 'dance' });
        await expect.poll(async () => (await last(page, 'error'))?.message).toContain('There is no message "dance"');
        await say(page, { marrow: 'open', files: ['samples/crawler.skel', 'samples/crawler_walk.anim'] });
        await expect.poll(() => last(page, 'ready')).toMatchObject({ characters: ['crawler'] });
        await say(page, { marrow: 'open', files: ['samples/nowhere.skel'] });
        await expect.poll(async () => (await last(page, 'error'))?.message).toContain('nowhere.skel');
        // What was open stays.
        await expect.poll(() => frame.getByRole('img').getAttribute('aria-label')).toBe('crawler');
        await say(page, { marrow: 'open', files: ['samples/cube.skel'] });
        await expect.poll(() => last(page, 'ready')).toMatchObject({ characters: ['cube'] });
        const [ready, errors] = [await heard(page, 'ready'), await heard(page, 'error')];
        expect(ready.length).toBe(3);
        expect(errors.length).toBe(3);
      },
      /status of 404/,
    ));

  it('an origin that can’t be is told in the frame, and an address is taken for its origin', async () => {
    await embedded('sample=walker&embed-origin=*', async (page, frame) => {
      const told = () => frame.locator('.message').innerText();
      await expect.poll(told).toContain('The link asks for what can’t be: embed-origin=* (expected the origin');
      const said = await page.evaluate(() => window.heard);
      expect(said).toEqual([]);
    });
    await embedded(`sample=walker&time=1&embed-origin=${encodeURIComponent(`${origin}/page`)}`, async (page) => {
      await expect.poll(() => last(page, 'ready')).toMatchObject({ characters: ['walker'] });
      await say(page, { marrow: 'seek', time: 0.5 });
      await expect.poll(() => last(page, 'time')).toMatchObject({ time: 0.5, playing: false });
    });
  });

  it('the embedded page stores nothing, loads no panels before its picture, and leads to the whole page', () =>
    embedded('sample=walker&show=skin', async (_page, frame) => {
      const before = server.asked
        .filter((path) => path.endsWith('.js'))
        .map((path) => path.replace(/-[\w-]{8}\.js$/, ''));
      expect(before.slice(0, 3).sort()).toEqual(['assets/index', 'assets/rolldown-runtime', 'assets/three']);
      expect(before).toContain('assets/embed');
      expect(before).not.toContain('assets/inspector');
      const href = await frame.getByRole('link', { name: 'Open in Marrow' }).getAttribute('href');
      expect(href).toBe('/marrow/?sample=walker&show=skin');
      const stored = await frame.evaluate(async () => ({
        local: localStorage.length,
        databases: (await indexedDB.databases()).length,
        workers: (await navigator.serviceWorker.getRegistrations()).length,
      }));
      expect(stored).toEqual({ local: 0, databases: 0, workers: 0 });
    }));

  it('the embedded page has keys while it has the focus, and hears none but the origin that is named', () =>
    embedded('sample=walker&play=0&embed-origin=https://elsewhere.example', async (page, frame) => {
      const time = frame.getByRole('slider', { name: 'Time in seconds' });
      const at = async () => Number(await time.inputValue());
      await page.locator('input').press('Space');
      await say(page, { marrow: 'seek', time: 0.5 });
      await frame.getByRole('img').focus();
      await page.keyboard.press('.');
      await expect.poll(at).toBeGreaterThan(0);
      const stepped = await at();
      expect(stepped).toBeLessThan(0.1);
      const said = await page.evaluate(() => window.heard);
      expect(said).toEqual([]);
    }));
});
