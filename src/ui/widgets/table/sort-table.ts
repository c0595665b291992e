/**
 * A table of rows that can be selected: a windowed grid with a header that sorts. What is selected, and the order, are
 * the owner's. The focus is on the table, except for fields and buttons in a row. Clicks and keys select as in all lists
 * (`RowSelection`), but for page keys where several rows can be selected; those and other keys are the owner's.
 */
import { element, setAttribute } from '../dom.ts';
import { HAS_KEYS } from '../focus/focus.ts';
import { asksForMenu, type MenuPlace } from '../menu.ts';
import { WindowedList, type WindowedListOptions, type WindowedRow } from '../windowed-list.ts';
import { RowSelection } from './row-selection.ts';
import { type SortColumn, SortHeads, type SortOrder } from './sort-heads.ts';

/** What a table shows beside its rows. */
export interface SortTableState<C extends string> {
  /** Default: the owner's. */
  readonly order?: SortOrder<C> | undefined;
  readonly chosen: ReadonlySet<string>;
  readonly focused?: string | undefined;
}

export interface SortTableParts<Row, View extends WindowedRow, C extends string> {
  /** CSS classes begin with it: `take-table`, `take-head`. */
  readonly kind: string;
  readonly label: string;
  readonly columns: readonly SortColumn<C>[];
  /** Label of a column before them that can't be sorted. */
  readonly lead?: string;
  /** Columns whose largest come first. */
  readonly mostFirst?: readonly C[];
  readonly rowHeight: WindowedListOptions<View>['rowHeight'];
  /** Whether several rows can be selected. */
  readonly isMultiple: boolean;
  /** Pixels from the left at which the menu of the keyboard opens. */
  readonly menuLeft?: number;
  keyOf(row: Row): string;
  make(row: Row): View;
  fill(view: View, row: Row, isChosen: boolean): void;
  /** @param order undefined: the owner's */
  sort(order: SortOrder<C> | undefined): void;
  choose(chosen: ReadonlySet<string>, focused: Row): void;
  /** @param row undefined: beside the rows */
  menu?(row: Row | undefined, at: MenuPlace): void;
  /** Whether it takes the key. */
  takesKey?(event: KeyboardEvent, row: Row | undefined): boolean;
}

export class SortTable<Row, View extends WindowedRow, C extends string> {
  readonly element: HTMLElement;
  private readonly space = element('div', { class: 'sort-space', role: 'rowgroup' });
  private readonly heads: SortHeads<C>;
  private readonly list: WindowedList<View>;
  private readonly picks: RowSelection<Row>;
  private state: SortTableState<C> = { chosen: new Set() };

  constructor(private readonly parts: SortTableParts<Row, View, C>) {
    const { kind, label, columns, lead, rowHeight } = parts;
    this.element = element('div', {
      class: `sort-table ${kind}-table`,
      role: 'grid',
      tabindex: 0,
      [HAS_KEYS]: true,
      'aria-label': label,
      'aria-multiselectable': parts.isMultiple ? 'true' : undefined,
      'aria-colcount': columns.length + (lead === undefined ? 0 : 1),
    });
    const first = lead === undefined ? undefined : { label: lead };
    this.heads = new SortHeads(`${kind}-head`, columns, (column) => parts.sort(this.orderAfter(column)), first);
    this.element.append(this.heads.element, this.space);
    const { keyOf, choose } = parts;
    this.picks = new RowSelection({
      keyOf,
      selectOnly: (row) => choose(new Set([keyOf(row)]), row),
      focus: (row) => choose(this.state.chosen, row),
      ...(parts.isMultiple && {
        toggle: (row: Row) => this.toggle(row),
        selectRange: (rows: readonly Row[], to: Row) => choose(new Set(rows.map(keyOf)), to),
        selectAll: (rows: readonly Row[]) => choose(new Set(rows.map(keyOf)), this.focused ?? rows[0]),
      }),
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.space.addEventListener('click', (event) => this.onClick(event));
    if (parts.menu) this.space.addEventListener('contextmenu', (event) => this.onMenu(event));
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      rowHeight,
      rowsAbove: 1,
      headHeight: () => this.heads.height,
      keyOf: (index) => parts.keyOf(this.rows[index]),
      make: (index) => parts.make(this.rows[index]),
      fill: (view, index) => this.fill(view, this.rows[index]),
    });
  }

