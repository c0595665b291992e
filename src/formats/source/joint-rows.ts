/**
 * The rows of a `.skel` without braces: six numbers a joint, wherever lines end, or the numbers of the first line, if
 * the last of these is -1, the index of no parent.
 */
import type { Located } from './locator.ts';
import { RowsBuilder } from './row-lines.ts';

const AXIS_ANGLE_WIDTH = 6;

/** Marks the rows of joints in an axis-angle `.skel`, in the depth-first order of the model. */
export class JointRows {
  /** Numbers of the first line, until it ends. */
  private start: { readonly line: number; readonly values: number[] } | undefined;
  private rows: RowsBuilder | undefined;
  private width = 0;
  /** Tokens of the current row. */
  private tokens = 0;
  /** As written; undefined in the axis-angle form. */
  private parents: number[] | undefined;
  /** Joints of the axis-angle form that are announced and haven't come. */
  private missing = 1;

  constructor(private readonly found: Located) {}

  /**
   * Takes the next token of the file.
   * @param read the token's value, NaN for a word
   */
  token(line: number, read: () => number): void {
    if (this.rows) this.take(this.rows, line, read);
    else if (!this.start) this.start = { line, values: [read()] };
    else if (this.start.line === line && this.start.values.length < AXIS_ANGLE_WIDTH) this.start.values.push(read());
    else this.take(this.begin(), line, read);
  }

  /** Marks the rows read; rows that make no single tree are not marked. */
  end(): void {
    const { parents, found } = this;
    const rows = this.rows ?? this.begin();
    const indices = parents && depthFirst(parents);
    const isWhole = this.missing === 0 && this.tokens === this.width;
    // Rows of several roots, or that make no tree, are left out, as are those of forms that only look alike.
    if (!parents && isWhole) found.rows.push({ of: 'joint', lines: rows.done() });
    else if (indices) found.rows.push({ of: 'joint', lines: rows.done(), indices });
  }

  private begin(): RowsBuilder {
    const { line = 1, values = [] } = this.start ?? {};
    const hasParent = (values.length === 4 || values.length === 5) && values.at(-1) === -1;
    this.width = hasParent ? values.length : AXIS_ANGLE_WIDTH;
    if (hasParent) this.parents = [];
    const rows = new RowsBuilder(this.width);
    this.rows = rows;
    for (const value of values) this.take(rows, line, () => value);
    return rows;
  }

  private take(rows: RowsBuilder, line: number, read: () => number): void {
    rows.token(line, read);
    this.tokens = (this.tokens % this.width) + 1;
    if (this.tokens !== this.width) return;
    if (this.parents) this.parents.push(read());
    else this.missing += read() - 1;
  }
}

/** Index of each row's joint in the order of the tree; undefined if there is not one tree. */
function depthFirst(parents: readonly number[]): Uint32Array | undefined {
  const children = new Map<number, number[]>();
  parents.forEach((parent, row) => {
    const own = children.get(parent);
    if (own) own.push(row);
    else children.set(parent, [row]);
  });
  const open = children.get(-1) ?? [];
  if (open.length !== 1) return undefined;
  const indices = new Uint32Array(parents.length);
  let count = 0;
  for (let row = open.pop(); row !== undefined; row = open.pop()) {
    indices[row] = count++;
    open.push(...(children.get(row) ?? []).reverse());
  }
  return count === parents.length ? indices : undefined;
}
