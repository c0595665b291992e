/**
 * Where each large typed array is stored among the pieces of the store. Arrays are immutable, so one that has a place
 * is never written again; a save writes those without a place and deletes pieces that are no longer needed.
 *
 *     array      ▒▒▒▒ ▒▒▒▒ ▒▒     its own pieces, deleted with it
 */
import type { PiecePut } from '../../io/session-store.ts';
import type { StorableNumbers, StoredNumbers } from './encoded.ts';

/** Copied in about a millisecond. */
export const PIECE_BYTES = 1 << 20;

interface Place {
  readonly piece: number;
  readonly bytes: number;
}

/** `doomed`: every save tries to delete it, until one has succeeded. */
type PieceState = 'writing' | 'stored' | 'doomed';

/** What a save has to do about pieces. Call `done` or `failed` with its outcome. */
export interface PiecePlan {
  readonly puts: readonly PiecePut[];
  readonly gone: readonly number[];
  done(): void;
  failed(): void;
}

export class StoredPieces {
  private readonly places = new WeakMap<StorableNumbers, Place>();
  private readonly pieces = new Map<number, PieceState>();
  private nextId = 1;

  /**
   * Gives each array a place, written into its node.
   *
   * May be called while an earlier save is running: the plan relies on nothing that isn't stored for certain, and needs
   * nothing that the earlier save deletes.
   */
  plan(arrays: ReadonlyMap<StorableNumbers, StoredNumbers>): PiecePlan {
    const needed = new Set<number>();
    const puts: PiecePut[] = [];
    for (const [array, node] of arrays) {
      const place = this.storedPlace(array) ?? this.place(array, puts);
      for (const id of piecesOf(place)) needed.add(id);
      node.piece = place.piece;
    }
    const gone = [...this.pieces.keys()].filter((id) => !needed.has(id));
    for (const id of gone) this.pieces.set(id, 'doomed');
    return {
      puts,
      gone,
      done: () => {
        for (const { id } of puts) if (this.pieces.get(id) === 'writing') this.pieces.set(id, 'stored');
        for (const id of gone) this.pieces.delete(id);
      },
      // Pieces to be deleted may still be there: they stay doomed.
      failed: () => {
        for (const { id } of puts) this.pieces.delete(id);
      },
    };
  }

  /** Registers an array that was read back. */
  adopt(array: StorableNumbers, place: Place): void {
    this.places.set(array, place);
    for (const id of piecesOf(place)) this.add(id, 'stored');
  }

  /** Registers a stored piece that nothing uses. */
  adoptWaste(id: number): void {
    if (!this.pieces.has(id)) this.add(id, 'doomed');
  }

  /** The store was cleared. */
  forget(): void {
    this.pieces.clear();
  }

  private add(id: number, state: PieceState): void {
    this.pieces.set(id, state);
    this.nextId = Math.max(this.nextId, id + 1);
  }

  private storedPlace(array: StorableNumbers): Place | undefined {
    const place = this.places.get(array);
    return place && piecesOf(place).every((id) => this.pieces.get(id) === 'stored') ? place : undefined;
  }

  private place(array: StorableNumbers, puts: PiecePut[]): Place {
    const place: Place = { piece: this.nextId, bytes: array.byteLength };
    for (let from = 0; from < array.byteLength; from += PIECE_BYTES) {
      const size = Math.min(PIECE_BYTES, array.byteLength - from);
      puts.push({ id: this.nextId, size, bytes: () => bytesOf(array).slice(from, from + size) });
      this.add(this.nextId, 'writing');
    }
    this.places.set(array, place);
    return place;
  }
}

/** The pieces that a place extends over. */
export function piecesOf({ piece, bytes }: Place): readonly number[] {
  const count = Math.max(1, Math.ceil(bytes / PIECE_BYTES));
  return Array.from({ length: count }, (_, i) => piece + i);
}

/** Copies the part of an array that is in one of its pieces. */
export function fill(array: StorableNumbers, place: Place, piece: number, bytes: Uint8Array): void {
  bytesOf(array).set(bytes, (piece - place.piece) * PIECE_BYTES);
}

function bytesOf(array: StorableNumbers): Uint8Array<ArrayBuffer> {
  return new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
}
