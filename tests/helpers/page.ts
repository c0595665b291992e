/**
 * The built page in a real browser: served under a sub-path, as a static host would, with everything that goes wrong
 * on the way collected. A fresh context (no cache, no storage) for each page; browser and server are shared by all test
 * files of a worker, and end with its process: starting them anew for each file took a second of both cores.
 *
 *     it('plays what is dropped', () =>
 *       withPage(async ({ page }) => {
 *         await dropFiles(page, [{ path: 'a.skel', bytes }]);
 *         …
 *       }));
 */
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { expect } from 'vitest';
import type { GivenBlob } from '../../src/worker/protocol.ts';
import { launchChromium } from './chromium.ts';
import type { Firefox } from './firefox.ts';
import { type ExtraFiles, type StaticServer, serveFolder } from './server.ts';
import { stillPage } from './still.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const SUB_PATH = '/some/where/marrow/';

export interface PageOptions {
  /** Appended to the page's address: `?files=given/a.skel`. */
  readonly query?: string;
  /** Served next to the page, for `query` to name. */
  readonly files?: ExtraFiles;
  /** CSS pixels; default 1280 × 800. */
  readonly size?: { readonly width: number; readonly height: number };
  readonly colorScheme?: 'light' | 'dark';
  /** Opens with the page's own example, a walker, instead of a static post. */
  readonly walking?: boolean;
  /** Without `prefers-reduced-motion`: what the page opens with plays. */
  readonly fullMotion?: boolean;
  readonly touch?: boolean;
  /** Continues as soon as the page is loaded, without waiting for menus and panels. */
  readonly early?: boolean;
  /** Stays blank until the test goes to `url`, which has routed requests before. */
  readonly blank?: boolean;
  /** With what newcomers see: the hint over the viewport, and shadows. */
  readonly firstVisit?: boolean;
  /** With the pixels of the viewport, for tests that look at them; `later`: from when `fillPixels` says so. */
  readonly drawn?: boolean | 'later';
  /** Run in the page before any of its own scripts. */
  readonly before?: (() => void) | readonly (() => void)[];
  /** With the page's service worker; by default there is none, so that no test reads what another has stored. */
  readonly serviceWorker?: boolean;
  /** Another folder than `dist/`. */
  readonly folder?: string;
  /** Instead of Chromium. */
  readonly firefox?: Firefox;
  /** Problems that this test causes intentionally; all others fail it. */
  readonly expected?: RegExp;
}

export interface OpenPage {
  readonly page: Page;
  /** The page's address without its query; ends with `/`. */
  readonly url: string;
  /** Console errors, uncaught errors, failed and foreign requests so far. */
  readonly problems: readonly string[];
  /** Replaces files next to the page. */
  serve(files: ExtraFiles): void;
  /** What the server was asked for, below `url`. */
  asked(): readonly string[];
  /** Ends the page's server, for this test. */
  stopServer(): Promise<void>;
  /** Does something that saves a file by download, and returns it. */
  download(act: () => Promise<unknown>): Promise<DownloadedFile>;
  /** Another tab of the same browser profile, at the same address; its problems count too. */
  openAnother(query?: string): Promise<Page>;
}

export interface DownloadedFile {
  readonly name: string;
  readonly text: string;
  readonly bytes: Uint8Array;
}

/** For screenshots Playwright adds an empty inline style to pages in Firefox, which the policy refuses. */
const OF_SCREENSHOTS = /refused by the policy: style-src-elem inline|blocked an inline style \(style-src-elem\)/;

/** Runs in the page: what its Content-Security-Policy refuses is a problem, also where the browser is silent. */
function tellViolations(): void {
  document.addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI, sample }) => {
    console.error(`refused by the policy: ${effectiveDirective} ${blockedURI} ${sample}`);
  });
}

/**
 * Runs in the page. A visitor who has closed the hint, opened the timeline, and turned shadows off: drawn in software,
 * a shadow takes almost half of the time of a frame.
 */
