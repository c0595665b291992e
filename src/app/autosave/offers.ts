/**
 * Sessions that pages left behind, as the person is asked about them. The newest are offered; what is older than a month
 * or than the five newest is dropped.
 */
import type { SessionLocks } from '../../io/session-locks.ts';
import type { SessionCard, SessionStore } from '../../io/session-store.ts';
import type { Observable } from '../../ui/kit/observable.ts';
import type { KeptOffer } from '../../ui/state/kept-offer.ts';
import { READABLE_VERSIONS } from './session-state.ts';

export const MAX_KEPT = 5;
export const LONGEST_KEPT_MS = 30 * 24 * 3600 * 1000;
/** A page that is being reloaded may hold its session's lock for a moment yet. */
const LOCK_PATIENCE_MS = 2000;
/** Until then a discarded session can be had back. */
const SECOND_THOUGHTS_MS = 10_000;

export class KeptOffers {
  private works: readonly SessionCard[] = [];
  private discarded: SessionCard | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isAside = false;
  private isPutOff = false;

  constructor(
    private readonly sessions: SessionStore,
    private readonly locks: SessionLocks,
    private readonly shown: Observable<KeptOffer | undefined>,
    private readonly onRestore: (id: string) => Promise<void>,
  ) {}

  /** Looks for sessions that nobody holds, and offers them. Rejects where the store can't be read. */
  async find(ownId: string): Promise<void> {
    const now = Date.now();
    const cards = (await this.sessions.list()).filter((card) => card.id !== ownId);
    const sorted = [...cards].sort((a, b) => b.savedAtMs - a.savedAtMs);
    await Promise.all(
      sorted.map(async (card) => {
        const lock = await this.locks.hold(card.id, LOCK_PATIENCE_MS);
        if (!lock) return;
        const tooMany = this.works.filter((other) => other.savedAtMs > card.savedAtMs).length >= MAX_KEPT;
        try {
          if (tooMany || now - card.savedAtMs > LONGEST_KEPT_MS) await this.sessions.remove(card.id);
          // Another version's may be read by that version.
          else if (READABLE_VERSIONS.includes(card.version)) this.add(card);
        } finally {
          lock();
        }
      }),
    );
  }

  /** Something else is being worked on. */
  setAside(): void {
    if (this.isAside) return;
    this.isAside = true;
    if (this.shown.get()) this.show();
  }

  show(isAskedFor = false): void {
    const { works, discarded, isAside, isPutOff } = this;
    if (works.length === 0 && !discarded) {
      this.shown.set(undefined);
      return;
    }
    this.shown.set({
      works,
      ...(discarded && { discarded }),
      isAside,
      isPutOff,
      isAskedFor,
      restore: (id) => {
        this.shown.set(undefined);
        void this.onRestore(id);
      },
      discard: (id) => this.discard(id),
      putBack: () => this.putBack(),
      choose: (id) => {
        const chosen = works.find((work) => work.id === id);
        if (chosen) this.works = [chosen, ...works.filter((work) => work !== chosen)];
        this.show();
      },
      later: () => {
        this.isPutOff = true;
        this.show();
      },
      again: () => {
        this.isPutOff = false;
        this.show(true);
      },
    });
  }

  /** It is being worked on from now on; the others can still be asked for. */
  taken(id: string): void {
    this.isPutOff = true;
    this.drop(id);
  }

  /** A session that can't be offered any more. */
  drop(id: string): void {
    this.works = this.works.filter((work) => work.id !== id);
    this.show();
  }

  private add(card: SessionCard): void {
    this.works = [...this.works, card].sort((a, b) => b.savedAtMs - a.savedAtMs);
    this.show();
  }

  private discard(id: string): void {
    this.forget();
    this.discarded = this.works.find((work) => work.id === id);
    this.works = this.works.filter((work) => work.id !== id);
    this.timer = setTimeout(() => {
      this.forget();
      if (this.shown.get()) this.show();
    }, SECOND_THOUGHTS_MS);
    this.show();
  }

  private putBack(): void {
    clearTimeout(this.timer);
    if (this.discarded) this.works = [this.discarded, ...this.works];
    this.discarded = undefined;
    this.show();
  }

  /** What was discarded goes for good, unless someone else has taken it up meanwhile. */
  private forget(): void {
    clearTimeout(this.timer);
    const { discarded } = this;
    this.discarded = undefined;
    if (discarded) void this.remove(discarded.id).catch(() => undefined);
  }

  private async remove(id: string): Promise<void> {
    const lock = await this.locks.hold(id);
    if (!lock) return;
    await this.sessions.remove(id).finally(lock);
  }
}
