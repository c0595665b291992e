/**
 * A table of aligned numbers that can each be copied exactly: click or Enter copies the number in full precision, arrow
 * keys move between numbers, and the whole table is one tab stop.
 */
import { copyText } from './clipboard.ts';
import { element, setText } from './dom.ts';
import { aligned, decimalsWithin, exact } from './number-text.ts';
import { setTooltip } from './tooltip.ts';

export interface GridOptions {
  readonly label: string;
  readonly rows: number;
  readonly columns: number;
  /** Before each row. */
  readonly rowLabels?: readonly string[];
  /** Above each column; `x y z` are coloured. */
  readonly columnLabels?: readonly string[];
}

const COPIED_MS = 700;
/** Characters that fit into a quarter of the narrowest inspector. */
const CHARACTERS = 8;

export class NumberGrid {
  readonly element: HTMLTableElement;
  private readonly cells: HTMLElement[] = [];
  private readonly values: Float64Array;

  constructor(private readonly options: GridOptions) {
    const { label, rows, columns, rowLabels, columnLabels } = options;
    this.values = new Float64Array(rows * columns).fill(Number.NaN);
    this.element = element('table', { class: 'grid', role: 'grid', 'aria-label': label });
    if (columnLabels) {
      const head = element('tr', { role: 'row' });
      if (rowLabels) head.append(element('td'));
      for (const text of columnLabels) head.append(element('th', { scope: 'col', class: axisClass(text) }, text));
      this.element.append(head);
    }
    for (let r = 0; r < rows; r++) {
      const row = element('tr', { role: 'row' });
      const text = rowLabels?.[r];
      if (text !== undefined) row.append(element('th', { scope: 'row', class: axisClass(text), tooltip: text }, text));
      for (let c = 0; c < columns; c++) row.append(this.cell(r * columns + c));
      this.element.append(row);
    }
    if (this.cells[0]) this.cells[0].tabIndex = 0;
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => {
      const index = this.indexOf(event.target);
      if (index >= 0) this.copy(index);
    });
  }

  set(row: number, column: number, value: number): void {
    const index = row * this.options.columns + column;
    if (Object.is(this.values[index], value)) return;
    this.values[index] = value;
    setText(this.cells[index], aligned(value, decimalsWithin(value, CHARACTERS)));
  }

  /** A 4×4 matrix, column-major from `offset`, shown with its columns as columns. */
  setMatrix(matrix: Float64Array, offset = 0): void {
    for (let r = 0; r < 4; r++) for (let c = 0; c < 4; c++) this.set(r, c, matrix[offset + 4 * c + r]);
  }

  setRow(row: number, values: ArrayLike<number>, offset = 0): void {
    for (let c = 0; c < this.options.columns; c++) this.set(row, c, values[offset + c]);
  }

  /** The table as text, exact, one line per row. */
  text(): string {
    const { rows, columns, rowLabels } = this.options;
    const lines: string[] = [];
    for (let r = 0; r < rows; r++) {
      const numbers = Array.from(this.values.subarray(r * columns, (r + 1) * columns), exactOrNone).join(' ');
      lines.push(rowLabels ? `${rowLabels[r]} ${numbers}` : numbers);
    }
    return lines.join('\n');
  }

  private cell(index: number): HTMLElement {
    const made = element('td', { role: 'gridcell', class: 'number', tabindex: -1 });
    setTooltip(made, () => `${exactOrNone(this.values[index])}  (click or Enter copies it)`);
    this.cells.push(made);
    return made;
  }

  private onKey(event: KeyboardEvent): void {
    const index = this.indexOf(event.target);
    if (index < 0 || event.altKey) return;
    const command = event.ctrlKey || event.metaKey;
    const { columns } = this.options;
    const steps: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns };
    if (!command && steps[event.key] !== undefined) this.focusAt(index + steps[event.key]);
    else if (event.key === 'Enter' || (command && event.key.toLowerCase() === 'c')) this.copy(index);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private indexOf(target: EventTarget | null): number {
    return target instanceof HTMLElement ? this.cells.indexOf(target) : -1;
  }

  private focusAt(index: number): void {
    const to = this.cells[index];
    if (!to) return;
    for (const cell of this.cells) cell.tabIndex = -1;
    to.tabIndex = 0;
    to.focus();
  }

  private copy(index: number): void {
    const cell = this.cells[index];
    void copyText(exactOrNone(this.values[index])).then((done) => {
      cell.classList.toggle('copied', done);
      setTimeout(() => cell.classList.remove('copied'), COPIED_MS);
    });
  }
}

/** An infinite limit is copied as a word: no file has the number `Infinity`. */
function exactOrNone(value: number): string {
  return Math.abs(value) === Infinity ? 'none' : exact(value);
}

function axisClass(text: string): string | undefined {
  const axis = /^[rts]?([xyz])$/.exec(text)?.[1];
  return axis && `axis-${axis}`;
}
