import { describe, expect, it } from 'vitest';
import { type BuiltFiles, StoredPage } from '../../src/offline/stored-page.ts';

const SCOPE = 'https://host/some/marrow/';
const OLD: BuiltFiles = {
  'index.html': 'sha256-page1',
  'assets/panel-1.js': 'sha256-panel1',
  'assets/three.js': 'sha256-3',
};
const NEW: BuiltFiles = {
  'index.html': 'sha256-page2',
  'assets/panel-2.js': 'sha256-panel2',
  'assets/three.js': 'sha256-3',
};

/** A browser whose server has files by path; its caches, requests and open pages are visible. */
class FakeBrowser {
  readonly scope: string = SCOPE;
  /** Contents by path; their hash is `sha256-` and the content. */
  server: Readonly<Record<string, string>> = {};
  /** What the HTTP cache has, before the server is asked. */
  outdated: Readonly<Record<string, string>> = {};
  open: string[] = [];
  successor = false;
  isRefused = false;
  readonly fetched: string[] = [];
  readonly stores = new Map<string, Map<string, Response>>();

  readonly caches = {
    open: async (name: string): Promise<Cache> => {
      if (this.isRefused) throw new DOMException('', 'SecurityError');
      const entries = this.stores.get(name) ?? new Map<string, Response>();
      this.stores.set(name, entries);
      const plain = (url: string) => url.replace(/\?.*/, '');
      const cache = {
        keys: async () => [...entries.keys()].map((url) => ({ url })),
        put: async (url: string, response: Response) => void entries.set(url, response),
        delete: async (url: string) => entries.delete(url),
        match: async (url: string, options?: CacheQueryOptions) => {
          const key = options?.ignoreSearch ? [...entries.keys()].find((k) => plain(k) === plain(url)) : url;
          return key === undefined ? undefined : entries.get(key)?.clone();
        },
      };
      // All that is used of it.
      return cache as unknown as Cache;
    },
  };

  async fetch(address: string, { integrity, cache }: RequestInit): Promise<Response> {
    const path = address.slice(SCOPE.length);
    this.fetched.push(path);
    const content = (cache === 'reload' ? undefined : this.outdated[path]) ?? this.server[path];
    if (content === undefined || integrity !== `sha256-${content}`) throw new TypeError('Failed to fetch');
    return new Response(content, { headers: { vary: '*', etag: `"${content}"` } });
  }

  openPages = async () => [...this.open];
  hasSuccessor = () => this.successor;

  /** Addresses of everything stored. */
  get stored(): readonly string[] {
    return [...(this.stores.get(`marrow ${SCOPE}`)?.keys() ?? [])].sort();
  }
}

const contents = (files: BuiltFiles) =>
  Object.fromEntries(Object.entries(files).map(([path, hash]) => [path, hash.replace('sha256-', '')]));
const keys = (files: BuiltFiles) =>
  Object.entries(files)
    .map(([path, hash]) => `${SCOPE}${path}?${hash}`)
    .sort();

async function installed(files: BuiltFiles, browser = new FakeBrowser()) {
  browser.server = contents(files);
  const page = new StoredPage(files, browser);
  await page.install();
  return { page, browser };
}

/** The text of the answer; `network` where it has to be fetched; undefined if it isn't answered. */
async function answer(page: StoredPage, url: string, request: { mode?: RequestMode; method?: string } = {}) {
  const fromNetwork = async () => new Response('network');
  const response = page.respond({ url, mode: 'cors', method: 'GET', ...request }, fromNetwork);
  return response && (await response).text();
}
const navigate = { mode: 'navigate' } as const;

