/** *Save > Web page*: one file, opened from disk without a network, which shows what the page shows. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { MarrowViewer } from '../../src/viewer/element.ts';
import { glbOf } from '../helpers/glb.ts';
import { hero } from '../helpers/hero.ts';
import { inOnePage } from '../helpers/one-page.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { type DroppedFile, dropFiles, fillNoPixels, type OpenPage, screenshot, withPage } from '../helpers/page.ts';
import { openedFrom } from '../helpers/saved-page.ts';

/** Bytes of a saved page without its files. */
const MAX_BYTES = 350_000;

const SMALL = { width: 480, height: 360 };

interface Size {
  readonly width: number;
  readonly height: number;
}

/**
 * Opens a saved page from disk, as somebody's browser without a network would, and fails on any problem.
 * @param isDrawn with the pixels of its viewport
 */
async function fromDisk(
  of: Page,
  text: string,
  { size, isDrawn = false }: { readonly size: Size; readonly isDrawn?: boolean },
  body: (page: Page) => Promise<void>,
): Promise<void> {
  const folder = mkdtempSync(join(tmpdir(), 'marrow-web-page-'));
  const context = await of.context().browser()?.newContext({ viewport: size, offline: true });
  if (!context) throw new Error('The page has no browser.');
  try {
    const path = join(folder, 'a page & more.html');
    writeFileSync(path, text);
    const page = await context.newPage();
    if (!isDrawn) await page.addInitScript(fillNoPixels, false);
    const problems: string[] = [];
    const asked: string[] = [];
    page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
    page.on('pageerror', (error) => problems.push(error.message));
    page.on('request', (request) => asked.push(request.url()));
    await page.goto(pathToFileURL(path).href);
    await page.waitForFunction(() => (document.querySelector<MarrowViewer>('marrow-viewer')?.joints?.length ?? 0) > 0);
    await body(page);
    expect(asked).toEqual([pathToFileURL(path).href]);
    expect(problems).toEqual([]);
  } finally {
    await context.close();
    rmSync(folder, { recursive: true, force: true });
  }
}

const shownIn = (page: Page) =>
  page.locator('marrow-viewer').evaluate((viewer: MarrowViewer) => ({
    time: viewer.currentTime,
    camera: viewer.cameraNumbers,
    worlds: viewer.characters.map((_, i) => Array.from(viewer.worldMatrices(i))),
  }));

/** Saves what the page shows, and holds the saved page to it, in a window of that size. */
async function expectSame(
  { page, download }: OpenPage,
  how: Parameters<typeof fromDisk>[2],
  look: (page: Page, text: string) => Promise<void>,
) {
  const { name, text } = await download(() => page.evaluate(() => window.marrow.run('save.webPage')));
  expect(name).toMatch(/\.html$/);
  const again = await page.evaluate(async () => (await window.marrow.webPage())?.text());
  expect(again).toBe(text);
  const own = await page.evaluate(() => ({
    worlds: window.marrow.characters().map(({ id }) => window.marrow.worldMatrices(id).flat()),
  }));
  const files = [...text.matchAll(/<pre hidden data-(?:file|packed|shown)[^<]*<\/pre>/g)].map(([part]) => part.length);
  expect(text.length - files.reduce((sum, length) => sum + length, 0)).toBeLessThan(MAX_BYTES);
  await fromDisk(page, text, how, async (saved) => {
    const { worlds } = await shownIn(saved);
    expect(worlds.map((world) => world.length)).toEqual(own.worlds.map((world) => world.length));
    const off = worlds.map((world, i) => Math.max(...world.map((value, k) => Math.abs(value - own.worlds[i][k]))));
    expect(Math.max(...off)).toBeLessThan(5e-10);
    await look(saved, text);
  });
}

/** Of the pixels of two pictures, the part that differs by more than a shade. @param page without a policy */
function difference(page: Page, pictures: readonly [string, string]): Promise<number> {
  return page.evaluate(async (addresses) => {
    const [ours, theirs] = await Promise.all(
      addresses.map(async (address) => {
        const bitmap = await createImageBitmap(await (await fetch(address)).blob());
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
        return canvas.getContext('2d')?.getImageData(0, 0, bitmap.width, bitmap.height);
      }),
    );
    if (!ours || !theirs || ours.width !== theirs.width || ours.height !== theirs.height) return 1;
    let off = 0;
    for (let i = 0; i < ours.data.length; i++) if (Math.abs(ours.data[i] - theirs.data[i]) > 2) off++;
    return off / ours.data.length;
  }, pictures);
}

