/** `<marrow-viewer>` in other people's pages. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { MarrowViewer, ReadDetail } from '../../src/package/viewer.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';
import { ELEMENT, withElement } from '../helpers/element-page.ts';
import { readPixels, screenshot } from '../helpers/page.ts';
import { countResources } from '../helpers/page-resources.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const WALKER = 'walker.skel walker.skin walker_walk.anim walker.png';

declare global {
  interface Window {
    /** Set by `countThreads`. */
    threads?: { workers: number; contexts: number };
    /** Names of events, set by `noteEvents`. */
    noted?: string[];
    /** Frames of all elements, set by `countFrames`. */
    framesDrawn?: number;
  }
}

/** Runs in the page before its scripts: counts workers and contexts that are begun less those that are given back. */
function countThreads(): void {
  const threads = { workers: 0, contexts: 0 };
  window.threads = threads;
  const { getContext } = HTMLCanvasElement.prototype;
  const seen = new WeakSet<object>();
  // One of its signatures; whatever is asked for is passed on.
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: [string]) {
    const made = getContext.apply(this, args);
    if (made instanceof WebGL2RenderingContext && !seen.has(made)) {
      seen.add(made);
      threads.contexts++;
      this.addEventListener('webglcontextlost', () => threads.contexts--);
    }
    return made;
  } as typeof getContext;
  const { Worker: Original } = window;
  const running = new Set<Worker>();
  window.Worker = class extends Original {
    constructor(...args: ConstructorParameters<typeof Worker>) {
      super(...args);
      running.add(this);
      threads.workers = running.size;
    }
    override terminate() {
      super.terminate();
      running.delete(this);
      threads.workers = running.size;
    }
  };
}

/** Runs in the page: notes the events of all elements, those of time once for several. */
function noteEvents(): void {
  const noted: string[] = [];
  window.noted = noted;
  for (const name of ['load', 'error', 'play', 'pause', 'ended', 'timeupdate']) {
    const note = ({ target }: Event) => {
      const isTime = name === 'timeupdate' && noted.at(-1) === name;
      if (target instanceof Element && target.localName === 'marrow-viewer' && !isTime) noted.push(name);
    };
    document.addEventListener(name, note, { capture: true });
  }
}

/** Runs in the page: counts the frames that elements draw, each into a canvas of its own. */
function countFrames(): void {
  const { prototype } = CanvasRenderingContext2D;
  const { drawImage } = prototype;
  window.framesDrawn = 0;
  prototype.drawImage = function (this: CanvasRenderingContext2D, ...args: Parameters<typeof drawImage>) {
    window.framesDrawn = (window.framesDrawn ?? 0) + 1;
    drawImage.apply(this, args);
  } as typeof drawImage;
}

const before = [countThreads, countResources, noteEvents, countFrames];
const element = (page: Page) => page.locator('marrow-viewer').first();
const noted = (page: Page, name: string) =>
  page.evaluate((asked) => window.noted?.filter((one) => one === asked).length, name);
const loaded = (page: Page, count = 1) => expect.poll(() => noted(page, 'load')).toBe(count);
const timeOf = (page: Page) => element(page).evaluate((viewer: MarrowViewer) => viewer.currentTime);
const words = (page: Page) => element(page).locator('.message').innerText();

const framesDrawn = (page: Page) => page.evaluate(() => window.framesDrawn ?? 0);

/** Waits until the page has had ten frames. */
async function tenFrames(page: Page): Promise<void> {
  for (let i = 0; i < 10; i++) await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(resolve)));
}

/** How many colours there are in a part of the page: of a picture, many. */
async function coloursAt(page: Page, target = element(page)): Promise<number> {
  const box = await target.boundingBox();
  if (!box) return 0;
  const { data } = await readPixels(page, box);
  const colours = new Set<number>();
  for (let i = 0; i < data.length; i += 4) colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
  return colours.size;
}

