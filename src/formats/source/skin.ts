/** `.skin` and `.morph`: the rows of each vertex and triangle, and the lines of each joint's binding. */
import type { SourceRows } from '../../model/source-map.ts';
import type { Located, Locator } from './locator.ts';
import { RowsBuilder } from './row-lines.ts';

interface Block {
  readonly of: SourceRows['of'];
  /** As for `RowsBuilder`. */
  readonly width: number | undefined;
  /** A row's first number is the index of its part. */
  readonly isIndexed?: true;
}

const SKIN: ReadonlyMap<string, Block> = new Map([
  ['positions', { of: 'vertex', width: 3 }],
  ['normals', { of: 'vertex', width: 3 }],
  ['texcoords', { of: 'vertex', width: 2 }],
  ['skinweights', { of: 'vertex', width: undefined }],
  ['triangles', { of: 'triangle', width: 3 }],
]);
const MORPH: ReadonlyMap<string, Block> = new Map([
  ['positions', { of: 'vertex', width: 4, isIndexed: true }],
  ['normals', { of: 'vertex', width: 4, isIndexed: true }],
]);

/** Blocks without rows of parts. */
const OTHER_BLOCKS: ReadonlySet<string> = new Set(['bindings', 'matrix', 'material']);

/** Marks the rows of vertices and triangles, and the lines of bindings, of a `.skin` in `found`. */
export function skinLocator(found: Located): Locator {
  return new BlockLocator(found, SKIN);
}

/** Marks the rows of positions and normals of a `.morph` in `found`. */
export function morphLocator(found: Located): Locator {
  return new BlockLocator(found, MORPH);
}

class BlockLocator implements Locator {
  inRows = false;
  private depth = 0;
  /** The word that opens a block. */
  private head = '';
  private headLine = 0;
  /** Between the keyword of a block and its brace, where there may be names. */
  private inHead = false;
  private current: { readonly block: Block; readonly rows: RowsBuilder; readonly indices: number[] } | undefined;
  private inBindings = false;
  private bindings = 0;
  /** Triangles of all blocks so far. */
  private triangles = 0;

  constructor(
    private readonly found: Located,
    private readonly blocks: ReadonlyMap<string, Block>,
  ) {}

  word(text: string, line: number): void {
    if (this.inHead && line === this.headLine) return;
    this.head = text;
    this.headLine = line;
    this.inHead = this.blocks.has(text) || OTHER_BLOCKS.has(text);
  }

  value(line: number, read: () => number): void {
    const { current } = this;
    if (current?.rows.token(line, read) && current.block.isIndexed) current.indices.push(read());
  }

  open(): void {
    this.inHead = false;
    const block = this.depth === 0 ? this.blocks.get(this.head) : undefined;
    if (this.depth === 0) this.inBindings = this.head === 'bindings';
    this.depth++;
    if (!block) return;
    this.current = { block, rows: new RowsBuilder(block.width), indices: [] };
    this.inRows = true;
  }

  close(line: number): void {
    this.depth = Math.max(0, this.depth - 1);
    const { current } = this;
    if (current) {
      const { of, isIndexed } = current.block;
      const indices = isIndexed && { indices: Uint32Array.from(current.indices) };
      const lines = current.rows.done();
      this.found.rows.push({ of, lines, ...indices, ...(of === 'triangle' && { first: this.triangles }) });
      if (of === 'triangle') this.triangles += lines.count;
      this.current = undefined;
      this.inRows = false;
    } else if (this.inBindings && this.depth === 1 && this.head === 'matrix') {
      this.found.marks.push({ target: { kind: 'binding', joint: this.bindings++ }, from: this.headLine, to: line });
    }
    if (this.depth === 0) this.head = '';
  }

  end(): void {}
}
