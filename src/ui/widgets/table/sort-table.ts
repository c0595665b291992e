/**
 * A table of rows that can be selected: a windowed grid with a header that sorts. What is selected, and the order, are
 * the owner's. The focus is on the table, except for fields and buttons in a row.
 *
 *     ↑ ↓ Home End     to a row, which is selected; Shift extends the selection, Ctrl keeps it
 *     Ctrl+Space       toggles a row in it           Ctrl+A   all
 *
 * Space alone plays, as everywhere; other keys are the owner's.
 */
import { element, setAttribute } from '../dom.ts';
import { HAS_KEYS } from '../focus/focus.ts';
import { isMac } from '../focus/keyboard.ts';
import { asksForMenu, type MenuPlace } from '../menu.ts';
import { rowAfterKey, WindowedList, type WindowedListOptions, type WindowedRow } from '../windowed-list.ts';
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
  private rows: readonly Row[] = [];
  private places = new Map<string, number>();
  private state: SortTableState<C> = { chosen: new Set() };
  /** Row from which Shift extends. */
  private anchor: string | undefined;

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
    return this.rows[this.placeOf(this.state.focused)];
  }

  /** Reveals the focused row if it is another one, or if asked to. */
  show(rows: readonly Row[], state: SortTableState<C>, reveals = state.focused !== this.state.focused): void {
    if (rows !== this.rows) {
      this.rows = rows;
      this.places = new Map(rows.map((row, i) => [this.parts.keyOf(row), i]));
    }
    this.state = state;
    this.heads.show(state.order);
    const focused = this.placeOf(state.focused);
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
    return this.list.row(this.placeOf(this.parts.keyOf(row)));
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
    this.anchor = this.parts.keyOf(row);
    this.parts.choose(new Set([this.anchor]), row);
  }

  private fill(view: View, row: Row | undefined): void {
    if (row) this.parts.fill(view, row, this.state.chosen.has(this.parts.keyOf(row)));
  }

  private placeOf(key: string | undefined): number {
    return key === undefined ? -1 : (this.places.get(key) ?? -1);
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
    if (!row) return;
    const { isMultiple } = this.parts;
    if (isMultiple && event.shiftKey) this.extendTo(row);
    else if (isMultiple && (isMac ? event.metaKey : event.ctrlKey)) {
      this.anchor = this.parts.keyOf(row);
      this.toggle(row);
    } else this.goTo(row);
  }

  private extendTo(row: Row): void {
    const { keyOf } = this.parts;
    const from = Math.max(0, this.placeOf(this.anchor ?? this.state.focused ?? keyOf(row)));
    const to = this.placeOf(keyOf(row));
    const between = this.rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    this.parts.choose(new Set(between.map(keyOf)), row);
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
    const { rows, parts, focused: row, state } = this;
    const place = this.placeOf(state.focused);
    const command = isMac ? event.metaKey : event.ctrlKey;
    if (!parts.isMultiple && (event.ctrlKey || event.metaKey)) return false;
    // Where several can be selected, pages are the owner's.
    const isOwners = event.altKey || (parts.isMultiple && event.key.startsWith('Page'));
    const to = isOwners ? undefined : rowAfterKey(event.key, place, rows.length, this.list.page);
    const next = to === undefined ? undefined : rows[to];
    if (next && event.shiftKey && parts.isMultiple) this.extendTo(next);
    else if (next && command) parts.choose(state.chosen, next);
    else if (next) this.goTo(next);
    else if (command && !event.shiftKey && event.key.toLowerCase() === 'a' && rows.length > 0) {
      parts.choose(new Set(rows.map(parts.keyOf)), row ?? rows[0]);
    } else if (command && event.key === ' ' && row) this.toggle(row);
    else if (parts.menu && asksForMenu(event) && row) {
      const { left, bottom } = (this.list.row(place)?.element ?? this.element).getBoundingClientRect();
      this.openMenu(row, { x: left + (parts.menuLeft ?? 0), y: bottom, byKeyboard: true });
    } else return false;
    return true;
  }
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('input,button') !== null;
}
