/**
 * Sessions left behind by earlier pages, as offered to the user. All but the five newest, and those older than a month,
 * are dropped.
 */
import type { SessionLocks } from '../../io/session-locks.ts';
import type { SessionCard, SessionStore } from '../../io/session-store.ts';
import type { KeptOffer } from '../../ui/state/kept-offer.ts';
import type { Observable } from '../../ui/widgets/observable.ts';
import { SESSION_VERSION } from './session-state.ts';

const MAX_KEPT = 5;
const LONGEST_KEPT_MS = 30 * 24 * 3600 * 1000;
/** A page that is reloading may hold its session's lock a moment longer. */
const LOCK_PATIENCE_MS = 2000;
/** A discarded session can be restored for this long. */
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

  /** Finds sessions that no page holds, and offers them. Rejects if the store can't be read. */
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
          // Sessions of another version may be read by that version.
          else if (card.version === SESSION_VERSION) this.add(card);
        } finally {
          lock();
        }
      }),
    );
  }

  /** Hides the offer, since something else is being worked on. */
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

  /** That session is being restored; the others stay available. */
  taken(id: string): void {
    this.isPutOff = true;
    this.drop(id);
  }

  /** Removes a session that can't be offered any more. */
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

  /** Deletes discarded sessions for good, except those that another page has taken meanwhile. */
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
