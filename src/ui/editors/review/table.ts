/**
 * The list of takes in review: a windowed grid with a header. The take with the focus is the one that is shown.
 *
 *     ↑ ↓ Home End PageUp PageDown   to a row; Shift extends the selection     Ctrl+A   all
 *     Ctrl+Space                     toggles it in the selection
 *     G B 0…5 J Delete               are actions of the panel (`actions.ts`)
 */

import type { ReviewColumn, ReviewView } from '../../state/review.ts';
import { element } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { asksForMenu, type MenuPlace } from '../../widgets/menu.ts';
import { type SortColumn, SortHeads } from '../../widgets/sort-heads.ts';
import { rowAfterKey, WindowedList } from '../../widgets/windowed-list.ts';
import { ReviewRowView } from './row.ts';
import { isSameFilter, type ReviewRow, worstListed } from './rows.ts';

export interface ReviewTableEvents {
  sort(order: ReviewView['order']): void;
  choose(chosen: ReadonlySet<string>, focused: string): void;
  menu(at: MenuPlace): void;
  /** Escape: nothing of the review is shown any more. */
  leave(): void;
  /** These rows are in view. */
  seen(paths: readonly string[]): void;
}

const COLUMNS: readonly SortColumn<ReviewColumn>[] = [
  ['name', 'Take', '', 'Name of the file'],
  ['verdict', 'Verdict', 'review-verdict', 'Good or bad'],
  ['stars', 'Stars', 'review-stars', 'None to five'],
  ['seconds', 'Length', 'number', 'Seconds from first to last frame'],
  ['frames', 'Frames', 'number review-frames', 'Number of frames'],
  ['fps', 'FPS', 'number review-fps', 'Frames per second'],
  ['joints', 'Joints', 'number review-joints', 'Joints of the skeleton'],
  ['flags', 'Flags', 'review-flags', 'What looks wrong, sorted by number'],
  ['worst', 'Worst', 'number review-worst', 'Size of the worst listed flag'],
  ['tags', 'Tags', 'review-tags', 'Tags'],
  ['notes', 'Notes', 'review-notes', 'Notes'],
];

