/**
 * Keeps the page's work in the browser, and offers to restore what an earlier page left behind.
 *
 * Each page has its own session under a random id and holds that session's lock while it is open: two pages never write
 * the same records, and an unlocked session is one whose page is closed. What the page opened by itself is not kept,
 * since it will be opened again. If the browser has no storage, or no room left, a message says so once.
 */

import type { Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import type { SessionLocks } from '../../io/session-locks.ts';
import type { SessionStore } from '../../io/session-store.ts';
import type { Document } from '../../model/document.ts';
import { sentenceOf } from '../../model/failure.ts';
import type { KeptOffer } from '../../ui/state/kept-offer.ts';
import type { Messages } from '../../ui/state/messages.ts';
import type { Timeline } from '../../ui/state/timeline.ts';
import type { Loading } from '../../ui/state/workbench.ts';
import type { Observable } from '../../ui/widgets/observable.ts';
import type { ViewCamera } from '../../view/camera/view-camera.ts';
import type { Runs } from '../../worker/client.ts';
import type { OpenedFiles, Opener } from '../opening.ts';
import { isFull, Keeper } from './keeper.ts';
import { KeptOffers } from './offers.ts';
import { Origins } from './origins.ts';
import { putBack } from './put-back.ts';
import { type ReadSession, readSession } from './restore.ts';
import { Rhythm } from './rhythm.ts';
import { isSameState, type SessionState } from './session-state.ts';

export interface AutosaveParts {
  readonly store: Store;
  readonly transport: Observable<Playback>;
  readonly timeline: Timeline;
  readonly camera: Pick<ViewCamera, 'view'>;
  readonly messages: Messages;
  readonly loading: Observable<Loading | undefined>;
  readonly kept: Observable<KeptOffer | undefined>;
  readonly opener: Pick<Opener, 'subscribe' | 'inTurn'>;
  readonly worker: Runs<'parse'>;
  readonly saving: SavingMarks;
  /** Undefined if the browser has no storage. */
  readonly sessions: SessionStore | undefined;
  readonly locks: SessionLocks | undefined;
}

/** What happened before autosave started. */
export interface TimeBefore {
  /** The page's initial document. It is opened again on each start, so it isn't kept. */
  readonly own: Document;
  readonly opened: readonly OpenedFiles[];
}

/** The state of saving that is not in the document, as plain data. */
export interface SavingMarks {
  /** Of that document, which may lack what is only tried. */
  snapshot(document: Document): unknown;
  restore(kept: unknown): void;
  /** Calls back when the snapshot has changed. */
  subscribe(listener: () => void): void;
}

/** Shown as `<html data-autosave="kept">`, for tests. */
export type AutosaveState = 'nothing' | 'pending' | 'kept' | 'failed';

/** Delay before retrying after a failure. */
const RETRY_MS = 30_000;

export class Autosave {
  private readonly rhythm: Rhythm;
  private readonly origins = new Origins(Date.now() * 1000);
  private readonly offers: KeptOffers | undefined;
  private keeper: Keeper | undefined;
  /** Requested on the first change. */
  private lock: Promise<(() => void) | undefined> | undefined;
  private isHeld = false;
  private last: SessionState | undefined;
  private marksChanged = false;
  /** The document that the page opened by itself: not kept, even if undo leads back to it. */
  private readonly own: Document;
  private hasComplained = false;
  /** No save before this time, since the last one failed. */
  private retryAtMs = 0;

  constructor(
    private readonly parts: AutosaveParts,
    before: TimeBefore,
    private readonly tell: (state: AutosaveState) => void,
    id: string = newId(),
  ) {
    const { store, transport, timeline, opener, saving, sessions, locks, kept } = parts;
    this.rhythm = new Rhythm(() => void this.save());
    if (sessions && locks) {
      sessions.onClosed(() => {
        // What it held may be gone.
        this.last = undefined;
        this.changed();
      });
      this.keeper = new Keeper(id, sessions, this.origins);
      this.offers = new KeptOffers(sessions, locks, kept, (other) => this.restore(other));
    }
    opener.subscribe(({ given, files }) => {
      this.origins.learn(given, files);
      this.changed();
    });
    store.subscribe((now, before) => {
      if (now !== before) this.changed();
    });
    transport.subscribe((now, before) => {
      if (!(now.playing && before.playing)) this.changed();
    });
    timeline.view.subscribe(() => this.changed());
    saving.subscribe(() => {
      this.marksChanged = true;
      this.changed();
    });
    tell('nothing');
    this.own = before.own;
    for (const { given, files } of before.opened) this.origins.learn(given, files);
    this.changed();
  }

  /** Looks for sessions left by earlier pages. */
  async offer(): Promise<void> {
    // If the store can't be read it can't be written either; that is reported when there is something to save.
    await this.offers?.find(this.keeper?.id ?? '').catch(() => undefined);
  }

  /** Something may have changed: compared when it is time to save. */
  changed(): void {
    if (!this.isWorthKeeping && !this.keeper?.isStored) return;
    if (this.isWorthKeeping) this.offers?.setAside();
    this.tell('pending');
    this.rhythm.changed();
    if (this.isWorthKeeping) void this.hold();
  }

  /** Input that may have moved the camera. */
  touched(): void {
    if (this.isWorthKeeping) this.rhythm.changed();
  }

  /** A mouse button or finger went down or up. */
  setPointerDown(isDown: boolean): void {
    this.rhythm.setPointerDown(isDown);
  }

  /** Saves without waiting, since the page may be closing. */
  saveAtOnce(): void {
    const { keeper } = this;
    const state = this.state();
    if (!keeper || !this.isHeld || !this.isWorthKeeping || !this.isNew(state)) return;
    this.rhythm.clear();
    void this.settle(keeper, state, keeper.saveAtOnce(state, Date.now()));
  }

  private get isWorthKeeping(): boolean {
    const { document } = this.parts.store;
    if (document === this.own) return false;
    return document.characters.length > 0 || document.unused.length > 0 || (document.review ?? []).length > 0;
  }

  private state(): SessionState {
    const { store, transport, timeline, camera, saving } = this.parts;
    const { document, selection } = store.confirmed;
    return {
      document,
      selection,
      transport: transport.get(),
      timeline: timeline.view.get(),
      camera: camera.view,
      saving: saving.snapshot(document),
    };
  }

  private isNew(state: SessionState): boolean {
    return this.marksChanged || !this.last || !isSameState(this.last, state);
  }

  private async save(): Promise<void> {
    const { keeper } = this;
    if (!keeper) {
      this.say(NO_STORE);
      return;
    }
    if (!this.isWorthKeeping) {
      this.last = undefined;
      // If removing fails, the session is only offered once more.
      await keeper.remove().catch(() => undefined);
      this.tell('nothing');
      return;
    }
    const wait = this.retryAtMs - performance.now();
    if (wait > 0) {
      this.rhythm.changedLater(wait);
      return;
    }
    const state = this.state();
    if (!this.isNew(state)) {
      this.tell('kept');
      return;
    }
    await this.settle(
      keeper,
      state,
      this.hold().then(() => keeper.save(state, Date.now())),
    );
  }

  /** Waits for a running save and reports its result. Never rejects. */
  private async settle(keeper: Keeper, state: SessionState, saving: Promise<void>): Promise<void> {
    this.marksChanged = false;
    try {
      await saving;
      if (this.keeper !== keeper) return;
      this.rhythm.saveTook(keeper.busyMs);
      this.last = state;
      if (!this.rhythm.isPending) this.tell('kept');
    } catch (error) {
      if (this.keeper !== keeper) return;
      this.marksChanged = true;
      this.say(isFull(error) ? FULL : NO_STORE);
      this.retryAtMs = performance.now() + RETRY_MS;
      this.rhythm.changedLater(RETRY_MS);
    }
  }

  private say(sentence: string): void {
    this.tell('failed');
    if (!this.hasComplained) this.parts.messages.note(sentence, 'warning', 'until read');
    this.hasComplained = true;
  }

  private hold(): Promise<unknown> {
    const { locks } = this.parts;
    const { keeper } = this;
    if (!locks || !keeper) return Promise.resolve();
    if (!this.lock) {
      const lock = locks.hold(keeper.id);
      this.lock = lock;
      lock.then(
        () => {
          this.isHeld = this.lock === lock;
        },
        // Reported to whoever awaits the save, now or on the next try.
        () => {
          this.lock = undefined;
        },
      );
    }
    return this.lock;
  }

  /** Continues in another session. */
  private async restore(id: string): Promise<void> {
    const { opener, locks, messages } = this.parts;
    await opener.inTurn(async () => {
      const lock = await locks?.hold(id, LOCK_PATIENCE_MS).catch(() => undefined);
      if (!lock) {
        messages.note('That work is already open in another tab or window.', 'warning');
        this.offers?.drop(id);
        return;
      }
      try {
        await this.takeOver(await this.read(id), lock);
        this.offers?.taken(id);
      } catch (error) {
        lock();
        this.offers?.show();
        const reason = sentenceOf(error);
        const wasCancelled = error instanceof DOMException && error.name === 'AbortError';
        if (wasCancelled) messages.note('Restore cancelled. Nothing was changed.');
        else messages.note(`Your work could not be restored. Nothing was changed. ${reason}`, 'error');
      }
    });
  }

  private async read(id: string): Promise<ReadSession> {
    const { sessions, loading, worker } = this.parts;
    if (!sessions) throw new Error(NO_STORE);
    const abort = new AbortController();
    const cancel = () => abort.abort(new DOMException('Restore cancelled.', 'AbortError'));
    loading.set({ label: 'your work', done: 0, of: 0, cancel });
    try {
      return await readSession(id, sessions, worker, this.origins, {
        signal: abort.signal,
        onProgress: (p) => loading.set({ label: p.label, done: p.done, of: p.of, cancel }),
      });
    } finally {
      loading.set(undefined);
    }
  }

  private async takeOver(session: ReadSession, lock: () => void): Promise<void> {
    const { keeper: before, lock: lockBefore, isWorthKeeping: wasWork } = this;
    // Restoring changes everything: none of it may be written under the old id.
    this.keeper = session.keeper();
    this.lock = Promise.resolve(lock);
    this.isHeld = true;
    putBack(session.state, this.parts, wasWork);
    this.last = this.state();
    this.marksChanged = false;
    this.rhythm.clear();
    this.tell('kept');
    // What was open can be restored by undo, and belongs to the restored session now.
    await before?.remove().catch(() => undefined);
    (await lockBefore?.catch(() => undefined))?.();
  }
}

/** A closing page may hold its lock a little longer. */
const LOCK_PATIENCE_MS = 1000;

const FULL =
  'This browser is out of storage, so your work is not protected against a crash or reload. Everything else works; ' +
  'save your files often.';
const NO_STORE =
  'This browser does not let Marrow keep a backup of your work. Everything else works; save your files often.';

/** Only has to be unique; `randomUUID` is missing on plain http. */
function newId(): string {
  return Array.from(crypto.getRandomValues(new Uint32Array(4)), (part) => part.toString(36)).join('-');
}
