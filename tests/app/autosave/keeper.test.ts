import { isDeepStrictEqual } from 'node:util';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RestoreError } from '../../../src/app/autosave/decode.ts';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import type { SessionState } from '../../../src/app/autosave/session-state.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { adoptSkinFacts, skinFacts } from '../../../src/evaluate/skin/bounds.ts';
import type { Document } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import type { Channel, KeyedChannel } from '../../../src/model/takes/take.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import type { Runs } from '../../../src/worker/client.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { character, documentOf, morph, skin, takeOfValues } from '../../helpers/builders.ts';
import { type MemoryStore, memoryStore } from './memory-store.ts';

const SKEL = 'balljoint root {\n\tballjoint tip {\n\t\toffset 0 1 0\n\t}\n}\n';
const SKIN = `positions 3 { 0 0 0 1 0 0 0 1 0 }
skinweights 3 { 1 0 1 1 0 1 1 0 1 }
triangles 1 { 0 1 2 }
bindings 1 { matrix { 1 0 0 0 1 0 0 0 1 0 0 0 } }
`;
const given = (path: string, text = SKEL): GivenBlob => ({ path, blob: new Blob([text]) });

function stateOf(document: Document): SessionState {
  return {
    document,
    selection: NOTHING_SELECTED,
    transport: DEFAULT_PLAYBACK,
    timeline: DEFAULT_TIMELINE_VIEW,
    camera: { target: [0, 1, 0], azimuth: 0.5, polar: 1, distance: 3 },
  };
}

/** The worker's job without the worker, but as a copy, as from there. */
const read = async (files: readonly GivenBlob[]) => structuredClone(await parse({ files }, () => undefined));
const worker: Runs<'parse'> = { run: (_job, { files }) => read(files) };
/** Vitest's own comparison of long arrays takes seconds. */
const expectSame = (a: unknown, b: unknown) => expect(isDeepStrictEqual(a, b)).toBe(true);
const options = { signal: new AbortController().signal, onProgress: () => undefined };
const readBack = (store: MemoryStore, origins = new Origins(1000)) => readSession('s', store, worker, origins, options);

function channel(keys: number, first = 0): KeyedChannel {
  const column = () => Float64Array.from({ length: keys }, (_, i) => first + i);
  const side = () => ({ kinds: new Uint8Array(keys).fill(2), slopes: column() });
  return {
    kind: 'keys',
    extrapolateIn: 'constant',
    extrapolateOut: 'cycle',
    times: column(),
    values: column(),
    tangentsIn: side(),
    tangentsOut: side(),
  };
}

const animated = (channels: readonly Channel[]) =>
  documentOf(character({ takes: [{ ...takeOfValues('walk', []), channels }], shownTake: 0 }));

async function opened(store: MemoryStore, ...blobs: GivenBlob[]) {
  const origins = new Origins();
  const { files } = await read(blobs);
  origins.learn(blobs, files);
  return { origins, files, keeper: new Keeper('s', store, origins) };
}

const skinOf = (file: ParsedFile) => {
  if (file.kind !== 'skin') throw new Error('fixtures');
  return file.skin;
};
const skeletonOf = (file: ParsedFile) => {
  if (file.kind !== 'skel') throw new Error('fixtures');
  return file.skeletons[0];
};

