/**
 * A tree of which only the rows in view are in the page, so that ten thousand joints scroll like ten. The focus stays
 * on the tree itself and points at its row (`aria-activedescendant`), for a row may leave the page while focused.
 */
import { element, uniqueId } from '../../kit/dom.ts';
import { icon } from '../../kit/icons.ts';
import type { OutlineRow } from './outline-rows.ts';

export interface TreeEvents {
  toggle(row: OutlineRow, open: boolean): void;
  /** The row that was gone to, by arrow keys or a click. */
  select(row: OutlineRow): void;
  /** Enter; a single click on an alternative that is not shown. */
  activate(row: OutlineRow): void;
  doubleClick(row: OutlineRow): void;
  menu(row: OutlineRow, at: { readonly x: number; readonly y: number }): void;
  /** Fills the row's icon and label; the tree does the rest. */
  draw(row: OutlineRow): Node[];
}

const OVERSCAN = 6;
const MEANT = 'Nothing is selected; channels and keys are those of this character';
/** Pixels that a row is moved in by for each level down to this one; deeper levels less, and those below not at all. */
const INDENTS: readonly (readonly [depth: number, pixels: number])[] = [
  [3, 12],
  [5, 6],
  [14, 4],
  [30, 2],
];

/**
 * How far in a row stands, in pixels: who is whose child is told by a few as well as by many, and at the eighth joint
 * of a chain its name has to be read still. A chain of a thousand stays in the panel.
 */
export function indentOf(depth: number): number {
  let pixels = 0;
  let above = 0;
  for (const [until, step] of INDENTS) {
    pixels += step * Math.max(0, Math.min(depth, until) - above);
    above = until;
  }
  return pixels;
}

export class Tree {
  readonly element = element('div', { role: 'tree', class: 'tree', tabindex: 0 });
  private readonly space = element('div', { class: 'tree-space', role: 'presentation' });
  private rows: readonly OutlineRow[] = [];
  private places = new Map<string, number>();
  private readonly drawn = new Map<number, HTMLElement>();
  private selectedKey: string | undefined;
  private focusedKey: string | undefined;
  private meantKey: string | undefined;
  private rowHeight = 24;
  private readonly idPrefix = uniqueId('row');

