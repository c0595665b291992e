/**
 * A session as data to be stored: a tree of plain values in which
 *
 *     what came from a file      is the file and a path in it
 *     a large typed array        is a place in the store's pieces
 *     a large list               is chunks, each a record of its own (`chunks.ts`)
 *     everything else            is itself
 *
 * so that a skin of 100 MB read from a file takes a few bytes, and an edit of one of 60,000 channels writes a chunk.
 * A value shared in a record is one node, and structured cloning preserves that: decoded, it is shared again. So are
 * large arrays and chunks anywhere in the session.
 */
import type { OriginFile, PathKey } from './origins.ts';

export type Encoded =
  | undefined
  | null
  | boolean
  | number
  | string
  | StorableNumbers
  | { readonly is: 'object'; readonly of: Readonly<Record<string, Encoded>> }
  | { readonly is: 'list'; readonly of: readonly Encoded[] }
  /** A list of primitives only, stored as it is. */
  | { readonly is: 'plain'; readonly of: readonly unknown[] }
  /** The items of these chunks, one after the other. */
  | { readonly is: 'chunks'; readonly of: readonly number[] }
  /** Index into the head's files, and the path in that file. */
  | { readonly is: 'part'; readonly file: number; readonly path: readonly PathKey[] }
  | StoredNumbers
  /** Anything else that can be cloned: a file handle, for example. */
  | { readonly is: 'other'; readonly of: unknown };

/** A typed array in the store's pieces: starts in one and continues in those numbered after it. */
export interface StoredNumbers {
  readonly is: 'numbers';
  readonly type: NumbersType;
  piece: number;
  readonly bytes: number;
}

export type StorableNumbers =
  | Float64Array<ArrayBuffer>
  | Float32Array<ArrayBuffer>
  | Uint32Array<ArrayBuffer>
  | Int32Array<ArrayBuffer>
  | Uint8Array<ArrayBuffer>;

export const NUMBERS_TYPES = { Float64Array, Float32Array, Uint32Array, Int32Array, Uint8Array } as const;
export type NumbersType = keyof typeof NUMBERS_TYPES;

/** A run of the items of a list, a record of its own. */
export interface Chunk {
  readonly id: number;
  readonly items: readonly unknown[];
  readonly needs: Needs;
  /** `doomed`: every save tries to delete it, until one has succeeded. */
  state: 'new' | 'writing' | 'stored' | 'doomed';
}

/** What a tree refers to outside itself. */
export interface Needs {
  readonly files: ReadonlySet<OriginFile>;
  /** Large arrays, each with its node, whose place is not set before the first save. */
  readonly arrays: ReadonlyMap<StorableNumbers, StoredNumbers>;
  readonly chunks: ReadonlySet<Chunk>;
}

export function isNumbers(value: unknown): value is StorableNumbers {
  return Object.values(NUMBERS_TYPES).some((Type) => value instanceof Type);
}
