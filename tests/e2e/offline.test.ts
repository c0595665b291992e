/**
 * The built page as an app: stored by its service worker, updated, used without its server along with its manual, and
 * given files by the system. Systems can't be operated from tests, so their files come through a `launchQueue` of the
 * test's own.
 */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';
import { collectProblems, dropFiles, withPage } from '../helpers/page.ts';

const DIST = fileURLToPath(new URL('../../dist/', import.meta.url));
const ARM = 'balljoint shoulder { balljoint elbow { offset 0 1 0 } }';
const OFFER = 'A new version of Marrow is ready.';

type Consumer = (launch: { readonly files: readonly FileSystemFileHandle[] }) => void;

declare global {
  interface Window {
    /** What the page does with launches. */
    launch?: Consumer;
    file?: FileSystemFileHandle;
  }
}

/** A page that draws little, and still has the examples that its service worker stores. */
const SMALL = '?files=samples/cube.skel';

const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);
const controlled = (page: Page) => page.waitForFunction(() => navigator.serviceWorker.controller !== null);
/** Browsers look for a new version by themselves, but a test can't wait for that. */
const lookForVersion = (page: Page) =>
  page.evaluate(async () => {
    const registration = await navigator.serviceWorker.ready;
    await registration.update();
    const worker = registration.installing ?? registration.waiting;
    if (!worker) throw new Error('The server has no new version.');
    const isDone = () => worker.state !== 'installing';
    while (!isDone()) await new Promise((resolve) => worker.addEventListener('statechange', resolve, { once: true }));
    return worker.state;
  });

const built = (path: string) => readFileSync(join(DIST, path), 'utf8');
const integrity = (text: string) => `sha256-${createHash('sha256').update(text).digest('base64')}`;
const aboutScript = () => /"(assets\/about-[^"]+\.js)"/.exec(built('sw.js'))?.[1] ?? '';

/** Another build: another page, and no script of the About dialog's old name. */
function nextBuild() {
  const page = built('index.html').replace('<html lang="en"', '<html lang="en" data-build="next"');
  const script = aboutScript();
  const list = built('sw.js')
    .replace(integrity(built('index.html')), integrity(page))
    .replace(script, script.replace('about-', 'about-next-'));
  return {
    'index.html': page,
    'sw.js': list,
    [script]: 'throw new Error("This script is of another build.")',
    [script.replace('about-', 'about-next-')]: built(script),
  };
}
const buildOf = (page: Page) => page.evaluate(() => document.documentElement.dataset.build);

/** Stored once, with the examples: `walking`. A test that fails begins anew; the failed update is a problem. */
const inStored = inOnePage({ serviceWorker: true, walking: true, query: SMALL, expected: /index\.html|sw\.js/ });

inStored(
  'a new version is offered and never forced: other tabs keep their work and their own scripts',
  async ({ page, serve, openAnother, problems }) => {
    await controlled(page);
    const offer = (tab: Page) => tab.getByRole('region', { name: 'New version' });
    await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
    await shown(page, 'arm');
    await page.evaluate(() => window.marrow.run('rig.rename', { joint: 0, name: 'humerus' }));
    serve(nextBuild());
    const version = await lookForVersion(page);
    expect(version).toBe('installed');
    await offer(page).getByText(`${OFFER} Unsaved changes can be restored`).waitFor();

    const other = await openAnother(SMALL);
    await expect.poll(() => buildOf(other)).toBeUndefined();
    await offer(other).getByText(OFFER).waitFor();
    await offer(other).getByRole('button', { name: 'Reload' }).click();
    await other.waitForFunction(() => document.documentElement.dataset.build === 'next');

    await expect.poll(() => buildOf(page)).toBeUndefined();
    // Not on the server any more.
    await page.evaluate(() => window.marrow.run('help.about'));
    await page.getByRole('dialog').getByText('Works offline').waitFor();
    await page.keyboard.press('Escape');

    const answers = ['dismiss', 'accept'] as const;
    const asked: string[] = [];
    page.on('dialog', (dialog) => {
      asked.push(dialog.type());
      void dialog[answers[asked.length - 1]]();
    });
    await offer(page).getByRole('button', { name: 'Reload' }).click();
    await expect.poll(() => asked).toEqual(['beforeunload']);
    await expect
      .poll(() => page.evaluate(() => window.marrow.characters().map(({ name }) => name)))
      .toEqual(['cube', 'arm']);
    await offer(page).getByRole('button', { name: 'Reload' }).click();
    await page.waitForFunction(() => document.documentElement.dataset.build === 'next');
    expect(asked).toEqual(['beforeunload', 'beforeunload']);
    await page.getByRole('region', { name: 'Unsaved work' }).getByText('arm').waitFor();
    expect(problems).toEqual([]);
    page.removeAllListeners('dialog');
  },
);

