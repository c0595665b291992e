/**
 * The files of the built page in the browser's cache, from which its service worker answers: the page opens and works
 * without its server.
 *
 *     https://host/marrow/assets/panel-D15q8sUj.js?sha256-…    what a file is stored as: its address and its content
 *
 * All versions share one cache. Files that two of them have are stored once; an interrupted installation continues
 * where it was; and a page of an earlier version finds its own scripts until it is closed.
 */

/** The files of a build: their encoded paths below the page, `/` between folders, and their `integrity`, `sha256-…`. */
export type BuiltFiles = Readonly<Record<string, string>>;

/** The page itself, and the contents of the manual in their folder. */
const PAGE = 'index.html';
/** Folder of the files that have their content's hash in their names, so that those of earlier versions differ. */
const ASSETS = 'assets/';
/** Few, since the page may be fetching its own scripts from the same server. */
const PARALLEL_FETCHES = 3;

/** What is used of the browser. */
export interface Browser {
  /** The page's folder, ending with `/`. */
  readonly scope: string;
  readonly caches: Pick<CacheStorage, 'open'>;
  fetch(address: string, options: RequestInit): Promise<Response>;
  /** Addresses of all open pages of this origin. */
  openPages(): Promise<readonly string[]>;
  /** Whether a newer version is being installed or waits to take over. */
  hasSuccessor(): boolean;
}

export class StoredPage {
  private readonly browser: Browser;
  private readonly files: BuiltFiles;
  /** Sub-paths of one origin are different pages. */
  private readonly cacheName: string;

  constructor(files: BuiltFiles, browser: Browser) {
    this.files = files;
    this.browser = browser;
    this.cacheName = `marrow ${browser.scope}`;
  }

  /** Stores what is missing. Rejects if a file can't be fetched or has other content: then nothing changes. */
  async install(): Promise<void> {
    const cache = await this.open();
    const stored = new Set((await cache.keys()).map(({ url }) => url));
    const missing = Object.keys(this.files).filter((path) => !stored.has(this.keyOf(path)));
    const fetchMissing = async () => {
      for (let path = missing.pop(); path !== undefined; path = missing.pop()) {
        await cache.put(this.keyOf(path), await this.fetchFile(path));
      }
    };
    await Promise.all(Array.from({ length: PARALLEL_FETCHES }, fetchMissing));
  }

  /**
   * Deletes files of other versions, unless a page is open that may need them, or a newer version is storing its own.
   *
   * @param after pages that are opened from now on don't count; the work itself waits for this
   */
  async deleteOthers(after?: Promise<unknown>): Promise<void> {
    const { scope } = this.browser;
    if ((await this.browser.openPages()).some((address) => address.startsWith(scope))) return;
    await after;
    const cache = await this.open();
    const own = new Set(Object.keys(this.files).map((path) => this.keyOf(path)));
    const others = (await cache.keys()).filter(({ url }) => !own.has(url));
    // Only now: what a newer version stores from here on is not among them.
    if (this.browser.hasSuccessor()) return;
    await Promise.all(others.map(({ url }) => cache.delete(url)));
  }

  /**
   * Undefined for what isn't of the page: other origins, files of the user, other pages.
   *
   * @param fromNetwork fetches it, for what the browser has deleted
   */
  respond(
    { method, url, mode }: Pick<Request, 'method' | 'url' | 'mode'>,
    fromNetwork: () => Promise<Response>,
  ): Promise<Response> | undefined {
    const { scope } = this.browser;
    if (method !== 'GET' || !url.startsWith(scope)) return undefined;
    const path = url.slice(scope.length).replace(/[?#].*/s, '');
    const found = async (key: string, options?: CacheQueryOptions) =>
      (await this.open().then(
        (cache) => cache.match(key, options),
        () => undefined,
      )) ?? fromNetwork();
    // Hosts answer a folder's address with its page.
    const file = mode === 'navigate' && /(^|\/)$/.test(path) ? path + PAGE : path;
    if (Object.hasOwn(this.files, file)) return found(this.keyOf(file));
    if (mode === 'navigate') return undefined;
    // A script of an earlier version, whose page is still open.
    return path.startsWith(ASSETS) ? found(scope + path, { ignoreSearch: true }) : undefined;
  }

  private async fetchFile(path: string): Promise<Response> {
    const address = this.browser.scope + path;
    const integrity = this.files[path];
    // What the page has just loaded is in the browser's HTTP cache, and is asked for no second time, even by hosts that
    // don't say how long it may be kept; if it is of another version, the server is asked.
    const response = await this.browser
      .fetch(address, { integrity, cache: 'force-cache' })
      .catch(() => this.browser.fetch(address, { integrity, cache: 'reload' }));
    if (!response.ok) throw new Error(`${address} answered ${response.status}.`);
    return storable(response);
  }

  private keyOf(path: string): string {
    return `${this.browser.scope}${path}?${this.files[path]}`;
  }

  private open(): Promise<Cache> {
    return this.browser.caches.open(this.cacheName);
  }
}

/**
 * The same without what caches and navigations refuse: `Vary: *`, and having been redirected (hosts that send
 * `index.html` to its folder).
 */
function storable(response: Response): Response {
  const headers = new Headers(response.headers);
  headers.delete('vary');
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}
