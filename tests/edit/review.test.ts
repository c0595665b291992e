/** Takes in review: what is special about their commands. */
import { expect, it } from 'vitest';
import { addToReview, readReview, setReview } from '../../src/edit/commands/review.ts';
import { Store } from '../../src/edit/store.ts';
import { NO_REVIEW } from '../../src/model/takes/review.ts';
import { character, documentOf } from '../helpers/builders.ts';

const HERO = documentOf(character());

it('takes in review keep their verdicts as others are added, and the opening example leaves', () => {
  const store = new Store({ ...HERO, isOpeningSample: true });
  store.apply(addToReview, { paths: ['a.bvh', 'b.bvh'] });
  expect([store.document.characters, store.document.isOpeningSample]).toEqual([[], false]);
  store.apply(setReview, { paths: ['a.bvh'], review: { verdict: 'good', tags: ['one, two', 'one'] } });
  store.apply(addToReview, { paths: ['c.bvh', 'a.bvh'] });
  expect(store.document.review?.map(({ path, verdict }) => `${path} ${verdict}`)).toEqual([
    'a.bvh good',
    'b.bvh ',
    'c.bvh ',
  ]);
  expect(store.document.review?.[0].tags).toEqual(['one', 'two']);
  store.undo();
  store.undo();
  expect(store.document.review?.map(({ verdict }) => verdict)).toEqual(['', '']);
});

it('a list that is read back gives its takes their verdicts, and no other', () => {
  const store = new Store(HERO);
  store.apply(addToReview, { paths: ['a.bvh', 'b.bvh'] });
  const said = { ...NO_REVIEW, verdict: 'bad', stars: 1, notes: 'twitches' } as const;
  store.apply(readReview, {
    takes: [
      { path: 'b.bvh', ...said },
      { path: 'gone.bvh', ...said },
    ],
  });
  expect(store.document.review).toEqual([
    { path: 'a.bvh', ...NO_REVIEW },
    { path: 'b.bvh', ...said },
  ]);
});

it.each([{ stars: 6 }, { stars: 1.5 }, { verdict: 'maybe' }])('a review with %j is refused', (review) => {
  const document = { ...HERO, review: [{ path: 'a.bvh', ...NO_REVIEW }] };
  // As scripts may pass it.
  expect(() => setReview.run(document, { paths: ['a.bvh'], review: review as never })).toThrow(/must be|found/);
});
