/**
 * The names beside the sheet, as a tree of which only the rows in view are in the page. It is the scroller of both: the
 * sheet is drawn to where this stands. The summary stays on top. The focus is on the tree itself and points at its row
 * (`aria-activedescendant`), for a row may leave the page while focused.
 */
import { jointName } from '../../../model/joint-name.ts';
import { element, setAttribute, setText, uniqueId } from '../../kit/dom.ts';
import { icon } from '../../kit/icons.ts';
import { plural } from '../../kit/number-text.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';

export interface NameEvents {
  /** @param every all rows along with it */
  fold(row: DopeRow, open: boolean, every: boolean): void;
  /** Gone to, by a click or the arrow keys. */
  choose(row: DopeRow): void;
  selectKeys(row: DopeRow, adds: boolean): void;
  menu(row: DopeRow, at: { readonly x: number; readonly y: number }): void;
  scrolled(): void;
}

/** How many keys a row has, and how many of them are selected. */
export type CountKeys = (row: DopeRow) => { readonly keys: number; readonly selected: number };

const OVERSCAN = 4;

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
  private readonly drawn = new Map<number, HTMLElement>();
  private focusedKey: string | undefined;
  private selectedJoint: number | undefined;
  private height = 20;
  private readonly idPrefix = uniqueId('dope-row');

  constructor(
    private readonly events: NameEvents,
    private readonly countKeys: CountKeys,
  ) {
    this.element.append(this.summary, this.space);
    this.element.addEventListener('scroll', () => {
      this.draw();
      events.scrolled();
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('click', (event) => this.onClick(event));
    this.element.addEventListener('contextmenu', (event) => this.onMenu(event));
  }

  get rowHeight(): number {
    return this.height;
  }

  get scrollTop(): number {
    return this.element.scrollTop;
  }

  /** As far as there are rows. */
  scrollTo(top: number): void {
    this.element.scrollTop = top;
  }

  /** Another size of the panel, or other sizes of controls. */
  resized(): void {
    this.height = Number.parseFloat(getComputedStyle(this.element).getPropertyValue('--dope-row')) || 20;
    this.drawAnew();
  }

  show(rows: readonly DopeRow[]): void {
    this.rows = rows;
    this.drawAnew();
  }

  /** Counts and marks, on the rows that are there. */
  refresh(selectedJoint: number | undefined): void {
    this.selectedJoint = selectedJoint;
    this.mark();
  }

  /** Brings a joint's row into view. */
  reveal(joint: number): void {
    const index = this.rows.findIndex((row) => row.kind === 'joint' && row.joint === joint);
    if (index < 0) return;
    this.focusedKey = this.rows[index].key;
    this.revealRow(index);
    this.mark();
  }

  /** Below the summary a row stands at index · height, the summary being the first. */
  private revealRow(index: number): void {
    if (index === 0) return;
    const top = (index - 1) * this.height;
    const room = this.element.clientHeight - this.height;
    const { scrollTop } = this.element;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (top + this.height > scrollTop + room) this.element.scrollTop = top + this.height - room;
  }

  private drawAnew(): void {
    this.summary.replaceChildren();
    this.space.replaceChildren();
    this.drawn.clear();
    this.space.style.height = `${Math.max(0, this.rows.length - 1) * this.height}px`;
    this.element.setAttribute('aria-rowcount', String(this.rows.length));
    this.draw();
  }

  private draw(): void {
    const top = Math.floor(this.element.scrollTop / this.height);
    const first = Math.max(1, 1 + top - OVERSCAN);
    const end = Math.min(this.rows.length, 1 + top + Math.ceil(this.element.clientHeight / this.height) + OVERSCAN);
    for (const [index, row] of this.drawn) {
      if (index === 0 || (index >= first && index < end)) continue;
      row.remove();
      this.drawn.delete(index);
    }
    if (this.rows.length && !this.drawn.has(0)) this.summary.append(this.drawRow(0));
    for (let i = first; i < end; i++) if (!this.drawn.has(i)) this.space.append(this.drawRow(i));
    this.mark();
  }

  private drawRow(index: number): HTMLElement {
    const row = this.rows[index];
    const twisty = element('span', { class: 'twisty' });
    if (row.fold !== undefined) twisty.append(icon('fold'));
    const { axis, follows } = row;
    const text = rowName(row);
    const title = follows === undefined ? text : `${text}: linked to ${follows}, so its keys have no effect`;
    const label = element(row.label || row.kind === 'summary' ? 'span' : 'i', { class: 'label', title }, text);
    if (follows !== undefined) label.append(element('span', { class: 'dope-follows' }, ` ← ${follows}`));
    const made = element(
      'div',
      {
        role: 'row',
        id: `${this.idPrefix}-${index}`,
        class: `dope-row dope-row-${row.kind}${follows === undefined ? '' : ' follows'}`,
        'data-index': index,
        'aria-level': row.depth + 1,
        'aria-rowindex': index + 1,
        'aria-expanded': row.fold === undefined ? undefined : String(row.expanded),
      },
      element('span', { role: 'rowheader', class: 'dope-name' }, twisty, axis && dot(axis), label),
      element('span', { role: 'gridcell', class: 'dope-count' }),
    );
    if (index > 0) made.style.top = `${(index - 1) * this.height}px`;
    this.drawn.set(index, made);
    return made;
  }

  private mark(): void {
    let focused: number | undefined;
    for (const [index, made] of this.drawn) {
      const row = this.rows[index];
      if (!row) continue;
      const chosen = row.joint !== undefined && row.joint === this.selectedJoint;
      setAttribute(made, 'aria-selected', String(chosen));
      made.classList.toggle('focused', row.key === this.focusedKey);
      if (row.key === this.focusedKey) focused = index;
      const { keys, selected } = this.countKeys(row);
      const count = made.lastElementChild;
      if (!(count instanceof HTMLElement)) continue;
      const words = selected ? `${selected} of ${plural(keys, 'key')} selected` : plural(keys, 'key');
      if (count.title === words) continue;
      setText(count, keys === 0 ? '' : selected ? `${selected}/${keys}` : String(keys));
      count.title = words;
      count.setAttribute('aria-label', words);
      count.classList.toggle('some', selected > 0);
    }
    setAttribute(
      this.element,
      'aria-activedescendant',
      focused === undefined ? undefined : `${this.idPrefix}-${focused}`,
    );
  }

  private indexAt(event: Event): number {
    const target = event.target instanceof Element ? event.target.closest<HTMLElement>('[data-index]') : null;
    return target ? Number(target.dataset.index) : -1;
  }

  private onClick(event: MouseEvent): void {
    const row = this.rows[this.indexAt(event)];
    if (!row || !(event.target instanceof Element)) return;
    if (event.target.closest('.twisty') && row.fold !== undefined) this.events.fold(row, !row.expanded, event.altKey);
    else if (event.target.closest('.dope-count') || row.kind === 'summary') this.pick(row, event.shiftKey);
    else this.goTo(row);
  }

  private pick(row: DopeRow, adds: boolean): void {
    this.focusedKey = row.key;
    this.events.selectKeys(row, adds);
    this.mark();
  }

  private goTo(row: DopeRow | undefined): void {
    if (!row) return;
    this.focusedKey = row.key;
    this.revealRow(this.rows.indexOf(row));
    this.events.choose(row);
    this.mark();
  }

  private onMenu(event: MouseEvent): void {
    const row = this.rows[this.indexAt(event)];
    if (!row) return;
    event.preventDefault();
    this.focusedKey = row.key;
    this.mark();
    this.events.menu(row, { x: event.clientX, y: event.clientY });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.ctrlKey || event.metaKey || event.altKey || !this.rows.length) return;
    const index = Math.max(
      0,
      this.rows.findIndex((row) => row.key === this.focusedKey),
    );
    const row = this.rows[index];
    const page = Math.max(1, Math.floor(this.element.clientHeight / this.height) - 2);
    const last = this.rows.length - 1;
    switch (event.key) {
      case 'ArrowDown':
        this.goTo(this.rows[Math.min(last, this.focusedKey === undefined ? 0 : index + 1)]);
        break;
      case 'ArrowUp':
        this.goTo(this.rows[Math.max(0, index - 1)]);
        break;
      case 'PageDown':
        this.goTo(this.rows[Math.min(last, index + page)]);
        break;
      case 'PageUp':
        this.goTo(this.rows[Math.max(0, index - page)]);
        break;
      case 'Home':
        this.goTo(this.rows[0]);
        break;
      case 'End':
        this.goTo(this.rows[last]);
        break;
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
    const box = (this.drawn.get(index) ?? this.element).getBoundingClientRect();
    this.events.menu(this.rows[index], { x: box.left + 24, y: box.bottom });
  }
}

/** What a row is called on screen. */
export function rowName(row: DopeRow): string {
  if (row.kind === 'summary') return 'All keys';
  return row.label || (row.joint === undefined ? 'unnamed' : jointName(undefined, row.joint));
}

function dot(axis: string): HTMLElement {
  return element('span', { class: `dope-axis axis-${axis}`, 'aria-hidden': 'true' });
}
