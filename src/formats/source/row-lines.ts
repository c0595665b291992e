/** Collects the lines of a block's rows, as runs: a block with a row on each line is one run, whatever its size. */
import type { RowLines } from '../../model/source-map.ts';

/** Collects on which line each row of a block begins. */
export class RowsBuilder {
  private readonly rows: number[] = [];
  private readonly lines: number[] = [];
  private readonly steps: number[] = [];
  private count = 0;
  private last = 0;
  private end = 0;
  /** Tokens left of the current row. */
  private left = 0;

  /** @param width tokens in a row; undefined: a count, then two tokens for each */
  constructor(private readonly width: number | undefined) {}

  /**
   * Takes the next token of the block.
   *
   * @param value of the token, asked only for a count
   * @returns whether it begins a row
   */
  token(line: number, value: () => number): boolean {
    this.end = line;
    if (this.left > 0) {
      this.left--;
      return false;
    }
    const more = this.width === undefined ? 2 * value() : this.width - 1;
    // What is no count is an error, and the file is not opened.
    this.left = more > 0 && Number.isFinite(more) ? more : 0;
    this.begin(line);
    return true;
  }

  private begin(line: number): void {
    const { rows, lines, steps } = this;
    const run = rows.length - 1;
    const step = line - this.last;
    if (run >= 0 && this.count === rows[run] + 1) steps[run] = step;
    else if (run < 0 || steps[run] !== step) {
      rows.push(this.count);
      lines.push(line);
      steps.push(0);
    }
    this.last = line;
    this.count++;
  }

  /** The lines of all rows so far, as runs. */
  done(): RowLines {
    return {
      rows: Uint32Array.from(this.rows),
      lines: Uint32Array.from(this.lines),
      steps: Uint32Array.from(this.steps),
      count: this.count,
      end: this.end,
    };
  }
}
