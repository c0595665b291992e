/**
 * Where each typed array is stored among the pieces of the store. Arrays are immutable, so one that has a place is
 * never written again; a save writes those without a place and deletes pieces that are no longer needed.
 *
 *     large array      ▒▒▒▒ ▒▒▒▒ ▒▒     its own pieces, deleted with it
 *     small arrays     ▒|▒▒|▒|▒         one piece for all new ones of a save
 *
 * A piece of small arrays is kept as long as one of them is needed. If less than half of it is needed, the rest moves
 * into the next save's piece, as in log compaction: storage stays below twice what is needed. (One record per array
 * would be thousands for a clip of a hundred channels, each with its overhead.)
 */
import type { PiecePut } from '../../io/session-store.ts';
import type { StorableNumbers, StoredNumbers } from './encode.ts';

/** Copied in about a millisecond. */
export const PIECE_BYTES = 1 << 20;
/** Arrays of at least this size have their own pieces. */
export const LARGE_BYTES = 1 << 18;
/** With more pieces of small arrays than this, mostly empty ones are compacted. */
const MAX_SCRAPS = 32;
const SCRAP_BYTES = PIECE_BYTES / 4;

interface Place {
  readonly piece: number;
  readonly offset: number;
  readonly bytes: number;
}

interface Piece {
  readonly bytes: number;
  readonly isLarge: boolean;
  /** `doomed`: every save tries to delete it, until one has succeeded. */
  state: 'writing' | 'stored' | 'doomed';
}

/** What a save has to do about pieces. Call `done` or `failed` with its outcome. */
export interface PiecePlan {
  readonly puts: readonly PiecePut[];
  readonly gone: readonly number[];
  done(): void;
  failed(): void;
}

export class StoredPieces {
  private readonly places = new WeakMap<StorableNumbers, Place>();
  private readonly pieces = new Map<number, Piece>();
  private nextId = 1;

  /**
   * Gives each array a place, written into its node.
   *
   * May be called while an earlier save is running: the plan relies on nothing that isn't stored for certain, and needs
   * nothing that the earlier save deletes.
   */
  plan(arrays: ReadonlyMap<StorableNumbers, StoredNumbers>): PiecePlan {
    const needed = new Set<number>();
    const loose: StorableNumbers[] = [];
    const worn = this.wornPieces(arrays.keys());
    for (const [array, node] of arrays) {
      const place = this.storedPlace(array);
      if (!place || worn.has(place.piece)) {
        loose.push(array);
        continue;
      }
      for (const id of piecesOf(place)) needed.add(id);
      node.piece = place.piece;
      node.offset = place.offset;
    }
    const puts = this.placeAll(loose, arrays);
    for (const { id } of puts) needed.add(id);
    const gone: number[] = [];
    for (const [id, piece] of this.pieces) {
      if (needed.has(id)) continue;
      piece.state = 'doomed';
      gone.push(id);
    }
    return {
      puts,
      gone,
      done: () => {
        for (const { id } of puts) {
          const piece = this.pieces.get(id);
          if (piece?.state === 'writing') piece.state = 'stored';
        }
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
    for (const id of piecesOf(place)) {
      const isLarge = place.bytes >= LARGE_BYTES;
      const bytes = isLarge ? PIECE_BYTES : Math.max(this.pieces.get(id)?.bytes ?? 0, place.offset + place.bytes);
      this.add(id, { bytes, isLarge, state: 'stored' });
    }
  }

  /** Registers a stored piece that nothing uses. */
  adoptWaste(id: number): void {
    if (!this.pieces.has(id)) this.add(id, { bytes: 0, isLarge: true, state: 'doomed' });
  }

  /** The store was cleared. */
  forget(): void {
    this.pieces.clear();
  }

  private add(id: number, piece: Piece): void {
    this.pieces.set(id, piece);
    this.nextId = Math.max(this.nextId, id + 1);
  }

  private storedPlace(array: StorableNumbers): Place | undefined {
    const place = this.places.get(array);
    if (!place) return undefined;
    for (const id of piecesOf(place)) if (this.pieces.get(id)?.state !== 'stored') return undefined;
    return place;
  }

  /** Pieces of small arrays that are mostly unused. */
  private wornPieces(arrays: Iterable<StorableNumbers>): ReadonlySet<number> {
    const used = new Map<number, number>();
    for (const array of arrays) {
      const place = this.storedPlace(array);
      if (place && place.bytes < LARGE_BYTES) used.set(place.piece, (used.get(place.piece) ?? 0) + place.bytes);
    }
    const worn = new Set<number>();
    const scraps: number[] = [];
    for (const [id, bytes] of used) {
      const piece = this.pieces.get(id);
      if (piece && 2 * bytes < piece.bytes) worn.add(id);
      else if (bytes < SCRAP_BYTES) scraps.push(id);
    }
    if (scraps.length > MAX_SCRAPS) for (const id of scraps) worn.add(id);
    return worn;
  }

  private placeAll(loose: readonly StorableNumbers[], arrays: ReadonlyMap<StorableNumbers, StoredNumbers>): PiecePut[] {
    const puts: PiecePut[] = [];
    const put = (isLarge: boolean, bytes: number, make: () => Uint8Array<ArrayBuffer>) => {
      const id = this.nextId;
      this.add(id, { bytes, isLarge, state: 'writing' });
      puts.push({ id, size: bytes, bytes: make });
      return id;
    };
    const settle = (array: StorableNumbers, piece: number, offset: number) => {
      this.places.set(array, { piece, offset, bytes: array.byteLength });
      const node = arrays.get(array);
      if (!node) return;
      node.piece = piece;
      node.offset = offset;
    };
    let pool: StorableNumbers[] = [];
    let poolBytes = 0;
    const closePool = () => {
      if (!pool.length) return;
      const [together, bytes] = [pool, poolBytes];
      const id = put(false, bytes, () => joined(together, bytes));
      let offset = 0;
      for (const array of together) {
        settle(array, id, offset);
        offset += array.byteLength;
      }
      pool = [];
      poolBytes = 0;
    };
    for (const array of loose) {
      if (array.byteLength < LARGE_BYTES) {
        if (poolBytes + array.byteLength > PIECE_BYTES) closePool();
        pool.push(array);
        poolBytes += array.byteLength;
        continue;
      }
      const first = this.nextId;
      for (let from = 0; from < array.byteLength; from += PIECE_BYTES) {
        const bytes = Math.min(PIECE_BYTES, array.byteLength - from);
        put(true, bytes, () => bytesOf(array).slice(from, from + bytes));
      }
      settle(array, first, 0);
    }
    closePool();
    return puts;
  }
}

/** The pieces that a place extends over. */
export function piecesOf({ piece, offset, bytes }: Place): readonly number[] {
  const count = Math.max(1, Math.ceil((offset + bytes) / PIECE_BYTES));
  return Array.from({ length: count }, (_, i) => piece + i);
}

/** Copies the part of an array that is in one of its pieces. */
export function fill(array: StorableNumbers, place: Place, piece: number, bytes: Uint8Array): void {
  const target = bytesOf(array);
  if (piece === place.piece) target.set(bytes.subarray(place.offset, place.offset + place.bytes), 0);
  else target.set(bytes, (piece - place.piece) * PIECE_BYTES - place.offset);
}

function bytesOf(array: StorableNumbers): Uint8Array<ArrayBuffer> {
  return new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
}

function joined(arrays: readonly StorableNumbers[], bytes: number): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(bytes);
  let offset = 0;
  for (const array of arrays) {
    all.set(bytesOf(array), offset);
    offset += array.byteLength;
  }
  return all;
}
