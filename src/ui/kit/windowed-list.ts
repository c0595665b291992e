/**
 * A list of which only the rows in view are in the page, so that ten thousand scroll like ten.
 *
 *     scroller ┌─ head ──────────────┐  stays on top, if there is one
 *              ├─ row 3 ─────────────┤ ┐
 *              │  row 4              │ │ in the page, and a few beyond either edge
 *              └─ row 5 ─────────────┘ ┘
 *
 * The scroller keeps the focus and points at the row that is meant (`aria-activedescendant`), for a row may leave the
 * page at any time. Only a row in which something has the focus itself, such as a field, stays.
 */
import { setAttribute, uniqueId } from './dom.ts';

export interface WindowedRow {
  readonly element: HTMLElement;
}

export interface WindowedListOptions<Row extends WindowedRow> {
  /** Holds the focus; whoever lists gives it its role and label. */
  readonly scroller: HTMLElement;
  /** In the scroller: as high as all rows together, which are placed in it. */
  readonly space: HTMLElement;
  /** In the scroller, above the space: has the first row, which stays. */
  readonly pinned?: HTMLElement;
  /** The custom property that has a row's height, and the pixels where it has none. */
  readonly rowHeight: readonly [property: string, pixels: number];
  /** A grid's rows that are listed before these, such as its head; absent where rows are not numbered. */
  readonly rowsAbove?: number;
  /** Pixels at the top of the scroller that are covered by a head. */
  headHeight?(): number;
  /** A row for that index, which `fill` is called for next. */
  make(index: number): Row;
  /** Shows that index in a row, which may have shown another. */
  fill(row: Row, index: number): void;
  /** What a row stays with when indices change; the index by itself. */
  keyOf?(index: number): string;
  /** What of the row with the focus is meant; the row by itself. */
  meant?(row: Row): HTMLElement;
}

/** Rows beyond the edges, so that a quick turn of the wheel shows no gaps. */
const SPARE_ROWS = 6;

export class WindowedList<Row extends WindowedRow> {
  private count = 0;
  private height: number;
  private focused: number | undefined;
  private readonly drawn = new Map<string | number, { readonly row: Row; index: number }>();
  private readonly spare: Row[] = [];
  private readonly idPrefix = uniqueId('row');
  /** How many rows are not in the space. */
  private readonly pinnedCount: number;

  constructor(private readonly options: WindowedListOptions<Row>) {
    this.height = options.rowHeight[1];
    this.pinnedCount = options.pinned ? 1 : 0;
    options.scroller.addEventListener('scroll', () => this.draw(false));
    new ResizeObserver(() => this.resized()).observe(options.scroller);
  }

  /** Pixels. */
  get rowHeight(): number {
    return this.height;
  }

  /** Whole rows in view but one, which is what a page key goes by; at least 1. */
  get page(): number {
    return Math.max(1, Math.floor(this.room / this.height) - 1);
  }

  /** Fills all rows in view anew. */
  show(count: number): void {
    this.count = count;
    const { scroller, space, rowsAbove } = this.options;
    space.style.height = `${Math.max(0, count - this.pinnedCount) * this.height}px`;
    if (rowsAbove !== undefined) setAttribute(scroller, 'aria-rowcount', String(count + rowsAbove));
    this.draw(true);
  }

  /** The list or its rows have another size. */
  resized(): void {
    const { scroller, rowHeight } = this.options;
    this.height = Number.parseFloat(getComputedStyle(scroller).getPropertyValue(rowHeight[0])) || rowHeight[1];
    this.show(this.count);
  }

  /** Marks the row that keys are about; negative or undefined for none. */
  focus(index: number | undefined): void {
    this.focused = index;
    this.point();
  }

  reveal(index: number): void {
    if (index < this.pinnedCount || index >= this.count) return;
    const { scroller } = this.options;
    scroller.scrollTop = revealed(scroller.scrollTop, this.room, this.topOf(index), this.height);
  }

  /** The row of an index, if it is in the page. */
  row(index: number): Row | undefined {
    return index >= 0 && index < this.count ? this.drawn.get(this.keyOf(index))?.row : undefined;
  }

  /** All rows in the page. */
  each(visit: (row: Row, index: number) => void): void {
    for (const { row, index } of this.drawn.values()) visit(row, index);
  }

  /** The index of the row that an event has come from; -1 for none. */
  indexOf({ target }: Event): number {
    const row = target instanceof Element ? target.closest<HTMLElement>('[data-index]') : null;
    return row ? Number(row.dataset.index) : -1;
  }

