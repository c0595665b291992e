/** What is done with takes in review, and what is said about it. */
import { describe, expect, it } from 'vitest';
import { titleFor } from '../../../../src/app/leaving.ts';
import { withReview } from '../../../../src/app/unsaved-review.ts';
import type { UnsavedPart } from '../../../../src/files/save/saved-parts.ts';
import { NO_REVIEW } from '../../../../src/model/takes/review.ts';
import { toggleVerdict } from '../../../../src/ui/editors/review/edits.ts';
import { noneLeft } from '../../../../src/ui/editors/review/texts.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { menuEntries } from '../../../../src/ui/state/actions/menu-entries.ts';
import { observable } from '../../../../src/ui/widgets/observable.ts';
import { documentOf, workbench } from '../../builders.ts';

const page = () => {
  const review = ['lab/walk.bvh', 'lab/run.bvh'].map((path) => ({ path, ...NO_REVIEW }));
  const { wb } = workbench({ ...documentOf(), review });
  wb.timeline.review.change({ chosen: new Set(['lab/walk.bvh']), focused: 'lab/walk.bvh' });
  return wb;
};

describe('the verdict on a take in review', () => {
  it('is set, and taken back by the same key', () => {
    const wb = page();
    toggleVerdict(wb, 'good');
    expect(wb.store.document.review?.map(({ verdict }) => verdict)).toEqual(['good', '']);
    toggleVerdict(wb, 'good');
    expect(wb.store.document.review?.map(({ verdict }) => verdict)).toEqual(['', '']);
    expect(wb.messages.passing.get()).toBeUndefined();
  });

  it('says that the take leaves the list, if a filter by verdict no longer lists it', () => {
    const wb = page();
    wb.timeline.review.change({ verdict: '' });
    toggleVerdict(wb, 'bad');
    expect(wb.messages.passing.get()).toBe('walk.bvh: bad; no longer listed because of Show only > Verdict.');
    expect(noneLeft(wb.timeline.review.view.get())).toContain('Every take has a verdict');
  });
});

describe('saving what is said about takes', () => {
  const unsavedOf = (wb: ReturnType<typeof page>) =>
    withReview(observable<readonly UnsavedPart[]>([]), wb.store, wb.timeline.review);

  it('Ctrl+S saves the list, until which verdicts are unsaved work; undoing past a save makes them so again', async () => {
    const wb = page();
    const unsaved = unsavedOf(wb);
    const saved: string[] = [];
    Object.assign(wb.files, { unsaved, saveText: (name: string, text: string) => saved.push(`${name}: ${text}`) });
    expect(unsaved.get()).toEqual([]);
    toggleVerdict(wb, 'good');
    expect(unsaved.get().map(({ name }) => name)).toEqual(['review.csv']);
    expect(titleFor('Marrow', unsaved.get())).toBe('• review.csv – Marrow');
    await runAction(wb, 'save.changed');
    expect(saved).toEqual([expect.stringContaining('lab/walk.bvh,good')]);
    expect(unsaved.get()).toEqual([]);
    wb.store.undo();
    expect(unsaved.get()).toHaveLength(1);
    wb.store.redo();
    expect(unsaved.get()).toEqual([]);
  });

  it('is offered in the Save menu too', () => {
    const labels = menuEntries(page(), 'Save').flatMap((entry) =>
      entry.kind === 'item' && entry.enabled ? [entry.label] : [],
    );
    expect(labels).toEqual(['Save changes', 'Save review as CSV']);
  });
});
