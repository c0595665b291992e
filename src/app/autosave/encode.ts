/** Encodes a session into the form of `encoded.ts`: what is in the store already is only referred to. */
import type { Steps } from '../../evaluate/steps.ts';
import type { ChunkDraft } from './chunks.ts';
import {
  type Chunk,
  type Encoded,
  isNumbers,
  type Needs,
  type NumbersType,
  type StorableNumbers,
  type StoredNumbers,
} from './encoded.ts';
import type { OriginFile, Origins, PathKey } from './origins.ts';

/** Arrays of at least this size have pieces of their own; smaller ones are in the tree. */
export const LARGE_BYTES = 1 << 15;
/** Of a chunk, in bytes, roughly: encoded and cloned in a millisecond or two. */
const CHUNK_BYTES = 1 << 16;
const NODE_BYTES = 32;

export interface EncodedSession {
  readonly tree: Encoded;
  /** What the tree needs directly, or by its chunks. */
  readonly needs: Needs;
}

/** Index of each file that nodes refer to; a file keeps its index, so that stored chunks stay right. */
export type FileIndices = Map<OriginFile, number>;

/** One for each save. */
export class Encoder {
  private readonly nodes = new Map<object, Known>();
  private readonly arrays = new Map<StorableNumbers, StoredNumbers>();
  /** What nodes referred to, in the order in which they were encoded. */
  private readonly journal: Reference[] = [];
  /** The values with a node, in that order too. */
  private readonly made: object[] = [];
  private bytes = 0;

  constructor(
    private readonly origins: Origins,
    private readonly indices: FileIndices,
    private readonly chunks: ChunkDraft,
  ) {}

  /** Yields after each new chunk; how much is left is not known. */
  *encode(session: object): Steps<EncodedSession> {
    const tree = yield* this.once(session);
    return { tree, needs: this.needsSince(0) };
  }

  private *once(value: object): Steps<Encoded> {
    const known = this.nodes.get(value);
    if (known) {
      for (let i = known.from; i < known.to; i++) this.journal.push(this.journal[i]);
      return known.node;
    }
    const from = this.journal.length;
    const node = yield* this.node(value);
    this.nodes.set(value, { node, from, to: this.journal.length });
    this.made.push(value);
    return node;
  }

  private *node(value: object): Steps<Encoded> {
    this.bytes += NODE_BYTES;
    const origin = this.origins.find(value);
    if (origin) return this.part(origin);
    if (isNumbers(value)) return this.numbers(value);
    if (Array.isArray(value)) return yield* this.list(value);
    if (Object.getPrototypeOf(value) !== Object.prototype) return { is: 'other', of: value };
    const of: Record<string, Encoded> = {};
    for (const [key, inner] of Object.entries(value)) {
      of[key] = isObject(inner) ? yield* this.once(inner) : this.primitive(inner);
    }
    return { is: 'object', of };
  }

  private *list(list: readonly unknown[]): Steps<Encoded> {
    if (!list.some(isObject)) {
      this.bytes += 8 * list.length;
      return { is: 'plain', of: list };
    }
    const chunks: Chunk[] = [];
    let begin = this.mark(0);
    let of: Encoded[] = [];
    // What replaces a chunk may be larger: split, it would leave a small one behind with each edit.
    let replaces = false;
    for (let at = 0; at < list.length; ) {
      const stored = this.chunks.find(list, at);
      if (stored) {
        if (of.length > 0) chunks.push(this.close(begin, list, of));
        chunks.push(stored);
        at += stored.items.length;
        replaces = true;
      } else {
        if (of.length === 0) replaces ||= this.chunks.begins(list[at]);
        const item = list[at++];
        of.push(isObject(item) ? yield* this.once(item) : this.primitive(item));
        if (this.bytes - begin.bytes < (replaces ? 2 : 1) * CHUNK_BYTES) continue;
        chunks.push(this.close(begin, list, of));
        yield 0;
      }
      of = [];
      begin = this.mark(at);
    }
    if (chunks.length === 0) return { is: 'list', of };
    if (of.length > 0) chunks.push(this.close(begin, list, of));
    for (const chunk of chunks) this.journal.push(chunk);
    this.bytes += 8 * chunks.length;
    return { is: 'chunks', of: chunks.map(({ id }) => id) };
  }

  private mark(at: number): Mark {
    return { at, references: this.journal.length, made: this.made.length, bytes: this.bytes };
  }

  /** Makes a chunk of what was encoded since then: nodes in it are not shared with what comes after it. */
  private close(since: Mark, list: readonly unknown[], of: readonly Encoded[]): Chunk {
    const items = list.slice(since.at, since.at + of.length);
    const chunk = this.chunks.add(items, of, this.bytes - since.bytes, this.needsSince(since.references));
    for (let i = since.made; i < this.made.length; i++) this.nodes.delete(this.made[i]);
    this.made.length = since.made;
    this.journal.length = since.references;
    this.bytes = since.bytes;
    return chunk;
  }

  private needsSince(reference: number): Needs {
    const files = new Set<OriginFile>();
    const arrays = new Map<StorableNumbers, StoredNumbers>();
    const chunks = new Set<Chunk>();
    for (let i = reference; i < this.journal.length; i++) {
      const one = this.journal[i];
      if ('items' in one) chunks.add(one);
      else if ('array' in one) arrays.set(one.array, one.node);
      else files.add(one);
    }
    return { files, arrays, chunks };
  }

  private primitive(value: unknown): Encoded {
    this.bytes += typeof value === 'string' ? 8 + 2 * value.length : 8;
    return isPrimitive(value) ? value : { is: 'other', of: value };
  }

  private numbers(array: StorableNumbers): Encoded {
    if (array.byteLength < LARGE_BYTES) {
      this.bytes += array.byteLength;
      // Cloning a view would clone its whole buffer.
      return array.byteLength === array.buffer.byteLength ? array : array.slice();
    }
    let node = this.arrays.get(array);
    if (!node) {
      // Constructor names are the keys of the table.
      const type = array.constructor.name as NumbersType;
      node = { is: 'numbers', type, piece: 0, bytes: array.byteLength };
      this.arrays.set(array, node);
    }
    this.journal.push({ array, node });
    return node;
  }

  private part({ file, path }: { readonly file: OriginFile; readonly path: readonly PathKey[] }): Encoded {
    this.bytes += 16 * path.length;
    this.journal.push(file);
    let index = this.indices.get(file);
    if (index === undefined) {
      index = this.indices.size;
      this.indices.set(file, index);
    }
    return { is: 'part', file: index, path };
  }
}

type Reference = OriginFile | Chunk | { readonly array: StorableNumbers; readonly node: StoredNumbers };

interface Known {
  readonly node: Encoded;
  /** Of its references in the journal, up to `to` (excluding). */
  readonly from: number;
  readonly to: number;
}

/** How far encoding has come. */
interface Mark {
  /** Index into the list. */
  readonly at: number;
  readonly references: number;
  readonly made: number;
  readonly bytes: number;
}

function isObject(value: unknown): value is object {
  return typeof value === 'object' && value !== null;
}

function isPrimitive(value: unknown): value is undefined | null | boolean | number | string {
  return value === null || ['undefined', 'boolean', 'number', 'string'].includes(typeof value);
}
