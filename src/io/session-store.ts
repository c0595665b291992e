/**
 * Stored sessions in IndexedDB: written by autosave, read by a restore. Records, by key:
 *
 *     ['session', id]        the card: enough to offer the session without reading it
 *     [id, 'file', n]        a file as it was opened, its Blob put once: the browser copies it, the page never reads it
 *     [id, 'piece', n]       bytes of a large typed array, at most a MB
 *     [id, 'chunk', n]       a run of the items of a long list
 *     [id, 'head']           everything else, with references to files, pieces and chunks
 *
 * A save is one transaction: either all of it is stored or the session is unchanged. After each quarter of a megabyte
 * of pieces and chunks it continues in the success event of the last put, since the browser copies a value while `put`
 * runs: together they would be one long task. All else doesn't wait, since each answer takes a while on a busy machine.
 * (A record per array would need no pieces, but a put then takes as long as the array is large.)
 */

import { createStore, promisifyRequest, type UseStore } from 'idb-keyval';
import { UserError } from '../model/user-error.ts';
import type { GivenBlob } from '../worker/protocol.ts';

/** What is known of a session before it is read. */
export interface SessionCard {
  readonly id: string;
  /** Format version of the records; others can't be read. */
  readonly version: number;
  /** Milliseconds since 1970. */
  readonly savedAtMs: number;
  readonly characters: readonly CardCharacter[];
}

export interface CardCharacter {
  readonly name: string;
  readonly joints: number;
  readonly takes: number;
}

/** A file as given. */
export interface KeptFile {
  /** Increases in the order of opening. */
  readonly id: number;
  /** The same for all files that were opened together, since they are read together again. */
  readonly opening: number;
  readonly given: GivenBlob;
}

/** Created when its turn comes, so that a save holds one at a time. */
export interface PiecePut {
  readonly id: number;
  /** In bytes. */
  readonly size: number;
  bytes(): Uint8Array<ArrayBuffer>;
}

/** Never changed: what replaces it has another id. */
export interface ChunkPut {
  readonly id: number;
  /** In bytes, roughly. */
  readonly size: number;
  /** Plain data, as in the head. */
  readonly of: readonly unknown[];
}

export interface SessionWrite {
  readonly card: SessionCard;
  /** Must be plain data, or the save fails. */
  readonly head: unknown;
  readonly files: readonly KeptFile[];
  readonly pieces: readonly PiecePut[];
  readonly chunks: readonly ChunkPut[];
  readonly goneFiles: readonly number[];
  readonly gonePieces: readonly number[];
  readonly goneChunks: readonly number[];
  /** Extends an earlier save: fails with `SessionLostError` if that no longer exists. */
  readonly follows: boolean;
  /** All puts in one task, committed without waiting, for a page that is being closed. */
  readonly atOnce: boolean;
}

export interface SessionContent {
  readonly head: unknown;
  /** Ascending by id. */
  readonly files: readonly KeptFile[];
  readonly pieces: readonly number[];
  readonly chunks: readonly number[];
}

export interface SessionStore {
  list(): Promise<readonly SessionCard[]>;
  /** Returns for how many milliseconds it kept the page busy. */
  write(write: SessionWrite): Promise<number>;
  /** Undefined if the session does not exist. */
  read(id: string): Promise<SessionContent | undefined>;
  /** Calls back with each of the pieces, one per task. Throws a `SessionLostError` if one is missing. */
  readPieces(id: string, pieces: readonly number[], take: (piece: number, bytes: Uint8Array) => void): Promise<void>;
  /** Likewise. */
  readChunks(
    id: string,
    chunks: readonly number[],
    take: (chunk: number, of: readonly unknown[]) => void,
  ): Promise<void>;
  remove(id: string): Promise<void>;
  /** Calls back when the browser closes the store while it is in use, as when its data is cleared. */
  onClosed(listener: () => void): void;
}

/** An earlier save no longer exists: cleared by the user, or by the browser for lack of space. */
export class SessionLostError extends UserError {
  override readonly name = 'SessionLostError';
}

const DATABASE = 'marrow-sessions';
const RECORDS = 'records';

