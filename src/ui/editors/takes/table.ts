/**
 * The table of takes.
 *
 *     Enter     plays it alone              Delete   removes the selected takes
 *     F2        edits its start time
 */

import type { TakeColumn, TakeOrder } from '../../state/takes.ts';
import type { MenuPlace } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import type { SortColumn } from '../../widgets/table/sort-heads.ts';
import { SortTable, type SortTableState } from '../../widgets/table/sort-table.ts';
import { type RowEvents, type RowState, RowView } from './row.ts';
import type { TakeRow } from './rows.ts';

export interface TableEvents extends RowEvents {
  sort(order: TakeOrder | undefined): void;
  choose(chosen: ReadonlySet<string>, focused: TakeRow): void;
  remove(rows: readonly TakeRow[]): void;
  /** @param row undefined: beside the rows */
  menu(row: TakeRow | undefined, at: MenuPlace): void;
}

/** State of the list beside its rows. */
export interface TableState extends SortTableState<TakeColumn> {
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
  readonly element: HTMLElement;
  private readonly table: SortTable<TakeRow, RowView, TakeColumn>;
  private rows: readonly TakeRow[] = [];
  private state: TableState | undefined;

  constructor(private readonly events: TableEvents) {
    this.table = new SortTable({
      kind: 'take',
      label: 'Takes',
      columns: COLUMNS,
      lead: 'Shown',
      rowHeight: ['--take-row', 24],
      isMultiple: true,
      menuLeft: 60,
      ...{ sort: events.sort, choose: events.choose, menu: events.menu },
      keyOf: ({ key }) => key,
      make: (row) => new RowView(row, events),
      fill: (view, row, chosen) => this.fill(view, row, chosen),
      takesKey: (event, row) => this.takesKey(event, row),
    });
    this.element = this.table.element;
    this.element.addEventListener('dblclick', (event) => {
      const row = this.table.rowAt(event);
      if (row) events.play(row);
    });
  }

  show(rows: readonly TakeRow[], state: TableState): void {
    this.rows = rows;
    this.state = state;
    this.table.show(rows, state);
  }

  private fill(view: RowView, row: TakeRow, chosen: boolean): void {
    const { state } = this;
    if (!state) return;
    const { framesPerSecond } = state;
    view.show(row, { chosen, focused: state.focused === row.key, compared: state.compared(row), framesPerSecond });
  }

  private takesKey({ key }: KeyboardEvent, row: TakeRow | undefined): boolean {
    const { events, state } = this;
    if (key === 'Delete' || key === 'Backspace') events.remove(this.rows.filter((r) => state?.chosen.has(r.key)));
    else if (row && key === 'Enter') events.play(row);
    else if (row && key === 'F2') this.table.viewOf(row)?.edit();
    else return false;
    return true;
  }
}

/** `3 of 52 takes` and `, 2 selected`, which is empty for fewer. */
export function countTexts(shown: number, all: number, chosen: number): readonly [takes: string, selected: string] {
  const takes = shown === all ? plural(all, 'take') : `${shown} of ${plural(all, 'take')}`;
  return [takes, chosen > 1 ? `, ${chosen} selected` : ''];
}
