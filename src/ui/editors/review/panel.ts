/**
 * *Review*: takes by the hundred, of which the one with the focus plays in the viewport. What is said about them is
 * part of the document; their files are not.
 */

import { sectionsOf } from '../../state/actions/menu-entries.ts';
import { MAX_OPENED, REVIEWED_LIST, type ReviewView } from '../../state/review.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { atMostEvery, oncePerFrame } from '../../widgets/frame.ts';
import { type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { ReviewDetail } from './detail.ts';
import { judge } from './edits.ts';
import { listOfReview } from './meant-takes.ts';
import { isFiltered, isSameFilter, type ReviewRow } from './rows.ts';
import { ShownTake } from './shown-take.ts';
import { ReviewTable } from './table.ts';
import { noneLeft } from './texts.ts';
import { type ReviewTools, reviewTools } from './tools.ts';

export function reviewPanel(wb: Workbench): TimelineTab {
  return new ReviewPanel(wb);
}

const MENU = [
  ['review.good', 'review.bad', 'review.stars5', 'review.stars4', 'review.stars3', 'review.stars2', 'review.stars1'],
  ['review.stars0', 'review.clear'],
  ['review.open', 'review.openGood'],
  ['review.saveCsv', 'review.saveJson'],
  ['review.remove'],
];
const EMPTY = `No takes to review. Drop a folder or a zip with more than ${MAX_OPENED} takes (${REVIEWED_LIST}), or a saved review.`;
/** What comes from the worker is shown this often. */
const PROGRESS_MS = 200;

class ReviewPanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly table: ReviewTable;
  private readonly detail: ReviewDetail;
  private readonly bar: ReviewTools;
  private readonly empty = element('p', { class: 'empty review-empty', hidden: true });
  private readonly body: HTMLElement;
  private readonly shownTake: ShownTake;
  private visible = false;
  private stopProgress: (() => void) | undefined;
  /** Place of the focus in the list: a take that leaves it is followed by the next one. */
  private place = 0;
  private listedFor: ReviewView | undefined;
  private readonly showSoon = oncePerFrame(() => this.show());
  private readonly showProgress = atMostEvery(PROGRESS_MS, () => this.show());

  constructor(private readonly wb: Workbench) {
    const { review } = wb.timeline;
    this.shownTake = new ShownTake(wb);
    this.table = new ReviewTable({
      sort(order) {
        const { order: _before, ...view } = review.view.get();
        review.view.set({ ...view, ...(order && { order }) });
      },
      choose: (chosen, focused) => review.change({ chosen, focused }),
      menu: (at) => this.menu(at),
      leave: () => void this.shownTake.show(undefined),
      seen: (paths) => review.files.get()?.want(paths),
    });
    this.detail = new ReviewDetail({
      change: (change) => judge(wb, change),
      seek: (flag) => {
        const { focused } = review.view.get();
        if (focused !== undefined) void this.shownTake.seek(focused, flag.from);
      },
    });
    this.bar = reviewTools(wb);
    this.tools = this.bar.element;
    this.body = element('div', { class: 'review-body' }, this.table.element, this.detail.element);
    this.element = element('div', { class: 'review', 'data-panel': 'review' }, this.empty, this.body);
    wb.store.subscribe((now, before) => {
      // What is opened or edited is seen.
      if (now.document.characters !== before.document.characters) void this.shownTake.show(undefined);
      if (now.document.review !== before.document.review) this.showSoon();
    });
    // At once, since the next key continues from this row.
    review.view.subscribe((now, before) => {
      this.show();
      if (now.focused !== before.focused) this.showFocused();
    });
    review.files.subscribe(() => this.followFiles());
    this.followFiles();
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    this.show();
    if (visible) this.showFocused();
    else void this.shownTake.show(undefined);
  }

  fitAll(): void {
    this.wb.viewport.camera.frameAll();
  }

  fitSelected(): void {
    this.fitAll();
  }

  recolour(): void {
    this.show();
  }

  private followFiles(): void {
    this.stopProgress?.();
    this.stopProgress = this.wb.timeline.review.files.get()?.progress.subscribe(this.showProgress);
    this.showSoon();
  }

  private showFocused(): void {
    const { focused } = this.wb.timeline.review.view.get();
    if (this.visible && focused !== undefined) void this.shownTake.show(focused);
  }

  private show(): void {
    if (!this.visible) return;
    const { wb } = this;
    const { review } = wb.timeline;
    const view = review.view.get();
    const rows = listOfReview(wb);
    const at = rows.findIndex(({ take }) => take.path === view.focused);
    const isEmpty = (wb.store.document.review ?? []).length === 0;
    write(this.empty, 'hidden', rows.length > 0);
    write(this.body, 'hidden', rows.length === 0);
    setText(this.empty, isEmpty || !isFiltered(view) ? EMPTY : noneLeft(view));
    // What is listed again begins with its first take.
    if (this.listedFor && !isSameFilter(view, this.listedFor)) this.place = 0;
    this.listedFor = view;
    if (at >= 0) this.place = at;
    else if (this.moveOn(rows)) return;
    this.table.show(rows, view);
    const row: ReviewRow | undefined = rows[at];
    this.detail.show(row, view.chosen.size);
    this.bar.show(rows.length);
  }

  /** Whether the focus has moved to a take that is listed. */
  private moveOn(rows: readonly ReviewRow[]): boolean {
    const next = rows[Math.min(this.place, rows.length - 1)];
    if (!next) return false;
    const { path } = next.take;
    this.wb.timeline.review.change({ focused: path, chosen: new Set([path]) });
    return true;
  }

  private menu(at: MenuPlace): void {
    openMenu(at, sectionsOf(this.wb, MENU), { label: 'Take in review' });
  }
}