/** Opens nothing until first used; then every call may reject with IndexedDB's error. */
export function sessionStore(): SessionStore {
  let use: UseStore | undefined;
  let connection: IDBDatabase | undefined;
  let closed: () => void = () => undefined;
  const watched =
    <T>(body: (store: IDBObjectStore) => Promise<T>) =>
    (store: IDBObjectStore) => {
      const { db } = store.transaction;
      if (db !== connection) db.addEventListener('close', () => closed());
      connection = db;
      return body(store);
    };
  /** Retried once over a new connection, since browsers close old ones, some without notice. */
  const within = async <T>(mode: IDBTransactionMode, body: (store: IDBObjectStore) => Promise<T>): Promise<T> => {
    use ??= createStore(DATABASE, RECORDS);
    try {
      return await use(mode, watched(body));
    } catch (error) {
      if (!(error instanceof DOMException) || error.name !== 'InvalidStateError') throw error;
      use = createStore(DATABASE, RECORDS);
      return use(mode, watched(body));
    }
  };
  return {
    onClosed(listener) {
      closed = listener;
    },
    list: () => within('readonly', (store) => promisifyRequest<SessionCard[]>(store.getAll(under('session')))),
    write: (write) => within('readwrite', (store) => inTurn(store, puts(store, write), write.atOnce)),
    read: (id) =>
      within('readonly', async (store) => {
        const [head, files, pieces, chunks] = await Promise.all([
          promisifyRequest<unknown>(store.get([id, 'head'])),
          promisifyRequest<KeptFile[]>(store.getAll(under(id, 'file'))),
          promisifyRequest(store.getAllKeys(under(id, 'piece'))),
          promisifyRequest(store.getAllKeys(under(id, 'chunk'))),
        ]);
        return head === undefined
          ? undefined
          : { head, files, pieces: pieces.map(numberOf), chunks: chunks.map(numberOf) };
      }),
    readPieces: (id, pieces, take) =>
      within('readonly', async (store) => {
        const read = (piece: number, found: unknown) => {
          if (!(found instanceof Uint8Array)) throw lostPart();
          take(piece, found);
        };
        await inTurn(store, gets(store, id, 'piece', pieces, read));
      }),
    readChunks: (id, chunks, take) =>
      within('readonly', async (store) => {
        const read = (chunk: number, found: unknown) => {
          if (!Array.isArray(found)) throw lostPart();
          take(chunk, found);
        };
        await inTurn(store, gets(store, id, 'chunk', chunks, read));
      }),
    remove: (id) =>
      within('readwrite', (store) => {
        store.delete(['session', id]);
        store.delete(under(id));
        return promisifyRequest(store.transaction);
      }),
  };
}

/** All keys with this prefix; arrays sort after every text and number. */
function under(...beginning: readonly string[]): IDBKeyRange {
  return IDBKeyRange.bound([...beginning], [...beginning, []]);
}

/** Put in one task: a few milliseconds. */
const MAX_TASK_BYTES = 1 << 18;

function* puts(store: IDBObjectStore, write: SessionWrite): Generator<IDBRequest> {
  const { id } = write.card;
  if (write.follows && !write.atOnce) {
    const earlier = store.count(['session', id]);
    yield earlier;
    if (earlier.result === 0) throw new SessionLostError('The stored session is gone.');
  }
  for (const file of write.files) yield store.put(file, [id, 'file', file.id]);
  let bytes = 0;
  const isMuch = ({ size }: { readonly size: number }) => {
    bytes += size;
    if (bytes < MAX_TASK_BYTES) return false;
    bytes = 0;
    return true;
  };
  for (const piece of write.pieces) {
    const put = store.put(piece.bytes(), [id, 'piece', piece.id]);
    if (isMuch(piece)) yield put;
  }
  for (const chunk of write.chunks) {
    const put = store.put(chunk.of, [id, 'chunk', chunk.id]);
    if (isMuch(chunk)) yield put;
  }
  for (const file of write.goneFiles) store.delete([id, 'file', file]);
  for (const piece of write.gonePieces) store.delete([id, 'piece', piece]);
  for (const chunk of write.goneChunks) store.delete([id, 'chunk', chunk]);
  store.put(write.card, ['session', id]);
  store.put(write.head, [id, 'head']);
}

/** Keys of pieces and chunks end with their number. */
function numberOf(key: IDBValidKey): number {
  return Number(Array.isArray(key) ? key.at(-1) : Number.NaN);
}

const lostPart = () => new SessionLostError('Part of the stored session is gone.');

function* gets(
  store: IDBObjectStore,
  id: string,
  kind: 'piece' | 'chunk',
  numbers: readonly number[],
  take: (number: number, found: unknown) => void,
): Generator<IDBRequest> {
  for (const number of numbers) {
    const request = store.get([id, kind, number]);
    yield request;
    take(number, request.result);
  }
}

/**
 * Makes each request after the previous one succeeded; resolves when the transaction is complete, with the milliseconds
 * that making them took.
 */
function inTurn(store: IDBObjectStore, requests: Iterator<IDBRequest>, atOnce = false): Promise<number> {
  const { transaction } = store;
  return new Promise((resolve, reject) => {
    let problem: unknown;
    let busyMs = 0;
    const fail = (error: unknown) => {
      problem = error;
      transaction.abort();
    };
    const next = () => {
      const begun = performance.now();
      try {
        for (let step = requests.next(); !step.done; step = requests.next()) {
          if (atOnce) continue;
          step.value.onsuccess = next;
          return;
        }
        if (transaction.mode === 'readwrite') transaction.commit();
      } catch (error) {
        fail(error);
      } finally {
        busyMs += performance.now() - begun;
      }
    };
    transaction.oncomplete = () => resolve(busyMs);
    transaction.onabort = () => reject(problem ?? transaction.error ?? new Error('The transaction was aborted.'));
    next();
  });
}
