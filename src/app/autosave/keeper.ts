/**
 * Writes one session into the store, each time only what the store doesn't hold yet. Saves run one after the other,
 * except the last one of a closing page: it doesn't wait, and relies on nothing that a running save has not finished.
 */
import { SessionLostError, type SessionStore, type SessionWrite } from '../../io/session-store.ts';
import { type Encoded, encode } from './encode.ts';
import { KeptFiles } from './kept-files.ts';
import { knownSkins } from './known-skins.ts';
import type { Given, Origins } from './origins.ts';
import { StoredPieces } from './pieces.ts';
import { cardOf, type KeptState, SESSION_VERSION, type SessionState } from './session-state.ts';

/** The session's record. */
export interface SessionHead {
  /** Absent: 1. */
  readonly version?: number;
  /** Indexed by the tree's `part`s. */
  readonly files: readonly HeadFile[];
  /** Ids of stored files that those are read with, such as the buffers of a `.gltf`; absent: none. */
  readonly beside?: readonly number[];
  readonly tree: Encoded;
}

export interface HeadFile {
  /** Id of the stored file. */
  readonly given: number;
  /** `source.path` of the file read from it. */
  readonly path: string;
}

/** Writing more than this at once would block a closing page for too long. */
const MAX_AT_ONCE_BYTES = 8 << 20;

export class Keeper {
  readonly pieces = new StoredPieces();
  readonly files = new KeptFiles();
  /** Whether the store holds anything of the session. */
  isStored = false;
  /** For how many milliseconds the last save kept the page busy. */
  busyMs = 0;
  private last: Promise<unknown> = Promise.resolve();

  constructor(
    readonly id: string,
    private readonly store: SessionStore,
    private readonly origins: Origins,
  ) {}

  /** Rejects with IndexedDB's error; the store is then unchanged. */
  save(state: SessionState, savedAtMs: number): Promise<void> {
    const turn = this.last.then(() => this.saveNow(state, savedAtMs));
    this.last = turn.catch(() => undefined);
    return turn;
  }

  /** Saves without waiting, since the page may be closing. */
  saveAtOnce(state: SessionState, savedAtMs: number): Promise<void> {
    return this.write(state, savedAtMs, true);
  }

  /** Deletes the session from the store. */
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
        // The browser's data was cleared: write everything again.
        this.forget();
        await this.write(state, savedAtMs, false);
      } else await this.writeWithoutFiles(state, savedAtMs, error);
    }
  }

  /**
   * A file that was changed or removed on disk after opening can't be copied any more. Its content is still in memory:
   * it is kept as if created here.
   */
  private async writeWithoutFiles(state: SessionState, savedAtMs: number, reason: unknown): Promise<void> {
    const missing = this.files.missing(this.encode(state).given);
    if (missing.length === 0) throw reason;
    for (const given of missing) this.origins.setKeepable(given, false);
    try {
      await this.write(state, savedAtMs, false);
    } catch (error) {
      // The files weren't the cause.
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
    const given = new Set(encoded.files.map((file): Given => file.given));
    const beside = new Set<Given>();
    for (const file of given) for (const other of this.origins.besideOf(file)) beside.add(other);
    return { ...encoded, beside, given: new Set([...given, ...beside]) };
  }

  private async write(state: SessionState, savedAtMs: number, atOnce: boolean): Promise<void> {
    const begun = performance.now();
    const { tree, files, arrays, given, beside } = this.encode(state);
    const filePlan = this.files.plan(given);
    const piecePlan = this.pieces.plan(arrays);
    const head: SessionHead = {
      version: SESSION_VERSION,
      files: files.map((f) => ({ given: f.given.id, path: f.path })),
      ...(beside.size > 0 && { beside: Array.from(beside, ({ id }) => id) }),
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
    const encodingMs = performance.now() - begun;
    try {
      this.busyMs = encodingMs + (await this.store.write(write));
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

/** Whether the store is out of space. */
export function isFull(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}
