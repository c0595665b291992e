/** Which of the given files are reviewed, which opened, and what a list says about takes. */
import { zipSync } from 'fflate';
import { expect, it } from 'vitest';
import { type ReviewingParts, takeForReview } from '../../src/app/reviewing.ts';
import { Store } from '../../src/edit/store.ts';
import type { GivenFile } from '../../src/io/given.ts';
import { NO_REVIEW } from '../../src/model/takes/review.ts';
import { listAsCsv } from '../../src/review/write-list.ts';
import { DEFAULT_SETTINGS } from '../../src/ui/state/settings.ts';
import { Timeline } from '../../src/ui/state/timeline.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import type { Jobs } from '../../src/worker/protocol.ts';
import { unpackTakes } from '../../src/worker/review.ts';

const given = (path: string, text = ''): GivenFile => ({ path, blob: new Blob([text]), version: '1' });
const takes = (count: number) => Array.from({ length: count }, (_, i) => given(`lab/take${i + 1}.bvh`));

function page() {
  const notes: string[] = [];
  const read: string[] = [];
  let goOn = () => {};
  const asked = new Promise<void>((resolve) => {
    goOn = resolve;
  });
  const jobs: {
    readonly [K in 'parse' | 'review' | 'unpack']: (input: Jobs[K]['takes']) => Promise<Jobs[K]['gives']>;
  } = {
    parse: async () => ({ files: [], broken: [], diagnostics: [], facts: [], keeps: [] }),
    unpack: unpackTakes,
    review: async ({ files }) => {
      await asked;
      read.push(...files.map(({ path }) => path));
      return { takes: files.map(({ path }) => ({ path, problem: 'The file has no frames.' })) };
    },
  };
  const parts: ReviewingParts = {
    store: new Store(),
    messages: { note: (text) => notes.push(text), report: () => undefined },
    timeline: new Timeline(),
    settings: observable(DEFAULT_SETTINGS),
    opener: { open: async () => [] },
    worker: { run: (job, input) => jobs[job](input) },
  };
  const verdicts = () => parts.store.document.review?.map(({ path, verdict }) => `${path} ${verdict}`.trim());
  return { parts, notes, read, verdicts, goOn };
}

it('more than 20 takes are reviewed, those in view read first; characters beside them are opened, readmes are not', async () => {
  const { parts, read, goOn } = page();
  const files = [...takes(24), given('lab/README.md'), given('lab/wasp.skel')];
  const opened = await takeForReview(parts, files);
  expect(opened.map(({ path }) => path)).toEqual(['lab/wasp.skel']);
  expect(parts.store.document.review).toHaveLength(24);
  expect(parts.timeline.view.get().tab).toBe('review');
  const reviewed = parts.timeline.review.files.get();
  reviewed?.want(['lab/take20.bvh', 'lab/take21.bvh']);
  goOn();
  await expect.poll(() => reviewed?.progress.get()).toEqual({ done: 24, of: 24 });
  // The first batch was on its way.
  expect(read.slice(4, 6)).toEqual(['lab/take20.bvh', 'lab/take21.bvh']);
  expect([...read].sort()).toEqual(
    takes(24)
      .map(({ path }) => path)
      .sort(),
  );
});

it('takes of other programs and in zips are reviewed too, if there are more than 20; smaller zips are opened', async () => {
  const zip = (name: string, count: number) => {
    const files = Object.fromEntries(takes(count).map(({ path }) => [path, new Uint8Array(1)]));
    return { ...given(name), blob: new Blob([zipSync({ ...files, 'lab/notes.txt': new Uint8Array(1) })]) };
  };
  const { parts, verdicts } = page();
  const small = zip('few.zip', 20);
  expect(await takeForReview(parts, [small])).toEqual([small]);
  expect(verdicts()).toBeUndefined();
  expect(await takeForReview(parts, [zip('lab.zip', 21)])).toEqual([]);
  expect(verdicts()?.slice(0, 2)).toEqual(['lab.zip/lab/take1.bvh', 'lab.zip/lab/take2.bvh']);
  expect(parts.timeline.review.files.get()?.has('lab.zip/lab/take21.bvh')).toBe(true);
  const others = Array.from({ length: 24 }, (_, i) => given(`more/${i}.${['fbx', 'glb', 'FBX', 'vrma'][i % 4]}`));
  expect(await takeForReview(parts, [...others, given('more/a.gltf')])).toHaveLength(1);
  expect(verdicts()).toHaveLength(21 + 24);
  const broken = given('broken.zip', 'no zip');
  expect(await takeForReview(parts, [broken])).toEqual([broken]);
});

it('20 takes and fewer are opened, but those in review get their files', async () => {
  const { parts, verdicts } = page();
  expect(await takeForReview(parts, takes(20))).toHaveLength(20);
  expect(verdicts()).toBeUndefined();
  parts.store.replace('Restore', {
    ...parts.store.document,
    review: [{ path: 'lab/take2.bvh', ...NO_REVIEW, verdict: 'bad' }],
  });
  const opened = await takeForReview(parts, takes(3));
  expect(opened.map(({ path }) => path)).toEqual(['lab/take1.bvh', 'lab/take3.bvh']);
  expect(parts.timeline.review.files.get()?.has('lab/take2.bvh')).toBe(true);
  expect(verdicts()).toEqual(['lab/take2.bvh bad']);
});

it('a list gives the takes in review their verdicts by their paths, and says which are missing', async () => {
  const { parts, notes, verdicts } = page();
  await takeForReview(parts, takes(21));
  const list = listAsCsv([
    { path: '/home/mo/lab/take2.bvh', ...NO_REVIEW, verdict: 'good' },
    { path: 'other/take3.bvh', ...NO_REVIEW, verdict: 'bad' },
  ]);
  expect(await takeForReview(parts, [given('review.csv', list)])).toEqual([]);
  expect(verdicts()?.slice(0, 3)).toEqual(['lab/take1.bvh', 'lab/take2.bvh good', 'lab/take3.bvh']);
  expect(notes.at(-1)).toContain('1 take in that list is not in review');
});

it('a list alone is the review, until its takes are given; other tables and JSON are left to be opened', async () => {
  const { parts, verdicts } = page();
  const dump = [given('positions.csv', 'x,y,z\n1,2,3\n'), given('pose.json', '[[1, 2, 3]]')];
  expect(await takeForReview(parts, dump)).toEqual(dump);
  const list = listAsCsv([{ path: 'a.bvh', ...NO_REVIEW, verdict: 'bad' }]);
  await takeForReview(parts, [given('list.csv', list)]);
  expect(verdicts()).toEqual(['a.bvh bad']);
  expect(parts.timeline.review.files.get()?.has('a.bvh')).toBe(false);
});
