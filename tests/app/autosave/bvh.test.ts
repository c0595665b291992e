import { describe, expect, it } from 'vitest';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import { Unsaved } from '../../../src/app/unsaved.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { Store } from '../../../src/edit/store.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { partsOf } from '../../../src/model/character-parts.ts';
import { type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';
import { memoryStore } from './memory-store.ts';

const SKELETON = { name: 'walk', joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rx'], { endSites: [[0, 2, 0]] })] };
const ROWS = Array.from({ length: 20_000 }, (_, f) => [f, 1, 2, f / 7]);
const BLOB: GivenBlob = { path: 'walk.bvh', blob: new Blob([writeBvh([captureOf(SKELETON, ROWS)]).text]) };

const read = async (files: readonly GivenBlob[]) => structuredClone(await parse({ files }, () => undefined));
const worker = { run: (_job: 'parse', { files }: { files: readonly GivenBlob[] }) => read(files) };
const stateOf = (document: Document, saving: unknown) => ({
  document,
  saving,
  selection: NOTHING_SELECTED,
  transport: DEFAULT_PLAYBACK,
  timeline: DEFAULT_TIMELINE_VIEW,
  camera: { target: [0, 1, 0], azimuth: 0.5, polar: 1, distance: 3 } as const,
});

/** A page with the take open, and its session stored. */
async function openedPage() {
  const store = memoryStore();
  const origins = new Origins();
  const { files } = await read([BLOB]);
  origins.learn([BLOB], files);
  const page = new Store();
  const unsaved = new Unsaved(page);
  const { document } = openFiles(EMPTY_DOCUMENT, files);
  page.replace('Open', document);
  unsaved.opened(files);
  return { store, page, unsaved, keeper: new Keeper('s', store, origins) };
}

const again = (store: ReturnType<typeof memoryStore>) =>
  readSession('s', store, worker, new Origins(1000), {
    signal: new AbortController().signal,
    onProgress: () => undefined,
  });

describe('a kept session with motion capture', () => {
  it('stores the file of an unedited take, and none of its numbers', async () => {
    const { store, page, unsaved, keeper } = await openedPage();
    await keeper.save(stateOf(page.document, unsaved.snapshot(page.document)), 1);
    expect(store.writes[0].files.map((f) => f.given.path)).toEqual(['walk.bvh']);
    expect(store.writes[0].pieces).toEqual([]);
    const { state } = await again(store);
    const [before, after] = [page.document.characters[0], state.document.characters[0]];
    expect(after.skeleton).toEqual(before.skeleton);
    expect(after.takes[0].samples?.values).toEqual(before.takes[0].samples?.values);
  });

  it('stores edited samples once, and which of them are saved', async () => {
    const { store, page, unsaved, keeper } = await openedPage();
    const [character] = page.document.characters;
    const [take] = character.takes;
    if (!take.samples) throw new Error('There are samples.');
    const values = take.samples.values.map((v) => v + 1);
    const edited = { ...character, takes: [{ ...take, samples: { ...take.samples, values } }] };
    page.replace('Edit', { ...page.document, characters: [edited] });
    await keeper.save(stateOf(page.document, unsaved.snapshot(page.document)), 1);
    expect(store.lastBytes()).toBe(values.byteLength);
    await keeper.save(stateOf({ ...page.document, charactersMade: 9 }, unsaved.snapshot(page.document)), 2);
    expect(store.writes[1].pieces).toEqual([]);

    const { state } = await again(store);
    const next = new Store();
    const marks = new Unsaved(next);
    next.adopt('Restore', { document: state.document, selection: NOTHING_SELECTED });
    // Written by our own `snapshot`.
    marks.restore(state.saving as ReturnType<Unsaved['snapshot']>);
    expect(marks.current()).toMatchObject([{ kind: 'bvh', name: 'walk.bvh' }]);
    expect(partsOf(state.document.characters[0])[0]).toMatchObject({ kind: 'bvh', name: 'walk' });
    expect(state.document.characters[0].takes[0].samples?.values).toEqual(values);
  });
});
