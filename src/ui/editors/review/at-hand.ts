/** Which takes in review are meant. */
import type { Uses } from '../../state/workbench.ts';
import { listedRows, type ReviewRow, reviewRows } from './rows.ts';

type Parts = Uses<'store' | 'timeline'>;

/** In the list's current order and filter. */
export function listOfReview({ store, timeline }: Parts): readonly ReviewRow[] {
  const { view, files } = timeline.review;
  return listedRows(reviewRows(store.document.review ?? [], files.get()), view.get());
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
