import { expect, it } from 'vitest';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import { savingMarks } from '../../../src/app/autosave/saving-marks.ts';
import { DiskHandles } from '../../../src/app/disk-handles.ts';
import { Unsaved } from '../../../src/app/unsaved.ts';
import { addLimb, keyLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { setLocked } from '../../../src/edit/commands/beside/sets.ts';
import { pinPoint, setStiffness } from '../../../src/edit/commands/ik.ts';
import { addMarkers } from '../../../src/edit/commands/markers.ts';
import { keepPose } from '../../../src/edit/commands/poses.ts';
import { addToReview, setReview } from '../../../src/edit/commands/review.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { Store } from '../../../src/edit/store.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import { ReviewState } from '../../../src/ui/state/review.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { character } from '../../helpers/builders.ts';
import { memoryStore } from './memory-store.ts';

const text = (kind: 'skel' | 'pose') =>
  saveCharacter(character({ poses: [{ name: 'sit', values: [1, 2, 3, 0.5] }] }), kind)[0].text;
const FILES: readonly GivenBlob[] = [
  { path: 'hero.skel', blob: new Blob([text('skel')]) },
  { path: 'hero.pose', blob: new Blob([text('pose')]) },
];
const read = async (files: readonly GivenBlob[]) => structuredClone(await parse({ files }, () => undefined));
const worker = { run: (_job: 'parse', { files }: { files: readonly GivenBlob[] }) => read(files) };

/** A page with the files open, and its session stored and read again. */
async function page(edit: (store: Store, review: ReviewState) => void, given = FILES) {
  const origins = new Origins();
  const { files } = await read(given);
  origins.learn(given, files);
  const store = new Store();
  const unsaved = new Unsaved(store);
  store.replace('Open', openFiles(EMPTY_DOCUMENT, files));
  unsaved.opened(files);
  const review = new ReviewState();
  edit(store, review);
  const kept = memoryStore();
  const camera = { target: [0, 1, 0], azimuth: 0.5, polar: 1, distance: 3 } as const;
  const rest = { selection: NOTHING_SELECTED, transport: DEFAULT_PLAYBACK, timeline: DEFAULT_TIMELINE_VIEW, camera };
  const saving = savingMarks(unsaved, new DiskHandles(), review).snapshot(store.document);
  await new Keeper('s', kept, origins).save({ document: store.document, ...rest, saving }, 1);
  const reading = { signal: new AbortController().signal, onProgress: () => undefined };
  const { state } = await readSession('s', kept, worker, new Origins(1000), reading);
  const next = new Store();
  next.adopt('Restore', { document: state.document, selection: NOTHING_SELECTED });
  const nextUnsaved = new Unsaved(next);
  const nextReview = new ReviewState();
  savingMarks(nextUnsaved, new DiskHandles(), nextReview).restore(state.saving);
  const [[before], [after]] = [store.document.characters, next.document.characters];
  return { before, after, unsaved: nextUnsaved, document: next.document, review: nextReview };
}

it('restores saved poses, pins, locks and stiffness', async () => {
  const { before, after, unsaved } = await page((store) => {
    store.apply(keepPose, { characterId: 'c1', name: 'kept by hand', timeSeconds: 0 });
    store.apply(pinPoint, { characterId: 'c1', joint: 1, point: [0, 1, 0], weight: 2, holdsOrientation: true });
    store.apply(setStiffness, { characterId: 'c1', joints: [0], stiffness: 4 });
  });
  expect(after.poses?.map(({ name }) => name)).toEqual(['sit', 'kept by hand']);
  expect(after.poses).toEqual(before.poses);
  expect(after.ik).toEqual({
    pins: [{ id: 1, joint: 1, point: [0, 1, 0], weight: 2, holdsOrientation: true }],
    stiff: [{ joint: 0, stiffness: 4 }],
    rootIsFree: true,
  });
  expect(unsaved.current().map(({ name }) => name)).toEqual(['hero.pose']);
});

it('recognises poses equal to those of their file', async () => {
  const { after, unsaved } = await page(() => undefined);
  expect(after.poses?.map(({ name }) => name)).toEqual(['sit']);
  expect(unsaved.current()).toEqual([]);
});

it('restores selection sets and locks, fields of their file that are not known, and what of them is saved', async () => {
  const given = '{"sets": [{"name": "all", "joints": ["#0"], "icon": {"of": [1]}}], "by": "another"}';
  const files = [...FILES, { path: 'wasp.sets.json', blob: new Blob([given]) }];
  const sets = [{ name: 'all', joints: [0], others: { icon: { of: [1] } } }];
  const untouched = await page(() => undefined, files);
  expect(untouched.after.sets).toEqual({ sets, locked: [], others: { by: 'another' } });
  expect(untouched.unsaved.current()).toEqual([]);
  const { after, unsaved } = await page(
    (store) => store.apply(setLocked, { characterId: 'c1', dofs: [4], locked: true }),
    files,
  );
  expect(after.sets).toMatchObject({ sets, locked: [{ joint: 0, dofs: ['ry'] }], others: { by: 'another' } });
  expect(unsaved.current().map(({ name }) => name)).toEqual(['wasp.sets.json']);
});

it('restores limbs and their goals, and that neither is saved yet', async () => {
  const { before, after, unsaved } = await page((store) => {
    store.apply(addLimb, { characterId: 'c1', joints: [0, 1], name: 'arm', orient: true });
    store.apply(keyLimb, { characterId: 'c1', timeSeconds: 0.5, limb: 0, blend: 1, space: 'parent' });
  });
  expect(after.limbs).toEqual(before.limbs);
  expect(after.takes).toEqual(before.takes);
  expect(after.takes[0].goals?.list).toMatchObject([{ limb: 'arm' }]);
  expect(unsaved.current().map(({ name }) => name)).toEqual(['hero_anim.anim', 'hero.limbs.json']);
});

const ROOT = 'ROOT hips { OFFSET 0 0 0 CHANNELS 3 Xposition Yposition Zposition End Site { OFFSET 0 20 0 } }';
const TAKE: readonly GivenBlob[] = [
  { path: 'walk.bvh', blob: new Blob([`HIERARCHY ${ROOT} MOTION Frames: 2 Frame Time: 0.1\n0 90 0\n1 90 0\n`]) },
];

it('restores markers, and what is said about takes in review, with what of it a list has', async () => {
  const MARKERS = [
    { timeSeconds: 0, label: 'begins' },
    { timeSeconds: 0, endSeconds: 0.1, label: 'all' },
  ];
  const said = { verdict: 'good', stars: 3, tags: ['calm'], notes: 'again, slower' } as const;
  const { after, document, review, unsaved } = await page((store, state) => {
    store.apply(addMarkers, { characterId: 'c1', markers: MARKERS });
    store.apply(addToReview, { paths: ['lab/a.bvh', 'lab/b.bvh'] });
    store.apply(setReview, { paths: ['lab/a.bvh'], review: said });
    state.areSaved(store.document.review ?? []);
    store.apply(setReview, { paths: ['lab/b.bvh'], review: { verdict: 'bad' } });
  }, TAKE);
  expect(after.takes[0].markers).toEqual(MARKERS);
  expect(unsaved.current().map(({ name }) => name)).toEqual(['walk.markers.json']);
  const [a, b] = document.review ?? [];
  expect(a).toEqual({ path: 'lab/a.bvh', ...said });
  expect(b).toMatchObject({ path: 'lab/b.bvh', verdict: 'bad' });
  expect([[a], [b]].map((takes) => review.isUnsaved(takes))).toEqual([false, true]);
});
