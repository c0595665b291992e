/** The outliner's tree, a windowed list: mouse and keys, and what all rows share. */
import { element, setAttribute, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { continuesTyping, isCharacter, noteTyped } from '../../widgets/focus/typing.ts';
import { icon } from '../../widgets/icons.ts';
import { asksForMenu, type MenuPlace } from '../../widgets/menu.ts';
import { RowSelection } from '../../widgets/table/row-selection.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { WindowedList, type WindowedRow } from '../../widgets/windowed-list.ts';
import type { OutlineRow } from './outline-rows.ts';

export interface TreeEvents {
  toggle(row: OutlineRow, open: boolean): void;
  /** A row was reached by arrow keys or a click. */
  select(row: OutlineRow): void;
  /** Ctrl+click or Ctrl+Space: a row is selected with the others, or deselected. */
  toggleSelected(row: OutlineRow): void;
  /** Shift+click or Shift+arrows: exactly these rows are selected, and the last one is active. */
  selectRange(rows: readonly OutlineRow[]): void;
  /** Enter, or a click on an alternative that isn't shown. */
  activate(row: OutlineRow): void;
  doubleClick(row: OutlineRow): void;
  menu(row: OutlineRow, at: MenuPlace): void;
  /** Fills in the row's icon and label; the tree does the rest. */
  draw(row: OutlineRow): Node[];
}

const MEANT = 'Nothing is selected; channels and keys are those of this character';
/** Deeper trees have no lines below their arrows: those would be too close to be told apart. */
const MAX_LINES = 16;

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
  readonly element = element('div', {
    role: 'tree',
    'aria-multiselectable': 'true',
    class: 'tree',
    tabindex: 0,
    [HAS_KEYS]: true,
  });
  private readonly space = element('div', { class: 'tree-space', role: 'presentation' });
  private readonly picks: RowSelection<OutlineRow>;
  private readonly list: WindowedList<WindowedRow>;
  private selected: ReadonlySet<string> = new Set();
  private activeKey: string | undefined;
  private meantKey: string | undefined;
  private litKey: string | undefined;
  /** Letters go to rows while the focus came by keyboard; after a click they are the page's shortcuts. */
  private takesLetters = false;
  private isPressed = false;
  /** So far of a name. */
  private typed = '';

  constructor(
    label: string,
    private readonly events: TreeEvents,
  ) {
    setAttribute(this.element, 'aria-label', label);
    this.element.append(this.space);
    this.picks = new RowSelection({
      keyOf: ({ key }) => key,
      selectOnly: (row) => events.select(row),
      toggle: (row) => events.toggleSelected(row),
      selectRange: (rows, to) => events.selectRange(rows[0] === to ? rows.toReversed() : rows),
    });
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
      if (this.takesLetters) this.list.reveal(this.picks.place);
    });
    for (const type of ['click', 'pointercancel']) {
      this.element.addEventListener(type, () => {
        this.isPressed = false;
      });
    }
    // A drag and a right press end without a click. A menu gives the focus back.
    this.element.addEventListener('blur', ({ relatedTarget }) => {
      this.typed = '';
      this.takesLetters = false;
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
    this.picks.show(rows);
    const deepest = rows.reduce((depth, row) => Math.max(depth, row.depth), 0);
    this.space.style.setProperty('--deepest', String(Math.max(1, deepest)));
    this.space.classList.toggle('is-deep', deepest > MAX_LINES);
    this.drawAnew();
  }

  /** Selects rows, and scrolls to the active one, the last. */
  select(keys: readonly string[]): void {
    const before = this.activeKey;
    const { picks } = this;
    const isRange = picks.anchor !== undefined && keys.length > 1 && keys.includes(picks.anchor);
    this.selected = new Set(keys);
    this.activeKey = keys.at(-1);
    if (!isRange) picks.anchor = this.activeKey;
    if (this.activeKey !== undefined && this.activeKey !== before) {
      picks.focusedKey = this.activeKey;
      this.list.reveal(picks.place);
    }
    this.mark();
  }

  /** Scrolls to the active row, if there is one. */
  revealActive(): void {
    this.list.reveal(this.picks.placeOf(this.activeKey));
  }

  /** Marks a row faintly: the current character when nothing is selected. */
  mean(key: string | undefined): void {
    if (key === this.meantKey) return;
    this.meantKey = key;
    this.mark();
  }

  /** Lights a row up as if under the pointer: the joint that is pointed at elsewhere. */
  light(key: string | undefined): void {
    if (key === this.litKey) return;
    this.litKey = key;
    this.mark();
  }

  /** As if reached with the arrow keys; does nothing without a row. */
  goTo(row: OutlineRow | undefined): void {
    this.element.focus();
    this.moveTo(row);
  }

  get focused(): OutlineRow | undefined {
    return this.picks.focused;
  }

  /** Redraws the same rows, since something that `draw` reads has changed. */
  drawAnew(): void {
    this.list.show(this.rows.length);
    this.list.focus(this.picks.place);
  }

  /** Updates selection and focus of existing rows: a double click needs both clicks on one element. */
  private mark(): void {
    this.list.each(({ element: made }, index) => this.markRow(made, this.rows[index]));
    this.list.focus(this.picks.place);
  }

  private markRow(made: HTMLElement, { key }: OutlineRow): void {
    setAttribute(made, 'aria-selected', String(this.selected.has(key)));
    made.classList.toggle('selected-too', this.selected.has(key) && key !== this.activeKey);
    made.classList.toggle('meant', key === this.meantKey);
    made.classList.toggle('lit', key === this.litKey);
    setTooltip(made, key === this.meantKey ? MEANT : undefined);
  }

  private fill(made: HTMLElement, index: number): void {
    const row = this.rows[index];
    write(made, 'className', `row row-${row.kind}`);
    made.classList.toggle('on-the-way', row.onTheWay);
    setAttribute(made, 'aria-level', String(row.depth + 1));
    setAttribute(made, 'aria-expanded', row.expandable ? String(row.expanded) : undefined);
    setAttribute(made, 'aria-checked', row.shown === undefined ? undefined : String(row.shown));
    made.style.setProperty('--depth', String(row.depth));
    const twisty = element('span', { class: 'twisty' });
    if (row.expandable) twisty.append(icon('fold'));
    made.replaceChildren(twisty, ...this.events.draw(row));
    this.markRow(made, row);
  }

  private get rows(): readonly OutlineRow[] {
    return this.picks.rows;
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
    else {
      this.picks.pressed(row, event);
      this.moved();
    }
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
    // The menu of one of several selected rows is for all of them.
    if (this.selected.has(row.key)) {
      this.picks.focusedKey = row.key;
      this.moved();
    } else this.moveTo(row);
    this.events.menu(row, { x: event.clientX, y: event.clientY });
  }

  private moveTo(row: OutlineRow | undefined): void {
    if (!row) return;
    this.picks.goTo(row);
    this.moved();
  }

  /** Another row has the focus. */
  private moved(): void {
    this.list.reveal(this.picks.place);
    this.mark();
  }

  /** Goes to a row by its name, which begins with a letter; what else is in names types on. */
  private type(event: KeyboardEvent, index: number): boolean {
    if (!this.takesLetters || !isCharacter(event)) return false;
    const isMore = this.typed !== '' && continuesTyping(event);
    if (!isMore && !/^[\p{L}\p{N}_]$/u.test(event.key)) return false;
    noteTyped(event);
    this.typed = isMore ? this.typed + event.key : event.key;
    const to = rowTyped(this.rows, index, this.typed);
    if (to >= 0) this.moveTo(this.rows[to]);
    return true;
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.altKey) return;
    const index = Math.max(0, this.picks.place);
    const row = this.rows[index];
    if (!row) return;
    if (this.picks.place < 0) this.picks.focusedKey = row.key;
    if (this.picks.takesKey(event, this.list.page)) this.moved();
    else if (event.ctrlKey || event.metaKey || !(this.type(event, index) || this.takesKey(event, row, index))) return;
    event.preventDefault();
  }

  private takesKey(event: KeyboardEvent, row: OutlineRow, index: number): boolean {
    if (asksForMenu(event)) {
      this.openMenuAt(row, index);
      return true;
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
      default:
        return false;
    }
    return true;
  }

  private openMenuAt(row: OutlineRow, index: number): void {
    const box = (this.list.row(index)?.element ?? this.element).getBoundingClientRect();
    this.events.menu(row, { x: box.left + 24, y: box.bottom, byKeyboard: true });
  }

  private above(index: number): OutlineRow | undefined {
    for (let i = index - 1; i >= 0; i--) if (this.rows[i].depth < this.rows[index].depth) return this.rows[i];
    return undefined;
  }
}
