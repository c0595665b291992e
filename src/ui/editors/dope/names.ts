/**
 * The names beside the sheet: a windowed list of all rows except the summary, which stays on top. It scrolls for both:
 * the sheet is drawn at its scroll position.
 */
import type { SelectedPart } from '../../../model/session.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import type { MenuPlace } from '../../widgets/menu.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { rowAfterKey, WindowedList, type WindowedRow } from '../../widgets/windowed-list.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';

export interface NameEvents {
  /** @param every all other rows too */
  fold(row: DopeRow, open: boolean, every: boolean): void;
  /** By click or arrow keys. */
  choose(row: DopeRow): void;
  selectKeys(row: DopeRow, adds: boolean): void;
  menu(row: DopeRow, at: MenuPlace): void;
  scrolled(): void;
}

/** Number of keys of a row, and of selected ones. */
export type CountKeys = (row: DopeRow) => { readonly keys: number; readonly selected: number };

export class DopeNames {
  readonly element = element('div', {
    role: 'treegrid',
    class: 'dope-names',
    tabindex: 0,
    'aria-label': 'Rows of the dope sheet',
    'aria-multiselectable': 'true',
    'aria-colcount': 2,
  });
  private readonly summary = element('div', { class: 'dope-summary', role: 'presentation' });
  private readonly space = element('div', { class: 'dope-space', role: 'presentation' });
  private rows: readonly DopeRow[] = [];
  private readonly list: WindowedList<NameRow>;
  private focusedKey: string | undefined;
  private isSelected: (row: DopeRow) => boolean = () => false;

