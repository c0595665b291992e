/**
 * A table of what was compared: a windowed list with a header that sorts. The focus is on the table.
 *
 *     ↑ ↓ Home End Page Up Page Down     to another row, which is selected
 *     Enter Space                        the row that is shown is selected
 */
import { type JointMark, MARK_TEXTS } from '../../../teaching/compare/joint-marks.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { type SortColumn, SortHeads } from '../../widgets/sort-heads.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { rowAfterKey, WindowedList, type WindowedRow } from '../../widgets/windowed-list.ts';
import { numberText } from './banner-text.ts';
import { type ComparedRow, inOrder, type RowColumn, type RowOrder } from './compared-rows.ts';

const COLUMNS: readonly SortColumn<RowColumn>[] = [
  ['index', '#', 'number', 'Index, from 0'],
  ['name', 'Name', '', 'Name'],
  ['mark', 'Found', '', 'Own error: its local matrix is wrong. Inherited: wrong only because a parent is'],
  ['error', 'Error', 'number', 'Largest difference; lengths are divided by the size'],
];

interface Row extends WindowedRow {
  readonly index: HTMLElement;
  readonly name: HTMLElement;
  readonly mark: HTMLElement;
  readonly error: HTMLElement;
}

export class ComparedTable {
  readonly element = element('div', {
    class: 'sort-table compare-table',
    role: 'grid',
    tabindex: 0,
    [HAS_KEYS]: true,
    'aria-label': 'Compared',
    'aria-colcount': COLUMNS.length,
  });
  private readonly space = element('div', { class: 'sort-space', role: 'rowgroup' });
  private readonly heads = new SortHeads('compare-head', COLUMNS, (column) => this.sortBy(column));
  private readonly list: WindowedList<Row>;
  private given: readonly ComparedRow[] = [];
  private rows: readonly ComparedRow[] = [];
  private order: RowOrder = { column: 'index', descending: false };
  private selected: number | undefined;

  /** @param pick a row was reached by click or keys */
  constructor(private readonly pick: (row: ComparedRow) => void) {
    this.element.append(this.heads.element, this.space);
    this.space.addEventListener('click', (event) => {
      const row = this.rows[this.list.indexOf(event)];
      if (row) this.choose(row);
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      rowHeight: ['--row', 24],
      rowsAbove: 1,
      headHeight: () => this.heads.height,
      make: makeRow,
      fill: (row, index) => this.fill(row, this.rows[index]),
    });
  }

  /** @param selected index of the joint, vertex or channel of the selected row */
  show(rows: readonly ComparedRow[], selected: number | undefined): void {
    const isMoved = selected !== this.selected;
    this.selected = selected;
    if (rows !== this.given) {
      this.given = rows;
      this.sort();
    } else this.list.show(this.rows.length);
    this.point();
    if (isMoved) this.list.reveal(this.place);
  }

  setLabel(label: string): void {
    setAttribute(this.element, 'aria-label', label);
  }

  setOrder(order: RowOrder): void {
    this.order = order;
    this.sort();
  }

  private sort(): void {
    this.rows = inOrder(this.given, this.order);
    this.heads.show(this.order);
    this.list.show(this.rows.length);
    this.point();
  }

  private get place(): number {
    return this.rows.findIndex(({ index }) => index === this.selected);
  }

  private point(): void {
    this.list.focus(this.place);
  }

  private choose(row: ComparedRow): void {
    this.selected = row.index;
    this.list.show(this.rows.length);
    this.point();
    this.list.reveal(this.place);
    this.pick(row);
  }

  private sortBy(column: RowColumn): void {
    const { order } = this;
    // The largest errors first.
    const descending = order.column === column ? !order.descending : column === 'error';
    this.setOrder({ column, descending });
  }

  private fill({ element: made, index, name, mark, error }: Row, row: ComparedRow): void {
    setAttribute(made, 'aria-selected', String(row.index === this.selected));
    write(made.dataset, 'mark', row.mark);
    setText(index, String(row.index));
    setText(name, row.name);
    setTooltip(name, row.name);
    fillMark(mark, row.mark);
    setText(error, numberText(row.error));
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.altKey || event.ctrlKey || event.metaKey) return;
    const isChosen = event.key === 'Enter' || event.key === ' ';
    const to = isChosen ? this.place : rowAfterKey(event.key, this.place, this.rows.length, this.list.page);
    const row = to === undefined ? undefined : this.rows[to];
    if (!row) return;
    event.preventDefault();
    this.choose(row);
  }
}

function makeRow(): Row {
  const cell = (className = '') => element('span', { class: `sort-cell ${className}`, role: 'gridcell' });
  const [index, name, mark, error] = [cell('number faint'), cell(), cell(), cell('number')];
  return {
    element: element('div', { class: 'sort-row compare-row', role: 'row' }, index, name, mark, error),
    index,
    name,
    mark,
    error,
  };
}

function fillMark(cell: HTMLElement, mark: JointMark): void {
  if (cell.dataset.mark === mark) return;
  write(cell.dataset, 'mark', mark);
  const swatch = element('span', { class: 'compare-swatch', 'data-mark': mark, 'aria-hidden': 'true' });
  cell.replaceChildren(swatch, MARK_TEXTS[mark]);
}
