/**
 * Which parts of long lists the store holds. A chunk is a run of a list's items, encoded: a record of its own, written
 * once. What is in the document is immutable, so a chunk is right for as long as its items are the same objects,
 * wherever in whichever list they are.
 *
 *     stored     a b c d │ e f g │ h i
 *     now        a b c d │ e x g │ h i      writes one chunk
 *     now        y │ a b c d │ e f g │ h i  writes one, too
 */
import type { ChunkPut } from '../../io/session-store.ts';
import type { Chunk, Encoded, Needs } from './encoded.ts';

/** What a save has to do about chunks. Call `done` or `failed` with its outcome. */
export interface ChunkPlan {
  readonly puts: readonly ChunkPut[];
  readonly gone: readonly number[];
  done(): void;
  failed(): void;
}

export class StoredChunks {
  private readonly all = new Map<number, Chunk>();
  private readonly byFirst = new WeakMap<object, Set<Chunk>>();
  private nextId = 1;

  /** For the next save. Nothing is relied on that isn't stored for certain. */
  draft(): ChunkDraft {
    return new ChunkDraft(
      (first) => this.byFirst.get(first) ?? [],
      () => this.nextId++,
      (needed, puts) => this.plan(needed, puts),
    );
  }

  /** Registers a stored chunk that nothing uses. */
  adoptWaste(id: number): void {
    const needs: Needs = { files: new Set(), arrays: new Map(), chunks: new Set() };
    this.all.set(id, { id, items: [], needs, state: 'doomed' });
    this.nextId = Math.max(this.nextId, id + 1);
  }

  /** The store was cleared. */
  forget(): void {
    for (const chunk of this.all.values()) this.drop(chunk);
  }

  private plan(needed: ReadonlySet<Chunk>, puts: readonly ChunkPut[]): ChunkPlan {
    const written = [...needed].filter(({ state }) => state === 'new');
    for (const chunk of written) {
      chunk.state = 'writing';
      this.add(chunk);
    }
    const gone = [...this.all.values()].filter((chunk) => !needed.has(chunk));
    for (const chunk of gone) chunk.state = 'doomed';
    const ids = new Set(written.map(({ id }) => id));
    return {
      puts: puts.filter(({ id }) => ids.has(id)),
      gone: gone.map(({ id }) => id),
      done: () => {
        for (const chunk of written) if (chunk.state === 'writing') chunk.state = 'stored';
        for (const chunk of gone) this.drop(chunk);
      },
      // Chunks to be deleted may still be there: they stay doomed.
      failed: () => {
        for (const chunk of written) this.drop(chunk);
      },
    };
  }

  private add(chunk: Chunk): void {
    this.all.set(chunk.id, chunk);
    const [first] = chunk.items;
    if (typeof first !== 'object' || first === null) return;
    const known = this.byFirst.get(first);
    if (known) known.add(chunk);
    else this.byFirst.set(first, new Set([chunk]));
  }

  private drop(chunk: Chunk): void {
    chunk.state = 'doomed';
    this.all.delete(chunk.id);
    const [first] = chunk.items;
    if (typeof first === 'object' && first !== null) this.byFirst.get(first)?.delete(chunk);
  }
}

/** The chunks of one save: those that are stored already, and new ones. */
export class ChunkDraft {
  private readonly made = new Map<unknown, Chunk[]>();
  private readonly puts: ChunkPut[] = [];

  constructor(
    private readonly beginningWith: (first: object) => Iterable<Chunk>,
    private readonly newId: () => number,
    private readonly planned: (needed: ReadonlySet<Chunk>, puts: readonly ChunkPut[]) => ChunkPlan,
  ) {}

  /** A chunk with the items of the list from there on. */
  find(list: readonly unknown[], at: number): Chunk | undefined {
    const first = list[at];
    if (typeof first !== 'object' || first === null) return undefined;
    for (const chunk of this.beginningWith(first)) if (chunk.state === 'stored' && isAt(chunk, list, at)) return chunk;
    return this.made.get(first)?.find((chunk) => isAt(chunk, list, at));
  }

  /** Whether a stored chunk begins with this item. */
  begins(item: unknown): boolean {
    return typeof item === 'object' && item !== null && !this.beginningWith(item)[Symbol.iterator]().next().done;
  }

  /** @param of the items, encoded @param size in bytes, roughly */
  add(items: readonly unknown[], of: readonly Encoded[], size: number, needs: Needs): Chunk {
    const chunk: Chunk = { id: this.newId(), items, needs, state: 'new' };
    const [first] = items;
    this.made.set(first, [...(this.made.get(first) ?? []), chunk]);
    this.puts.push({ id: chunk.id, size, of });
    return chunk;
  }

  /** What is to be written and deleted so that the store holds what is needed, and no more. */
  plan(needed: ReadonlySet<Chunk>): ChunkPlan {
    return this.planned(needed, this.puts);
  }
}

function isAt({ items }: Chunk, list: readonly unknown[], at: number): boolean {
  return items.length <= list.length - at && items.every((item, i) => item === list[at + i]);
}

/** With all that its chunks need, and theirs. */
export function allNeeded(needs: Needs): Needs {
  const files = new Set(needs.files);
  const arrays = new Map(needs.arrays);
  const chunks = new Set(needs.chunks);
  // A set yields what is added while it is gone through.
  for (const { needs: its, state } of chunks) {
    for (const file of its.files) files.add(file);
    // The node of this save is the one whose place is not set yet.
    for (const [array, node] of its.arrays) if (state === 'new' || !arrays.has(array)) arrays.set(array, node);
    for (const chunk of its.chunks) chunks.add(chunk);
  }
  return { files, arrays, chunks };
}