describe('the element', () => {
  it('the element poses as the command does, in a page with a strict policy', () =>
    withElement(
      { html: `<marrow-viewer src="${WALKER}" time="0.4"></marrow-viewer>`, before },
      async ({ page, asked }) => {
        await loaded(page);
        const { joints, world, characters, takes, duration, paused } = await element(page).evaluate(
          (viewer: MarrowViewer) => ({
            joints: viewer.joints,
            world: Array.from(viewer.worldMatrices()),
            characters: viewer.characters,
            takes: viewer.takes,
            duration: viewer.duration,
            paused: viewer.paused,
          }),
        );
        const files = ['walker.skel', 'walker.skin', 'walker_walk.anim'].map((name) => join(SAMPLES, name));
        const pose = await commandJson<PoseJson>(['pose', ...files, '--time', '0.4']);
        const [expected] = pose.characters;
        expect(joints).toEqual(expected.joints.map(({ name }) => name));
        const off = expected.joints.flatMap((joint) => joint.world).map((value, i) => Math.abs(world[i] - value));
        expect(Math.max(...off)).toBeLessThan(1e-12);
        expect([characters, takes, paused]).toEqual([['walker'], ['walker_walk'], true]);
        expect(duration).toBeGreaterThan(0.5);
        await expect.poll(() => coloursAt(page)).toBeGreaterThan(1000);
        const threads = await page.evaluate(() => window.threads);
        expect(threads).toEqual({ workers: 1, contexts: 1 });
        const scripts = asked().filter((path) => path.endsWith('.js'));
        expect(scripts.sort()).toEqual(['marrow-viewer.js', 'page.js', 'worker.js']);
        await screenshot(page, 'element-light');
      },
    ));

  it('the element is played by its controls, by keys while it has the focus, and by scripts', () =>
    withElement(
      {
        html: `<marrow-viewer src="${WALKER}" controls alt="A red panda walks"></marrow-viewer>`,
        before,
        drawn: false,
      },
      async ({ page }) => {
        await loaded(page);
        const stage = page.getByRole('img', { name: 'A red panda walks' });
        const time = page.getByRole('slider', { name: 'Time in seconds' });
        await page.getByRole('button', { name: 'Play' }).click();
        await expect.poll(() => timeOf(page)).toBeGreaterThan(0.05);
        await page.getByRole('button', { name: 'Pause' }).click();
        await time.fill('0.3');
        await expect.poll(() => timeOf(page)).toBe(0.3);
        // Elsewhere keys are the page's.
        await page.locator('body').press('Space');
        await stage.focus();
        const camera = () => element(page).evaluate((viewer: MarrowViewer) => [...viewer.cameraNumbers]);
        const first = await camera();
        await page.keyboard.press('ArrowLeft');
        const turned = await camera();
        expect(turned.slice(3)).toEqual(first.slice(3));
        expect(turned.slice(0, 3)).not.toEqual(first.slice(0, 3));
        await page.keyboard.press('Space');
        await expect.poll(() => timeOf(page)).not.toBe(0.3);
        await page.keyboard.press('Space');
        // It ends at its end, as a video does.
        await element(page).evaluate((viewer: MarrowViewer) => {
          viewer.currentTime = viewer.range[1] - 0.02;
          viewer.play();
        });
        await expect.poll(() => noted(page, 'ended')).toBe(1);
        const isPaused = await element(page).evaluate((viewer: MarrowViewer) => viewer.paused);
        expect(isPaused).toBe(true);
      },
    ));

  it('the element plays what it is asked to before it is loaded, and keeps no time of files that it showed before', () =>
    withElement({ html: '<marrow-viewer></marrow-viewer>', before, drawn: false }, async ({ page }) => {
      const asked = await element(page).evaluate((viewer: MarrowViewer, files) => {
        viewer.play();
        const empty = viewer.paused;
        viewer.setAttribute('src', files);
        viewer.play();
        return [empty, viewer.paused];
      }, WALKER);
      expect(asked).toEqual([true, false]);
      await expect.poll(() => timeOf(page)).toBeGreaterThan(0.05);
      const state = await element(page).evaluate(
        (viewer: MarrowViewer) =>
          new Promise((resolve) => {
            viewer.addEventListener('load', () => resolve([viewer.paused, viewer.currentTime, viewer.range]));
            viewer.setAttribute('src', 'cube.skel');
          }),
      );
      expect(state).toEqual([true, 0, [0, 2]]);
    }));

  it('the element says in its place what is wrong with files and attributes', () =>
    withElement(
      {
        html: '<marrow-viewer src="broken.skel" controls></marrow-viewer>',
        files: { 'broken.skel': 'balljoint a {\n  offset 1 two 3\n}\n' },
        before,
        drawn: false,
        expected: /answered 404|status of 404/,
      },
      async ({ page }) => {
        await expect.poll(() => words(page)).toMatch(/^broken\.skel:2:12: /);
        const set = (name: string, value: string) =>
          element(page).evaluate((viewer, [key, text]) => viewer.setAttribute(key, text), [name, value]);
        await set('src', 'nowhere.skel');
        await expect.poll(() => words(page)).toBe('"nowhere.skel" could not be fetched: the server answered 404.');
        await set('src', 'page.css');
        await expect.poll(() => words(page)).toContain('page.css: ');
        await expect.poll(() => noted(page, 'error')).toBe(3);
        // What is right is done.
        await set('src', WALKER);
        await loaded(page);
        await set('take', 'dance');
        await set('speed', 'fast');
        await set('show', 'skin, feathers');
        await set('background', 'tartan');
        await set('camera', '1,2');
        const told = await words(page);
        expect(told).toContain('take="dance" (expected walker_walk)');
        for (const name of ['speed', 'show', 'background', 'camera']) expect(told).toContain(`${name}="`);
        await page.evaluate(() => {
          for (const name of ['take', 'speed', 'show', 'background', 'camera']) {
            document.querySelector('marrow-viewer')?.removeAttribute(name);
          }
        });
        await expect.poll(() => element(page).locator('.message').isHidden()).toBe(true);
        const detail = await element(page).evaluate(
          (viewer) =>
            new Promise<ReadDetail>((resolve) => {
              viewer.addEventListener('error', (event) => resolve((event as CustomEvent<ReadDetail>).detail));
              viewer.setAttribute('src', 'broken.skel');
            }),
        );
        expect(detail.diagnostics[0]).toMatchObject({ severity: 'error', file: 'broken.skel', line: 2 });
      },
    ));

  it('the element is still for those who want less motion, and reads in its page where there is no worker', () =>
    withElement(
      {
        html: `<marrow-viewer src="${WALKER}" autoplay loop></marrow-viewer>`,
        before,
        allowsWorkers: false,
        fullMotion: false,
        expected: /[Tt]rusted|refused by the policy/,
      },
      async ({ page }) => {
        await loaded(page);
        const isPaused = await element(page).evaluate((viewer: MarrowViewer) => viewer.paused);
        expect(isPaused).toBe(true);
        const workers = await page.evaluate(() => window.threads?.workers);
        expect(workers).toBe(0);
        await expect.poll(() => coloursAt(page)).toBeGreaterThan(1000);
      },
    ));

  it('the element is drawn for the page that it is in: light, dark, or over its own colour', () =>
    withElement(
      {
        html: ['background="dark"', '', 'background="none"', 'background="rebeccapurple" show="bones names"']
          .map((said) => `<marrow-viewer src="${WALKER}" controls ${said}></marrow-viewer>`)
          .join(''),
        style: ':root { color-scheme: light dark; background: canvas } body { display: flex; flex-wrap: wrap }',
        before,
        colorScheme: 'dark',
      },
      async ({ page, asked }) => {
        await loaded(page, 4);
        const themes = await page.evaluate(() =>
          [...document.querySelectorAll('marrow-viewer')].map(
            (viewer) => viewer.shadowRoot?.querySelector('.frame')?.className,
          ),
        );
        expect(themes).toEqual(['frame dark', 'frame dark', 'frame dark', 'frame dark']);
        await expect.poll(() => coloursAt(page, page.locator('marrow-viewer').last())).toBeGreaterThan(300);
        await screenshot(page, 'element-dark');
        const own = asked().filter((path) => path.startsWith('walker'));
        expect(own.sort()).toEqual(WALKER.split(' ').sort());
      },
    ));
});

