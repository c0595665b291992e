/** A browser on a profile of its own, which can be killed and started again. */
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { env } from 'node:process';
import { type BrowserContext, chromium, type Page } from 'playwright-core';
import { ready } from '../../../e2e/checks/autosave.ts';
import { CHROMIUM_FLAGS, findChromium } from '../../../helpers/chromium.ts';

/** What is killed: all of the browser, or those of its processes that have a page. */
export type Target = 'browser' | 'renderer';

const BEGINS = 'storing begins';
const ENDS = 'storing ends';

export class Profile {
  private readonly folder = mkdtempSync(join(tmpdir(), 'marrow-killed-'));
  readonly downloads = join(this.folder, 'downloads');
  private context: BrowserContext | undefined;
  private storing = 0;
  private storingSinceMs = 0;
  private listeners: (() => void)[] = [];

  constructor(
    private readonly url: string,
    /** Runs in each page before its own scripts. */
    private readonly before: (() => void) | undefined,
  ) {
    mkdirSync(this.downloads);
  }

  /** For how many milliseconds autosave has been writing; 0 if it isn't. */
  get storingMs(): number {
    return this.storing > 0 ? performance.now() - this.storingSinceMs : 0;
  }

  /** Resolves when autosave next begins to write. */
  nextStore(): Promise<void> {
    return new Promise((resolve) => this.listeners.push(resolve));
  }

  /** A page that has its example. Starts the browser if it doesn't run. */
  async open(): Promise<Page> {
    this.context ??= await this.start();
    const blank = this.context.pages().find((page) => page.url() === 'about:blank');
    const page = blank ?? (await this.context.newPage());
    page.on('console', (message) => {
      if (message.text() === BEGINS) {
        if (this.storing++ === 0) this.storingSinceMs = performance.now();
        for (const tell of this.listeners.splice(0)) tell();
      } else if (message.text() === ENDS) this.storing--;
    });
    await page.goto(this.url);
    await ready(page);
    return page;
  }

  /** Kills it, with all pages. */
  async kill(target: Target): Promise<void> {
    kill(this.folder, target);
    this.storing = 0;
    const { context } = this;
    if (target === 'renderer') {
      await Promise.all((context?.pages() ?? []).map((page) => page.close().catch(() => undefined)));
      return;
    }
    this.context = undefined;
    await context?.close().catch(() => undefined);
  }

  async close(): Promise<void> {
    await this.context?.close().catch(() => undefined);
    rmSync(this.folder, { recursive: true, force: true });
  }

  private async start(): Promise<BrowserContext> {
    const { path, env: extra } = findChromium();
    const all = Object.entries({ ...env, ...extra }).flatMap(([name, value]) =>
      value === undefined ? [] : [[name, value]],
    );
    const context = await chromium.launchPersistentContext(this.folder, {
      executablePath: path,
      env: Object.fromEntries(all),
      args: [...CHROMIUM_FLAGS],
      // High enough for the tree to show the joints.
      viewport: { width: 1280, height: 800 },
      serviceWorkers: 'block',
      reducedMotion: 'reduce',
    });
    await context.addInitScript(tellStoring, [BEGINS, ENDS] as const);
    if (this.before) await context.addInitScript(this.before);
    const [first = await context.newPage()] = context.pages();
    const session = await context.newCDPSession(first);
    // Under their own names, as for anyone; Playwright would give them its own.
    await session.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: this.downloads });
    return context;
  }
}

/** Runs in the page: tells when something is written into a database. */
function tellStoring([begins, ends]: readonly [string, string]): void {
  const { transaction } = IDBDatabase.prototype;
  IDBDatabase.prototype.transaction = function (stores, mode, options) {
    const made = transaction.call(this, stores, mode, options);
    if (mode === 'readwrite') {
      console.debug(begins);
      for (const end of ['complete', 'abort']) made.addEventListener(end, () => console.debug(ends));
    }
    return made;
  };
}

/** Linux only. */
function kill(profile: string, target: Target): void {
  const all = readdirSync('/proc').flatMap((pid) => {
    if (!/^\d+$/.test(pid)) return [];
    try {
      const command = readFileSync(`/proc/${pid}/cmdline`, 'utf8');
      const parent = Number(/^\d+ \(.*\) \S (\d+)/s.exec(readFileSync(`/proc/${pid}/stat`, 'utf8'))?.[1]);
      return [{ pid: Number(pid), parent, command }];
    } catch {
      // It has ended meanwhile.
      return [];
    }
  });
  const browser = all.find(({ command }) => command.includes(profile) && !command.includes('--type='));
  if (!browser) throw new Error('The browser has no process.');
  const descends = (pid: number): boolean =>
    pid === browser.pid || all.some((one) => one.pid === pid && one.parent !== pid && descends(one.parent));
  const renderers = all.filter(({ pid, command }) => command.includes('--type=renderer') && descends(pid));
  for (const { pid } of target === 'browser' ? [browser] : renderers) process.kill(pid, 'SIGKILL');
}
