/**
 * The table of takes, a windowed list with a header. The focus is on the table, except for fields and buttons in a row.
 *
 *     ↑ ↓ Home End     to a row; Shift extends the selection     Ctrl+A   all
 *     Enter            plays it alone                                  Delete   removes the selected takes
 *     F2               edits its start time                                  Ctrl+Space   toggles it in the selection
 */

import type { TakeColumn, TakeOrder } from '../../state/takes.ts';
import { element } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import type { MenuPlace } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { type SortColumn, SortHeads } from '../../widgets/sort-heads.ts';
import { WindowedList } from '../../widgets/windowed-list.ts';
import { type RowEvents, type RowState, RowView } from './row.ts';
import type { TakeRow } from './rows.ts';

export interface TableEvents extends RowEvents {
  sort(order: TakeOrder | undefined): void;
  choose(chosen: ReadonlySet<string>, focused: TakeRow): void;
  remove(rows: readonly TakeRow[]): void;
  menu(row: TakeRow, at: MenuPlace): void;
  /** Beside the rows. */
  menuOfAll(at: MenuPlace): void;
}

/** State of the list beside its rows. */
export interface TableState {
  readonly order: TakeOrder | undefined;
  readonly chosen: ReadonlySet<string>;
  readonly focused: string | undefined;
  compared(row: TakeRow): RowState['compared'];
  readonly framesPerSecond: number;
}

const COLUMNS: readonly SortColumn<TakeColumn>[] = [
  ['name', 'Take', '', 'Name of the take'],
  ['character', 'Character', 'take-character', 'If its name differs from the take'],
  ['duration', 'Length', 'number', 'Seconds from first to last played frame or key'],
  ['frames', 'Frames', 'number take-frames', 'Dimmed: keyed, counted at the playback frame rate'],
  ['rate', 'FPS', 'number take-rate', 'Frames per second'],
  ['start', 'Start time', 'number', 'When the take starts on the timeline, in seconds'],
  ['x', 'x', 'number take-place', 'Place along x'],
  ['z', 'z', 'number take-place', 'Place along z'],
  ['file', 'File', 'take-file', 'Where it came from'],
];

export class TakeTable {
  readonly element = element('div', {
    class: 'sort-table take-table',
    role: 'grid',
    tabindex: 0,
    [HAS_KEYS]: true,
    'aria-label': 'Takes',
    'aria-multiselectable': 'true',
    'aria-colcount': COLUMNS.length + 1,
  });
  private readonly space = element('div', { class: 'sort-space', role: 'rowgroup' });
  private readonly heads: SortHeads<TakeColumn>;
  private readonly list: WindowedList<RowView>;
  private rows: readonly TakeRow[] = [];
  private places = new Map<string, number>();
  private state: TableState | undefined;
  /** Row from which Shift extends. */
  private anchor: string | undefined;