  /** The index at a height of the window, which may be beyond the last or negative. */
  indexAt(clientY: number): number {
    const { top } = this.options.space.getBoundingClientRect();
    return Math.floor((clientY - top) / this.height) + this.pinnedCount;
  }

  private get room(): number {
    return this.options.scroller.clientHeight - (this.options.headHeight?.() ?? 0);
  }

  private topOf(index: number): number {
    return (index - this.pinnedCount) * this.height;
  }

  private keyOf(index: number): string | number {
    return this.options.keyOf?.(index) ?? index;
  }

  /** @param anew fills also the rows that have been there before */
  private draw(anew: boolean): void {
    const { scroller } = this.options;
    const { height, count, pinnedCount } = this;
    const room = scroller.clientHeight;
    // Nothing in a panel that is not seen: once it is, it has another size, and is filled.
    const [first, end] = room ? windowOf(scroller.scrollTop, room, height, count - pinnedCount) : [0, 0];
    const wanted = new Map<string | number, number>();
    for (let i = 0; i < Math.min(count, pinnedCount); i++) wanted.set(this.keyOf(i), i);
    for (let i = first + pinnedCount; i < end + pinnedCount; i++) wanted.set(this.keyOf(i), i);
    for (const [key, { row }] of this.drawn) {
      if (wanted.has(key)) continue;
      const index = row.element.contains(document.activeElement) ? this.find(key) : undefined;
      if (index !== undefined) wanted.set(key, index);
      else this.drop(key, row);
    }
    for (const [key, index] of wanted) this.drawRow(key, index, anew);
    this.point();
  }

  private drop(key: string | number, row: Row): void {
    this.drawn.delete(key);
    row.element.remove();
    this.spare.push(row);
  }

  private drawRow(key: string | number, index: number, anew: boolean): void {
    const known = this.drawn.get(key);
    if (known?.index === index && !anew) return;
    const { make, fill, space, pinned, rowsAbove } = this.options;
    const isPinned = index < this.pinnedCount;
    const row = known?.row ?? this.spare.pop() ?? make(index);
    const { element } = row;
    element.id = `${this.idPrefix}-${index}`;
    element.dataset.index = String(index);
    element.style.top = isPinned ? '' : `${this.topOf(index)}px`;
    if (rowsAbove !== undefined) setAttribute(element, 'aria-rowindex', String(index + 1 + rowsAbove));
    if (known) known.index = index;
    else this.drawn.set(key, { row, index });
    fill(row, index);
    if (!known) (isPinned ? (pinned ?? space) : space).append(element);
  }

  /** Where a row is now that was drawn under that key. */
  private find(key: string | number): number | undefined {
    for (let i = 0; i < this.count; i++) if (this.keyOf(i) === key) return i;
    return undefined;
  }

  private point(): void {
    const { scroller, meant } = this.options;
    this.each(({ element }, index) => element.classList.toggle('focused', index === this.focused));
    const row = this.focused === undefined ? undefined : this.row(this.focused);
    setAttribute(scroller, 'aria-activedescendant', row && (meant?.(row) ?? row.element).id);
  }
}

/**
 * The rows that are drawn, of those that reach into view.
 * @returns the first one and the one after the last
 */
export function windowOf(
  scrollTop: number,
  room: number,
  rowHeight: number,
  count: number,
): readonly [first: number, end: number] {
  const first = Math.max(0, Math.floor(scrollTop / rowHeight) - SPARE_ROWS);
  return [first, Math.min(count, Math.ceil((scrollTop + room) / rowHeight) + SPARE_ROWS)];
}

/** How far a list is scrolled once the row at `top` is in view, having been at `scrollTop`: no farther than needed. */
export function revealed(scrollTop: number, room: number, top: number, rowHeight: number): number {
  if (top < scrollTop) return top;
  return Math.max(scrollTop, top + rowHeight - room);
}

/** Where a key goes to from a row: arrows, pages, both ends; undefined for any other key. */
export function rowAfterKey(key: string, from: number, count: number, page: number): number | undefined {
  const to = {
    ArrowUp: from - 1,
    ArrowDown: from + 1,
    PageUp: from - page,
    PageDown: from + page,
    Home: 0,
    End: count,
  }[key];
  return to === undefined ? undefined : Math.max(0, Math.min(count - 1, to));
}
