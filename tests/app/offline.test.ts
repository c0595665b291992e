import { describe, expect, it } from 'vitest';
import { offerInstalling } from '../../src/app/installing.ts';
import { startOffline } from '../../src/app/offline.ts';
import { TAKE_OVER } from '../../src/offline/take-over.ts';
import { NOT_OFFLINE, type Offline } from '../../src/ui/state/offline.ts';
import { observable } from '../../src/ui/widgets/observable.ts';

class FakeWorker extends EventTarget {
  state: ServiceWorkerState = 'installing';
  readonly messages: unknown[] = [];
  postMessage(message: unknown): void {
    this.messages.push(message);
  }
  become(state: ServiceWorkerState): void {
    this.state = state;
    this.dispatchEvent(new Event('statechange'));
  }
}

/** A browser with a stored version, of which a page is open. */
class FakeBrowser extends EventTarget {
  readonly offline = observable<Offline>(NOT_OFFLINE);
  readonly registration = Object.assign(new EventTarget(), {
    active: new FakeWorker(),
    installing: null as FakeWorker | null,
    waiting: null as FakeWorker | null,
    updates: 0,
    async update() {
      this.updates++;
      throw new TypeError('offline');
    },
  });
  controller = this.registration.active;
  reloads = 0;
  now = 0;
  comeBack = () => {};
  refuses = false;

  start(): Promise<void> {
    const { offline, registration } = this;
    const workers = Object.assign(this, {
      ready: Promise.resolve(registration),
      register: async () => {
        if (this.refuses) throw new DOMException('', 'SecurityError');
      },
    });
    return startOffline({
      offline,
      // All that is used of it.
      workers: workers as unknown as ServiceWorkerContainer,
      reload: () => void this.reloads++,
      onReturn: (listener) => {
        this.comeBack = listener;
      },
      nowMs: () => this.now,
    });
  }

  /** A new version is stored, and waits. */
  findVersion(): FakeWorker {
    const worker = new FakeWorker();
    this.registration.installing = worker;
    this.registration.dispatchEvent(new Event('updatefound'));
    this.registration.installing = null;
    this.registration.waiting = worker;
    worker.become('installed');
    return worker;
  }

  /** The waiting version takes over all tabs. */
  switch(): void {
    const { waiting } = this.registration;
    if (!waiting) throw new Error('Nothing waits.');
    this.registration.waiting = null;
    this.registration.active = waiting;
    this.controller = waiting;
    this.dispatchEvent(new Event('controllerchange'));
  }

  get offer() {
    return this.offline.get().newVersion;
  }
}

async function opened(prepare: (browser: FakeBrowser) => void = () => {}) {
  const browser = new FakeBrowser();
  prepare(browser);
  await browser.start();
  return browser;
}

describe('a page that is stored in the browser', () => {
  it('a stored page works offline, and offers nothing as long as it is the newest', async () => {
    const browser = await opened();
    expect(browser.offline.get()).toEqual({ isReady: true });
    // The first version takes over the page that has stored it.
    browser.dispatchEvent(new Event('controllerchange'));
    expect(browser.offer).toBeUndefined();
    expect(browser.reloads).toBe(0);
  });

  it('a page whose browser refuses storage works as before, and says nothing', async () => {
    const browser = await opened((b) => {
      b.refuses = true;
    });
    expect(browser.offline.get()).toEqual(NOT_OFFLINE);
  });

  it('a new version is offered when it is stored, not when it is found', async () => {
    const browser = await opened();
    const worker = new FakeWorker();
    browser.registration.installing = worker;
    browser.registration.dispatchEvent(new Event('updatefound'));
    expect(browser.offer).toBeUndefined();
    worker.become('installed');
    expect(browser.offer?.isPutOff).toBe(false);
  });

  it('a new version whose installation fails is not offered', async () => {
    const browser = await opened();
    const worker = new FakeWorker();
    browser.registration.installing = worker;
    browser.registration.dispatchEvent(new Event('updatefound'));
    worker.become('redundant');
    expect(browser.offer).toBeUndefined();
  });

  it('a new version that waits since an earlier visit, or is being stored, is offered', async () => {
    const waiting = await opened((b) => {
      b.registration.waiting = new FakeWorker();
    });
    expect(waiting.offer).toBeDefined();
    const installing = new FakeWorker();
    const storing = await opened((b) => {
      b.registration.installing = installing;
    });
    expect(storing.offer).toBeUndefined();
    installing.become('installed');
    expect(storing.offer).toBeDefined();
  });

  it('a new version takes over when it is accepted, and only then is the page reloaded', async () => {
    const browser = await opened();
    const worker = browser.findVersion();
    expect(worker.messages).toEqual([]);
    browser.offer?.reload();
    expect(worker.messages).toEqual([TAKE_OVER]);
    expect(browser.reloads).toBe(0);
    browser.switch();
    expect(browser.reloads).toBe(1);
  });

  it('a new version accepted in another tab is offered here, and reloads only this one', async () => {
    const browser = await opened();
    const worker = browser.findVersion();
    browser.switch();
    expect([browser.reloads, browser.offer?.isPutOff]).toEqual([0, false]);
    browser.offer?.reload();
    expect(browser.reloads).toBe(1);
    expect(worker.messages).toEqual([]);
  });

  it('a new version can be accepted again after leaving was cancelled', async () => {
    const browser = await opened();
    browser.findVersion();
    browser.offer?.reload();
    browser.switch();
    // The browser asked, and the page is still there.
    browser.offer?.reload();
    expect(browser.reloads).toBe(2);
  });

  it('a new version that was put off stays on offer in the menu, and the next one is offered anew', async () => {
    const browser = await opened();
    browser.findVersion();
    browser.offer?.later();
    expect(browser.offer?.isPutOff).toBe(true);
    browser.findVersion();
    expect(browser.offer?.isPutOff).toBe(false);
  });

  it('a page that stays open looks for new versions once an hour, when it is looked at', async () => {
    const browser = await opened();
    browser.comeBack();
    expect(browser.registration.updates).toBe(0);
    browser.now = 61 * 60 * 1000;
    browser.comeBack();
    browser.comeBack();
    expect(browser.registration.updates).toBe(1);
  });
});

describe('installing the page', () => {
  it('the page can be installed once for each time that the browser offers it', () => {
    const page = new EventTarget();
    const offline = observable<Offline>({ isReady: true });
    // All that is used of it.
    offerInstalling(offline, page as unknown as Window);
    let prompts = 0;
    const ask = () => {
      const event = new Event('beforeinstallprompt', { cancelable: true });
      page.dispatchEvent(Object.assign(event, { prompt: async () => void prompts++ }));
      return event;
    };
    expect(offline.get().install).toBeUndefined();
    expect(ask().defaultPrevented).toBe(true);
    offline.get().install?.();
    expect(prompts).toBe(1);
    expect(offline.get()).toEqual({ isReady: true });
    ask();
    expect(offline.get().install).toBeDefined();
    page.dispatchEvent(new Event('appinstalled'));
    expect(offline.get()).toEqual({ isReady: true });
  });
});
