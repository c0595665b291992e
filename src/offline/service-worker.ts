/**
 * The service worker of the built page, which makes it work offline. It takes over from an earlier version once no page
 * of that is open, or at once if the user asks for it.
 */
import { type BuiltFiles, StoredPage } from './stored-page.ts';
import { TAKE_OVER } from './take-over.ts';

/** Set by the build (`plugins/offline.ts`). */
declare const BUILT_FILES: BuiltFiles;

/** An event that lasts until the promise settles. */
interface LastingEvent {
  waitUntil(promise: Promise<unknown>): void;
}
interface WorkerEvents {
  readonly install: LastingEvent;
  readonly activate: LastingEvent;
  readonly message: { readonly data: unknown };
  readonly fetch: LastingEvent & { readonly request: Request; respondWith(response: Promise<Response>): void };
}

/** The part of a service worker's global scope that is used; the project's types are those of a page. */
interface WorkerScope {
  readonly registration: Pick<ServiceWorkerRegistration, 'scope' | 'installing' | 'waiting'>;
  readonly caches: CacheStorage;
  readonly clients: {
    matchAll(options: { type: 'window'; includeUncontrolled: true }): Promise<readonly { readonly url: string }[]>;
    claim(): Promise<void>;
  };
  fetch: typeof fetch;
  skipWaiting(): Promise<void>;
  addEventListener<K extends keyof WorkerEvents>(type: K, listener: (event: WorkerEvents[K]) => void): void;
}
// To the compiler `self` is a window; in a service worker it is this.
const worker = self as unknown as WorkerScope;

const page = new StoredPage(BUILT_FILES, {
  scope: worker.registration.scope,
  caches: worker.caches,
  fetch: (address, options) => worker.fetch(address, options),
  async openPages() {
    const pages = await worker.clients.matchAll({ type: 'window', includeUncontrolled: true });
    return pages.map(({ url }) => url);
  },
  hasSuccessor: () => worker.registration.installing !== null || worker.registration.waiting !== null,
});

worker.addEventListener('install', (event) => event.waitUntil(page.install()));

worker.addEventListener('activate', (event) => {
  // The page that was open during the first installation also gets the rest of its scripts from here.
  event.waitUntil(page.deleteOthers().then(() => worker.clients.claim()));
});

worker.addEventListener('message', ({ data }) => {
  if (data === TAKE_OVER) void worker.skipWaiting();
});

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  const response = page.respond(request, () => worker.fetch(request));
  if (!response) return;
  event.respondWith(response);
  // Pages that were open when this version took over may be closed now.
  if (request.mode === 'navigate') event.waitUntil(page.deleteOthers(response));
});
