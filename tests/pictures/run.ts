/**
 * `npm run docs:pictures`: makes the pictures of docs/ from the built page, all or those that are named. The same page
 * makes the same bytes on one machine; fonts are the system's, so another machine's differ.
 */
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { launchChromium } from '../helpers/chromium.ts';
import { serveFolder } from '../helpers/server.ts';
import { fileOf, SHOTS, type Shot } from './shots.ts';

const at = (path: string) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
const EXAMPLES: readonly { readonly id: string; readonly files: readonly string[] }[] = JSON.parse(
  readFileSync(at('public/samples/samples.json'), 'utf8'),
);
const MAX_BYTES = 150_000;
/** From without loss downwards, until the picture is small enough. */
const QUALITIES = [1, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7];
/** Looks at the page before it counts as one that never rests. */
const MAX_LOOKS = 40;

/** @param names without extensions; empty: all. @returns the exit status */
export async function run(names: readonly string[]): Promise<number> {
  const unknown = names.filter((name) => !SHOTS.some((shot) => shot.name === name));
  if (unknown.length > 0) {
    console.error(`There is no picture ${unknown.join(', ')}. There are ${SHOTS.map(({ name }) => name).join(', ')}.`);
    return 2;
  }
  mkdirSync(at('docs/pictures'), { recursive: true });
  const server = await serveFolder(at('dist'), '/');
  const browser = await launchChromium();
  let status = 0;
  for (const shot of SHOTS.filter(({ name }) => names.length === 0 || names.includes(name))) {
    const context = await browser.newContext({
      viewport: shot.size ?? { width: 1200, height: 750 },
      colorScheme: shot.theme ?? 'dark',
      reducedMotion: 'reduce',
      serviceWorkers: 'block',
    });
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    await page.addInitScript(() => localStorage.setItem('marrow.settings', JSON.stringify({ firstSteps: false })));
    const [opening] = EXAMPLES;
    const { id, files = [] } = EXAMPLES.find((example) => example.id === shot.example) ?? {};
    // The first is what the page opens with, as it shows it.
    const query = id === opening?.id ? '' : `?files=${files.map((file) => `samples/${file}`).join(',')}`;
    await page.goto(server.url + query);
    await page.waitForFunction(() => window.marrow?.characters().length > 0 && !document.querySelector('#app.frame'));
    await page.locator('.inspector .lil-gui').first().waitFor({ state: 'attached' });
    try {
      const { name, bytes } = await made(page, shot);
      writeFileSync(at(`docs/pictures/${name}`), bytes);
      if (bytes.length > MAX_BYTES) throw new Error(`${bytes.length} bytes are too many.`);
      console.log(`${String(bytes.length).padStart(8)}  ${name}`);
    } catch (error) {
      status = 1;
      console.error(`${shot.name}: ${error instanceof Error ? error.message : error}`);
    }
    await context.close();
  }
  await browser.close();
  await server.close();
  return status;
}

async function made(page: Page, shot: Shot): Promise<{ readonly name: string; readonly bytes: Uint8Array }> {
  await shot.act(page);
  if (shot.film) return { name: fileOf(shot), bytes: await shot.film(page) };
  const png = await resting(page);
  for (const quality of QUALITIES) {
    const bytes = await asWebp(page, png, quality);
    if (bytes.length <= MAX_BYTES || quality === QUALITIES.at(-1)) return { name: fileOf(shot), bytes };
  }
  throw new Error('There are no qualities.');
}

/** A screenshot once two in a row are the same. */
async function resting(page: Page): Promise<Buffer> {
  let before = await page.screenshot();
  for (let look = 0; look < MAX_LOOKS; look++) {
    await page.waitForTimeout(150);
    const now = await page.screenshot();
    if (now.equals(before)) return now;
    before = now;
  }
  throw new Error('The page does not come to rest.');
}

/** By the browser's own encoder. @param quality 1: without loss */
async function asWebp(page: Page, png: Buffer, quality: number): Promise<Uint8Array> {
  const base64 = await page.evaluate(
    async ({ given, quality }) => {
      const bytes = Uint8Array.from(atob(given), (letter) => letter.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext('2d');
      if (!context) throw new Error('no 2D canvas');
      context.drawImage(bitmap, 0, 0);
      const made = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/webp', quality })).arrayBuffer());
      let text = '';
      for (let i = 0; i < made.length; i += 0x8000) text += String.fromCharCode(...made.subarray(i, i + 0x8000));
      return btoa(text);
    },
    { given: png.toString('base64'), quality },
  );
  return Buffer.from(base64, 'base64');
}
