/**
 * Kept sessions in IndexedDB: what autosave writes and a restore reads. Records, by key:
 *
 *     ['session', id]        the card: enough to offer the session without reading it
 *     [id, 'file', n]        a file as it was opened, its Blob put once: the browser copies it, the page never reads it
 *     [id, 'piece', n]       bytes of typed arrays, at most a MB or so
 *     [id, 'head']           everything else, with references to files and pieces
 *
 * A save is one transaction: either all of it is there or the session is what it was. Its puts follow each other, each
 * in the success of the one before, since the browser copies a value while `put` runs: together they would be one long
 * task. (A record for each array would need no pieces, but then a put is as long as the array.)
 */
import { createStore, promisifyRequest, type UseStore } from 'idb-keyval';
import type { GivenBlob } from '../worker/protocol.ts';

/** What is known of a session before it is read. */
export interface SessionCard {
  readonly id: string;
  /** Of the form of the records; another one can't be read. */
  readonly version: number;
  /** Milliseconds since 1970. */
  readonly savedAtMs: number;
  readonly characters: readonly CardCharacter[];
}

export interface CardCharacter {
  readonly name: string;
  readonly joints: number;
  readonly clips: number;
}

/** A file as it was given. */
export interface KeptFile {
  /** Rises in the order of opening. */
  readonly id: number;
  /** One number for all files that were opened together: they are read together again. */
  readonly opening: number;
  readonly given: GivenBlob;
}

/** Made when its turn comes, so that a save holds one of them at a time. */
export interface PiecePut {
  readonly id: number;
  /** Bytes. */
  readonly size: number;
  bytes(): Uint8Array<ArrayBuffer>;
}

export interface SessionWrite {
  readonly card: SessionCard;
  /** Plain data, or else the save fails. */
  readonly head: unknown;
  readonly files: readonly KeptFile[];
  readonly pieces: readonly PiecePut[];
  readonly goneFiles: readonly number[];
  readonly gonePieces: readonly number[];
  /** Builds on an earlier save: fails with `SessionLostError` where that is not there any more. */
  readonly follows: boolean;
  /** All puts in one task, committed without waiting: for a page that is about to go. */
  readonly atOnce: boolean;
}

export interface SessionContent {
  readonly head: unknown;
  /** Ascending by id. */
  readonly files: readonly KeptFile[];
  readonly pieces: readonly number[];
}

export interface SessionStore {
  list(): Promise<readonly SessionCard[]>;
  write(write: SessionWrite): Promise<void>;
  /** undefined where there is no such session. */
  read(id: string): Promise<SessionContent | undefined>;
  /** Calls back with each of the pieces, one a task. Throws a `SessionLostError` where one is missing. */
  readPieces(id: string, pieces: readonly number[], take: (piece: number, bytes: Uint8Array) => void): Promise<void>;
  remove(id: string): Promise<void>;
}

/** What an earlier save wrote is gone: the person, or the browser for want of room, has cleared it. */
export class SessionLostError extends Error {
  override readonly name = 'SessionLostError';
}

const DATABASE = 'marrow-sessions';
const RECORDS = 'records';

/** Nothing is opened until something is asked for; then everything may reject with what IndexedDB says. */
export function sessionStore(): SessionStore {
  let use: UseStore | undefined;
  /** Retried once over a new connection: browsers close old ones, some without a word. */
  const within = async <T>(mode: IDBTransactionMode, body: (store: IDBObjectStore) => Promise<T>): Promise<T> => {
    use ??= createStore(DATABASE, RECORDS);
    try {
      return await use(mode, body);
    } catch (error) {
      if (!(error instanceof DOMException) || error.name !== 'InvalidStateError') throw error;
      use = createStore(DATABASE, RECORDS);
      return use(mode, body);
    }
  };
  return {
    list: () => within('readonly', (store) => promisifyRequest<SessionCard[]>(store.getAll(under('session')))),
    write: (write) => within('readwrite', (store) => inTurn(store, puts(store, write), write.atOnce)),
    read: (id) =>
      within('readonly', async (store) => {
        const [head, files, keys] = await Promise.all([
          promisifyRequest<unknown>(store.get([id, 'head'])),
          promisifyRequest<KeptFile[]>(store.getAll(under(id, 'file'))),
          promisifyRequest(store.getAllKeys(under(id, 'piece'))),
        ]);
        // Keys of pieces end with their number.
        const pieces = keys.map((key) => Number(Array.isArray(key) ? key.at(-1) : Number.NaN));
        return head === undefined ? undefined : { head, files, pieces };
      }),
    readPieces: (id, pieces, take) => within('readonly', (store) => inTurn(store, gets(store, id, pieces, take))),
    remove: (id) =>
      within('readwrite', (store) => {
        store.delete(['session', id]);
        store.delete(under(id));
        return promisifyRequest(store.transaction);
      }),
  };
}

/** All keys that begin so; a list stands after every text and number. */
function under(...beginning: readonly string[]): IDBKeyRange {
  return IDBKeyRange.bound([...beginning], [...beginning, []]);
}

function* puts(store: IDBObjectStore, write: SessionWrite): Generator<IDBRequest> {
  const { id } = write.card;
  if (write.follows && !write.atOnce) {
    const earlier = store.count(['session', id]);
    yield earlier;
    if (earlier.result === 0) throw new SessionLostError('The stored session is gone.');
  }
  for (const file of write.files) yield store.put(file, [id, 'file', file.id]);
  for (const piece of write.pieces) yield store.put(piece.bytes(), [id, 'piece', piece.id]);
  for (const file of write.goneFiles) yield store.delete([id, 'file', file]);
  for (const piece of write.gonePieces) yield store.delete([id, 'piece', piece]);
  yield store.put(write.card, ['session', id]);
  yield store.put(write.head, [id, 'head']);
}

function* gets(
  store: IDBObjectStore,
  id: string,
  pieces: readonly number[],
  take: (piece: number, bytes: Uint8Array) => void,
): Generator<IDBRequest> {
  for (const piece of pieces) {
    const request = store.get([id, 'piece', piece]);
    yield request;
    if (!(request.result instanceof Uint8Array)) throw new SessionLostError('Part of the stored session is gone.');
    take(piece, request.result);
  }
}

/** Makes each request when the one before has succeeded; resolves when the transaction is complete. */
function inTurn(store: IDBObjectStore, requests: Iterator<IDBRequest>, atOnce = false): Promise<void> {
  const { transaction } = store;
  return new Promise((resolve, reject) => {
    let problem: unknown;
    const fail = (error: unknown) => {
      problem = error;
      transaction.abort();
    };
    const next = () => {
      try {
        for (let step = requests.next(); !step.done; step = requests.next()) {
          if (atOnce) continue;
          step.value.onsuccess = next;
          return;
        }
        if (atOnce) transaction.commit();
      } catch (error) {
        fail(error);
      }
    };
    transaction.oncomplete = () => resolve();
    transaction.onabort = () => reject(problem ?? transaction.error ?? new Error('The transaction was aborted.'));
    next();
  });
}
