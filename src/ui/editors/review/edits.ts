/** What is done with takes in review. */
import { removeFromReview, setReview } from '../../../edit/commands/review.ts';
import { baseName } from '../../../model/files.ts';
import { NO_REVIEW, type Review } from '../../../model/takes/review.ts';
import { listedTake } from '../../../review/list.ts';
import { listAsCsv, listAsJson } from '../../../review/write-list.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { chosenPaths, listOfReview } from './meant-takes.ts';

type Parts = Uses<'store' | 'timeline' | 'messages'>;

/** Of the selected takes. */
export function judge(wb: Parts, review: Partial<Review>): void {
  attempt(wb.messages, () => wb.store.apply(setReview, { paths: chosenPaths(wb), review }));
}

/** The same verdict again takes it back. */
export function toggleVerdict(wb: Parts, verdict: 'good' | 'bad'): void {
  const paths = new Set(chosenPaths(wb));
  const meant = (wb.store.document.review ?? []).filter(({ path }) => paths.has(path));
  const next = meant.every((take) => take.verdict === verdict) ? '' : verdict;
  judge(wb, { verdict: next });
  const { verdict: listed } = wb.timeline.review.view.get();
  if (listed === undefined || listed === next) return;
  const [first] = meant;
  const who = meant.length === 1 && first ? baseName(first.path) : plural(meant.length, 'take');
  const how = next === '' ? 'without verdict' : next;
  wb.messages.note(`${who}: ${how}; no longer listed because of Show only > Verdict.`);
}

export function clearReview(wb: Parts): void {
  judge(wb, NO_REVIEW);
}

/** Moves on in the list, and selects that take alone. */
export function stepReview(wb: Parts, by: 1 | -1): void {
  const rows = listOfReview(wb);
  const { focused } = wb.timeline.review.view.get();
  const at = rows.findIndex(({ take }) => take.path === focused);
  const to = rows[at < 0 ? 0 : Math.max(0, Math.min(rows.length - 1, at + by))];
  if (!to) return;
  const { path } = to.take;
  if (path === focused) {
    wb.messages.note(by > 0 ? 'This is the last take in the list.' : 'This is the first take in the list.');
    return;
  }
  wb.timeline.review.change({ focused: path, chosen: new Set([path]) });
}

/** As characters, beside those that are open. */
export function openTakes(wb: Parts, paths: readonly string[]): void {
  const files = wb.timeline.review.files.get();
  const there = paths.filter((path) => files?.has(path));
  if (there.length < paths.length) {
    const missing = paths.length - there.length;
    wb.messages.note(
      `The files of ${missing} of ${paths.length} takes are missing. Drop their folder again.`,
      'warning',
    );
  }
  if (there.length === 0) return;
  wb.timeline.change({ tab: 'takes' });
  files?.open(there);
}

export function goodPaths({ store }: Uses<'store'>): readonly string[] {
  return (store.document.review ?? []).flatMap(({ path, verdict }) => (verdict === 'good' ? [path] : []));
}

export function removeTakes(wb: Parts): void {
  const paths = chosenPaths(wb);
  attempt(wb.messages, () => wb.store.apply(removeFromReview, { paths }));
}

/** The whole list, whatever is filtered. */
export function saveList(wb: Parts & Uses<'files'>, format: 'csv' | 'json'): void {
  const { review } = wb.timeline;
  const said = wb.store.document.review ?? [];
  const takes = said.map((take) => listedTake(take.path, take, review.files.get()?.digest(take.path)?.found?.facts));
  const name = `review.${format}`;
  wb.files.saveText(name, format === 'csv' ? listAsCsv(takes) : listAsJson(takes));
  review.areSaved(said);
  wb.messages.note(`Saved ${name}: ${plural(takes.length, 'take')}.`);
}
