/**
 * The rows of a text with changes: its lines, and above a changed one, when it is open, the lines that it was. Where
 * lines were removed, a row says so, or shows them.
 *
 *     12   offset 0 1 0
 *      −   pose 0 0 0        of an open hunk
 *     13 ~ pose 0.5 0 0
 */
import { lastUpTo } from '../../../model/source-map.ts';
import { type HunkKind, kindOf, type LineHunk } from '../../../model/text-changes.ts';

/** A row: a line of the text, a line that it had before, or a row that counts those that were removed. */
export type ChangedRow =
  | { readonly kind: 'line'; readonly line: number; readonly hunk?: number; readonly change?: HunkKind }
  | { readonly kind: 'old'; readonly line: number; readonly hunk: number }
  | { readonly kind: 'removed'; readonly count: number; readonly hunk: number };

export class ChangedRows {
  /** Of each hunk, its first row above the lines, and behind that, the rows added up to and with this hunk. */
  private readonly starts: number[] = [];
  private readonly added: number[] = [];
  private readonly lineStarts: readonly number[];
  readonly count: number;

  /**
   * @param lines of the text
   * @param open hunks whose old lines are shown
   */
  constructor(
    lines: number,
    readonly hunks: readonly LineHunk[],
    private readonly open: ReadonlySet<number>,
  ) {
    let added = 0;
    hunks.forEach((hunk, h) => {
      this.starts.push(hunk.newFrom + added);
      const old = hunk.oldTo - hunk.oldFrom;
      added += open.has(h) ? old : kindOf(hunk) === 'removed' ? 1 : 0;
      this.added.push(added);
    });
    this.lineStarts = hunks.map(({ newFrom }) => newFrom);
    this.count = lines + added;
  }

  /** @param row from 1 */
  at(row: number): ChangedRow {
    const { hunks, starts, added, open } = this;
    if (hunks.length === 0 || row < starts[0]) return { kind: 'line', line: row };
    const hunk = lastUpTo(starts, row);
    const { oldFrom, oldTo, newTo } = hunks[hunk];
    const own = added[hunk] - (added[hunk - 1] ?? 0);
    if (row - starts[hunk] < own) {
      if (!open.has(hunk)) return { kind: 'removed', count: oldTo - oldFrom, hunk };
      return { kind: 'old', line: oldFrom + row - starts[hunk], hunk };
    }
    const line = row - added[hunk];
    return line < newTo ? { kind: 'line', line, hunk, change: kindOf(hunks[hunk]) } : { kind: 'line', line };
  }

  rowOf(line: number): number {
    if (this.hunks.length === 0 || line < this.lineStarts[0]) return line;
    return line + this.added[lastUpTo(this.lineStarts, line)];
  }

  /** The first row of a hunk. */
  rowOfHunk(hunk: number): number {
    return this.starts[hunk];
  }

  /** The next hunk below a row, or above it with -1; the first or last one if there is none. Undefined without any. */
  hunkFrom(row: number, step: 1 | -1): number | undefined {
    const { hunks, starts } = this;
    if (hunks.length === 0) return undefined;
    if (step > 0)
      return Math.max(
        0,
        starts.findIndex((start) => start > row),
      );
    const own = this.at(row).hunk;
    const before = starts.findLastIndex((start, h) => start < row && h !== own);
    return before < 0 ? hunks.length - 1 : before;
  }
}
