/** The outliner's tree, a windowed list: mouse and keys, and what all rows share. */
import { element, setAttribute } from '../../kit/dom.ts';
import { icon } from '../../kit/icons.ts';
import { setTooltip } from '../../kit/tooltip.ts';
import { rowAfterKey, WindowedList, type WindowedRow } from '../../kit/windowed-list.ts';
import type { OutlineRow } from './outline-rows.ts';

export interface TreeEvents {
  toggle(row: OutlineRow, open: boolean): void;
  /** A row was reached by arrow keys or a click. */
  select(row: OutlineRow): void;
  /** Enter, or a click on an alternative that isn't shown. */
  activate(row: OutlineRow): void;
  doubleClick(row: OutlineRow): void;
  menu(row: OutlineRow, at: { readonly x: number; readonly y: number }): void;
  /** Fills in the row's icon and label; the tree does the rest. */
  draw(row: OutlineRow): Node[];
}

const MEANT = 'Nothing is selected; channels and keys are those of this character';
/** Indentation per level down to this depth: less for deeper levels, and none below the last. */
const INDENTS: readonly (readonly [depth: number, pixels: number])[] = [
  [3, 12],
  [5, 6],
  [14, 4],
  [30, 2],
];

/**
 * Indentation of a row in pixels: a few per level suffice, and the eighth joint of a chain must still be readable. Even
 * a chain of a thousand stays in the panel.
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
  private readonly list: WindowedList<WindowedRow>;
  private selectedKey: string | undefined;
  private focusedKey: string | undefined;
  private meantKey: string | undefined;

  constructor(
    label: string,
    private readonly events: TreeEvents,
  ) {
    this.element.setAttribute('aria-label', label);
    this.element.append(this.space);
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => this.onClick(event));
    this.element.addEventListener('dblclick', (event) => this.onDoubleClick(event));
    this.element.addEventListener('contextmenu', (event) => this.onContextMenu(event));
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      rowHeight: ['--row', 24],
      make: () => ({ element: element('div', { role: 'treeitem' }) }),
      fill: (row, index) => this.fill(row.element, index),
    });
  }

  show(rows: readonly OutlineRow[]): void {
    this.rows = rows;
    this.places = new Map(rows.map((row, i) => [row.key, i]));
    this.drawAnew();
  }

  /** Selects a row and scrolls it into view. */
  select(key: string | undefined): void {
    this.selectedKey = key;
    if (key !== undefined) {
      this.focusedKey = key;
      this.list.reveal(this.placeOf(key));
    }
    this.mark();
  }

  /** Marks a row faintly: the current character when nothing is selected. */
  mean(key: string | undefined): void {
    if (key === this.meantKey) return;
    this.meantKey = key;
    this.mark();
  }

  /** As if reached with the arrow keys; does nothing without a row. */
  goTo(row: OutlineRow | undefined): void {
    this.element.focus();
    this.moveTo(row);
  }

  get focused(): OutlineRow | undefined {
    return this.rows[this.placeOf(this.focusedKey)];
  }

  /** Redraws the same rows, since something that `draw` reads has changed. */
  drawAnew(): void {
    this.list.show(this.rows.length);
    this.list.focus(this.placeOf(this.focusedKey));
  }

  /** Updates selection and focus of existing rows: a double click needs both clicks on one element. */
  private mark(): void {
    this.list.each(({ element: made }, index) => this.markRow(made, this.rows[index]));
    this.list.focus(this.placeOf(this.focusedKey));
  }

  private markRow(made: HTMLElement, { key }: OutlineRow): void {
    made.setAttribute('aria-selected', String(key === this.selectedKey));
    made.classList.toggle('meant', key === this.meantKey);
    setTooltip(made, key === this.meantKey ? MEANT : undefined);
  }

  private fill(made: HTMLElement, index: number): void {
    const row = this.rows[index];
    made.className = `row row-${row.kind}`;
    made.classList.toggle('on-the-way', row.onTheWay);
    setAttribute(made, 'aria-level', String(row.depth + 1));
    setAttribute(made, 'aria-expanded', row.expandable ? String(row.expanded) : undefined);
    setAttribute(made, 'aria-checked', row.shown === undefined ? undefined : String(row.shown));
    made.style.setProperty('--indent', `${indentOf(row.depth)}px`);
    const twisty = element('span', { class: 'twisty' });
    if (row.expandable) twisty.append(icon('fold'));
    made.replaceChildren(twisty, ...this.events.draw(row));
    this.markRow(made, row);
  }

  private placeOf(key: string | undefined): number {
    return key === undefined ? -1 : (this.places.get(key) ?? -1);
  }

  /** The row at a client height, with its element; undefined below the last. */
  rowUnder(clientY: number): { readonly row: OutlineRow; readonly made: HTMLElement } | undefined {
    const index = this.list.indexAt(clientY);
    const made = this.list.row(index)?.element;
    return made && { row: this.rows[index], made };
  }

  private rowAt(event: Event): OutlineRow | undefined {
    return this.rows[this.list.indexOf(event)];
  }

  private onClick(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (!row) return;
    const onTwisty = event.target instanceof Element && event.target.closest('.twisty') !== null;
    if (row.expandable && (onTwisty || row.kind === 'group')) this.events.toggle(row, !row.expanded);
    else this.moveTo(row);
    // A click activates an alternative; arrow keys only move to it.
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
    // Last, since the selection may be another row: the character of a skin.
    this.focusedKey = row.key;
    this.list.reveal(this.placeOf(row.key));
    this.mark();
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.ctrlKey || event.metaKey || event.altKey) return;
    const index = Math.max(0, this.placeOf(this.focusedKey));
    const row = this.rows[index];
    if (!row) return;
    const to = rowAfterKey(event.key, index, this.rows.length, this.list.page);
    if (to !== undefined) {
      this.moveTo(this.rows[to]);
      event.preventDefault();
      return;
    }
    switch (event.key) {
      case 'ArrowRight':
        if (row.expandable && !row.expanded) this.events.toggle(row, true);
        else if (row.expandable) this.moveTo(this.rows[index + 1]);
        break;
      case 'ArrowLeft':
        if (row.expanded) this.events.toggle(row, false);
        else this.moveTo(this.above(index));
        break;
      // Not Space, which plays, as everywhere on the page.
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
    const box = (this.list.row(index)?.element ?? this.element).getBoundingClientRect();
    this.events.menu(row, { x: box.left + 24, y: box.bottom });
  }

  private above(index: number): OutlineRow | undefined {
    for (let i = index - 1; i >= 0; i--) if (this.rows[i].depth < this.rows[index].depth) return this.rows[i];
    return undefined;
  }
}
