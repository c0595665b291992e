/** Which takes in review are meant. */
import type { ReviewedTake } from '../../../model/takes/review.ts';
import type { ReviewFiles, ReviewProgress, ReviewView } from '../../state/review.ts';
import type { Uses } from '../../state/workbench.ts';
import { isSameFilter, listedRows, type ReviewRow, reviewRows } from './rows.ts';

type Parts = Uses<'store' | 'timeline'>;

/** A list, and what it was made of. */
interface Listed {
  readonly takes: readonly ReviewedTake[] | undefined;
  readonly files: ReviewFiles | undefined;
  readonly progress: ReviewProgress | undefined;
  readonly rows: readonly ReviewRow[];
  readonly view: ReviewView;
  readonly listed: readonly ReviewRow[];
}

/** The latest of each review: menus, tools and the list ask for it many times for one change. */
const latest = new WeakMap<Parts['timeline']['review'], Listed>();

/** In the list's current order and filter. The same array until something changes. */
export function listOfReview({ store, timeline }: Parts): readonly ReviewRow[] {
  const { review } = timeline;
  const takes = store.document.review;
  const files = review.files.get();
  const progress = files?.progress.get();
  const view = review.view.get();
  const known = latest.get(review);
  const areSame = known && known.takes === takes && known.files === files && known.progress === progress;
  const rows = areSame ? known.rows : reviewRows(takes ?? [], files);
  const isSame = areSame && known.view.order === view.order && isSameFilter(known.view, view);
  const listed = isSame ? known.listed : listedRows(rows, view);
  latest.set(review, { takes, files, progress, rows, view, listed });
  return listed;
}

/** Paths of the selected takes that are listed, in the order of the list. */
export function chosenPaths(wb: Parts): readonly string[] {
  const { chosen } = wb.timeline.review.view.get();
  if (chosen.size === 0) return [];
  return listOfReview(wb).flatMap(({ take }) => (chosen.has(take.path) ? [take.path] : []));
}

/** Whether a take is selected that is listed. */
export function hasChosenTake(wb: Parts): boolean {
  const { chosen } = wb.timeline.review.view.get();
  return chosen.size > 0 && listOfReview(wb).some(({ take }) => chosen.has(take.path));
}

export function hasReview({ store }: Uses<'store'>): boolean {
  return store.document.review !== undefined;
}
