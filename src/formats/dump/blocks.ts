/** Collects the rows of a dump into blocks: a heading, a time or a kind of its own starts another one. */
import type { DumpBlock, DumpHeading, DumpKind, DumpLabel, DumpTarget } from '../../model/dump.ts';

/** Facts that headings have stated so far; applies to the rows that follow. */
export interface Heading {
  readonly holds?: DumpKind;
  readonly time?: number;
  readonly channel?: number;
  readonly times?: Float64Array;
  readonly columns?: readonly string[];
  readonly nesting?: 'flat' | 'rows';
}

/** Collects rows into blocks of equal heading, in the order of the file, with headings and IK targets beside them. */
export class Blocks {
  readonly done: DumpBlock[] = [];
  /** Lines whose numbers are of a heading; after `settle`. */
  readonly headings: DumpHeading[] = [];
  /** Targets of inverse kinematics. */
  readonly targets: DumpTarget[] = [];
  isOneStep = false;
  heading: Heading = {};
  private values = new Float64Array(1024);
  private count = 0;
  private starts = new Uint32Array(64);
  private lines = new Uint32Array(64);
  private rows = 0;
  /** Rows of the current block that may be headings; then those of each. */
  private doubtful: number[] = [];
  private readonly doubts = new Map<DumpBlock, readonly number[]>();
  /** Empty up to the first row with one. */
  private labels: (DumpLabel | null)[] = [];
  /** Labels of all blocks, by their content: held once, as thousands of rows have the same few. */
  private readonly known = new Map<string, DumpLabel>();

  /** Says something about the rows to come; ends the current block if that is new. */
  say(change: Heading): void {
    const next = { ...this.heading, ...change };
    const keys = Object.keys(change) as (keyof Heading)[];
    if (keys.every((key) => this.heading[key] === next[key])) return;
    this.close();
    this.heading = next;
  }

  /** A target of the rows to come, or, before any time, of all. */
  target(target: Omit<DumpTarget, 'line'>, line: number): void {
    const { time } = this.heading;
    this.targets.push({ ...target, ...(time !== undefined && { time }), line });
  }

  /**
   * Adds a row of numbers to the current block.
   * @param mayBeHeading whether its numbers may be those of a heading, which `settle` decides
   */
  row(numbers: ArrayLike<number>, line: number, label: DumpLabel | null = null, mayBeHeading = false): void {
    if (mayBeHeading) this.doubtful.push(this.rows);
    const needed = this.count + numbers.length;
    if (needed > this.values.length) {
      const grown = new Float64Array(Math.max(needed, 2 * this.values.length));
      grown.set(this.values);
      this.values = grown;
    }
    // One more than rows.
    if (this.rows + 2 > this.starts.length) {
      this.starts = twiceAsLong(this.starts);
      this.lines = twiceAsLong(this.lines);
    }
    // Rows are short: `set` takes longer.
    const { values, count } = this;
    for (let i = 0; i < numbers.length; i++) values[count + i] = numbers[i];
    this.lines[this.rows] = line;
    if (label || this.labels.length > 0) {
      while (this.labels.length < this.rows) this.labels.push(null);
      this.labels.push(label && this.shared(label));
    }
    this.count = needed;
    this.starts[++this.rows] = needed;
  }

  /** Appends to the last row of the current block; a row of its own if there is none. */
  extend(numbers: ArrayLike<number>, line: number): void {
    this.row(numbers, line);
    if (this.rows < 2) return;
    this.rows--;
    this.starts[this.rows] = this.count;
    if (this.labels.length > this.rows) this.labels.length = this.rows;
  }

  /**
   * Ends the current block, and takes out what may be headings and has another number of numbers than most: few of
   * them, or whole ones, beside words.
   *
   * @returns how many rows are left
   */
  settle(): number {
    this.close();
    const most = widthOfMost(this.done);
    let rows = 0;
    const blocks = this.done.flatMap((block) => {
      const kept = this.withoutHeadings(block, most);
      rows += kept?.lines.length ?? 0;
      return kept ? [kept] : [];
    });
    this.done.splice(0, this.done.length, ...blocks);
    return rows;
  }

