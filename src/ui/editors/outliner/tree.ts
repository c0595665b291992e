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
/** Indentation per level. */
const INDENT_PIXELS = 12;
/** Width of a row beyond its indentation: deep levels are scrolled to, never squeezed. */
const NAME_PIXELS = 84;
/** Letters typed within this time of each other belong together. */
const TYPING_MS = 1000;

/** Indentation of a row in pixels. */
export function indentOf(depth: number): number {
  return INDENT_PIXELS * depth;
}

/**
 * The row that typing goes to: the next one whose name begins with what was typed, from the one in focus on. One letter
 * again and again goes from match to match.
 *
 * @returns an index, or −1
 */
export function rowTyped(rows: readonly Pick<OutlineRow, 'label'>[], focused: number, typed: string): number {
  const again = [...typed].every((letter) => letter === typed[0]);
  const needle = (again ? typed[0] : typed).toLowerCase();
  const first = focused + (again ? 1 : 0);
  for (let i = 0; i < rows.length; i++) {
    const at = (first + i) % rows.length;
    if (rows[at].label.toLowerCase().startsWith(needle)) return at;
  }
  return -1;
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
  /** Letters go to rows while the focus came by keyboard; after a click they are the page's shortcuts. */
  private takesLetters = false;
  private isPressed = false;
  private typed = { text: '', at: 0 };

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
    // The press comes before the focus that it gives.
    this.element.addEventListener('pointerdown', () => {
      this.takesLetters = false;
      this.isPressed = true;
    });
    this.element.addEventListener('focus', () => {
      this.takesLetters = !this.isPressed;
    });
    for (const type of ['click', 'pointercancel']) {
      this.element.addEventListener(type, () => {
        this.isPressed = false;
      });
    }
    // A drag and a right press end without a click. A menu gives the focus back.
    this.element.addEventListener('blur', ({ relatedTarget }) => {
      if (!(relatedTarget instanceof Element && relatedTarget.closest('[role=menu]'))) this.isPressed = false;
    });
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
    const deepest = rows.reduce((depth, row) => Math.max(depth, row.depth), 0);
    this.space.style.minWidth = `${indentOf(deepest) + NAME_PIXELS}px`;
    this.drawAnew();
  }

  /** Selects a row and scrolls it into view. */
  select(key: string | undefined): void {
    this.selectedKey = key;
    if (key !== undefined) {
      this.focusedKey = key;
      this.reveal(key);
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
    this.reveal(row.key);
    this.mark();
  }

  /** Scrolls to a row, and sideways to where its name begins. */
  private reveal(key: string): void {
    const place = this.placeOf(key);
    this.list.reveal(place);
    const row = this.rows[place];
    if (!row) return;
    const { element: scroller } = this;
    const left = indentOf(row.depth);
    const shows = left >= scroller.scrollLeft && left + NAME_PIXELS <= scroller.scrollLeft + scroller.clientWidth;
    if (!shows) scroller.scrollLeft = left + NAME_PIXELS - scroller.clientWidth;
  }

  /** Goes to a row by its name. */
  private type(letter: string, index: number, now: number): void {
    const text = now - this.typed.at > TYPING_MS ? letter : this.typed.text + letter;
    this.typed = { text, at: now };
    const to = rowTyped(this.rows, index, text);
    if (to >= 0) this.moveTo(this.rows[to]);
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
    if (this.takesLetters && /^[\p{L}\p{N}_]$/u.test(event.key)) {
      this.type(event.key, index, event.timeStamp);
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