export class ReviewTable {
  readonly element = element('div', {
    class: 'sort-table review-table',
    role: 'grid',
    tabindex: 0,
    [HAS_KEYS]: true,
    'aria-label': 'Takes in review',
    'aria-multiselectable': 'true',
    'aria-colcount': COLUMNS.length + 1,
  });
  private readonly space = element('div', { class: 'sort-space', role: 'rowgroup' });
  private readonly heads: SortHeads<ReviewColumn>;
  private readonly list: WindowedList<ReviewRowView>;
  private rows: readonly ReviewRow[] = [];
  private places = new Map<string, number>();
  private view: ReviewView | undefined;
  /** Row from which Shift extends. */
  private anchor: string | undefined;
  private readonly isStill = window.matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly events: ReviewTableEvents) {
    this.heads = new SortHeads('review-head', COLUMNS, (column) => events.sort(nextOrder(this.view?.order, column)), {
      label: 'Picture',
    });
    this.element.append(this.heads.element, this.space);
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('scroll', () => this.tellSeen());
    this.element.addEventListener('focus', () => this.refill());
    this.element.addEventListener('blur', () => this.refill());
    this.space.addEventListener('click', (event) => this.onClick(event));
    this.space.addEventListener('contextmenu', (event) => {
      event.preventDefault();
      const row = this.rows[this.list.indexOf(event)];
      if (row && !this.view?.chosen.has(row.take.path)) this.goTo(row);
      if (row) this.events.menu({ x: event.clientX, y: event.clientY });
    });
    this.list = new WindowedList({
      scroller: this.element,
      space: this.space,
      rowHeight: ['--review-row', 28],
      rowsAbove: 1,
      headHeight: () => this.heads.height,
      keyOf: (index) => this.rows[index].take.path,
      make: () => new ReviewRowView(),
      fill: (row, index) => this.fill(row, this.rows[index]),
    });
  }

  show(rows: readonly ReviewRow[], view: ReviewView): void {
    const focusMoved = view.focused !== this.view?.focused;
    const isSorted = view.order !== this.view?.order;
    const isFiltered = this.view !== undefined && !isSameFilter(view, this.view);
    this.rows = rows;
    this.places = new Map(rows.map(({ take }, i) => [take.path, i]));
    this.view = view;
    this.heads.show(view.order);
    const focused = this.placeOf(view.focused);
    // What was asked for begins at the top.
    if (isSorted) this.element.scrollTop = 0;
    else if (focusMoved || isFiltered) this.list.reveal(focused);
    this.list.show(rows.length);
    this.list.focus(focused);
    this.tellSeen();
  }

  private placeOf(path: string | undefined): number {
    return path === undefined ? -1 : (this.places.get(path) ?? -1);
  }

  private refill(): void {
    this.list.each((row, index) => this.fill(row, this.rows[index]));
  }

  private tellSeen(): void {
    const seen: string[] = [];
    this.list.each((_, index) => {
      const row = this.rows[index];
      if (row) seen.push(row.take.path);
    });
    this.events.seen(seen);
  }

  private fill(view: ReviewRowView, row: ReviewRow | undefined): void {
    if (!row || !this.view) return;
    const { path } = row.take;
    const focused = this.view.focused === path;
    const isActive = document.activeElement === this.element;
    view.show(row, {
      worst: worstListed(row, this.view),
      chosen: this.view.chosen.has(path),
      focused,
      plays: focused && isActive && !this.isStill.matches,
    });
  }

  private onClick(event: MouseEvent): void {
    const row = this.rows[this.list.indexOf(event)];
    if (!row) return;
    const { path } = row.take;
    if (event.shiftKey) this.extendTo(row);
    else if (isMac ? event.metaKey : event.ctrlKey) {
      const next = new Set(this.view?.chosen);
      if (!next.delete(path)) next.add(path);
      this.anchor = path;
      this.events.choose(next, path);
    } else this.goTo(row);
  }

  private goTo({ take }: ReviewRow): void {
    this.anchor = take.path;
    this.events.choose(new Set([take.path]), take.path);
  }

  private extendTo({ take }: ReviewRow): void {
    const from = this.placeOf(this.anchor ?? this.view?.focused ?? take.path);
    const to = this.placeOf(take.path);
    const between = this.rows.slice(Math.max(0, Math.min(from, to)), Math.max(from, to) + 1);
    this.events.choose(new Set(between.map((row) => row.take.path)), take.path);
  }

  private onKey(event: KeyboardEvent): void {
    if (event.target !== this.element || event.isComposing) return;
    const { rows, view } = this;
    const at = this.placeOf(view?.focused);
    const command = isMac ? event.metaKey : event.ctrlKey;
    const key = event.key.toLowerCase();
    // Pages are the panel's: with the keys of the list they move by a take, as everywhere.
    const isPage = key === 'pageup' || key === 'pagedown';
    const to = isPage || event.altKey ? undefined : rowAfterKey(event.key, at, rows.length, this.list.page);
    if (to !== undefined && rows[to]) {
      if (event.shiftKey) this.extendTo(rows[to]);
      else if (command) this.events.choose(view?.chosen ?? new Set(), rows[to].take.path);
      else this.goTo(rows[to]);
    } else if (key === 'a' && command && !event.shiftKey && rows.length > 0) {
      const paths = rows.map(({ take }) => take.path);
      this.events.choose(new Set(paths), view?.focused ?? paths[0]);
    } else if (key === ' ' && command && rows[at]) {
      const next = new Set(view?.chosen);
      const { path } = rows[at].take;
      if (!next.delete(path)) next.add(path);
      this.events.choose(next, path);
    } else if (key === 'escape' && !command) this.events.leave();
    else if (asksForMenu(event) && rows[at]) {
      const { left, bottom } = (this.list.row(at)?.element ?? this.element).getBoundingClientRect();
      this.events.menu({ x: left + 48, y: bottom, byKeyboard: true });
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

/** Ascending, descending, then as in the list; flags and stars begin with the most, sizes with the largest. */
function nextOrder(order: ReviewView['order'], column: ReviewColumn): ReviewView['order'] {
  const first = column === 'flags' || column === 'worst' || column === 'stars';
  if (order?.column !== column) return { column, descending: first };
  return order.descending === first ? { column, descending: !first } : undefined;
}