  private withoutHeadings(block: DumpBlock, most: number): DumpBlock | undefined {
    const { starts, lines, values, labels } = block;
    const doubtful = [...(isCountOfRows(block) ? [0] : []), ...(this.doubts.get(block) ?? [])];
    if (doubtful.length === 0) return block;
    const own = widthOfMost([block]);
    const isHeading = new Set(
      doubtful.filter((row) => {
        const width = starts[row + 1] - starts[row];
        return width !== own || ((width < MIN_WIDTH || lines.length === 1) && width !== most);
      }),
    );
    if (isHeading.size === 0) return block;
    const kept = Array.from(lines.keys()).filter((row) => !isHeading.has(row));
    for (const row of isHeading) this.headings.push({ line: lines[row], numbers: starts[row + 1] - starts[row] });
    if (kept.length === 0) return undefined;
    const rest = new Blocks();
    for (const row of kept) rest.row(values.subarray(starts[row], starts[row + 1]), lines[row], labels?.[row]);
    rest.heading = block;
    rest.close();
    return rest.done[0];
  }

  private shared(label: DumpLabel): DumpLabel {
    const key = `${label.index ?? ''} ${label.name ?? ''}`;
    const known = this.known.get(key);
    if (known) return known;
    if (this.known.size < MAX_KNOWN) this.known.set(key, label);
    return label;
  }

  /** Drops all rows so far, and what headings said. */
  forget(): void {
    this.done.length = 0;
    this.targets.length = 0;
    this.isOneStep = false;
    this.heading = {};
    this.reset();
  }

  /** Ends the current block, if it has rows. */
  close(): void {
    const { holds, time, channel, times, columns, nesting } = this.heading;
    if (this.count > 0) {
      const block: DumpBlock = {
        ...(holds !== undefined && { holds }),
        ...(time !== undefined && { time }),
        ...(channel !== undefined && { channel }),
        ...(times !== undefined && { times }),
        ...(columns !== undefined && { columns }),
        ...(nesting !== undefined && { nesting }),
        values: this.values.slice(0, this.count),
        starts: this.starts.slice(0, this.rows + 1),
        lines: this.lines.slice(0, this.rows),
        ...(this.labels.length > 0 && { labels: this.labels }),
      };
      this.done.push(block);
      if (this.doubtful.length > 0) this.doubts.set(block, this.doubtful);
    }
    this.reset();
  }

  private reset(): void {
    this.count = this.rows = 0;
    if (this.doubtful.length > 0) this.doubtful = [];
    if (this.labels.length > 0) this.labels = [];
  }
}

/** Numbers of a point: a row of fewer is one only if most are. */
const MIN_WIDTH = 3;

/** Whether a row of one number says how many follow. */
function isCountOfRows({ starts, lines, values, labels }: DumpBlock): boolean {
  return lines.length > 2 && starts[1] === 1 && values[0] === lines.length - 1 && !labels?.[0];
}

/** The number of values of the rows that have most of all; the larger one of two. */
function widthOfMost(blocks: readonly DumpBlock[]): number {
  const counts = new Map<number, number>();
  for (const { starts, lines } of blocks) {
    for (let r = 0; r < lines.length; r++) {
      const width = starts[r + 1] - starts[r];
      counts.set(width, (counts.get(width) ?? 0) + width);
    }
  }
  let most = 0;
  for (const [width, count] of counts) {
    const other = counts.get(most) ?? 0;
    if (count > other || (count === other && width > most)) most = width;
  }
  return most;
}

/** Labels that are looked up; those of a table of joints. */
const MAX_KNOWN = 1024;

function twiceAsLong(numbers: Uint32Array<ArrayBuffer>): Uint32Array<ArrayBuffer> {
  const grown = new Uint32Array(2 * numbers.length);
  grown.set(numbers);
  return grown;
}