describe('a session', () => {
  it('stores an opened file once, and a few words afterwards', async () => {
    const store = memoryStore();
    const { keeper, files } = await opened(store, given('hero.skel'));
    const document = documentOf(character({ skeleton: skeletonOf(files[0]) }));
    await keeper.save(stateOf(document), 1);
    expect(store.writes[0].files.map((f) => f.given.path)).toEqual(['hero.skel']);
    const posed = documentOf({ ...document.characters[0], pose: [1, 2, 3] });
    await keeper.save(stateOf(posed), 2);
    expect(store.writes[1].files).toEqual([]);
    expect(store.writes[1].pieces).toEqual([]);
  });

  it('stores only the changed columns of a long channel', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const [long, other] = [channel(100_000), channel(100_000, 7)];
    await keeper.save(stateOf(animated([long, other])), 1);
    await keeper.save(stateOf(animated([{ ...long, values: long.values.slice() }, other])), 2);
    expect(store.lastBytes()).toBe(long.values.byteLength);
  });

  it('reads back unchanged after any saves', async () => {
    const edit = fc.record({ index: fc.nat(5), keys: fc.nat(3000), first: fc.integer() });
    await fc.assert(
      fc.asyncProperty(fc.array(edit, { maxLength: 12 }), async (edits) => {
        const store = memoryStore();
        const { keeper, files, origins } = await opened(store, given('hero.skel'));
        const channels = Array.from({ length: 6 }, (_, i) => channel(20 * i));
        const build = () => {
          const base = animated([...channels]);
          return stateOf(documentOf({ ...base.characters[0], skeleton: skeletonOf(files[0]) }));
        };
        await keeper.save(build(), 1);
        for (const { index, keys, first } of edits) {
          channels[index] = channel(keys, first);
          await keeper.save(build(), 2);
        }
        const { state } = await readBack(store, origins);
        expectSame(state, build());
      }),
      { numRuns: 20 },
    );
  });

  it('continues after reading: stored data is not written again, unneeded data is deleted', async () => {
    const store = memoryStore();
    const { keeper, files } = await opened(store, given('hero.skel'));
    const long = channel(50_000);
    const base = animated([long, channel(100)]);
    await keeper.save(stateOf(documentOf({ ...base.characters[0], skeleton: skeletonOf(files[0]) })), 1);
    const back = await readBack(store);
    const next = back.keeper();
    const [hero] = back.state.document.characters;
    await next.save(stateOf(documentOf({ ...hero, name: 'other' })), 2);
    expect(store.writes[1]).toMatchObject({ files: [], pieces: [], goneFiles: [], gonePieces: [] });
    await next.save(stateOf(documentOf({ ...hero, takes: [] })), 3);
    expect(store.sessions.get('s')?.pieces.size).toBe(0);
    expect(store.sessions.get('s')?.files.size).toBe(1);
    await next.save(stateOf(documentOf(character())), 4);
    expect(store.sessions.get('s')?.files.size).toBe(0);
  });

  it('a session is unchanged after a failed save, and complete after the next', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const before = stateOf(animated([channel(5000)]));
    const after = stateOf(animated([channel(6000)]));
    await keeper.save(before, 1);
    store.onWrite = () => {
      throw new DOMException('full', 'QuotaExceededError');
    };
    await expect(keeper.save(after, 2)).rejects.toThrow('full');
    expectSame((await readBack(store)).state, before);
    store.onWrite = () => undefined;
    await keeper.save(after, 3);
    expectSame((await readBack(store)).state, after);
  });

  it('stores content of a file that can’t be copied any more as its own', async () => {
    const store = memoryStore();
    const { keeper, files } = await opened(store, given('hero.skel'));
    store.onWrite = (write) => {
      if (write.files.length) throw new DOMException('It was changed on disk.', 'NotReadableError');
    };
    const state = stateOf(documentOf(character({ skeleton: skeletonOf(files[0]) })));
    await keeper.save(state, 1);
    expect(store.sessions.get('s')?.files.size).toBe(0);
    expectSame((await readBack(store)).state, state);
  });

  it('stores facts of skins that no file restores, and none of those that a file does', async () => {
    const store = memoryStore();
    const { keeper, files } = await opened(store, given('hero.skin', SKIN));
    const [made, smile, read] = [skin('made'), morph('smile'), skinOf(files[0])];
    // Marked, to tell them from recomputed ones.
    adoptSkinFacts(made, { ...skinFacts(made, [smile]), maxAttachments: 99 }, [smile]);
    adoptSkinFacts(read, { ...skinFacts(read), maxAttachments: 99 });
    const state = stateOf(documentOf(character({ skins: [made], morphs: [smile] }), character({ skins: [read] })));
    await keeper.save(state, 1);
    const back = await readBack(store);
    expectSame(back.state, state);
    const [one, other] = back.state.document.characters;
    expect(skinFacts(one.skins[0], one.morphs)).toEqual(skinFacts(made, [smile]));
    expect(skinFacts(one.skins[0]).maxAttachments).toBe(99);
    expect(skinFacts(other.skins[0]).maxAttachments).toBe(1);
    await back.keeper().save(back.state, 2);
    expect(store.writes[1]).toMatchObject({ files: [], pieces: [], goneFiles: [], gonePieces: [] });
  });

  it('a session is written again if its store was cleared', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const channels = [channel(5000)];
    await keeper.save(stateOf(animated(channels)), 1);
    store.sessions.clear();
    const state = stateOf(animated([...channels, channel(10)]));
    await keeper.save(state, 2);
    expectSame((await readBack(store)).state, state);
  });

  it('a session is right if an immediate save overtakes a running one, whether that finishes or not', async () => {
    for (const comesToAnEnd of [true, false]) {
      const store = memoryStore();
      const keeper = new Keeper('s', store, new Origins());
      const [a, b] = [channel(40_000), channel(40_000, 5)];
      await keeper.save(stateOf(animated([a])), 1);
      let letGo = () => {};
      store.onWrite = (write) => {
        if (write.atOnce) return undefined;
        return new Promise<void>((resolve, reject) => {
          letGo = comesToAnEnd ? resolve : () => reject(new DOMException('full', 'QuotaExceededError'));
        });
      };
      const slow = keeper.save(stateOf(animated([b])), 2).catch(() => undefined);
      await new Promise((resolve) => setImmediate(resolve));
      const last = stateOf(animated([a, b]));
      const hasty = keeper.saveAtOnce(last, 3);
      letGo();
      await Promise.all([slow, hasty]);
      expectSame((await readBack(store)).state, last);
    }
  });

  it('a session is refused as a whole if a file reads differently', async () => {
    const store = memoryStore();
    const { keeper, files } = await opened(store, given('hero.skel'));
    await keeper.save(stateOf(documentOf(character({ skeleton: skeletonOf(files[0]) }))), 1);
    const kept = store.sessions.get('s')?.files;
    for (const [id, file] of kept ?? []) kept?.set(id, { ...file, given: given('hero.skel', 'balljoint {') });
    await expect(readBack(store)).rejects.toThrow(RestoreError);
  });
});