async function dropped(page: Page, files: readonly DroppedFile[], characters: number): Promise<void> {
  await dropFiles(page, files);
  await page.waitForFunction((count) => window.marrow.characters().length === count, characters);
  await page.waitForFunction(() =>
    window.marrow.characters().every(({ id }) => window.marrow.worldMatrices(id).length > 0),
  );
}

const inPage = inOnePage();

describe('a saved page', () => {
  it('a saved page shows an edited document from disk: the same pixels at the same time, from the same camera', () =>
    withPage(
      async (open) => {
        const { page } = open;
        await page.waitForFunction(() => window.marrow.characters()[0]?.takes.length === 1);
        const size = await page.evaluate(async () => {
          const placement = { position: [0.2, 0, 0.1], turn: [0, 0.3, 0], scale: 1 };
          await window.marrow.run('character.place', { index: 0, placement });
          window.marrow.seek(0.6);
          await window.marrow.run('pose.setDofs', { dofs: [{ index: 4, value: 0.4 }], key: {} });
          const { clientWidth: width, clientHeight: height } =
            document.querySelector('.viewport canvas') ?? document.body;
          return { width, height };
        });
        const picture = await page.evaluate(async () => {
          window.fillPixels(true);
          const blob = await window.marrow.picture();
          window.fillPixels(false);
          return new Promise<string>((resolve) => {
            const reader = new FileReader();
            reader.onload = () => resolve(String(reader.result));
            reader.readAsDataURL(blob ?? new Blob());
          });
        });
        await expectSame(open, { size, isDrawn: true }, async (saved, text) => {
          await screenshot(saved, 'web-page-dark');
          await saved.evaluate(() => document.querySelector('marrow-viewer')?.removeAttribute('controls'));
          const canvas = () =>
            saved.evaluate(
              () => document.querySelector('marrow-viewer')?.shadowRoot?.querySelector('canvas')?.toDataURL() ?? '',
            );
          const plain = await page.context().newPage();
          await expect.poll(async () => difference(plain, [picture, await canvas()])).toBeLessThan(0.001);
          await plain.close();
          await fromDisk(page, text, { size: { width: 390, height: 844 } }, async (phone) => {
            const { camera } = await shownIn(phone);
            expect(Math.hypot(camera[0], camera[2])).toBeGreaterThan(1.5 * Math.hypot(2, 3));
            await phone.getByRole('button', { name: 'Play' }).dispatchEvent('click');
            await expect.poll(async () => (await shownIn(phone)).time).not.toBe(0.6);
          });
        });
      },
      {
        drawn: 'later',
        size: { width: 960, height: 400 },
        query: '?sample=walker&time=0.6&camera=2,1.5,3,0,0.8,0&show=skin,bones&theme=dark',
        walking: true,
      },
    ));

  inPage('a saved page shows captures and characters of other programs, several at once', async (open) => {
    const { page } = open;
    const files = [
      ...[...OWN_CAPTURES].slice(0, 1).map(([name, bytes]) => ({ name, bytes })),
      { name: 'hero.glb', bytes: glbOf(await hero(0.04)).bytes },
    ];
    await dropped(page, files, 2);
    await page.evaluate(() => window.marrow.seek(0.5));
    await expectSame(open, { size: SMALL }, async (saved, text) => {
      await expect.poll(async () => (await shownIn(saved)).time).toBe(0.5);
      const { characters } = openedFrom(text);
      expect(characters.map(({ name }) => name).sort()).toEqual(['hero', 'own-walk']);
    });
  });

  inPage('a saved page that was damaged says so, and shows nothing else than its own files', async (open) => {
    const { page } = open;
    const text = (await page.evaluate(async () => (await window.marrow.webPage())?.text())) ?? '';
    await fromDisk(page, text, { size: SMALL }, async (saved) => {
      await saved.evaluate(() => document.querySelector('marrow-viewer')?.setAttribute('src', 'other.skel'));
      await expect
        .poll(() => saved.locator('marrow-viewer .message').innerText())
        .toBe('A saved page shows its own files alone.');
    });
  });
});