describe('a page stored by its service worker', () => {
  it('a stored page answers with its files, and with itself for every address of its own', async () => {
    const { page } = await installed(OLD);
    expect(await answer(page, `${SCOPE}assets/panel-1.js`)).toBe('panel1');
    for (const own of ['', '?files=a.skel,b.skin', 'index.html', 'index.html?files=a.skel#x']) {
      expect(await answer(page, SCOPE + own, navigate)).toBe('page1');
    }
  });

  it('a stored page answers with the pages of its manual, the contents for their folder', async () => {
    const { page } = await installed({ ...OLD, 'manual/index.html': 'sha256-contents', 'manual/a.html': 'sha256-a' });
    expect(await answer(page, `${SCOPE}manual/a.html#b`, navigate)).toBe('a');
    for (const own of ['manual/', 'manual/index.html']) {
      expect(await answer(page, SCOPE + own, navigate)).toBe('contents');
    }
    expect(await answer(page, `${SCOPE}manual/b.html`, navigate)).toBeUndefined();
  });

  it('a stored page answers nothing else: no files of the user, other origins, other pages, or sent data', async () => {
    const { page, browser } = await installed(OLD);
    const count = browser.stored.length;
    expect(await answer(page, `${SCOPE}given/a.skel`)).toBeUndefined();
    expect(await answer(page, `https://elsewhere/assets/three.js`)).toBeUndefined();
    expect(await answer(page, 'https://host/some/other/assets/three.js')).toBeUndefined();
    expect(await answer(page, `${SCOPE}other/`, navigate)).toBeUndefined();
    expect(await answer(page, `${SCOPE}assets/three.js`, { method: 'POST' })).toBeUndefined();
    expect(browser.stored.length).toBe(count);
  });

  it('a stored page fetches what the browser has deleted, or refuses to give', async () => {
    const { page, browser } = await installed(OLD);
    browser.stores.clear();
    expect(await answer(page, SCOPE, navigate)).toBe('network');
    expect(await answer(page, `${SCOPE}assets/three.js`)).toBe('network');
    browser.isRefused = true;
    expect(await answer(page, SCOPE, navigate)).toBe('network');
  });

  it('a stored page keeps headers such as etag, but none that a cache refuses', async () => {
    const { browser } = await installed(OLD);
    for (const response of browser.stores.get(`marrow ${SCOPE}`)?.values() ?? []) {
      expect([...response.headers.keys()]).toContain('etag');
      expect([...response.headers.keys()]).not.toContain('vary');
    }
  });

  it('a stored page of another folder of the host has a cache of its own', async () => {
    const { browser } = await installed(OLD);
    expect([...browser.stores.keys()]).toEqual([`marrow ${SCOPE}`]);
  });
});

describe('the installation of a new version', () => {
  it('a new version fetches only what has changed', async () => {
    const { browser } = await installed(OLD);
    browser.fetched.length = 0;
    await installed(NEW, browser);
    expect(browser.fetched.sort()).toEqual(['assets/panel-2.js', 'index.html']);
  });

  it('a new version that is incomplete on the server is not installed, and the old one goes on', async () => {
    const { page, browser } = await installed(OLD);
    // In the middle of an upload: the page is still the old one.
    browser.server = { ...contents(NEW), 'index.html': 'page1' };
    await expect(new StoredPage(NEW, browser).install()).rejects.toThrow('Failed to fetch');
    expect(await answer(page, SCOPE, navigate)).toBe('page1');
    expect(await answer(page, `${SCOPE}assets/panel-1.js`)).toBe('panel1');
    expect(browser.stored).toEqual(expect.arrayContaining(keys(OLD)));
  });

  it('a new version whose installation was interrupted goes on with what is missing', async () => {
    const browser = new FakeBrowser();
    browser.server = { 'index.html': 'page1', 'assets/three.js': '3' };
    await expect(new StoredPage(OLD, browser).install()).rejects.toThrow();
    const kept = browser.stored.length;
    expect(kept).toBeGreaterThan(0);
    browser.fetched.length = 0;
    await installed(OLD, browser);
    expect(browser.fetched.length).toBe(Object.keys(OLD).length - kept);
    expect(browser.stored).toEqual(keys(OLD));
  });

  it("a new version asks the server where the browser's own cache is outdated", async () => {
    const browser = new FakeBrowser();
    browser.outdated = { 'index.html': 'page1' };
    const { page } = await installed(NEW, browser);
    expect(await answer(page, SCOPE, navigate)).toBe('page2');
  });

  it('a new version that took over still answers the pages of the old one with their scripts', async () => {
    const { browser } = await installed(OLD);
    const { page } = await installed(NEW, browser);
    browser.open = [`${SCOPE}?files=a.skel`];
    await page.deleteOthers();
    expect(await answer(page, `${SCOPE}assets/panel-1.js`)).toBe('panel1');
    expect(await answer(page, SCOPE, navigate)).toBe('page2');
    // Never built.
    expect(await answer(page, `${SCOPE}assets/panel-0.js`)).toBe('network');
  });

  it('a new version deletes the old one once no page is open', async () => {
    const { browser } = await installed(OLD);
    const { page } = await installed(NEW, browser);
    browser.open = ['https://host/some/other/'];
    await page.deleteOthers();
    expect(browser.stored).toEqual(keys(NEW));
  });

  it('a new version is not deleted by the old one while it is installed or waits', async () => {
    const { page, browser } = await installed(OLD);
    await installed(NEW, browser);
    browser.successor = true;
    await page.deleteOthers();
    expect(browser.stored).toEqual([...new Set([...keys(OLD), ...keys(NEW)])].sort());
  });

  it('the page that is just being opened counts as none', async () => {
    const { browser } = await installed(OLD);
    const { page } = await installed(NEW, browser);
    const opening = Promise.resolve().then(() => browser.open.push(SCOPE));
    await page.deleteOthers(opening);
    expect(browser.stored).toEqual(keys(NEW));
  });
});