/** Puts twenty elements into the page, more than browsers have contexts for. */
function addTwenty(files: readonly string[]): void {
  for (let i = 0; i < 20; i++) {
    const viewer = document.createElement('marrow-viewer');
    viewer.setAttribute('src', files[i % files.length]);
    // Shadows take most of the time where they are drawn in software.
    viewer.setAttribute('show', 'skin no-shadow');
    document.querySelector('.many')?.append(viewer);
  }
}

/** What the page holds, after a collection of garbage. */
async function heldBy(page: Page) {
  const session = await page.context().newCDPSession(page);
  try {
    await session.send('Performance.enable');
    for (let i = 0; i < 2; i++) await session.send('HeapProfiler.collectGarbage');
    const { metrics } = await session.send('Performance.getMetrics');
    const metric = (name: string) => metrics.find((one) => one.name === name)?.value ?? Number.NaN;
    const counted = await page.evaluate(() => ({ ...window.threads, ...window.counted }));
    return { ...counted, listeners: metric('JSEventListeners'), nodes: metric('Nodes') };
  } finally {
    await session.detach();
  }
}

describe('twenty elements', () => {
  it('twenty elements share a worker and a context, ask for each file once, and give everything back', () =>
    withElement({ html: '<div class="many"></div>', before }, async ({ page, asked }) => {
      const files = [WALKER, 'crawler.skel crawler.skin crawler_walk.anim'];
      const gone = async () => {
        await page.evaluate(() => document.querySelector('.many')?.replaceChildren());
        await expect.poll(() => page.evaluate(() => window.threads)).toEqual({ workers: 0, contexts: 0 });
        return heldBy(page);
      };
      await page.evaluate(addTwenty, files);
      await loaded(page, 20);
      const threads = await page.evaluate(() => window.threads);
      expect(threads).toEqual({ workers: 1, contexts: 1 });
      const paths = asked();
      expect(paths.filter((path, i) => paths.indexOf(path) < i)).toEqual([]);
      // The page, its style and script, the element and its worker; the files.
      expect(paths.length).toBe(5 + files.join(' ').split(' ').length);
      for (const at of [0, 8, 19]) {
        await expect.poll(() => coloursAt(page, page.locator('marrow-viewer').nth(at))).toBeGreaterThan(200);
      }
      await screenshot(page, 'element-twenty');
      const first = await gone();
      await page.evaluate(addTwenty, files);
      await loaded(page, 40);
      const second = await gone();
      // What is made once for all stays.
      for (const what of ['listeners', 'nodes', 'observers', 'objectUrls'] as const) {
        expect(second[what], what).toBeLessThanOrEqual(first[what] ?? 0);
      }
    }));

  it('elements out of sight neither play nor draw', () =>
    withElement(
      {
        html: `<div class="above"></div><marrow-viewer src="${WALKER}" show="skin no-shadow" autoplay loop></marrow-viewer>`,
        style: '.above { height: 3000px }',
        before,
      },
      async ({ page }) => {
        await loaded(page);
        const start = await timeOf(page);
        await tenFrames(page);
        const later = await timeOf(page);
        expect(later).toBe(start);
        const unseen = await framesDrawn(page);
        expect(unseen).toBe(0);
        await element(page).scrollIntoViewIfNeeded();
        await expect.poll(() => timeOf(page)).toBeGreaterThan(start);
        await expect.poll(() => coloursAt(page)).toBeGreaterThan(1000);
        await page.evaluate(() => window.scrollTo(0, 0));
        await expect
          .poll(async () => {
            const [now, drawn] = [await timeOf(page), await framesDrawn(page)];
            await tenFrames(page);
            return [(await timeOf(page)) - now, (await framesDrawn(page)) - drawn];
          })
          .toEqual([0, 0]);
      },
    ));
});

describe('the files of the element', () => {
  it('are small: 230 kB with three.js, and what other formats need is apart', () => {
    const bytes = (name: string) => gzipSync(readFileSync(join(ELEMENT, name)), { level: 9 }).length;
    expect(bytes('marrow-viewer.js')).toBeLessThan(230_000);
    expect(bytes('worker.js')).toBeLessThan(128_000);
    const apart = readdirSync(join(ELEMENT, 'parts')).map((name) => name.replace(/-.*/, ''));
    expect(apart).toEqual(expect.arrayContaining(['imports', 'numpy', 'acclaim', 'annotations']));
  });
});
