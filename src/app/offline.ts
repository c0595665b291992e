/**
 * The page's side of its service worker (`offline/`): registers it, and offers new versions. A version that was found
 * waits until the user reloads, or all tabs are closed; reloading in one tab leaves the others as they are, and they
 * still get their own scripts.
 */
import { TAKE_OVER } from '../offline/take-over.ts';
import type { Offline } from '../ui/state/offline.ts';
import type { Observable } from '../ui/widgets/observable.ts';

export interface OfflineParts {
  readonly offline: Observable<Offline>;
  readonly workers: Pick<ServiceWorkerContainer, 'register' | 'ready' | 'controller' | 'addEventListener'>;
  /** Loads the page again. */
  reload(): void;
  /** Calls back when the page is looked at again. */
  onReturn(listener: () => void): void;
  nowMs(): number;
}

const WORKER = 'sw.js';
/** Browsers look for a new version when a page is loaded; one that stays open looks itself. */
const LOOK_AGAIN_MS = 60 * 60 * 1000;

/** Returns when the page works offline, or has learned that it won't. */
export async function startOffline({ offline, workers, reload, onReturn, nowMs }: OfflineParts): Promise<void> {
  try {
    await workers.register(WORKER);
  } catch {
    // Storage is refused, or the host has no such file: the page works, but not without its server.
    return;
  }
  // Not what `register` returns: the first version is stored by then.
  const registration = await workers.ready;
  const first = registration.active;
  offline.update((now) => ({ ...now, isReady: true }));

  let isAccepted = false;
  const accept = () => {
    const { waiting } = registration;
    isAccepted = waiting !== null;
    if (waiting) waiting.postMessage(TAKE_OVER);
    // Another tab has switched to it already.
    else reload();
  };
  const setPutOff = (isPutOff: boolean) =>
    offline.update((now) => ({
      ...now,
      newVersion: { isPutOff, reload: accept, later: () => setPutOff(true) },
    }));
  const offer = () => setPutOff(false);
  workers.addEventListener('controllerchange', () => {
    if (isAccepted) reload();
    else if (workers.controller !== first) offer();
    isAccepted = false;
  });

  const watch = (worker: ServiceWorker | null) =>
    worker?.addEventListener('statechange', () => {
      if (worker.state === 'installed') offer();
    });
  registration.addEventListener('updatefound', () => watch(registration.installing));
  watch(registration.installing);
  if (registration.waiting) offer();

  let lookedMs = nowMs();
  onReturn(() => {
    if (nowMs() - lookedMs < LOOK_AGAIN_MS) return;
    lookedMs = nowMs();
    // Without a connection there is none to find.
    registration.update().catch(() => undefined);
  });
}
