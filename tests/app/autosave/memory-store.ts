/** An in-memory store and locks for the tests of autosave: values are cloned as by IndexedDB. */
import type { SessionLocks } from '../../../src/io/session-locks.ts';
import {
  type KeptFile,
  type SessionCard,
  SessionLostError,
  type SessionStore,
  type SessionWrite,
} from '../../../src/io/session-store.ts';

interface Stored {
  card: SessionCard;
  head: unknown;
  readonly files: Map<number, KeptFile>;
  readonly pieces: Map<number, Uint8Array>;
  readonly chunks: Map<number, readonly unknown[]>;
}

export interface MemoryStore extends SessionStore {
  readonly sessions: Map<string, Stored>;
  /** Every successful write, newest last. */
  readonly writes: SessionWrite[];
  /** Bytes of pieces put by the last write. */
  lastBytes(): number;
  apply(write: SessionWrite): Promise<void>;
  /** Throws to make the next writes fail. */
  onWrite: (write: SessionWrite) => void | Promise<void>;
}

export function memoryStore(): MemoryStore {
  const sessions = new Map<string, Stored>();
  const writes: SessionWrite[] = [];
  /** One transaction at a time, as in a database. */
  let last: Promise<unknown> = Promise.resolve();
  return {
    sessions,
    writes,
    onWrite: () => undefined,
    onClosed: () => undefined,
    lastBytes: () => writes.at(-1)?.pieces.reduce((sum, piece) => sum + piece.bytes().byteLength, 0) ?? 0,
    list: async () => [...sessions.values()].map(({ card }) => card),
    write(write) {
      const turn = last.then(() => this.apply(write)).then(() => 0);
      last = turn.catch(() => undefined);
      return turn;
    },
    async apply(write) {
      const { card, follows } = write;
      await this.onWrite(write);
      const before = sessions.get(card.id);
      if (follows && !before) throw new SessionLostError('gone');
      const stored = before ?? { card, head: undefined, files: new Map(), pieces: new Map(), chunks: new Map() };
      // Blobs are immutable; Node's structuredClone accepts them too.
      for (const file of write.files) stored.files.set(file.id, file);
      for (const piece of write.pieces) stored.pieces.set(piece.id, structuredClone(piece.bytes()));
      for (const chunk of write.chunks) stored.chunks.set(chunk.id, structuredClone(chunk.of));
      for (const id of write.goneChunks) stored.chunks.delete(id);
      for (const id of write.goneFiles) stored.files.delete(id);
      for (const id of write.gonePieces) stored.pieces.delete(id);
      stored.card = card;
      stored.head = structuredClone(write.head);
      sessions.set(card.id, stored);
      writes.push(write);
    },
    async read(id) {
      const stored = sessions.get(id);
      if (!stored) return undefined;
      const files = [...stored.files.values()].sort((a, b) => a.id - b.id);
      const [pieces, chunks] = [[...stored.pieces.keys()], [...stored.chunks.keys()]];
      return { head: structuredClone(stored.head), files, pieces, chunks };
    },
    async readPieces(id, pieces, take) {
      for (const piece of pieces) {
        const bytes = sessions.get(id)?.pieces.get(piece);
        if (!bytes) throw new SessionLostError('gone');
        take(piece, bytes);
      }
    },
    async readChunks(id, chunks, take) {
      for (const chunk of chunks) {
        const of = sessions.get(id)?.chunks.get(chunk);
        if (!of) throw new SessionLostError('gone');
        take(chunk, structuredClone(of));
      }
    },
    remove: async (id) => void sessions.delete(id),
  };
}

/** One page's locks; pages share `held`. */
export function memoryLocks(held = new Set<string>()): SessionLocks {
  return {
    async hold(id) {
      if (held.has(id)) return undefined;
      held.add(id);
      return () => void held.delete(id);
    },
  };
}
