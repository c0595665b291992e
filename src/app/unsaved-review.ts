/** Verdicts on takes that no list has yet are unsaved work, beside the parts of characters. */
import type { Store } from '../edit/store.ts';
import type { UnsavedPart } from '../files/save/saved-parts.ts';
import type { ReviewState } from '../ui/state/review.ts';
import type { UnsavedList } from '../ui/state/workbench.ts';
import { type Observable, observable } from '../ui/widgets/observable.ts';

const LIST: UnsavedList = { kind: 'review', name: 'review.csv' };

/** The unsaved parts, and the list if it is unsaved. */
export function withReview(
  parts: Pick<Observable<readonly UnsavedPart[]>, 'get' | 'subscribe'>,
  store: Store,
  review: Pick<ReviewState, 'saved' | 'isUnsaved'>,
): Observable<readonly (UnsavedPart | UnsavedList)[]> {
  const all = observable<readonly (UnsavedPart | UnsavedList)[]>(parts.get());
  let isListUnsaved = false;
  const show = () => all.set(isListUnsaved ? [...parts.get(), LIST] : parts.get());
  const check = () => {
    const now = review.isUnsaved(store.document.review ?? []);
    if (now === isListUnsaved) return;
    isListUnsaved = now;
    show();
  };
  parts.subscribe(show);
  review.saved.subscribe(check);
  store.subscribe((now, before) => {
    if (now.document.review !== before.document.review) check();
  });
  check();
  return all;
}
