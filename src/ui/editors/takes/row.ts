/** One row of the table of takes: cells created once, and updated for another take. */
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { count, duration, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import type { TakeRow } from './rows.ts';

export interface RowEvents {
  toggle(row: TakeRow): void;
  play(row: TakeRow): void;
  /** @param seconds of the transport */
  startAt(row: TakeRow, seconds: number): void;
  /** Either of the two; the other stays. */
  place(row: TakeRow, to: { readonly x?: number; readonly z?: number }): void;
  refuse(reason: string): void;
}

/** State of a row in the list. */
export interface RowState {
  readonly chosen: boolean;
  readonly focused: boolean;
  /** Which of the two compared takes it is. */
  readonly compared: 'first' | 'second' | undefined;
  /** Frames per second of the transport, for takes without frames of their own. */
  readonly framesPerSecond: number;
}

export class RowView {
  readonly element: HTMLElement;
  private row: TakeRow;
  private readonly mark = element('span', { class: 'take-mark', 'aria-hidden': 'true' });
  private readonly name = middleCut('');
  private readonly note = element('span', { class: 'take-note' });
  private readonly character = cell('take-character');
  private readonly duration = cell('number');
  private readonly frames = cell('number take-frames');
  private readonly rate = cell('number take-rate');
  private readonly file = cell('take-file');
  private readonly nameCell: HTMLElement;
  private readonly eye: HTMLButtonElement;
  private readonly fields: Readonly<Record<'start' | 'x' | 'z', NumberField>>;

  constructor(row: TakeRow, events: RowEvents) {
    this.row = row;
    const field = (label: string, decimals: number, commit: (row: TakeRow, value: number) => void, step: number) =>
      new NumberField({
        label,
        // Coarse enough for a table; the tooltip is exact.
        text: (value) => shown(value, decimals),
        commit: (value) => commit(this.row, value),
        refuse: events.refuse,
        step,
      });
    this.fields = {
      start: field('Start time in seconds', 3, events.startAt, 0.1),
      x: field('Place along x', 2, (r, x) => events.place(r, { x }), 0.1),
      z: field('Place along z', 2, (r, z) => events.place(r, { z }), 0.1),
    };
    for (const { element: input } of Object.values(this.fields)) write(input, 'tabIndex', -1);
    this.eye = keepsFocusElsewhere(
      button('Show', { class: 'tool small', tabindex: -1 }, '', () => events.toggle(this.row)),
    );
    const play = keepsFocusElsewhere(
      button(
        'Play alone',
        { class: 'tool small take-play', tabindex: -1, tooltip: 'Play alone (Enter)' },
        icon('play'),
        () => events.play(this.row),
      ),
    );
    this.nameCell = cell('take-name', this.mark, this.name.element, this.note);
    this.element = element(
      'div',
      { class: 'sort-row take-row', role: 'row' },
      cell('take-shown', this.eye, play),
      this.nameCell,
      this.character,
      this.duration,
      this.frames,
      this.rate,
      element('div', { role: 'gridcell', class: 'number' }, this.fields.start.element),
      element('div', { role: 'gridcell', class: 'number take-place' }, this.fields.x.element),
      element('div', { role: 'gridcell', class: 'number take-place' }, this.fields.z.element),
      this.file,
    );
  }

  /** Focuses the field of its start time. */
  edit(): void {
    this.fields.start.element.focus();
  }

  show(row: TakeRow, { chosen, focused, compared, framesPerSecond }: RowState): void {
    this.row = row;
    const { element: target, eye, fields } = this;
    setAttribute(target, 'aria-selected', String(chosen));
    target.classList.toggle('hidden-take', !row.isShown && !compared);
    // The second take of one character is drawn beside the one that it plays.
    const isSeen = row.isShown || (compared !== undefined && !row.isHidden);
    if (eye.dataset.shown !== String(isSeen)) {
      write(eye.dataset, 'shown', String(isSeen));
      eye.replaceChildren(icon(isSeen ? 'eye' : 'eyeOff'));
      eye.classList.toggle('on', isSeen);
      setAttribute(eye, 'aria-pressed', String(isSeen));
      setTooltip(eye, isSeen ? 'Visible. Click to hide' : 'Hidden. Click to show');
    }
    setAttribute(eye, 'aria-label', `Show ${row.name}`);
    write(this.mark, 'className', `take-mark ${compared ?? ''}`);
    this.name.show(row.name || 'unnamed');
    setText(this.note, row.note);
    setTooltip(this.nameCell, row.note ? `${row.name}, ${row.note}` : row.name);
    setText(this.character, row.character);
    setText(this.duration, duration(row.durationSeconds));
    const own = row.framesPerSecond;
    // Keys at uneven times have no frames: shows how many the transport would count, and says so.
    const frames = row.frameCount ?? Math.round(row.durationSeconds * framesPerSecond) + 1;
    setText(this.frames, count(frames));
    this.frames.classList.toggle('faint', own === undefined);
    setTooltip(
      this.frames,
      own === undefined ? `Keyed; ${count(frames)} frames at the playback frame rate` : undefined,
    );
    setText(this.rate, own === undefined ? 'keys' : shown(own, 2));
    this.rate.classList.toggle('faint', row.isKeyed);
    setTooltip(this.rate, row.isKeyed ? (own === undefined ? UNEVEN : EVEN) : undefined);
    setText(this.file, row.file);
    setTooltip(this.file, row.file || undefined);
    fields.start.show(row.startSeconds);
    fields.x.show(row.x);
    fields.z.show(row.z);
    // Only the fields of the focused row are tab stops.
    for (const { element: input } of Object.values(fields)) write(input, 'tabIndex', focused ? 0 : -1);
  }
}

const UNEVEN = 'Keyed, at uneven times: it plays at the playback frame rate';
const EVEN = 'Keyed, on frames of this rate';

function cell(className: string, ...children: Node[]): HTMLElement {
  return element('div', { role: 'gridcell', class: `sort-cell ${className}` }, ...children);
}
