/**
 * A session as data to be stored: a tree of plain values in which
 *
 *     what came from a file      is the file and a path in it
 *     a typed array              is a place in the store's pieces
 *     everything else            is itself
 *
 * so that a skin of 100 MB read from a file takes a few bytes. A value shared in the session is one node, and structured
 * cloning preserves that: decoded, it is shared again.
 */
import type { OriginFile, Origins, PathKey } from './origins.ts';

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
  /** Bytes into the first piece. */
  offset: number;
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

/** Smaller arrays stay in the tree: placing them would cost more. */
export const SMALL_BYTES = 256;

export interface EncodedSession {
  readonly tree: Encoded;
  /** Indexed by `part`s. */
  readonly files: readonly OriginFile[];
  /** Arrays to be stored in pieces, each once, with its node, whose place is not set yet. */
  readonly arrays: ReadonlyMap<StorableNumbers, StoredNumbers>;
}

/** Arrays aren't placed yet: the store's pieces are planned from `arrays` (`pieces.ts`). */
export function encode(session: unknown, origins: Origins): EncodedSession {
  const encoder = new Encoder(origins);
  return { tree: encoder.encode(session), files: encoder.files, arrays: encoder.arrays };
}

class Encoder {
  readonly files: OriginFile[] = [];
  readonly arrays = new Map<StorableNumbers, StoredNumbers>();
  private readonly nodes = new Map<object, Encoded>();
  private readonly indices = new Map<OriginFile, number>();

  constructor(private readonly origins: Origins) {}

  encode(value: unknown): Encoded {
    switch (typeof value) {
      case 'undefined':
      case 'boolean':
      case 'number':
      case 'string':
        return value;
      case 'object':
        return value === null ? null : this.once(value);
      default:
        return { is: 'other', of: value };
    }
  }

  private once(value: object): Encoded {
    const known = this.nodes.get(value);
    if (known !== undefined) return known;
    const node = this.node(value);
    this.nodes.set(value, node);
    return node;
  }

  private node(value: object): Encoded {
    const origin = this.origins.find(value);
    if (origin) return { is: 'part', file: this.indexOf(origin.file), path: origin.path };
    if (isNumbers(value)) return this.numbers(value);
    if (Array.isArray(value)) {
      if (!value.some((item) => typeof item === 'object' && item !== null)) return { is: 'plain', of: value };
      return { is: 'list', of: value.map((item) => this.encode(item)) };
    }
    if (Object.getPrototypeOf(value) !== Object.prototype) return { is: 'other', of: value };
    const of: Record<string, Encoded> = {};
    for (const [key, inner] of Object.entries(value)) of[key] = this.encode(inner);
    return { is: 'object', of };
  }

  private numbers(array: StorableNumbers): Encoded {
    if (array.byteLength < SMALL_BYTES) {
      // Cloning a view would clone its whole buffer.
      return array.byteLength === array.buffer.byteLength ? array : array.slice();
    }
    // Constructor names are the keys of the table.
    const type = array.constructor.name as NumbersType;
    const node: StoredNumbers = { is: 'numbers', type, piece: 0, offset: 0, bytes: array.byteLength };
    this.arrays.set(array, node);
    return node;
  }

  private indexOf(file: OriginFile): number {
    const known = this.indices.get(file);
    if (known !== undefined) return known;
    const index = this.files.length;
    this.files.push(file);
    this.indices.set(file, index);
    return index;
  }
}

export function isNumbers(value: unknown): value is StorableNumbers {
  return Object.values(NUMBERS_TYPES).some((Type) => value instanceof Type);
}