  get focused(): Row | undefined {
    return this.picks.focused;
  }

  /** Reveals the focused row if it is another one, or if asked to. */
  show(rows: readonly Row[], state: SortTableState<C>, reveals = state.focused !== this.state.focused): void {
    this.picks.show(rows);
    this.picks.focusedKey = state.focused;
    this.state = state;
    this.heads.show(state.order);
    const focused = this.picks.place;
    this.list.show(rows.length, reveals ? focused : undefined);
    this.list.focus(focused);
  }

  setLabel(label: string): void {
    setAttribute(this.element, 'aria-label', label);
  }

  /** The row of an event, if it isn't one of a field or a button in it. */
  rowAt(event: Event): Row | undefined {
    return isControl(event.target) ? undefined : this.rows[this.list.indexOf(event)];
  }

  viewOf(row: Row): View | undefined {
    return this.list.row(this.picks.placeOf(this.parts.keyOf(row)));
  }

  /** All rows in the page. */
  drawn(): readonly Row[] {
    const drawn: Row[] = [];
    this.list.each((_, index) => {
      if (this.rows[index]) drawn.push(this.rows[index]);
    });
    return drawn;
  }

  /** What `fill` reads has changed, beside the rows. */
  refill(): void {
    this.list.each((view, index) => this.fill(view, this.rows[index]));
  }

  /** Selects only this row. */
  goTo(row: Row): void {
    this.picks.goTo(row);
  }

  private fill(view: View, row: Row | undefined): void {
    if (row) this.parts.fill(view, row, this.state.chosen.has(this.parts.keyOf(row)));
  }

  private get rows(): readonly Row[] {
    return this.picks.rows;
  }

  /** One way, the other, then the owner's order. */
  private orderAfter(column: C): SortOrder<C> | undefined {
    const { order } = this.state;
    const first = this.parts.mostFirst?.includes(column) === true;
    if (order?.column !== column) return { column, descending: first };
    return order.descending === first ? { column, descending: !first } : undefined;
  }

  // Selection.

  private onClick(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (row) this.picks.pressed(row, event);
  }

  private toggle(row: Row): void {
    const key = this.parts.keyOf(row);
    const chosen = new Set(this.state.chosen);
    if (!chosen.delete(key)) chosen.add(key);
    this.parts.choose(chosen, row);
  }

  private onMenu(event: MouseEvent): void {
    if (event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    this.openMenu(this.rows[this.list.indexOf(event)], { x: event.clientX, y: event.clientY });
  }

  private openMenu(row: Row | undefined, at: MenuPlace): void {
    if (row && !this.state.chosen.has(this.parts.keyOf(row))) this.goTo(row);
    this.parts.menu?.(row, at);
  }

  // The keyboard.

  private onKey(event: KeyboardEvent): void {
    // Keys in a field belong to it.
    if (event.target !== this.element || event.isComposing) return;
    if (!this.parts.takesKey?.(event, this.focused) && !this.takesKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  private takesKey(event: KeyboardEvent): boolean {
    const { parts, picks, list, focused } = this;
    if (picks.takesKey(event, parts.isMultiple ? undefined : list.page)) return true;
    if (!parts.menu || !asksForMenu(event) || !focused) return false;
    const { left, bottom } = (list.row(picks.place)?.element ?? this.element).getBoundingClientRect();
    this.openMenu(focused, { x: left + (parts.menuLeft ?? 0), y: bottom, byKeyboard: true });
    return true;
  }
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('input,button') !== null;
}