function asKnownVisitor(): void {
  try {
    if (!localStorage.getItem('marrow.settings')) {
      const panels = { timelineOpen: true };
      localStorage.setItem(
        'marrow.settings',
        JSON.stringify({ firstSteps: false, display: { shadow: false }, panels }),
      );
    }
  } catch {
    // A page without storage has both.
  }
}

/**
 * Runs in the page: the viewport stays empty. Everything is computed, sent to the GPU and checked as ever, but what is
 * shown is drawn without a vertex or a pixel, and out of sight, so that the browser has no picture of it to lay over the
 * page: in software both take most of the time of a test. What lies under the pointer is found as ever.
 * @param later whether the page may be shown after all
 */
export function fillNoPixels(later: boolean): void {
  const { prototype } = HTMLCanvasElement;
  const { getContext } = prototype;
  const { prototype: drawing } = WebGL2RenderingContext;
  const seen = new WeakSet<WebGL2RenderingContext>();
  /** Those of them that draw what is shown now, and nothing that is out of sight in the page too. */
  const showing = new WeakSet<object>();
  let isFilled = false;
  const stayEmpty = (gl: WebGL2RenderingContext) => {
    seen.add(gl);
    let unseen: WebGLFramebuffer | null = null;
    const show = (target: number) => {
      drawing.bindFramebuffer.call(gl, target, isFilled ? null : unseen);
      if (target === gl.READ_FRAMEBUFFER) return;
      if (isFilled) {
        showing.delete(gl);
        gl.disable(gl.RASTERIZER_DISCARD);
      } else {
        showing.add(gl);
        gl.enable(gl.RASTERIZER_DISCARD);
      }
    };
    const begin = () => {
      unseen = gl.createFramebuffer();
      drawing.bindFramebuffer.call(gl, gl.FRAMEBUFFER, unseen);
      for (const [attachment, format] of [
        [gl.COLOR_ATTACHMENT0, gl.RGBA8],
        [gl.DEPTH_STENCIL_ATTACHMENT, gl.DEPTH24_STENCIL8],
      ] as const) {
        const buffer = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorage(gl.RENDERBUFFER, format, 1, 1);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
      }
      gl.bindRenderbuffer(gl.RENDERBUFFER, null);
      show(gl.FRAMEBUFFER);
    };
    begin();
    gl.canvas.addEventListener('webglcontextrestored', begin, { capture: true });
    gl.bindFramebuffer = (target, buffer) => {
      if (!buffer) return show(target);
      drawing.bindFramebuffer.call(gl, target, buffer);
      if (target === gl.READ_FRAMEBUFFER) return;
      showing.delete(gl);
      gl.disable(gl.RASTERIZER_DISCARD);
    };
    gl.drawBuffers = (buffers) =>
      drawing.drawBuffers.call(
        gl,
        [...buffers].map((buffer) => (buffer === gl.BACK && !isFilled ? gl.COLOR_ATTACHMENT0 : buffer)),
      );
    // Between frames, when what is shown is bound.
    window.fillPixels = (filled) => {
      isFilled = filled;
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    };
  };
  // Scripts of tests that run after this one see how much would be drawn. WebGL's methods by name.
  const methods = drawing as unknown as Record<string, (...values: number[]) => void>;
  for (const [name, count] of [
    ['drawArrays', 2],
    ['drawElements', 1],
    ['drawArraysInstanced', 2],
    ['drawElementsInstanced', 1],
  ] as const) {
    const { [name]: draw } = methods;
    methods[name] = function (...values) {
      if (showing.has(this)) values[count] = 0;
      draw.apply(this, values);
    };
  }
  // It has an overload for each kind of context.
  prototype.getContext = function (this: HTMLCanvasElement, kind: string, options?: object) {
    if (kind !== 'webgl2') return getContext.call(this, kind, options);
    const gl = getContext.call(this, kind, later ? options : { ...options, antialias: false });
    if (gl instanceof WebGL2RenderingContext && !seen.has(gl)) stayEmpty(gl);
    return gl;
  } as typeof getContext;
}

declare global {
  interface Window {
    /** Of a page that is drawn later: its next frames have pixels, or none again. Set by `fillNoPixels`. */
    fillPixels(isFilled: boolean): void;
  }
}

let chromium: Promise<Browser> | undefined;
const servers = new Map<string, Promise<StaticServer>>();

