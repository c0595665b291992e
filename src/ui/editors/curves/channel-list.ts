/**
 * The list of channels beside the plot, a windowed list. For the keyboard it is one grid with one tab stop: arrows move
 * from row to row and from control to control, Enter or Space acts like a click. The focus stays on the grid, whose
 * active descendant is the current control.
 */
import { EXTRAPOLATION_NAMES } from '../../../edit/commands/extrapolation.ts';
import { allKeys, unionKeys } from '../../../edit/keys/selection.ts';
import type { Character } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { onResult } from '../../state/shown-comparison.ts';
import { CHANNEL_LISTS, type ChannelListKind as ListChoice } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere, setAttribute, setStyle, setText, write } from '../../widgets/dom.ts';
import { buttonMeant, isMac } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { asksForMenu, openMenu } from '../../widgets/menu.ts';
import { type MiddleCut, middleCut } from '../../widgets/middle-cut.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { isCommand, RowSelection } from '../../widgets/table/row-selection.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { WindowedList, type WindowedRow } from '../../widgets/windowed-list.ts';
import { LIST_LABELS } from '../timeline/actions.ts';
import { channelName, isAnimated, type ListedChannel, selectedChannels } from '../timeline/channels.ts';
import { selectedKeys, selectedKeysInView, selectKeys } from '../timeline/current-take.ts';
import { extrapolationIcon } from '../timeline/key-actions.ts';
import { countOfAll, isolateOfAll, toggleIn, viewOfAll } from '../timeline/listed-of-all.ts';
import { timelineTake } from '../timeline/timeline-take.ts';
import { extrapolationEntries, openChannelMenu } from './context-menu.ts';
import { isolatedAfter } from './isolating.ts';
import { cssColour } from './scene/colours.ts';
import type { CurveLine } from './scene/scene.ts';
import { type TheirChannel, theirsText } from './scene/their-channels.ts';

/** The controls of a row, left to right. */
const CELLS = ['eye', 'name', 'in', 'out', 'pin'] as const;
type Cell = (typeof CELLS)[number];

interface Row extends WindowedRow {
  readonly cells: Readonly<Record<Cell, HTMLElement>>;
  readonly swatch: HTMLElement;
  readonly joint: MiddleCut;
  readonly dof: HTMLElement;
  readonly follows: HTMLElement;
  readonly theirs: HTMLElement;
}

/** The plot's channels. */
export interface ListSource {
  readonly channels: readonly ListedChannel[];
  line(channel: number): CurveLine | undefined;
  /** What another program printed of a listed channel, if it is compared. */
  theirs(channel: number): TheirChannel | undefined;
}

export class ChannelList {
  readonly element: HTMLElement;
  /** What is listed. */
  readonly head: HTMLElement;
  private readonly choice = element('select', { class: 'channel-choice', 'aria-label': 'Channels listed' });
  private readonly filter = element('input', {
    type: 'search',
    class: 'channel-filter',
    placeholder: 'Filter',
    'aria-label': 'Filter channels by name',
    spellcheck: 'false',
    autocomplete: 'off',
  });
  private readonly space = element('div', { class: 'channel-space' });
  private readonly empty = element('p', { class: 'empty', hidden: true });
  private readonly grid = element(
    'div',
    { class: 'channel-rows', role: 'grid', tabindex: 0, 'aria-label': 'Channels' },
    this.space,
  );
  /** Goes from the selected joint's channels to all, and back. */
  private readonly more = keepsFocusElsewhere(element('button', { type: 'button', class: 'channel-more' }));
  private readonly list: WindowedList<Row>;
  private state: ListState = { hidden: new Set(), isolated: undefined, pinned: new Set(), selected: new Set() };
  private channels: readonly ListedChannel[] = [];
  private active = 0;
  private activeCell: Cell = 'name';
  /** Those that are isolated are selected. */
  private readonly picks: RowSelection<ListedChannel>;
  private visible = false;
  readonly showSoon = oncePerFrame(() => this.show());