  constructor(
    label: string,
    private readonly events: TreeEvents,
  ) {
    this.element.setAttribute('aria-label', label);
    this.element.append(this.space);
    this.element.addEventListener('scroll', () => this.draw());
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => this.onClick(event));
    this.element.addEventListener('dblclick', (event) => this.onDoubleClick(event));
    this.element.addEventListener('contextmenu', (event) => this.onContextMenu(event));
    new ResizeObserver(() => {
      this.rowHeight = Number.parseFloat(getComputedStyle(this.element).getPropertyValue('--row')) || 24;
      this.drawAnew();
    }).observe(this.element);
  }

  show(rows: readonly OutlineRow[]): void {
    this.rows = rows;
    this.places = new Map(rows.map((row, i) => [row.key, i]));
    this.drawAnew();
  }

  /** Marks a row and brings it into view. */
  select(key: string | undefined): void {
    this.selectedKey = key;
    if (key !== undefined) {
      this.focusedKey = key;
      this.reveal(key);
    }
    this.mark();
  }

  /** Marks a row quietly: it counts where nothing is selected. */
  mean(key: string | undefined): void {
    if (key === this.meantKey) return;
    this.meantKey = key;
    this.mark();
  }

  /** As if it had been gone to with the arrow keys; no row is no row. */
  goTo(row: OutlineRow | undefined): void {
    this.element.focus();
    this.moveTo(row);
  }

  get focused(): OutlineRow | undefined {
    return this.rows[this.placeOf(this.focusedKey)];
  }

  /** Anew, though the rows are the same: something that `draw` reads has changed. */
  drawAnew(): void {
    this.space.replaceChildren();
    this.drawn.clear();
    this.space.style.height = `${this.rows.length * this.rowHeight}px`;
    this.draw();
  }

  private draw(): void {
    const first = Math.max(0, Math.floor(this.element.scrollTop / this.rowHeight) - OVERSCAN);
    const shown = Math.ceil(this.element.clientHeight / this.rowHeight) + 2 * OVERSCAN;
    const end = Math.min(this.rows.length, first + shown);
    for (const [index, row] of this.drawn) {
      if (index >= first && index < end) continue;
      row.remove();
      this.drawn.delete(index);
    }
    for (let i = first; i < end; i++) {
      if (this.drawn.has(i)) continue;
      const row = this.drawRow(i);
      this.drawn.set(i, row);
      this.space.append(row);
    }
    this.mark();
  }

  /** Selection and focus, on rows that stay: a double click needs both of its clicks on one element. */
  private mark(): void {
    for (const [index, made] of this.drawn) {
      const { key } = this.rows[index];
      made.setAttribute('aria-selected', String(key === this.selectedKey));
      made.classList.toggle('focused', key === this.focusedKey);
      made.classList.toggle('meant', key === this.meantKey);
      if (key === this.meantKey) made.title = MEANT;
      else if (made.title === MEANT) made.title = '';
    }
    const focused = this.placeOf(this.focusedKey);
    if (this.drawn.has(focused)) this.element.setAttribute('aria-activedescendant', this.idOf(focused));
    else this.element.removeAttribute('aria-activedescendant');
  }

  private drawRow(index: number): HTMLElement {
    const row = this.rows[index];
    const made = element('div', {
      role: 'treeitem',
      id: this.idOf(index),
      class: `row row-${row.kind}`,
      'data-index': index,
      'aria-level': row.depth + 1,
      'aria-expanded': row.expandable ? String(row.expanded) : undefined,
      'aria-checked': row.shown === undefined ? undefined : String(row.shown),
    });
    made.classList.toggle('on-the-way', row.onTheWay);
    made.style.top = `${index * this.rowHeight}px`;
    made.style.setProperty('--indent', `${indentOf(row.depth)}px`);
    const twisty = element('span', { class: 'twisty' });
    if (row.expandable) twisty.append(icon('fold'));
    made.append(twisty, ...this.events.draw(row));
    return made;
  }

  private idOf(index: number): string {
    return `${this.idPrefix}-${index}`;
  }

  private placeOf(key: string | undefined): number {
    return key === undefined ? -1 : (this.places.get(key) ?? -1);
  }

  private reveal(key: string): void {
    const index = this.placeOf(key);
    if (index < 0) return;
    const top = index * this.rowHeight;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (top + this.rowHeight > scrollTop + clientHeight) {
      this.element.scrollTop = top + this.rowHeight - clientHeight;
    }
  }

  /** The row at that height of the page, with its element; none below the last. */
  rowUnder(clientY: number): { readonly row: OutlineRow; readonly made: HTMLElement } | undefined {
    const { top } = this.element.getBoundingClientRect();
    const index = Math.floor((clientY - top + this.element.scrollTop) / this.rowHeight);
    const made = this.drawn.get(index);
    return made && { row: this.rows[index], made };
  }

  private rowAt(event: Event): OutlineRow | undefined {
    const target = event.target instanceof Element ? event.target.closest<HTMLElement>('[data-index]') : null;
    return target ? this.rows[Number(target.dataset.index)] : undefined;
  }

  private onClick(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (!row) return;
    const onTwisty = event.target instanceof Element && event.target.closest('.twisty') !== null;
    if (row.expandable && (onTwisty || row.kind === 'group')) this.events.toggle(row, !row.expanded);
    else this.moveTo(row);
    // One of several alternatives is taken by a click, but only looked at by the arrow keys.
    if (row.shown === false) this.events.activate(row);
  }

  private onDoubleClick(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (row && row.kind !== 'group' && row.shown === undefined) this.events.doubleClick(row);
  }

  private onContextMenu(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (!row) return;
    event.preventDefault();
    this.moveTo(row);
    this.events.menu(row, { x: event.clientX, y: event.clientY });
  }

  private moveTo(row: OutlineRow | undefined): void {
    if (!row) return;
    this.events.select(row);
    // Last, for what is selected may be another row: the character of a skin.
    this.focusedKey = row.key;
    this.reveal(row.key);
    this.mark();
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.ctrlKey || event.metaKey || event.altKey) return;
    const index = Math.max(0, this.placeOf(this.focusedKey));
    const row = this.rows[index];
    if (!row) return;
    const page = Math.max(1, Math.floor(this.element.clientHeight / this.rowHeight) - 1);
    switch (event.key) {
      case 'ArrowDown':
        this.moveTo(this.rows[Math.min(this.rows.length - 1, index + 1)]);
        break;
      case 'ArrowUp':
        this.moveTo(this.rows[Math.max(0, index - 1)]);
        break;
      case 'PageDown':
        this.moveTo(this.rows[Math.min(this.rows.length - 1, index + page)]);
        break;
      case 'PageUp':
        this.moveTo(this.rows[Math.max(0, index - page)]);
        break;
      case 'Home':
        this.moveTo(this.rows[0]);
        break;
      case 'End':
        this.moveTo(this.rows.at(-1));
        break;
      case 'ArrowRight':
        if (row.expandable && !row.expanded) this.events.toggle(row, true);
        else if (row.expandable) this.moveTo(this.rows[index + 1]);
        break;
      case 'ArrowLeft':
        if (row.expanded) this.events.toggle(row, false);
        else this.moveTo(this.above(index));
        break;
      // Not Space: it plays, as everywhere on the page.
      case 'Enter':
        if (row.kind === 'group') this.events.toggle(row, !row.expanded);
        else this.events.activate(row);
        break;
      case 'ContextMenu':
        this.openMenuAt(row, index);
        break;
      case 'F10':
        if (!event.shiftKey) return;
        this.openMenuAt(row, index);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  private openMenuAt(row: OutlineRow, index: number): void {
    const box = (this.drawn.get(index) ?? this.element).getBoundingClientRect();
    this.events.menu(row, { x: box.left + 24, y: box.bottom });
  }

  private above(index: number): OutlineRow | undefined {
    for (let i = index - 1; i >= 0; i--) if (this.rows[i].depth < this.rows[index].depth) return this.rows[i];
    return undefined;
  }
}
