/** Commands on the list of reviewed takes: which are in it, and what a person says about them. */

import type { Document } from '../../model/document.ts';
import { MAX_STARS, NO_REVIEW, type Review, type ReviewedTake, tagsOf, VERDICTS } from '../../model/takes/review.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { filledText, list, oneOf, optional, record, text } from '../schema/shape.ts';

/** As in the list. */
const PATHS = { paths: list(filledText) } as const;
const verdict = oneOf([...VERDICTS, '']);
const stars = oneOf(Array.from({ length: MAX_STARS + 1 }, (_, count) => count));

/** Those in the list stay as they are. The unchanged opening example makes way for takes. */
export const addToReview = command({
  id: 'review.add',
  args: PATHS,
  label: (_, { paths }) => `Review ${takesText(paths)}`,
  run(document, { paths }) {
    const known = new Set((document.review ?? []).map(({ path }) => path));
    const added = paths.filter((path) => !known.has(path));
    if (added.length === 0) return document;
    const list = [...(document.review ?? []), ...[...new Set(added)].map((path) => ({ path, ...NO_REVIEW }))];
    const opened = { ...document, review: list };
    return document.isOpeningSample === true ? { ...opened, characters: [], isOpeningSample: false } : opened;
  },
});

/** Removes takes from the list of reviewed ones; their files stay. */
export const removeFromReview = command({
  id: 'review.remove',
  args: PATHS,
  label: (_, { paths }) => `Remove ${takesText(paths)} from review`,
  run(document, { paths }) {
    const gone = new Set(paths);
    const list = (document.review ?? []).filter(({ path }) => !gone.has(path));
    if (list.length === (document.review ?? []).length) return document;
    const { review: _before, ...rest } = document;
    return list.length > 0 ? { ...rest, review: list } : rest;
  },
});

/** Gives some takes a verdict, stars, tags or notes; what isn't given stays. */
export const setReview = command({
  id: 'review.set',
  args: {
    ...PATHS,
    review: record({
      verdict: optional(verdict),
      stars: optional(stars),
      tags: optional(list(text)),
      notes: optional(text),
    }),
  },
  label: (_, { paths, review }) => `${changeText(review)} of ${takesText(paths)}`,
  run(document, { paths, review }) {
    const change = checked(review);
    const meant = new Set(paths);
    return changeTakes(document, (take) => (meant.has(take.path) ? { ...take, ...change } : take));
  },
});

/** Takes over what a list says about takes, by their paths here; others of the list are left out. */
export const readReview = command({
  id: 'review.read',
  args: {
    takes: list(record({ path: filledText, verdict, stars, tags: list(text), notes: text })),
  },
  label: (_, { takes }) => `Read review of ${takesText(takes.map(({ path }) => path))}`,
  run(document, { takes }) {
    const found = new Map(takes.map((take) => [take.path, checked(take)]));
    return changeTakes(document, (take) => ({ ...take, ...found.get(take.path) }));
  },
});

/** The same document if no take changes. */
function changeTakes(document: Document, change: (take: ReviewedTake) => ReviewedTake): Document {
  let isChanged = false;
  const list = (document.review ?? []).map((take) => {
    const next = change(take);
    if (sameValue(next, take)) return take;
    isChanged = true;
    return next;
  });
  return isChanged ? { ...document, review: list } : document;
}

/** @throws CommandError if it says nothing */
function checked({ verdict, stars, tags, notes }: Partial<Review>): Partial<Review> {
  if ([verdict, stars, tags, notes].every((each) => each === undefined)) {
    throw new CommandError('A review must have a verdict, stars, tags or notes.');
  }
  return {
    ...(verdict !== undefined && { verdict }),
    ...(stars !== undefined && { stars }),
    ...(tags !== undefined && { tags: tagsOf(tags.join(',')) }),
    ...(notes !== undefined && { notes }),
  };
}

/** `walk.bvh`, or `12 takes`. */
function takesText(paths: readonly string[]): string {
  const [first] = paths;
  return paths.length === 1 ? cutName(first.slice(first.lastIndexOf('/') + 1)) : `${paths.length} takes`;
}

function changeText({ verdict, stars, tags, notes }: Partial<Review>): string {
  if (verdict !== undefined) return verdict === '' ? 'Clear verdict' : `Set verdict ${verdict}`;
  if (stars !== undefined) return stars === 1 ? 'Set 1 star' : `Set ${stars} stars`;
  if (tags !== undefined) return 'Set tags';
  return notes === undefined ? 'Set review' : 'Set notes';
}
