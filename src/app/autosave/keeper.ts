/**
 * Writes one session into the store, again and again: each time only what the store does not hold yet. Saves follow
 * each other; one that is made because the page is about to go does not wait, and takes nothing for granted that an
 * earlier one has not finished.
 */
import { SessionLostError, type SessionStore, type SessionWrite } from '../../io/session-store.ts';
import { type Encoded, encode } from './encode.ts';
import { KeptFiles } from './kept-files.ts';
import { knownSkins } from './known-skins.ts';
import type { Given, Origins } from './origins.ts';
import { StoredPieces } from './pieces.ts';
import { cardOf, type KeptState, SESSION_VERSION, type SessionState } from './session-state.ts';

/** The session's own record. */
export interface SessionHead {
  /** Absent: 1. */
  readonly version?: number;
  /** What the tree's `part`s refer to. */
  readonly files: readonly HeadFile[];
  readonly tree: Encoded;
}

export interface HeadFile {
  /** Id of the kept file. */
  readonly given: number;
  /** `source.path` of the file in it. */
  readonly path: string;
}

/** More than this to write makes a long task of a save that does not wait. */
const MAX_AT_ONCE_BYTES = 8 << 20;

export class Keeper {
  readonly pieces = new StoredPieces();
  readonly files = new KeptFiles();
  /** Whether the store has anything of the session. */
  isStored = false;
  private last: Promise<unknown> = Promise.resolve();

  constructor(
    readonly id: string,
    private readonly store: SessionStore,
    private readonly origins: Origins,
  ) {}

  /** Rejects with what IndexedDB says; the store then holds what it held before. */
  save(state: SessionState, savedAtMs: number): Promise<void> {
    const turn = this.last.then(() => this.saveNow(state, savedAtMs));
    this.last = turn.catch(() => undefined);
    return turn;
  }

  /** Without waiting for anything: the page is about to go. */
  saveAtOnce(state: SessionState, savedAtMs: number): Promise<void> {
    return this.write(state, savedAtMs, true);
  }

  /** The session is not wanted any more. */
  remove(): Promise<void> {
    const turn = this.last.then(async () => {
      if (!this.isStored) return;
      this.forget();
      await this.store.remove(this.id);
    });
    this.last = turn.catch(() => undefined);
    return turn;
  }

  private async saveNow(state: SessionState, savedAtMs: number): Promise<void> {
    try {
      await this.write(state, savedAtMs, false);
    } catch (error) {
      if (isFull(error)) throw error;
      if (error instanceof SessionLostError) {
        // Someone cleared the browser's data: all of it once more.
        this.forget();
        await this.write(state, savedAtMs, false);
      } else await this.writeWithoutFiles(state, savedAtMs, error);
    }
  }

  /**
   * A file that was changed or removed on disk since it was opened can't be copied any more. What came out of it is
   * still here: it is kept as if it had been made here.
   */
  private async writeWithoutFiles(state: SessionState, savedAtMs: number, reason: unknown): Promise<void> {
    const missing = this.files.missing(this.encode(state).given);
    if (missing.length === 0) throw reason;
    for (const given of missing) this.origins.setKeepable(given, false);
    try {
      await this.write(state, savedAtMs, false);
    } catch (error) {
      // It was not the files.
      for (const given of missing) this.origins.setKeepable(given, true);
      throw error;
    }
  }

  private forget(): void {
    this.pieces.forget();
    this.files.forget();
    this.isStored = false;
  }

  private encode(state: SessionState) {
    const kept: KeptState = { ...state, knownSkins: knownSkins(state.document, this.origins) };
    const encoded = encode(kept, this.origins);
    return { ...encoded, given: new Set(encoded.files.map((file): Given => file.given)) };
  }

  private async write(state: SessionState, savedAtMs: number, atOnce: boolean): Promise<void> {
    const { tree, files, arrays, given } = this.encode(state);
    const filePlan = this.files.plan(given);
    const piecePlan = this.pieces.plan(arrays);
    const head: SessionHead = {
      version: SESSION_VERSION,
      files: files.map((f) => ({ given: f.given.id, path: f.path })),
      tree,
    };
    const write: SessionWrite = {
      card: cardOf(this.id, state, savedAtMs),
      head,
      files: filePlan.puts,
      pieces: piecePlan.puts,
      goneFiles: filePlan.gone,
      gonePieces: piecePlan.gone,
      follows: this.isStored,
      atOnce: atOnce && piecePlan.puts.reduce((sum, put) => sum + put.size, 0) <= MAX_AT_ONCE_BYTES,
    };
    try {
      await this.store.write(write);
    } catch (error) {
      filePlan.failed();
      piecePlan.failed();
      throw error;
    }
    filePlan.done();
    piecePlan.done();
    this.isStored = true;
  }
}

/** Whether the store has no room left. */
export function isFull(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}