/** That of all test files of a worker; nobody closes it. */
export function sharedChromium(): Promise<Browser> {
  chromium ??= launchChromium();
  return chromium;
}

/** Opens the page, runs `body`, and fails on any unexpected problem. */
export async function withPage(body: (open: OpenPage) => Promise<void>, options: PageOptions = {}): Promise<void> {
  const { open, expectNoProblems, close } = await openPage(options);
  try {
    await body(open);
    expectNoProblems();
  } finally {
    await close();
  }
}

export interface OpenedPage {
  readonly open: OpenPage;
  /** @throws Error with all problems so far that this test doesn't cause intentionally */
  expectNoProblems(): void;
  close(): Promise<void>;
}

/** For tests that close it themselves. */
export async function openPage(options: PageOptions): Promise<OpenedPage> {
  const folder = options.folder ?? join(ROOT, 'dist');
  if (!existsSync(options.files?.['index.html'] ? folder : join(folder, 'index.html'))) {
    throw new Error(`${folder} holds no built page: "npm run build" first.`);
  }
  const browser = options.firefox?.browser ?? (await sharedChromium());
  const serving = servers.get(folder) ?? serveFolder(folder, SUB_PATH);
  servers.set(folder, serving);
  const server = await serving;
  const still = options.walking ? {} : await stillPage(folder);
  server.serve(options.files ?? {}, still);

  const context = await browser.newContext({
    viewport: options.size ?? { width: 1280, height: 800 },
    colorScheme: options.colorScheme ?? 'light',
    // Camera moves are then immediate, and nothing plays by itself.
    reducedMotion: options.fullMotion ? 'no-preference' : 'reduce',
    hasTouch: options.touch ?? false,
    serviceWorkers: options.serviceWorker ? 'allow' : 'block',
  });
  const problems: string[] = [];
  const openAnother = async (query = '') => {
    const another = await context.newPage();
    collectProblems(another, server.url, problems);
    await another.addInitScript(tellViolations);
    if (!options.firstVisit) await another.addInitScript(asKnownVisitor);
    if (options.drawn !== true) await another.addInitScript(fillNoPixels, options.drawn === 'later');
    for (const script of [options.before ?? []].flat()) await another.addInitScript(script);
    if (options.blank) return another;
    await another.goto(server.url + query);
    // If the page can't draw, it has neither.
    if (!options.early) await another.waitForFunction(() => !document.querySelector('#app.frame'));
    return another;
  };
  try {
    const page = await openAnother(options.query);
    return {
      open: {
        page,
        url: server.url,
        problems,
        serve: (files) => server.serve(files, still),
        asked: () => server.asked,
        stopServer() {
          servers.delete(folder);
          return server.close();
        },
        download: (act) => (options.firefox ? downloadedInto(options.firefox.downloads, act) : downloadedBy(page, act)),
        openAnother,
      },
      expectNoProblems() {
        const own = options.firefox && OF_SCREENSHOTS;
        const unexpected = problems.filter((problem) => !options.expected?.test(problem) && !own?.test(problem));
        if (unexpected.length > 0) throw new Error(`The page complained:\n${unexpected.join('\n')}`);
      },
      close: () => context.close(),
    };
  } catch (error) {
    await context.close();
    throw error;
  }
}

async function downloadedBy(page: Page, act: () => Promise<unknown>): Promise<DownloadedFile> {
  const [download] = await Promise.all([page.waitForEvent('download'), act()]);
  return fileOf(download.suggestedFilename(), readFileSync(await download.path()));
}

function fileOf(name: string, bytes: Buffer): DownloadedFile {
  return { name, bytes, text: bytes.toString('utf8') };
}

async function downloadedInto(folder: string, act: () => Promise<unknown>): Promise<DownloadedFile> {
  const before = new Set(readdirSync(folder));
  await act();
  let found: DownloadedFile | undefined;
  await expect
    .poll(() => {
      // While it is written it is empty, beside a `.part`.
      const name = readdirSync(folder).find((file) => !before.has(file) && !file.endsWith('.part'));
      const bytes = name === undefined ? undefined : readFileSync(join(folder, name));
      if (name !== undefined && bytes?.length) found = fileOf(name, bytes);
      return found;
    })
    .toBeDefined();
  if (!found) throw new Error(`Nothing was downloaded into ${folder}.`);
  return found;
}

