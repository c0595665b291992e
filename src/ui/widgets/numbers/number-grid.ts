/**
 * A table of aligned numbers that are copied exactly, in full precision:
 *
 *     click, Enter, Ctrl+C   copies the number               arrows       to another number
 *     Shift+Enter            its row                         Home, End    the first, last of its row; with Ctrl of all
 *     Ctrl+Enter             the table
 *     right click, Shift+F10 a menu of these
 *
 * The whole table is one tab stop. What was copied is announced.
 */
import { announce } from '../announce.ts';
import { BLOCKED, copyText } from '../clipboard.ts';
import { element, setText } from '../dom.ts';
import { isMac } from '../focus/keyboard.ts';
import { asksForMenu, type MenuEntry, openMenu } from '../menu.ts';
import { setTooltip } from '../tooltip.ts';
import { aligned, decimalsWithin, exact } from './number-text.ts';

export interface GridOptions {
  readonly label: string;
  readonly rows: number;
  readonly columns: number;
  /** Before each row: text, or an element with text. */
  readonly rowLabels?: readonly (string | HTMLElement)[];
  /** Above each column; `x y z` are coloured. */
  readonly columnLabels?: readonly string[];
  /** Text of a number on screen; default three decimals, as far as they fit. */
  text?(value: number): string;
}

const COPIED_MS = 700;
/** Characters that fit into a quarter of the narrowest inspector. */
const CHARACTERS = 7;

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
      const label = rowLabels?.[r];
      const text = labelText(label);
      if (label !== undefined)
        row.append(element('th', { scope: 'row', class: axisClass(text), tooltip: text }, label));
      for (let c = 0; c < columns; c++) row.append(this.cell(r * columns + c));
      this.element.append(row);
    }
    if (this.cells[0]) this.cells[0].tabIndex = 0;
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => {
      const index = this.indexOf(event.target);
      if (index >= 0) this.copy([index]);
    });
    this.element.addEventListener('contextmenu', (event) => {
      const index = this.indexOf(event.target);
      if (index < 0) return;
      event.preventDefault();
      this.openMenu(index, { x: event.clientX, y: event.clientY }, false);
    });
  }

  set(row: number, column: number, value: number): void {
    const index = row * this.options.columns + column;
    if (Object.is(this.values[index], value)) return;
    this.values[index] = value;
    const text = this.options.text?.(value) ?? aligned(value, decimalsWithin(value, CHARACTERS));
    setText(this.cells[index], text);
  }

  /** Marks a number as wrong. */
  mark(row: number, column: number, isWrong: boolean): void {
    this.cells[row * this.options.columns + column].classList.toggle('wrong', isWrong);
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
    const { rows, rowLabels } = this.options;
    const lines: string[] = [];
    for (let r = 0; r < rows; r++) {
      const numbers = this.rowText(r);
      lines.push(rowLabels ? `${labelText(rowLabels[r])} ${numbers}` : numbers);
    }
    return lines.join('\n');
  }

  private rowText(row: number): string {
    const { columns } = this.options;
    return Array.from(this.values.subarray(row * columns, (row + 1) * columns), exactOrNone).join(' ');
  }

  private cell(index: number): HTMLElement {
    const made = element('td', { role: 'gridcell', class: 'number', tabindex: -1 });
    setTooltip(made, () => `${exactOrNone(this.values[index])}\n${HINT}`);
    this.cells.push(made);
    return made;
  }

  private onKey(event: KeyboardEvent): void {
    const index = this.indexOf(event.target);
    if (index < 0 || event.altKey) return;
    const command = event.ctrlKey || event.metaKey;
    const to = cellAfter(event, index, this.options);
    if (to !== undefined) this.focusAt(to);
    else if (event.key === 'Enter' && command) this.copyTable();
    else if (event.key === 'Enter' && event.shiftKey) this.copyRow(index);
    else if (event.key === 'Enter' || (command && !event.shiftKey && event.key.toLowerCase() === 'c'))
      this.copy([index]);
    else if (asksForMenu(event)) {
      const { left, bottom } = this.cells[index].getBoundingClientRect();
      this.openMenu(index, { x: left, y: bottom }, true);
    } else return;
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

  private openMenu(index: number, at: { readonly x: number; readonly y: number }, focusFirst: boolean): void {
    const item = (label: string, shortcut: string, run: () => void): MenuEntry => {
      return { kind: 'item', label, enabled: true, shortcut: isMac ? shortcut.replace('Ctrl+', '⌘') : shortcut, run };
    };
    const entries = [
      item('Copy number', 'Ctrl+C', () => this.copy([index])),
      item('Copy row', 'Shift+Enter', () => this.copyRow(index)),
      item('Copy table', 'Ctrl+Enter', () => this.copyTable()),
    ];
    openMenu(at, entries, { label: this.options.label, opener: this.cells[index], focusFirst });
  }

  private copyRow(index: number): void {
    const { columns } = this.options;
    const row = Math.floor(index / columns);
    this.copy(
      Array.from({ length: columns }, (_, c) => row * columns + c),
      this.rowText(row),
    );
  }

  private copyTable(): void {
    this.copy([...this.cells.keys()], this.text());
  }

  /** @param text of the cells; default the number of the only one */
  private copy(indices: readonly number[], text = exactOrNone(this.values[indices[0]])): void {
    const cells = indices.map((index) => this.cells[index]);
    void copyText(text).then((done) => {
      announce(done ? `Copied ${indices.length === 1 ? text : `${indices.length} numbers`}` : BLOCKED);
      for (const cell of cells) cell.classList.toggle('copied', done);
      setTimeout(() => {
        for (const cell of cells) cell.classList.remove('copied');
      }, COPIED_MS);
    });
  }
}

const HINT = `Click or Enter copies it, Shift+Enter its row, ${isMac ? '⌘' : 'Ctrl+'}Enter the table`;

/** The cell that a key moves to, in rows of `columns`: it stays within the table. Undefined for other keys. */
export function cellAfter(
  { key, ctrlKey, metaKey, shiftKey }: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey'>,
  index: number,
  { rows, columns }: Pick<GridOptions, 'rows' | 'columns'>,
): number | undefined {
  if (shiftKey) return undefined;
  const last = rows * columns - 1;
  const first = index - (index % columns);
  const isAll = ctrlKey || metaKey;
  if (key === 'Home') return isAll ? 0 : first;
  if (key === 'End') return isAll ? last : first + columns - 1;
  if (isAll) return undefined;
  const steps: Readonly<Record<string, number>> = {
    ArrowLeft: index > first ? -1 : 0,
    ArrowRight: index < first + columns - 1 ? 1 : 0,
    ArrowUp: index >= columns ? -columns : 0,
    ArrowDown: index + columns <= last ? columns : 0,
  };
  return steps[key] === undefined ? undefined : index + steps[key];
}

function labelText(label: string | HTMLElement | undefined): string {
  return (typeof label === 'string' ? label : label?.textContent) ?? '';
}

/** An infinite limit is copied as a word: no file has the number `Infinity`. */
function exactOrNone(value: number): string {
  return Math.abs(value) === Infinity ? 'none' : exact(value);
}

function axisClass(text: string): string | undefined {
  const axis = /^[rts]?([xyz])$/.exec(text)?.[1];
  return axis && `axis-${axis}`;
}