  constructor(
    private readonly events: NameEvents,
    private readonly countKeys: CountKeys,
  ) {
    this.element.append(this.summary, this.space);
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      pinned: this.summary,
      rowHeight: ['--dope-row', 20],
      rowsAbove: 0,
      headHeight: () => this.rowHeight,
      make: makeRow,
      fill: (row, index) => this.fill(row, this.rows[index]),
    });
    this.element.addEventListener('scroll', () => events.scrolled());
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => this.onClick(event));
    this.element.addEventListener('contextmenu', (event) => this.onMenu(event));
  }

  get rowHeight(): number {
    return this.list.rowHeight;
  }

  get scrollTop(): number {
    return this.element.scrollTop;
  }

  /** Clamped to the rows. */
  scrollTo(top: number): void {
    this.element.scrollTop = top;
  }

  show(rows: readonly DopeRow[]): void {
    this.rows = rows;
    this.list.show(rows.length);
    this.point();
  }

  /** Updates counts and marks of the rows in view. */
  refresh(isSelected: (row: DopeRow) => boolean): void {
    this.isSelected = isSelected;
    this.list.each((row, index) => this.mark(row, this.rows[index]));
  }

  /** Scrolls a joint's row into view. */
  reveal({ characterId: id, joint }: SelectedPart): void {
    const isOf = ({ characterId = id }: DopeRow) => characterId === id;
    const index = this.rows.findIndex((row) => row.kind === 'joint' && row.joint === joint && isOf(row));
    if (index < 0) return;
    this.focusedKey = this.rows[index].key;
    this.list.reveal(index);
    this.point();
  }

  private fill(view: NameRow, row: DopeRow): void {
    const { element: made, name } = view;
    const { axis, unit, follows } = row;
    write(made, 'className', `dope-row dope-row-${row.kind}${follows === undefined ? '' : ' follows'}`);
    setAttribute(made, 'aria-level', String(row.depth + 1));
    setAttribute(made, 'aria-expanded', row.fold === undefined ? undefined : String(row.expanded));
    const twisty = element('span', { class: 'twisty' });
    if (row.fold !== undefined) twisty.append(icon('fold'));
    const text = rowName(row);
    const tooltip = follows === undefined ? text : `${text}: linked to ${follows}, so its keys have no effect`;
    const label = element(row.label || row.kind === 'summary' ? 'span' : 'i', { class: 'label', tooltip });
    const cut = middleCut('');
    cut.show(text);
    label.append(cut.element);
    if (follows !== undefined) label.append(element('span', { class: 'dope-follows' }, ` ← ${follows}`));
    name.replaceChildren(twisty, ...(axis ? [dot(axis, unit === 'length')] : []), label);
    this.mark(view, row);
  }

  private mark({ element: made, count }: NameRow, row: DopeRow): void {
    setAttribute(made, 'aria-selected', String(this.isSelected(row)));
    const { keys, selected } = this.countKeys(row);
    const words = selected ? `${selected} of ${plural(keys, 'key')} selected` : plural(keys, 'key');
    if (count.getAttribute('aria-label') === words) return;
    setText(count, keys === 0 ? '' : selected ? `${selected}/${keys}` : String(keys));
    setTooltip(count, words);
    setAttribute(count, 'aria-label', words);
    count.classList.toggle('some', selected > 0);
  }

  private point(): void {
    this.list.focus(this.rows.findIndex((row) => row.key === this.focusedKey));
  }

  private onClick(event: MouseEvent): void {
    const row = this.rows[this.list.indexOf(event)];
    if (!row || !(event.target instanceof Element)) return;
    if (event.target.closest('.twisty') && row.fold !== undefined) this.events.fold(row, !row.expanded, event.altKey);
    else if (event.target.closest('.dope-count') || row.kind === 'summary') this.pick(row, event.shiftKey);
    else this.goTo(row);
  }

  private pick(row: DopeRow, adds: boolean): void {
    this.focusedKey = row.key;
    this.events.selectKeys(row, adds);
    this.point();
  }

  private goTo(row: DopeRow | undefined): void {
    if (!row) return;
    this.focusedKey = row.key;
    this.list.reveal(this.rows.indexOf(row));
    this.events.choose(row);
    this.point();
  }

  private onMenu(event: MouseEvent): void {
    const row = this.rows[this.list.indexOf(event)];
    if (!row) return;
    event.preventDefault();
    this.focusedKey = row.key;
    this.point();
    this.events.menu(row, { x: event.clientX, y: event.clientY });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.ctrlKey || event.metaKey || event.altKey || !this.rows.length) return;
    const index = Math.max(
      0,
      this.rows.findIndex((row) => row.key === this.focusedKey),
    );
    const row = this.rows[index];
    const last = this.rows.length - 1;
    const from = this.focusedKey === undefined && event.key === 'ArrowDown' ? -1 : index;
    const to = rowAfterKey(event.key, from, this.rows.length, this.list.page);
    if (to !== undefined) {
      this.goTo(this.rows[to]);
      event.preventDefault();
      return;
    }
    switch (event.key) {
      case 'ArrowRight':
        if (row.fold === undefined) return;
        if (row.expanded) this.goTo(this.rows[Math.min(last, index + 1)]);
        else this.events.fold(row, true, false);
        break;
      case 'ArrowLeft':
        if (row.expanded) this.events.fold(row, false, false);
        else if (row.depth > 0) this.goTo(this.above(index));
        else return;
        break;
      case 'Enter':
        this.pick(row, event.shiftKey);
        break;
      case 'ContextMenu':
        this.openMenuAt(index);
        break;
      case 'F10':
        if (!event.shiftKey) return;
        this.openMenuAt(index);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  private above(index: number): DopeRow | undefined {
    for (let i = index - 1; i >= 0; i--) if (this.rows[i].depth < this.rows[index].depth) return this.rows[i];
    return undefined;
  }

  private openMenuAt(index: number): void {
    const box = (this.list.row(index)?.element ?? this.element).getBoundingClientRect();
    this.events.menu(this.rows[index], { x: box.left + 24, y: box.bottom, byKeyboard: true });
  }
}

interface NameRow extends WindowedRow {
  readonly name: HTMLElement;
  readonly count: HTMLElement;
}

function makeRow(): NameRow {
  const name = element('span', { role: 'rowheader', class: 'dope-name' });
  const count = element('span', { role: 'gridcell', class: 'dope-count' });
  return { element: element('div', { role: 'row' }, name, count), name, count };
}

/** The displayed name of a row. */
export function rowName(row: DopeRow): string {
  if (row.kind === 'summary') return 'All keys';
  return row.label || (row.joint === undefined ? 'unnamed' : jointName(undefined, row.joint));
}

/** A ring turns, a bar moves. */
function dot(axis: string, moves: boolean): HTMLElement {
  return element('span', {
    class: `swatch ${moves ? `bar move-${axis}` : `ring axis-${axis}`}`,
    'aria-hidden': 'true',
  });
}
