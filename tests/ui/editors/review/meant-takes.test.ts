/** The list of takes in review, which many ask for after each change. */
import { expect, it } from 'vitest';
import { NO_REVIEW } from '../../../../src/model/takes/review.ts';
import { judge } from '../../../../src/ui/editors/review/edits.ts';
import { hasChosenTake, listOfReview } from '../../../../src/ui/editors/review/meant-takes.ts';
import type { ReviewFiles } from '../../../../src/ui/state/review.ts';
import { observable } from '../../../../src/ui/widgets/observable.ts';
import { documentOf, workbench } from '../../builders.ts';

const page = () => {
  const review = ['lab/walk.bvh', 'lab/run.bvh'].map((path) => ({ path, ...NO_REVIEW }));
  return workbench({ ...documentOf(), review }).wb;
};

it('the list of takes in review stays the same array while takes are selected, and is made anew by what changes it', () => {
  const wb = page();
  const { review } = wb.timeline;
  const given = new Set<string>();
  const progress = observable({ done: 0, of: 2 });
  const files: ReviewFiles = {
    ...{ progress, has: (path) => given.has(path), digest: () => undefined, want: () => undefined },
    ...{ character: async () => undefined, open: () => undefined },
  };
  let before = listOfReview(wb);
  const names = () => listOfReview(wb).map(({ name }) => name);
  const expectAnew = (change: () => void) => {
    change();
    const now = listOfReview(wb);
    expect(now).not.toBe(before);
    expect(listOfReview(wb)).toBe(now);
    before = now;
  };
  expect(names()).toEqual(['walk', 'run']);
  review.change({ chosen: new Set(['lab/walk.bvh']), focused: 'lab/walk.bvh' });
  expect(listOfReview(wb)).toBe(before);

  expectAnew(() => judge(wb, { stars: 3 }));
  expect(listOfReview(wb).map(({ take }) => take.stars)).toEqual([3, 0]);
  expectAnew(() => review.files.set(files));
  expectAnew(() => {
    given.add('lab/run.bvh');
    progress.set({ done: 1, of: 2 });
  });
  expect(listOfReview(wb).map(({ hasFile }) => hasFile)).toEqual([false, true]);
  expectAnew(() => review.change({ order: { column: 'name', descending: false } }));
  expect(names()).toEqual(['run', 'walk']);
  expectAnew(() => review.change({ text: 'walk' }));
  expect(names()).toEqual(['walk']);
  expectAnew(() => wb.store.undo());
  expect(listOfReview(wb).map(({ take }) => take.stars)).toEqual([0]);
});

it('a selected take that the filter leaves out is not at hand', () => {
  const wb = page();
  wb.timeline.review.change({ chosen: new Set(['lab/walk.bvh']) });
  expect(hasChosenTake(wb)).toBe(true);
  wb.timeline.review.change({ text: 'run' });
  expect(hasChosenTake(wb)).toBe(false);
});