inStored(
  'the page plays, opens examples, panels and files without its server, after a failed update too',
  async ({ page, url, serve, stopServer }) => {
    await controlled(page);
    // An upload that was interrupted: the list is new, and the page is not.
    serve({ 'sw.js': built('sw.js').replace(integrity(built('index.html')), integrity('not yet')) });
    const version = await lookForVersion(page);
    expect(version).toBe('redundant');
    await stopServer();

    await page.goto(url);
    await shown(page, 'walker');
    const before = await page.evaluate(() => window.marrow.worldMatrices('walker'));
    await page.evaluate(() => window.marrow.play());
    await expect.poll(() => page.evaluate(() => window.marrow.worldMatrices('walker'))).not.toEqual(before);
    await page.evaluate(() => window.marrow.pause());

    await page.evaluate(() => window.marrow.run('help.about'));
    await page.getByText('Works offline').waitFor();
    await page.keyboard.press('Escape');
    await page.getByRole('tab', { name: 'Dope sheet' }).click();
    await page.locator('.dope').first().waitFor();
    await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
    await shown(page, 'arm');
    await page.evaluate(() => window.marrow.run('sample.crawler'));
    await shown(page, 'crawler');
  },
);

const PHONE = { width: 390, height: 844 };
const DESK = { width: 1280, height: 800 };

interface Read {
  readonly title: string;
  /** Of its link *Next*; the last page has none. */
  readonly next: string | undefined;
  readonly faults: readonly string[];
}

/** Reads a page of the manual, with what is wrong: pictures that are broken, and windows that it is wider than. */
async function read(page: Page, sizes: readonly (typeof DESK)[]): Promise<Read> {
  const { faults, ...found } = await page.evaluate(async () => {
    const broken = await Promise.all(
      [...document.images].map((image) =>
        image.decode().then(
          () => [],
          () => [image.src],
        ),
      ),
    );
    return {
      title: document.querySelector('h1')?.innerText ?? '',
      next: document.querySelector<HTMLAnchorElement>('a[rel=next]')?.href,
      faults: [...broken.flat(), ...(getComputedStyle(document.body).margin === '0px' ? [] : ['without its style'])],
    };
  });
  for (const size of sizes) {
    if (page.viewportSize()?.width !== size.width) await page.setViewportSize(size);
    let isWider = false;
    const width = async () => {
      const now = await page.evaluate(() => {
        const { scrollWidth, clientWidth } = document.documentElement;
        return { width: window.innerWidth, isWider: scrollWidth > clientWidth };
      });
      isWider = now.isWider;
      return now.width;
    };
    await expect.poll(width).toBe(size.width);
    if (isWider) faults.push(`wider than ${size.width} pixels`);
  }
  return { ...found, faults: faults.map((fault) => `${page.url()}: ${fault}`) };
}

inStored(
  'all pages of the manual are read without the server and without script, on a phone and at a desk, light and dark',
  async ({ page, url, stopServer }) => {
    await controlled(page);
    await stopServer();
    const manual = await page.context().newPage();
    const session = await page.context().newCDPSession(manual);
    await session.send('Emulation.setScriptExecutionDisabled', { value: true });
    const problems: string[] = [];
    collectProblems(manual, url, problems);
    await manual.goto(`${url}manual/`);
    for (const [colorScheme, ground] of [
      ['dark', 'rgb(33, 36, 39)'],
      ['light', 'rgb(246, 247, 248)'],
    ] as const) {
      await manual.emulateMedia({ colorScheme });
      const behind = () => manual.locator('html').evaluate((html) => getComputedStyle(html).backgroundColor);
      await expect.poll(behind).toBe(ground);
    }
    const titles: string[] = [];
    const faults: string[] = [];
    // By *Next*; each begins at the size at which the one before ended.
    for (let address: string | undefined = manual.url(); address !== undefined; ) {
      // Waits until the page has its style and pictures.
      await manual.goto(address);
      const { title, next, faults: own } = await read(manual, titles.length % 2 ? [DESK, PHONE] : [PHONE, DESK]);
      titles.push(title);
      faults.push(...own);
      address = next;
    }
    expect(titles.length).toBeGreaterThan(20);
    expect(new Set(titles).size).toBe(titles.length);
    expect(faults).toEqual([]);
    expect(problems).toEqual([]);
  },
);

describe('the installed page', () => {
  it('the installed page opens files from the system, and saves changes back to them', () =>
    withPage(
      async ({ page }) => {
        const manifest = await (await page.context().newCDPSession(page)).send('Page.getAppManifest');
        expect(manifest.errors).toEqual([]);
        expect(JSON.parse(manifest.data ?? '').file_handlers).toHaveLength(1);

        await page.evaluate(async (text) => {
          const file = await (await navigator.storage.getDirectory()).getFileHandle('arm.skel', { create: true });
          const stream = await file.createWritable();
          await stream.write(text);
          await stream.close();
          Object.assign(window, { file });
          window.launch?.({ files: [] });
          window.launch?.({ files: [file] });
        }, ARM);
        await shown(page, 'arm');
        await page.evaluate(() => window.marrow.run('rig.rename', { joint: 0, name: 'humerus' }));
        await page.keyboard.press('Control+s');
        await expect
          .poll(() => page.evaluate(async () => (await window.file?.getFile())?.text()))
          .toContain('balljoint humerus');
      },
      {
        before: () => {
          const launchQueue = {
            setConsumer(consumer: Consumer) {
              window.launch = consumer;
            },
          };
          Object.defineProperty(window, 'launchQueue', { value: launchQueue });
        },
      },
    ));
});