  constructor(private readonly events: TableEvents) {
    this.heads = new SortHeads('take-head', COLUMNS, (column) => events.sort(nextOrder(this.state?.order, column)), {
      label: 'Shown',
    });
    this.element.append(this.heads.element, this.space);
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.space.addEventListener('click', (event) => this.onClick(event));
    this.space.addEventListener('dblclick', (event) => {
      const row = this.rowAt(event);
      if (row && !isControl(event.target)) events.play(row);
    });
    this.space.addEventListener('contextmenu', (event) => this.onMenu(event));
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      rowHeight: ['--take-row', 24],
      rowsAbove: 1,
      headHeight: () => this.heads.height,
      keyOf: (index) => this.rows[index].key,
      make: (index) => new RowView(this.rows[index], events),
      fill: (view, index) => this.fill(view, this.rows[index]),
    });
  }

  show(rows: readonly TakeRow[], state: TableState): void {
    const focusMoved = state.focused !== this.state?.focused;
    if (rows !== this.rows) {
      this.rows = rows;
      this.places = new Map(rows.map((row, i) => [row.key, i]));
    }
    this.state = state;
    this.heads.show(state.order);
    const focused = state.focused === undefined ? -1 : (this.places.get(state.focused) ?? -1);
    if (focusMoved) this.list.reveal(focused);
    this.list.show(rows.length);
    this.list.focus(focused);
  }

  private fill(view: RowView, row: TakeRow): void {
    const { state } = this;
    if (!state) return;
    view.show(row, {
      chosen: state.chosen.has(row.key),
      focused: state.focused === row.key,
      compared: state.compared(row),
      framesPerSecond: state.framesPerSecond,
    });
  }

  private rowAt(event: Event): TakeRow | undefined {
    return this.rows[this.list.indexOf(event)];
  }

  // Selection.

  private onClick(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (!row || isControl(event.target)) return;
    const chosen = this.state?.chosen ?? new Set();
    if (event.shiftKey) this.extendTo(row);
    else if (isMac ? event.metaKey : event.ctrlKey) {
      const next = new Set(chosen);
      if (!next.delete(row.key)) next.add(row.key);
      this.anchor = row.key;
      this.events.choose(next, row);
    } else this.goTo(row);
  }

  private goTo(row: TakeRow): void {
    this.anchor = row.key;
    this.events.choose(new Set([row.key]), row);
  }

  private extendTo(row: TakeRow): void {
    const from = this.places.get(this.anchor ?? this.state?.focused ?? row.key) ?? 0;
    const to = this.places.get(row.key) ?? 0;
    const between = this.rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    this.events.choose(new Set(between.map((r) => r.key)), row);
  }

  private onMenu(event: MouseEvent): void {
    const row = this.rowAt(event);
    if (event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    if (!row) {
      this.events.menuOfAll({ x: event.clientX, y: event.clientY });
      return;
    }
    if (!this.state?.chosen.has(row.key)) this.goTo(row);
    this.events.menu(row, { x: event.clientX, y: event.clientY });
  }

  // The keyboard.

  private onKey(event: KeyboardEvent): void {
    // Keys in a field belong to it.
    if (event.target !== this.element || event.isComposing) return;
    const { rows, state } = this;
    const at = state?.focused === undefined ? -1 : (this.places.get(state.focused) ?? -1);
    const row: TakeRow | undefined = rows[at];
    const command = isMac ? event.metaKey : event.ctrlKey;
    const walk = (to: number) => {
      const next = rows[Math.max(0, Math.min(rows.length - 1, to))];
      if (!next) return;
      if (event.shiftKey) this.extendTo(next);
      else if (command) this.events.choose(state?.chosen ?? new Set(), next);
      else this.goTo(next);
    };
    switch (event.key) {
      case 'ArrowDown':
        walk(at + 1);
        break;
      case 'ArrowUp':
        walk(at < 0 ? rows.length - 1 : at - 1);
        break;
      case 'Home':
        walk(0);
        break;
      case 'End':
        walk(rows.length - 1);
        break;
      case 'a':
      case 'A':
        if (!command) return;
        if (row ?? rows[0]) this.events.choose(new Set(rows.map((r) => r.key)), row ?? rows[0]);
        break;
      case 'Enter':
        if (!row) return;
        this.events.play(row);
        break;
      case ' ':
        // Space alone plays, here as everywhere.
        if (!row || !command) return;
        this.toggleChosen(row);
        break;
      case 'F2':
        if (!row) return;
        this.list.row(at)?.edit();
        break;
      case 'Delete':
      case 'Backspace':
        this.events.remove(rows.filter((r) => state?.chosen.has(r.key)));
        break;
      case 'ContextMenu':
      case 'F10':
        if (!row || (event.key === 'F10' && !event.shiftKey)) return;
        this.openMenuAtRow(at);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  private toggleChosen(row: TakeRow): void {
    const next = new Set(this.state?.chosen);
    if (!next.delete(row.key)) next.add(row.key);
    this.events.choose(next, row);
  }

  private openMenuAtRow(place: number): void {
    const row = this.rows[place];
    const box = this.list.row(place)?.element.getBoundingClientRect();
    if (!this.state?.chosen.has(row.key)) this.goTo(row);
    if (box) this.events.menu(row, { x: box.left + 60, y: box.bottom, byKeyboard: true });
  }
}

/** Ascending, then descending, then the document's order. */
function nextOrder(now: TakeOrder | undefined, column: TakeColumn): TakeOrder | undefined {
  if (now?.column !== column) return { column, descending: false };
  return now.descending ? undefined : { column, descending: true };
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('input,button') !== null;
}

/** `3 of 52 takes` and `, 2 selected`, which is empty for fewer. */
export function countTexts(shown: number, all: number, chosen: number): readonly [takes: string, selected: string] {
  const takes = shown === all ? plural(all, 'take') : `${shown} of ${plural(all, 'take')}`;
  return [takes, chosen > 1 ? `, ${chosen} selected` : ''];
}
