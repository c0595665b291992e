/** A table of what was compared. Enter and Space select the row that is shown. */
import { type JointMark, MARK_TEXTS } from '../../../teaching/compare/joint-marks.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import type { SortColumn } from '../../widgets/table/sort-heads.ts';
import { SortTable } from '../../widgets/table/sort-table.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import type { WindowedRow } from '../../widgets/windowed-list.ts';
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
  readonly element: HTMLElement;
  private readonly table: SortTable<ComparedRow, Row, RowColumn>;
  private given: readonly ComparedRow[] = [];
  private rows: readonly ComparedRow[] = [];
  private order: RowOrder = BY_INDEX;
  private selected: number | undefined;

  /** @param pick a row was reached by click or keys */
  constructor(pick: (row: ComparedRow) => void) {
    this.table = new SortTable({
      kind: 'compare',
      label: 'Compared',
      columns: COLUMNS,
      // The largest errors first.
      mostFirst: ['error'],
      rowHeight: ['--row', 24],
      isMultiple: false,
      sort: (order) => this.setOrder(order ?? { ...this.order, descending: !this.order.descending }),
      choose: (_, row) => {
        this.selected = row.index;
        this.draw(true);
        pick(row);
      },
      keyOf: ({ index }) => String(index),
      make: makeRow,
      fill,
      takesKey: ({ key, altKey, ctrlKey, metaKey }, row) => {
        if (!row || (key !== 'Enter' && key !== ' ') || altKey || ctrlKey || metaKey) return false;
        this.table.goTo(row);
        return true;
      },
    });
    this.element = this.table.element;
  }

  /** @param selected index of the joint, vertex or channel of the selected row */
  show(rows: readonly ComparedRow[], selected: number | undefined): void {
    const isMoved = selected !== this.selected;
    this.selected = selected;
    if (rows !== this.given) {
      this.given = rows;
      this.rows = inOrder(rows, this.order);
    }
    this.draw(isMoved);
  }

  setLabel(label: string): void {
    this.table.setLabel(label);
  }

  setOrder(order: RowOrder = BY_INDEX): void {
    this.order = order;
    this.rows = inOrder(this.given, order);
    this.draw(false);
  }

  private draw(reveals: boolean): void {
    const focused = this.selected === undefined ? undefined : String(this.selected);
    const chosen = new Set(focused === undefined ? [] : [focused]);
    this.table.show(this.rows, { order: this.order, chosen, focused }, reveals);
  }
}

const BY_INDEX: RowOrder = { column: 'index', descending: false };

function fill({ element: made, index, name, mark, error }: Row, row: ComparedRow, isChosen: boolean): void {
  setAttribute(made, 'aria-selected', String(isChosen));
  write(made.dataset, 'mark', row.mark);
  setText(index, String(row.index));
  setText(name, row.name);
  setTooltip(name, row.name);
  fillMark(mark, row.mark);
  setText(error, numberText(row.error));
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
