/**
 * Writes one session into the store, each time only what the store doesn't hold yet. Saves run one after the other,
 * except the last one of a closing page: it doesn't wait, and relies on nothing that a running save has not finished.
 */
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { SessionLostError, type SessionStore, type SessionWrite } from '../../io/session-store.ts';
import { breathe } from '../../view/slices.ts';
import { allNeeded, type ChunkDraft, StoredChunks } from './chunks.ts';
import { type EncodedSession, Encoder, type FileIndices } from './encode.ts';
import type { Encoded } from './encoded.ts';
import { KeptFiles } from './kept-files.ts';
import { knownSkins } from './known-skins.ts';
import type { Given, OriginFile, Origins } from './origins.ts';
import { StoredPieces } from './pieces.ts';
import { cardOf, type KeptState, type SessionState } from './session-state.ts';

/** The session's record. */
export interface SessionHead {
  /** Indexed by the `part`s of tree and chunks; null: a file that nothing comes from any more. */
  readonly files: readonly (HeadFile | null)[];
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
/** Milliseconds of work before the page may do something else. */
const SLICE_MS = 8;

export class Keeper {
  readonly pieces = new StoredPieces();
  readonly chunks = new StoredChunks();
  readonly files = new KeptFiles();
  /** Whether the store holds anything of the session. */
  isStored = false;
  /** For how many milliseconds the last save kept the page busy. */
  busyMs = 0;
  private readonly indices: FileIndices = new Map();
  private last: Promise<unknown> = Promise.resolve();
  /** How many saves were made at once. */
  private atOnce = 0;

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
    this.atOnce++;
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
    const { needs } = runToEnd(this.encode(state, this.chunks.draft()));
    const missing = this.files.missing(this.givenOf(allNeeded(needs).files).all);
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
    this.chunks.forget();
    this.files.forget();
    this.isStored = false;
  }

  private *encode(state: SessionState, draft: ChunkDraft): Steps<EncodedSession> {
    yield* this.origins.look();
    const kept: KeptState = { ...state, knownSkins: knownSkins(state.document, this.origins) };
    return yield* new Encoder(this.origins, this.indices, draft).encode(kept);
  }

  private async write(state: SessionState, savedAtMs: number, atOnce: boolean): Promise<void> {
    this.busyMs = 0;
    const draft = this.chunks.draft();
    const steps = this.encode(state, draft);
    const { atOnce: before } = this;
    const { tree, needs } = atOnce ? runToEnd(steps) : await this.inSlices(steps);
    // What was saved at once between the slices is newer, and may have deleted what this save relies on.
    if (this.atOnce > before) return;
    const begun = performance.now();
    const { files, arrays, chunks } = allNeeded(needs);
    const chunkPlan = draft.plan(chunks);
    const { all, beside } = this.givenOf(files);
    const filePlan = this.files.plan(all);
    const piecePlan = this.pieces.plan(arrays);
    const head: SessionHead = {
      files: Array.from(this.indices.keys(), (file) =>
        files.has(file) ? { given: file.given.id, path: file.path } : null,
      ),
      ...(beside.size > 0 && { beside: Array.from(beside, ({ id }) => id) }),
      tree,
    };
    const bytes = [...piecePlan.puts, ...chunkPlan.puts].reduce((sum, put) => sum + put.size, 0);
    const write: SessionWrite = {
      card: cardOf(this.id, state, savedAtMs),
      head,
      files: filePlan.puts,
      pieces: piecePlan.puts,
      chunks: chunkPlan.puts,
      goneFiles: filePlan.gone,
      gonePieces: piecePlan.gone,
      goneChunks: chunkPlan.gone,
      follows: this.isStored,
      atOnce: atOnce && bytes <= MAX_AT_ONCE_BYTES,
    };
    const plans = [filePlan, piecePlan, chunkPlan];
    this.busyMs += performance.now() - begun;
    try {
      this.busyMs += await this.store.write(write);
    } catch (error) {
      for (const plan of plans) plan.failed();
      throw error;
    }
    for (const plan of plans) plan.done();
    this.isStored = true;
  }

  /** What is encoded is immutable: the page may continue meanwhile. */
  private async inSlices<T>(steps: Steps<T>): Promise<T> {
    for (;;) {
      const begun = performance.now();
      let step = steps.next();
      while (!step.done && performance.now() - begun < SLICE_MS) step = steps.next();
      this.busyMs += performance.now() - begun;
      if (step.done) return step.value;
      await breathe();
    }
  }

  private givenOf(files: Iterable<OriginFile>) {
    const all = new Set(Array.from(files, (file): Given => file.given));
    const beside = new Set<Given>();
    for (const file of all) for (const other of this.origins.besideOf(file)) beside.add(other);
    return { all: new Set([...all, ...beside]), beside };
  }
}

/** Whether the store is out of space. */
export function isFull(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}
