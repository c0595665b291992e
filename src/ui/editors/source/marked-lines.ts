/**
 * The lines of the text in view with their marks: those of what is selected, that of the current time, problems, and
 * changes, each of which can be opened to show what it was.
 */
import type { Diagnostic } from '../../../model/diagnostic.ts';
import { type LineRange, lastUpTo, linesOf, type SourceTarget } from '../../../model/source-map.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { ChangedRows } from './changed-rows.ts';
import { LineView, type ShownRow } from './line-view.ts';
import type { TextInView } from './text-in-view.ts';

const NO_LINES: readonly LineRange[] = [];
const NO_ROWS = new ChangedRows(0, [], new Set());

export class MarkedLines {
  private readonly view = new LineView({ row: (row) => this.row(row), pick: (row) => this.pickRow(row) });
  private rows = NO_ROWS;
  /** Changes whose old lines are shown. */
  private readonly open: Set<number> = new Set();
  private lit: readonly LineRange[] = NO_LINES;
  private litStarts: readonly number[] = [];
  private now: number | undefined;
  private problems: ReadonlyMap<number, Diagnostic> = new Map();

  /** @param pick called with a line that was clicked */
  constructor(
    private readonly text: TextInView,
    private readonly pick: (line: number) => void,
  ) {}

  get element(): HTMLElement {
    return this.view.element;
  }

  /** The line of the row with the keyboard's mark, or the one above it; from 1. */
  get currentLine(): number {
    for (let row = this.view.current; row > 0; row--) {
      const found = this.rows.at(row);
      if (found.kind === 'line') return found.line;
    }
    return 1;
  }

  /** The first and the last row in view. */
  get inView(): readonly [number, number] {
    return this.view.inView;
  }

  get hasErrors(): boolean {
    return [...this.problems.values()].some(({ severity }) => severity === 'error');
  }

  drawSoon(): void {
    this.view.drawSoon();
  }

  /** There is another text, or more or other rows of it. */
  show(isNewFile = false): void {
    const { shown, hunks } = this.text;
    this.rows = new ChangedRows(shown?.count ?? 0, hunks, this.open);
    this.view.setLines(this.rows.count, isNewFile);
  }

  /** The changes are others: none is open. */
  closeChanges(): void {
    this.open.clear();
  }

  /** Moves the keyboard's mark to a line and shows it. */
  goTo(line: number): void {
    this.view.goTo(this.rows.rowOf(line));
  }

  /** Goes to the next change, or back with -1; returns its index, undefined without any. */
  goToChange(step: 1 | -1): number | undefined {
    const hunk = this.rows.hunkFrom(this.view.current, step);
    if (hunk !== undefined) this.view.goTo(this.rows.rowOfHunk(hunk));
    return hunk;
  }

  /** The line of the current time; undefined: none. */
  markNow(line: number | undefined): void {
    if (line === this.now) return;
    this.now = line;
    this.view.drawSoon();
  }

  /** @param problems by line */
  markProblems(problems: ReadonlyMap<number, Diagnostic>): void {
    this.problems = problems;
    this.view.drawSoon();
  }

  /**
   * Lights up the lines of parts.
   *
   * @param targets the one to be shown first
   * @param reveals whether they are scrolled into view, unless they were lit already
   */
  light(targets: readonly SourceTarget[], reveals: boolean): void {
    const map = this.text.shown?.map;
    if (!map) return;
    const before = this.lit;
    const all = targets.flatMap((target) => linesOf(map, target));
    const ascending = [...all].sort((a, b) => a.from - b.from);
    this.lightLines(ascending);
    const isSame = before.length === ascending.length && before.every((l, i) => l.from === ascending[i].from);
    if (!reveals || isSame || all.length === 0) return;
    const [{ from, to }] = all;
    this.view.reveal({ from: this.rows.rowOf(from), to: this.rows.rowOf(to) });
  }

  /** Nothing is selected in the text, and no time is in it. */
  unmark(): void {
    this.lightLines(NO_LINES);
    this.markNow(undefined);
  }

  private lightLines(lines: readonly LineRange[]): void {
    this.lit = lines;
    this.litStarts = lines.map(({ from }) => from);
    this.view.drawSoon();
  }

  private row(row: number): ShownRow {
    const found = this.rows.at(row);
    if (found.kind === 'line') {
      const { line, change } = found;
      const problem = this.problems.get(line);
      return {
        line,
        change,
        text: this.text.shown?.line(line),
        isLit: isIn(this.lit, this.litStarts, line),
        isNow: line === this.now,
        problem: problem && { severity: problem.severity, text: problem.message },
      };
    }
    const plain = { isLit: false, isNow: false };
    if (found.kind === 'old') return { ...plain, text: this.text.opened?.line(found.line), change: 'old' };
    const text = `${plural(found.count, 'line')} removed`;
    return { ...plain, text: { text, more: 0, isAbout: false }, change: 'removed' };
  }

  /** Opens or closes the row's change, and picks its line. */
  private pickRow(row: number): void {
    const { hunks } = this.text;
    const found = this.rows.at(row);
    if (found.hunk !== undefined && hunks[found.hunk].oldFrom < hunks[found.hunk].oldTo) {
      if (!this.open.delete(found.hunk)) this.open.add(found.hunk);
      this.show();
      this.view.goTo(found.kind === 'line' ? this.rows.rowOf(found.line) : this.rows.rowOfHunk(found.hunk));
    }
    if (found.kind === 'line') this.pick(found.line);
  }
}

/** @param starts of the ranges, which ascend */
function isIn(ranges: readonly LineRange[], starts: readonly number[], line: number): boolean {
  if (ranges.length === 0 || line < starts[0]) return false;
  return line <= ranges[lastUpTo(starts, line)].to;
}
