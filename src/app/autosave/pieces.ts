/**
 * Where each typed array lies among the pieces of the store. Arrays never change, so one that has a place is never
 * written again; a save writes those that have none, and deletes the pieces that nobody needs any more.
 *
 *     large array      ▒▒▒▒ ▒▒▒▒ ▒▒     pieces of its own: they go when it goes
 *     small arrays     ▒|▒▒|▒|▒         one piece for all that are new in a save
 *
 * A piece of small arrays is kept as long as one of them is needed. Where less than half of it is, the rest moves into
 * the next save's piece, as a log is compacted: what is stored stays below twice what is needed. (A record an array
 * would be thousands for a clip of a hundred channels, each with its cost.)
 */
import type { PiecePut } from '../../io/session-store.ts';
import type { StorableNumbers, StoredNumbers } from './encode.ts';

/** Copied in about a millisecond. */
export const PIECE_BYTES = 1 << 20;
/** Arrays from here on have pieces of their own. */
export const LARGE_BYTES = 1 << 18;
/** More pieces of small arrays than these, and those that are mostly empty are put together. */
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
  /** `doomed`: to be deleted by every save from now on, until one that does so has succeeded. */
  state: 'writing' | 'stored' | 'doomed';
}

/** What a save has to do about pieces. Call `done` or `failed` when it is known how it went. */
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
   * Gives each array its place, in the node that stands for it.
   *
   * May be called while an earlier save is still under way: nothing is built on what is not stored for certain, and
   * nothing that the earlier one deletes is needed.
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
      // What was to be deleted may still be there: it stays doomed.
      failed: () => {
        for (const { id } of puts) this.pieces.delete(id);
      },
    };
  }

  /** An array that was read back from its place. */
  adopt(array: StorableNumbers, place: Place): void {
    this.places.set(array, place);
    for (const id of piecesOf(place)) {
      const isLarge = place.bytes >= LARGE_BYTES;
      const bytes = isLarge ? PIECE_BYTES : Math.max(this.pieces.get(id)?.bytes ?? 0, place.offset + place.bytes);
      this.add(id, { bytes, isLarge, state: 'stored' });
    }
  }

  /** A piece that is stored, but nobody's. */
  adoptWaste(id: number): void {
    if (!this.pieces.has(id)) this.add(id, { bytes: 0, isLarge: true, state: 'doomed' });
  }

  /** Everything stored is gone. */
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

  /** Pieces of small arrays that are more air than arrays. */
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

/** The pieces that a place reaches over. */
export function piecesOf({ piece, offset, bytes }: Place): readonly number[] {
  const count = Math.max(1, Math.ceil((offset + bytes) / PIECE_BYTES));
  return Array.from({ length: count }, (_, i) => piece + i);
}

/** Copies what one of its pieces holds into an array that lies at this place. */
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