  constructor(
    private readonly wb: Uses<'store' | 'actions' | 'timeline' | 'settings' | 'comparing'>,
    private readonly source: ListSource,
  ) {
    this.head = element('div', { class: 'channel-head' }, this.choice, this.filter);
    this.choice.append(...CHANNEL_LISTS.map((list) => element('option', { value: list }, LIST_LABELS[list])));
    this.element = element('div', { class: 'channel-list' }, this.empty, this.grid, this.more);
    this.more.addEventListener('click', () => {
      wb.timeline.change({ list: wb.timeline.view.get().list === 'selected' ? 'all' : 'selected' });
    });
    this.choice.addEventListener('change', () => {
      const list = CHANNEL_LISTS.find((l) => l === this.choice.value);
      if (list) this.wb.timeline.change({ list: list satisfies ListChoice });
    });
    this.filter.addEventListener('input', () => wb.timeline.change({ filter: this.filter.value }));
    this.filter.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && this.filter.value) wb.timeline.change({ filter: '' });
      else if (event.key === 'ArrowDown' || event.key === 'Enter') this.grid.focus();
      else return;
      event.preventDefault();
    });
    this.picks = new RowSelection<ListedChannel>({
      keyOf: ({ channel }) => String(channel),
      keysOnlyFocus: true,
      selectOnly: (one) => this.isolate([one], false),
      toggle: (one) => this.isolate([one], true),
      selectRange: (all, _, adds) => this.isolate(all.filter(isAnimated), adds),
    });
    this.list = new WindowedList({
      scroller: this.grid,
      space: this.space,
      rowHeight: ['--channel-row', 22],
      rowsAbove: 0,
      make: makeRow,
      fill: (row, index) => this.fill(row, index, this.state),
      meant: ({ cells }) => cells[this.activeCell],
    });
    this.grid.addEventListener('keydown', (event) => this.onKey(event));
    this.grid.addEventListener('click', (event) => this.onClick(event));
    this.grid.addEventListener('dblclick', (event) => this.onDoubleClick(event));
    this.grid.addEventListener('contextmenu', (event) => this.onMenu(event));
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) this.showSoon();
    });
    wb.timeline.view.subscribe(this.showSoon);
    onResult(wb, this.showSoon);
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (visible) this.showSoon();
  }

  private show(): void {
    if (!this.visible) return;
    const { wb, grid } = this;
    const view = wb.timeline.view.get();
    this.channels = this.source.channels;
    this.showChoice(view.list);
    if (this.filter.value !== view.filter) this.filter.value = view.filter;
    const count = this.channels.length;
    write(this.empty, 'hidden', count > 0);
    write(grid, 'hidden', count === 0);
    setText(this.empty, emptyText(wb, view.list, view.filter));
    this.picks.show(this.channels);
    this.goTo(Math.max(0, Math.min(this.active, count - 1)));
    const { hidden, isolated, pinned } = viewOfAll(wb);
    this.state = {
      hidden: new Set(hidden),
      isolated: isolated && new Set(isolated),
      pinned: new Set(pinned),
      selected: new Set(selectedKeysInView(wb).map((k) => k.channel)),
    };
    this.list.show(count);
    this.list.focus(this.active);
  }

  private showChoice(list: ListChoice): void {
    const { choice, wb } = this;
    if (choice.value !== list) choice.value = list;
    const { document, selection } = wb.store;
    const character = currentCharacter(wb);
    const texts = { ...LIST_LABELS, selected: selectedLabel(character, selection) };
    for (const [i, one] of CHANNEL_LISTS.entries()) setText(choice.options[i], texts[one]);
    const all = countOfAll(wb);
    const more = list === 'selected' ? `Show all ${all} channels` : `Show only ${lowerFirst(texts.selected)}`;
    const isShort = character !== undefined && selectedChannels(character, selection) !== undefined;
    write(this.more, 'hidden', !document.characters.length || !isShort || list === 'pinned' || all === 0);
    setText(this.more, more);
  }

  private fill(row: Row, index: number, state: ListState): void {
    const listed = this.channels[index];
    const { channel } = listed;
    const line = this.source.line(channel);
    const held = timelineTake(this.wb)?.take.channels[channel];
    const name = channelName(listed);
    const keyed = isAnimated(listed);
    const hidden = state.hidden.has(channel);
    const isolated = state.isolated?.has(channel) ?? false;
    const { element: target, cells } = row;
    target.classList.toggle('keyless', !keyed);
    target.classList.toggle('not-drawn', keyed && (state.isolated ? !isolated : hidden));
    target.classList.toggle('isolated', isolated);
    target.classList.toggle('selected', state.selected.has(channel));
    row.joint.show([listed.character, listed.joint].filter(Boolean).join(' '));
    setText(row.dof, listed.dof);
    setText(row.follows, listed.follows === undefined ? '' : `← ${listed.follows}`);
    target.classList.toggle('follows', listed.follows !== undefined);
    const theirs = this.source.theirs(channel);
    setText(row.theirs, theirs ? (theirs.firstWrong === undefined ? '=' : '≠') : '');
    row.theirs.classList.toggle('wrong', theirs?.firstWrong !== undefined);
    setStyle(row.swatch, 'color', line ? cssColour(line.colour) : '');
    setStyle(row.swatch, 'visibility', line && keyed ? '' : 'hidden');
    row.swatch.classList.toggle('ring', line?.unit === 'angle');
    row.swatch.classList.toggle('bar', line?.unit !== 'angle');
    row.swatch.classList.toggle('dashed', (line?.colour.dash.length ?? 0) > 0);
    describe(cells.eye, hidden ? `Show ${name}` : `Hide ${name}`, !hidden);
    const { keyCount, sampleCount } = listed;
    const keys = sampleCount ? plural(sampleCount, 'sample') : keyed ? plural(keyCount, 'key') : 'no keys';
    const follows = listed.follows === undefined ? '' : `; linked to ${listed.follows}, so its keys have no effect`;
    describe(
      cells.name,
      `${name}, ${keys}${isolated ? ', isolated' : ''}${follows}${theirs ? `; ${theirsText(theirs)}` : ''}`,
      isolated,
    );
    const pinned = state.pinned.has(channel);
    describe(cells.pin, `${pinned ? 'Unpin' : 'Pin'} ${name}`, pinned);
    for (const side of ['in', 'out'] as const) {
      const way = side === 'in' ? held?.extrapolateIn : held?.extrapolateOut;
      const cell = cells[side];
      // Sampled channels are constant beyond their ends: there is no choice.
      write(cell, 'hidden', keyCount === 0);
      if (!way || cell.dataset.way === way) continue;
      write(cell.dataset, 'way', way);
      cell.replaceChildren(icon(extrapolationIcon(way)));
      describe(cell, `${side === 'in' ? 'Before' : 'After'} the keys: ${EXTRAPOLATION_NAMES[way]}`);
      setAttribute(cell, 'aria-haspopup', 'menu');
    }
    for (const cell of CELLS) {
      write(cells[cell], 'id', `${target.id}-${cell}`);
      cells[cell].classList.toggle('current', index === this.active && cell === this.activeCell);
    }
  }

  private indexAt(event: Event): { readonly index: number; readonly cell: Cell | undefined } | undefined {
    if (!(event.target instanceof Element)) return undefined;
    const index = this.list.indexOf(event);
    if (!this.channels[index]) return undefined;
    const name = event.target.closest<HTMLElement>('[data-cell]')?.dataset.cell;
    return { index, cell: CELLS.find((c) => c === name) };
  }

  private onClick(event: MouseEvent): void {
    const at = this.indexAt(event);
    if (!at?.cell) return;
    this.activeCell = at.cell;
    const box = event.target instanceof Element ? event.target.getBoundingClientRect() : undefined;
    this.press(at.index, event, box);
  }

  /** Gives a row the keyboard. */
  private goTo(index: number): void {
    this.active = index;
    this.picks.focusedKey = this.channels[index] && String(this.channels[index].channel);
  }

  /** Runs the current control of a row. @param box of the control */
  private press(index: number, event: MouseEvent | KeyboardEvent, box: DOMRect | undefined): void {
    const { wb, activeCell: cell } = this;
    const { channel } = this.channels[index];
    if (cell === 'eye') toggleIn(wb, 'hidden', channel);
    else if (cell === 'pin') toggleIn(wb, 'pinned', channel);
    else if (cell === 'name') {
      if (isAnimated(this.channels[index])) this.picks.pressed(this.channels[index], event);
    } else if (box) {
      const label = cell === 'in' ? 'Before the keys' : 'After the keys';
      openMenu(box, extrapolationEntries(wb, channel, cell), { label, focusFirst: event instanceof KeyboardEvent });
    }
    this.goTo(index);
    this.showSoon();
  }

  private isolate(all: readonly ListedChannel[], ctrl: boolean): void {
    const channels = all.map(({ channel }) => channel);
    isolateOfAll(this.wb, isolatedAfter(viewOfAll(this.wb).isolated, channels, ctrl));
  }

  private onDoubleClick(event: MouseEvent): void {
    const at = this.indexAt(event);
    const current = timelineTake(this.wb);
    if (at?.cell !== 'name' || !current) return;
    const keys = allKeys(current.take, [this.channels[at.index].channel]);
    selectKeys(this.wb, event.ctrlKey || event.shiftKey ? unionKeys(selectedKeys(this.wb), keys) : keys);
  }

  private onMenu(event: MouseEvent): void {
    event.preventDefault();
    if (buttonMeant(event, isMac) !== 2) {
      this.openMenuByKey();
      return;
    }
    const index = this.indexAt(event)?.index;
    if (index === undefined || !this.channels[index]) return;
    this.goTo(index);
    openChannelMenu(this.wb, this.channels[index].channel, { x: event.clientX, y: event.clientY });
    this.showSoon();
  }

  private openMenuByKey(): void {
    const box = this.list.row(this.active)?.element.getBoundingClientRect();
    const channel = this.channels[this.active]?.channel;
    if (!box || channel === undefined) return;
    openChannelMenu(this.wb, channel, { x: box.left + 24, y: box.bottom, byKeyboard: true });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.altKey || !this.channels.length) return;
    if (asksForMenu(event)) {
      event.preventDefault();
      event.stopPropagation();
      this.openMenuByKey();
      return;
    }
    const side = event.key === 'ArrowLeft' ? -1 : event.key === 'ArrowRight' ? 1 : 0;
    if (event.key === 'Enter' || event.key === ' ') {
      const box = this.list.row(this.active)?.cells[this.activeCell].getBoundingClientRect();
      this.press(this.active, event, box);
    } else if (this.picks.takesKey(event, this.list.page)) {
      this.active = this.picks.place;
      this.list.reveal(this.active);
      this.showSoon();
    } else if (side && !event.shiftKey && !isCommand(event)) {
      const next = CELLS.indexOf(this.activeCell) + side;
      this.activeCell = CELLS[Math.max(0, Math.min(CELLS.length - 1, next))];
      this.showSoon();
    } else return;
    event.preventDefault();
  }
}

