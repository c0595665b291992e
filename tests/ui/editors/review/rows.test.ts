/** Which takes in review are listed, in which order. */
import { describe, expect, it } from 'vitest';
import { NO_REVIEW, type ReviewedTake } from '../../../../src/model/takes/review.ts';
import type { TakeDigest } from '../../../../src/review/digest.ts';
import type { Flag } from '../../../../src/review/flags.ts';
import { isSameFilter, listedRows, reviewRows, tagsIn } from '../../../../src/ui/editors/review/rows.ts';
import type { ReviewView } from '../../../../src/ui/state/review.ts';

const SPIKE: Flag = { kind: 'spike', from: 1, to: 1, amount: 0.1 };
const SLIDE: Flag = { kind: 'slide', from: 2, to: 3, amount: 0.2 };
const FIGURE = { frameCount: 0, pointCount: 0, above: new Uint8Array(0), points: new Uint8Array(0) };

const TAKES: readonly ReviewedTake[] = [
  { path: 'lab/walk10.bvh', ...NO_REVIEW, verdict: 'good', stars: 3, tags: ['calm'] },
  { path: 'lab/walk2.bvh', ...NO_REVIEW, verdict: 'bad', notes: 'Trips over the cable' },
  { path: 'lab/run.bvh', ...NO_REVIEW, stars: 5, tags: ['fast', 'calm'] },
  { path: 'gone/jump.bvh', ...NO_REVIEW },
];
const digest = (path: string, frames: number, ...flags: Flag[]): [string, TakeDigest] => [
  path,
  { path, found: { facts: { frames, fps: 30, seconds: frames / 30, joints: 20, flags }, figure: FIGURE } },
];
const DIGESTS = new Map([
  digest('lab/walk10.bvh', 300, SPIKE, SLIDE),
  digest('lab/walk2.bvh', 100),
  digest('lab/run.bvh', 200, SLIDE),
]);
const spike = (amount: number): Flag => ({ ...SPIKE, amount });
const sized = new Map([
  digest('a', 1, spike(0.3), SLIDE),
  digest('b', 1, spike(0.05), { kind: 'bone', from: 0, to: 1, amount: 0.5 }),
  digest('c', 1, spike(0.1)),
  digest('clean', 1),
]);
const ROWS = reviewRows(TAKES, { has: (path) => path.startsWith('lab'), digest: (path) => DIGESTS.get(path) });
const names = (view: Partial<ReviewView>) =>
  listedRows(ROWS, { text: '', stars: 0, chosen: new Set(), ...view }).map(({ name }) => name);

describe('the list of takes in review', () => {
  it('is in the order of the files until it is sorted', () => {
    expect(names({})).toEqual(['walk10', 'walk2', 'run', 'jump']);
    expect(names({ order: { column: 'name', descending: false } })).toEqual(['jump', 'run', 'walk2', 'walk10']);
    expect(names({ order: { column: 'stars', descending: true } })).toEqual(['run', 'walk10', 'walk2', 'jump']);
    expect(names({ order: { column: 'verdict', descending: false } })).toEqual(['walk10', 'run', 'jump', 'walk2']);
  });

  it('has takes that were not read yet at its end, however it is sorted by what is in them', () => {
    expect(names({ order: { column: 'frames', descending: false } })).toEqual(['walk2', 'run', 'walk10', 'jump']);
    expect(names({ order: { column: 'frames', descending: true } })).toEqual(['walk10', 'run', 'walk2', 'jump']);
    expect(names({ order: { column: 'flags', descending: true } })).toEqual(['walk10', 'run', 'walk2', 'jump']);
  });

  it('is filtered by text in paths, notes and tags', () => {
    expect(names({ text: 'GONE' })).toEqual(['jump']);
    expect(names({ text: 'cable' })).toEqual(['walk2']);
    expect(names({ text: ' calm ' })).toEqual(['walk10', 'run']);
  });

  it('is filtered by verdict, flags, stars and tag, all of which must hold', () => {
    expect(names({ verdict: '' })).toEqual(['run', 'jump']);
    expect(names({ flag: 'any' })).toEqual(['walk10', 'run']);
    // A take that was not read may have flags.
    expect(names({ flag: 'none' })).toEqual(['walk2']);
    expect(names({ flag: 'spike' })).toEqual(['walk10']);
    expect(names({ stars: 4 })).toEqual(['run']);
    expect(names({ tag: 'calm', flag: 'slide', verdict: 'good' })).toEqual(['walk10']);
  });

  it('is sorted by the size of the worst flag: of all kinds by how bad it is, of a listed kind by its amount', () => {
    const rows = reviewRows(
      ['a', 'b', 'c', 'clean', 'unread'].map((path) => ({ path, ...NO_REVIEW })),
      { has: () => true, digest: (path) => sized.get(path) },
    );
    const by = (view: Partial<ReviewView>) =>
      listedRows(rows, {
        text: '',
        stars: 0,
        chosen: new Set(),
        order: { column: 'worst', descending: true },
        ...view,
      }).map(({ name }) => name);
    expect(by({})).toEqual(['b', 'a', 'c', 'clean', 'unread']);
    expect(by({ order: { column: 'worst', descending: false } })).toEqual(['clean', 'c', 'a', 'b', 'unread']);
    expect(by({ flag: 'spike' })).toEqual(['a', 'c', 'b']);
    expect(by({ flag: 'spike', bad: 2 })).toEqual(['a']);
    expect(by({ flag: 'spike', bad: 10 })).toEqual([]);
    expect(
      isSameFilter({ text: '', stars: 0, chosen: new Set() }, { text: '', stars: 0, chosen: new Set(), bad: 2 }),
    ).toBe(false);
  });

  it('knows all tags, each once', () => {
    expect(tagsIn(TAKES)).toEqual(['calm', 'fast']);
  });
});
