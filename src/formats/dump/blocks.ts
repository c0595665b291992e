/** Collects the rows of a dump into blocks: a heading, a time or a kind of its own starts another one. */
import type { DumpBlock, DumpKind, DumpLabel } from '../../model/dump.ts';

/** What headings have said so far; applies to the rows that follow. */
export interface Heading {
  readonly holds?: DumpKind | undefined;
  readonly time?: number | undefined;
  readonly channel?: number | undefined;
  readonly times?: Float64Array | undefined;
  readonly columns?: readonly string[] | undefined;
  readonly nesting?: 'flat' | 'rows' | undefined;
}

export class Blocks {
  readonly done: DumpBlock[] = [];
  heading: Heading = {};
  private values = new Float64Array(1024);
  private count = 0;
  private starts = new Uint32Array(64);
  private lines = new Uint32Array(64);
  private rows = 0;
  /** Empty up to the first row with one. */
  private labels: (DumpLabel | null)[] = [];
  /** Of all blocks, by what they say: held once, as thousands of rows have the same few. */
  private readonly known = new Map<string, DumpLabel>();

  /** Says something about the rows to come; ends the current block if that is new. */
  say(change: Heading): void {
    const next = { ...this.heading, ...change };
    const keys = Object.keys(change) as (keyof Heading)[];
    if (keys.every((key) => this.heading[key] === next[key])) return;
    this.close();
    this.heading = next;
  }

  row(numbers: ArrayLike<number>, line: number, label: DumpLabel | null = null): void {
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
    this.heading = {};
    this.reset();
  }

  /** Ends the current block, if it has rows. */
  close(): void {
    const { holds, time, channel, times, columns, nesting } = this.heading;
    if (this.count > 0) {
      this.done.push({
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
      });
    }
    this.reset();
  }

  private reset(): void {
    this.count = this.rows = 0;
    if (this.labels.length > 0) this.labels = [];
  }
}

/** Labels that are looked up; those of a table of joints. */
const MAX_KNOWN = 1024;

function twiceAsLong(numbers: Uint32Array<ArrayBuffer>): Uint32Array<ArrayBuffer> {
  const grown = new Uint32Array(2 * numbers.length);
  grown.set(numbers);
  return grown;
}
