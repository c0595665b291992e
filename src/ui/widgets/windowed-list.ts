/**
 * A list with only the visible rows in the page, so that ten thousand scroll like ten.
 *
 *     scroller ┌─ head ──────────────┐  stays on top, if any
 *              ├─ row 3 ─────────────┤ ┐
 *              │  row 4              │ │ in the page, plus a few beyond the edges
 *              └─ row 5 ─────────────┘ ┘
 *
 * The scroller keeps the focus and refers to the current row (`aria-activedescendant`), since a row may be removed from
 * the page at any time. Only a row that contains the focus, such as in a field, is kept.
 */
import { setAttribute, setStyle, uniqueId, write } from './dom.ts';

export interface WindowedRow {
  readonly element: HTMLElement;
}

export interface WindowedListOptions<Row extends WindowedRow> {
  /** Has the focus; the owner sets its role and label. */
  readonly scroller: HTMLElement;
  /** In the scroller: as high as all rows together, which are positioned in it. */
  readonly space: HTMLElement;
  /** In the scroller, above the space: contains the first row, which doesn't scroll. */
  readonly pinned?: HTMLElement;
  /** Custom property with a row's height, and the default in pixels. */
  readonly rowHeight: readonly [property: string, pixels: number];
  /** Number of a grid's rows before these, such as its header; absent if rows aren't numbered. */
  readonly rowsAbove?: number;
  /** Pixels at the top of the scroller covered by a header. */
  headHeight?(): number;
  /** Creates a row for an index; `fill` is called next. */
  make(index: number): Row;
  /** Shows an index in a row, which may have shown another. */
  fill(row: Row, index: number): void;
  /** Key by which a row is kept when indices change; default: the index. */
  keyOf?(index: number): string;
  /** The active element in the focused row; default: the row. */
  meant?(row: Row): HTMLElement;
}

/** Rows beyond the edges, so that fast scrolling shows no gaps. */
const SPARE_ROWS = 6;

export class WindowedList<Row extends WindowedRow> {
  private count = 0;
  private height: number;
  private focused: number | undefined;
  private readonly drawn = new Map<string | number, { readonly row: Row; index: number }>();
  private readonly spare: Row[] = [];
  private readonly idPrefix = uniqueId('row');
  /** Number of rows outside the space. */
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

  /** Rows per page key: the fully visible ones minus one; at least 1. */
  get page(): number {
    return Math.max(1, Math.floor(this.room / this.height) - 1);
  }

  /**
   * Refills all rows in view.
   *
   * @param revealed index of a row to scroll to
   */
  show(count: number, revealed?: number): void {
    this.count = count;
    const { scroller, space, rowsAbove } = this.options;
    setStyle(space, 'height', `${Math.max(0, count - this.pinnedCount) * this.height}px`);
    if (rowsAbove !== undefined) setAttribute(scroller, 'aria-rowcount', String(count + rowsAbove));
    if (revealed !== undefined) this.reveal(revealed);
    this.draw(true);
  }

  /** The list or its rows have been resized. */
  resized(): void {
    const { scroller, rowHeight } = this.options;
    this.height = Number.parseFloat(getComputedStyle(scroller).getPropertyValue(rowHeight[0])) || rowHeight[1];
    this.show(this.count);
  }

  /** Marks the row with the keyboard focus; negative or undefined for none. */
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

  /** The index of the row where an event occurred; -1 for none. */
  indexOf({ target }: Event): number {
    const row = target instanceof Element ? target.closest<HTMLElement>('[data-index]') : null;
    return row ? Number(row.dataset.index) : -1;
  }

  /** The index at a client height; may be negative or beyond the last. */
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

  /** @param anew also refills rows that are already there */
  private draw(anew: boolean): void {
    const { scroller } = this.options;
    const { height, count, pinnedCount } = this;
    const room = scroller.clientHeight;
    // Draws nothing while hidden; becoming visible resizes and fills it.
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
    write(element, 'id', `${this.idPrefix}-${index}`);
    write(element.dataset, 'index', String(index));
    setStyle(element, 'top', isPinned ? '' : `${this.topOf(index)}px`);
    if (rowsAbove !== undefined) setAttribute(element, 'aria-rowindex', String(index + 1 + rowsAbove));
    if (known) known.index = index;
    else this.drawn.set(key, { row, index });
    fill(row, index);
    if (!known) (isPinned ? (pinned ?? space) : space).append(element);
  }

  /** The current index of a row drawn under that key. */
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
 * Rows to be drawn for the visible part.
 *
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

/** The scroll position that reveals the row at `top`, with the least movement from `scrollTop`. */
export function revealed(scrollTop: number, room: number, top: number, rowHeight: number): number {
  if (top < scrollTop) return top;
  return Math.max(scrollTop, top + rowHeight - room);
}

/** The row that a key moves to: arrows, pages, both ends; undefined for other keys. */
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
