/**
 * How rows of a list are selected, whatever it looks like and whatever they are:
 *
 *     click   ↑ ↓ PgUp PgDn Home End   only that row
 *     … with Shift                     all rows from where the range began to that one
 *     Ctrl+click   Ctrl+Space          adds a row to the selected ones, or removes it
 *     Ctrl+↑ ↓                         to a row, which isn't selected
 *     Ctrl+A                           all
 *
 * What is selected is the owner's, who says what a gesture means for it. Space alone plays, as everywhere.
 */
import { isMac } from '../focus/keyboard.ts';
import { rowAfterKey } from '../windowed-list.ts';

export interface RowSelectionParts<Row> {
  keyOf(row: Row): string;
  selectOnly(row: Row): void;
  /** Absent, with `selectRange`, where one row at most is selected. */
  toggle?(row: Row): void;
  /**
   * @param rows exactly these, as they are listed
   * @param to the first or last of them, where the gesture ended
   * @param adds with Ctrl
   */
  selectRange?(rows: readonly Row[], to: Row, adds: boolean): void;
  /** To a row by keys that leave what is selected. */
  focus?(row: Row): void;
  /** Keys never select: their owner presses what they have gone to. */
  readonly keysOnlyFocus?: boolean;
  /** Absent where Ctrl+A is another's. */
  selectAll?(rows: readonly Row[]): void;
}

/** Of an event. */
export type Modifiers = Pick<MouseEvent, 'shiftKey' | 'ctrlKey' | 'metaKey'>;
export type PressedKey = Modifiers & Pick<KeyboardEvent, 'key' | 'altKey'>;

export class RowSelection<Row> {
  private listed: readonly Row[] = [];
  private places = new Map<string, number>();
  /** Key of the row where a range begins. */
  anchor: string | undefined;
  /** Key of the row that has the keyboard. */
  focusedKey: string | undefined;

  constructor(private readonly parts: RowSelectionParts<Row>) {}

  /** In the order in which they are seen; kept by reference. */
  show(rows: readonly Row[]): void {
    if (rows === this.listed) return;
    this.listed = rows;
    this.places = new Map(rows.map((row, i) => [this.parts.keyOf(row), i]));
  }

  get rows(): readonly Row[] {
    return this.listed;
  }

  /** Index of a row by its key; −1 if it isn't listed. */
  placeOf(key: string | undefined): number {
    return key === undefined ? -1 : (this.places.get(key) ?? -1);
  }

  /** Index of the row that has the keyboard; −1 for none. */
  get place(): number {
    return this.placeOf(this.focusedKey);
  }

  get focused(): Row | undefined {
    return this.listed[this.place];
  }

  /** Selects only this row, as a click does. */
  goTo(row: Row): void {
    this.parts.selectOnly(row);
    this.endAt(row, true);
  }

  /** A row was clicked. */
  pressed(row: Row, event: Modifiers): void {
    if (event.shiftKey && this.parts.selectRange) this.extendTo(row, event);
    else if (isCommand(event) && this.parts.toggle) this.toggle(row);
    else this.goTo(row);
  }

  /**
   * Whether it takes a key.
   *
   * @param page number of rows that a page key passes; undefined: pages are the owner's
   */
  takesKey(event: PressedKey, page: number | undefined): boolean {
    const { parts, listed, focused } = this;
    const command = isCommand(event);
    const hasModifier = event.ctrlKey || event.metaKey;
    if (event.altKey || (hasModifier && (!command || !parts.toggle || parts.keysOnlyFocus))) return false;
    const isTo = page !== undefined || !event.key.startsWith('Page');
    const to = isTo ? rowAfterKey(event.key, this.place, listed.length, page ?? 1) : undefined;
    const next = to === undefined ? undefined : listed[to];
    if (next) return this.keyTo(next, event);
    if (command && event.key === ' ' && focused) this.toggle(focused);
    else if (command && !event.shiftKey && event.key.toLowerCase() === 'a' && listed.length > 0 && parts.selectAll) {
      parts.selectAll(listed);
    } else return false;
    return true;
  }

  private keyTo(row: Row, event: PressedKey): boolean {
    const { parts } = this;
    if (parts.keysOnlyFocus && event.shiftKey) return false;
    if (event.shiftKey && parts.selectRange) this.extendTo(row, event);
    else if (isCommand(event) || parts.keysOnlyFocus) {
      parts.focus?.(row);
      this.endAt(row, false);
    } else this.goTo(row);
    return true;
  }

  private toggle(row: Row): void {
    this.parts.toggle?.(row);
    this.endAt(row, true);
  }

  private extendTo(row: Row, event: Modifiers): void {
    const to = this.placeOf(this.parts.keyOf(row));
    const began = [this.anchor, this.focusedKey].map((key) => this.placeOf(key)).find((place) => place >= 0) ?? to;
    const rows = this.listed.slice(Math.min(began, to), Math.max(began, to) + 1);
    this.parts.selectRange?.(rows, row, isCommand(event));
    this.endAt(row, false);
  }

  /** After the owner was told, which may have made another row of it: the character of a skin. */
  private endAt(row: Row, begins: boolean): void {
    this.focusedKey = this.parts.keyOf(row);
    if (begins) this.anchor = this.focusedKey;
  }
}

/** Whether it has Ctrl, or ⌘ on a Mac. */
export function isCommand({ ctrlKey, metaKey }: Modifiers): boolean {
  return isMac ? metaKey : ctrlKey;
}