/** "The only thing ever requested is what the address names": any other request is a problem. */
export function collectProblems(page: Page, home: string, problems: string[]): void {
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(`console: ${message.text()} (${message.location().url})`);
  });
  page.on('pageerror', (error) => problems.push(`uncaught: ${error.stack ?? error.message}`));
  page.on('crash', () => problems.push('the page crashed'));
  page.on('requestfailed', (request) => {
    const why = request.failure()?.errorText ?? '';
    if (!/ERR_ABORTED|NS_BINDING_ABORTED/.test(why)) problems.push(`request: ${request.url()} ${why}`);
  });
  page.on('response', (response) => {
    if (response.status() >= 400) problems.push(`request: ${response.url()} answered ${response.status()}`);
  });
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(home)) {
      problems.push(`request to elsewhere: ${request.url()}`);
    }
  });
}

export interface DroppedFile {
  readonly name: string;
  readonly bytes: Uint8Array | string;
}

/**
 * Drops files that exist only in the test. Bytes are passed as text, so keep them under some 20 MB; write larger files
 * to disk and use `dropPaths`.
 */
export async function dropFiles(page: Page, files: readonly DroppedFile[], target = 'body'): Promise<void> {
  const encoded = files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString('base64') }));
  const transfer = await page.evaluateHandle((given) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of given) {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      transfer.items.add(new File([bytes], name));
    }
    return transfer;
  }, encoded);
  for (const type of ['dragenter', 'dragover', 'drop']) {
    await page.dispatchEvent(target, type, { dataTransfer: transfer });
  }
}

/** Opens files as scripts do. They have replaced an untouched example, or are beside what is there. */
export async function openFiles(page: Page, files: readonly GivenBlob[]): Promise<void> {
  const given = await Promise.all(
    files.map(async ({ path, blob }) => ({
      path,
      base64: Buffer.from(await blob.arrayBuffer()).toString('base64'),
    })),
  );
  await page.evaluate(async (all) => {
    const decoded = all.map(({ path, base64 }) => ({
      name: path,
      content: Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)),
    }));
    if (decoded.length > 0) await window.marrow.open(decoded);
  }, given);
}

/**
 * Drops files and folders from disk the way the system does, so that folders are real ones to the page.
 * @param paths absolute
 */
export async function dropPaths(page: Page, paths: readonly string[], x = 640, y = 400): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files: [...paths], dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop'] as const) {
    await session.send('Input.dispatchDragEvent', { type, x, y, data });
  }
  await session.detach();
}

/** Saves a screenshot, in MARROW_SCREENSHOTS or node_modules/.cache/screenshots. */
export async function screenshot(page: Page, name: string): Promise<string> {
  const folder = process.env.MARROW_SCREENSHOTS ?? join(ROOT, 'node_modules', '.cache', 'screenshots');
  mkdirSync(folder, { recursive: true });
  const path = join(folder, `${name}.png`);
  writeFileSync(path, await page.screenshot());
  return path;
}

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** r g b a, rows from the top. */
  readonly data: Uint8Array;
}

/** Pixels of the page, including panels. @param clip CSS pixels; default: the whole viewport */
export async function readPixels(
  page: Page,
  clip?: { x: number; y: number; width: number; height: number },
): Promise<Pixels> {
  const picture = await page.screenshot(clip ? { clip } : {});
  const decoded = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }), { premultiplyAlpha: 'none' });
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext('2d');
    if (!context) throw new Error('no 2D canvas');
    context.drawImage(bitmap, 0, 0);
    const { data, width, height } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let text = '';
    for (let i = 0; i < data.length; i += 0x8000) text += String.fromCharCode(...data.subarray(i, i + 0x8000));
    return { width, height, base64: btoa(text) };
  }, picture.toString('base64'));
  return { width: decoded.width, height: decoded.height, data: Buffer.from(decoded.base64, 'base64') };
}
