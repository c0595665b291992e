/** Which takes in review are meant. */
import type { ReviewedTake } from '../../../model/review.ts';
import type { ReviewProgress, ReviewState, ReviewView } from '../../state/review.ts';
import type { Uses } from '../../state/workbench.ts';
import { listedRows, type ReviewRow, reviewRows } from './rows.ts';

type Parts = Uses<'store' | 'timeline'>;

/** The last list, and what it depends on: every button asks for it. */
interface Listed {
  readonly takes: readonly ReviewedTake[] | undefined;
  readonly progress: ReviewProgress | undefined;
  readonly view: ReviewView;
  readonly rows: readonly ReviewRow[];
}
const last = new WeakMap<ReviewState, Listed>();

/** In the list's current order and filter; the same array if nothing changed. */
export function listOfReview({ store, timeline }: Parts): readonly ReviewRow[] {
  const { review } = timeline;
  const takes = store.document.review;
  const files = review.files.get();
  const progress = files?.progress.get();
  const view = review.view.get();
  const known = last.get(review);
  if (known && known.takes === takes && known.progress === progress && isSameList(known.view, view)) return known.rows;
  const rows = listedRows(reviewRows(takes ?? [], files), view);
  last.set(review, { takes, progress, view, rows });
  return rows;
}

function isSameList(a: ReviewView, b: ReviewView): boolean {
  return (['text', 'verdict', 'flag', 'tag', 'stars', 'order'] as const).every((key) => a[key] === b[key]);
}

/** Paths of the selected takes that are listed, in the order of the list. */
export function chosenPaths(wb: Parts): readonly string[] {
  const { chosen } = wb.timeline.review.view.get();
  if (chosen.size === 0) return [];
  return listOfReview(wb).flatMap(({ take }) => (chosen.has(take.path) ? [take.path] : []));
}

export function hasReview({ store }: Uses<'store'>): boolean {
  return store.document.review !== undefined;
}
