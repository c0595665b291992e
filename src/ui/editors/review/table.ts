/** The list of takes in review. The take with the focus is the one that is shown; its keys are in `actions.ts`. */

import type { ReviewColumn, ReviewView } from '../../state/review.ts';
import type { MenuPlace } from '../../widgets/menu.ts';
import type { SortColumn } from '../../widgets/table/sort-heads.ts';
import { SortTable } from '../../widgets/table/sort-table.ts';
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
  readonly element: HTMLElement;
  private readonly table: SortTable<ReviewRow, ReviewRowView, ReviewColumn>;
  private view: ReviewView | undefined;
  private readonly isStill = window.matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly events: ReviewTableEvents) {
    this.table = new SortTable({
      kind: 'review',
      label: 'Takes in review',
      columns: COLUMNS,
      lead: 'Picture',
      mostFirst: ['flags', 'worst', 'stars'],
      rowHeight: ['--review-row', 28],
      isMultiple: true,
      menuLeft: 48,
      sort: events.sort,
      choose: (chosen, { take }) => events.choose(chosen, take.path),
      menu: (row, at) => {
        if (row) events.menu(at);
      },
      keyOf: ({ take }) => take.path,
      make: () => new ReviewRowView(),
      fill: (view, row, chosen) => this.fill(view, row, chosen),
      takesKey: ({ key, ctrlKey, metaKey }) => {
        const leaves = key === 'Escape' && !ctrlKey && !metaKey;
        if (leaves) events.leave();
        return leaves;
      },
    });
    this.element = this.table.element;
    this.element.addEventListener('scroll', () => this.tellSeen());
    for (const type of ['focus', 'blur']) this.element.addEventListener(type, () => this.table.refill());
  }

  show(rows: readonly ReviewRow[], view: ReviewView): void {
    const before = this.view;
    this.view = view;
    const isSorted = view.order !== before?.order;
    const isFiltered = before !== undefined && !isSameFilter(view, before);
    // What was asked for begins at the top.
    if (isSorted) this.element.scrollTop = 0;
    this.table.show(rows, view, !isSorted && (view.focused !== before?.focused || isFiltered));
    this.tellSeen();
  }

  private tellSeen(): void {
    this.events.seen(this.table.drawn().map(({ take }) => take.path));
  }

  private fill(made: ReviewRowView, row: ReviewRow, chosen: boolean): void {
    const { view } = this;
    if (!view) return;
    const isActive = document.activeElement === this.element;
    const plays = view.focused === row.take.path && isActive && !this.isStill.matches;
    made.show(row, { worst: worstListed(row, view), chosen, plays });
  }
}
