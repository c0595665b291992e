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
  private starts: number[] = [];
  private lines: number[] = [];
  private labels: (DumpLabel | null)[] = [];
  private isLabelled = false;

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
    this.starts.push(this.count);
    this.values.set(numbers, this.count);
    this.count = needed;
    this.lines.push(line);
    this.labels.push(label);
    this.isLabelled ||= label !== null;
  }

  /** Drops all rows so far. */
  forget(): void {
    this.done.length = 0;
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
        starts: Uint32Array.from([...this.starts, this.count]),
        lines: Uint32Array.from(this.lines),
        ...(this.isLabelled && { labels: this.labels }),
      });
    }
    this.reset();
  }

  private reset(): void {
    this.count = 0;
    this.starts = [];
    this.lines = [];
    this.labels = [];
    this.isLabelled = false;
  }
}