function makeRow(): Row {
  const swatch = element('span', { class: 'swatch' });
  const joint = middleCut('channel-joint');
  const dof = element('span', { class: 'channel-dof' });
  // The cell's label says it too.
  const follows = element('span', { class: 'channel-follows', 'aria-hidden': 'true' });
  const theirs = element('span', { class: 'channel-theirs', 'aria-hidden': 'true' });
  const cell = (name: Cell, ...content: Node[]) => {
    const made = element('button', { type: 'button', role: 'gridcell', tabindex: -1, class: `channel-${name}` });
    write(made.dataset, 'cell', name);
    made.append(...content);
    // The focus stays on the grid when a control is clicked.
    made.addEventListener('mousedown', (event) => event.preventDefault());
    return made;
  };
  const cells = {
    eye: cell('eye', icon('eye')),
    name: cell('name', swatch, joint.element, new Text(' '), dof, follows, theirs),
    in: cell('in'),
    out: cell('out'),
    pin: cell('pin', icon('pin')),
  };
  const row = element('div', { role: 'row', class: 'channel-row' }, ...CELLS.map((c) => cells[c]));
  return { element: row, cells, swatch, joint, dof, follows, theirs };
}

interface ListState {
  readonly hidden: ReadonlySet<number>;
  readonly isolated: ReadonlySet<number> | undefined;
  readonly pinned: ReadonlySet<number>;
  readonly selected: ReadonlySet<number>;
}

function describe(target: HTMLElement, label: string, on = false): void {
  setAttribute(target, 'aria-label', label);
  setTooltip(target, label);
  target.classList.toggle('on', on);
}

/** What the list of the selection is called: without a joint it is that of the root and the morphs, or of all. */
export function selectedLabel(character: Character | undefined, selection: Selection): string {
  if (!character || (selection.characterId === character.id && selection.joint !== undefined)) {
    return LIST_LABELS.selected;
  }
  if (!selectedChannels(character, selection)) return 'All (no joint)';
  return 'Root';
}

function lowerFirst(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}

function emptyText(wb: Uses<'store'>, list: ListChoice, filter: string): string {
  if (filter) return `No channel matches “${filter}”.`;
  if (list === 'pinned') return 'No pinned channels. Click the pin in a channel’s row to keep it listed.';
  if (currentCharacter(wb)?.driver) return 'Own channels are hidden while the character is retargeted.';
  return wb.store.selection.joint === undefined ? 'No channels yet.' : 'This joint has no channels.';
}
