/** What is done with takes in review, and what is said about it. */
import { describe, expect, it } from 'vitest';
import { NO_REVIEW } from '../../../../src/model/review.ts';
import { toggleVerdict } from '../../../../src/ui/editors/review/edits.ts';
import { noneLeft } from '../../../../src/ui/editors/review/texts.ts';
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
    expect(wb.messages.passing.get()).toBe('walk.bvh: bad, so no longer listed by Only > Verdict.');
    expect(noneLeft(wb.timeline.review.view.get())).toContain('Every take has a verdict');
  });
});
