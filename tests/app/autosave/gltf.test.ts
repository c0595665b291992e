import { expect, it } from 'vitest';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import type { Runs } from '../../../src/worker/client.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { GltfMaker } from '../../import/make-gltf.ts';
import { memoryStore } from './memory-store.ts';

const read = async (files: readonly GivenBlob[]) => structuredClone(await parse({ files }, () => undefined));
const worker: Runs<'parse'> = { run: (_job, { files }) => read(files) };
const reading = { signal: new AbortController().signal, onProgress: () => undefined };

/** A triangle, its buffer in a file of its own. */
function triangle(folder: string): readonly GivenBlob[] {
  const maker = new GltfMaker();
  const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 1, 0, 0, 0, 2, 0));
  const made = maker.made({
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION } }] }],
  });
  const [bytes] = made.buffers;
  const json = { ...made.json, buffers: [{ uri: 'tri.bin', byteLength: bytes.length }] };
  return [
    { path: `${folder}tri.gltf`, blob: new Blob([JSON.stringify(json)]) },
    { path: `${folder}tri.bin`, blob: new Blob([bytes]) },
  ];
}

const stateOf = (files: Awaited<ReturnType<typeof read>>['files']) => ({
  document: openFiles(EMPTY_DOCUMENT, files, [], undefined).document,
  selection: NOTHING_SELECTED,
  transport: DEFAULT_PLAYBACK,
  timeline: DEFAULT_TIMELINE_VIEW,
  camera: { target: [0, 1, 0] as const, azimuth: 0.5, polar: 1, distance: 3 },
});

it.each(['', 'models/'])(
  'a .gltf with its buffer beside it is restored, and restored again, in folder “%s”',
  async (folder) => {
    const store = memoryStore();
    const origins = new Origins();
    const given = triangle(folder);
    const { files } = await read(given);
    origins.learn(given, files);
    const state = stateOf(files);
    expect(state.document.characters[0].skins).toHaveLength(1);
    await new Keeper('s', store, origins).save(state, 0);

    const again = new Origins(1000);
    const restored = await readSession('s', store, worker, again, reading);
    expect(restored.state.document.characters).toEqual(state.document.characters);
    // What is kept on from there has the buffer, too.
    await restored.keeper().save(restored.state, 1);
    const twice = await readSession('s', store, worker, new Origins(2000), reading);
    expect(twice.state.document.characters).toEqual(state.document.characters);
  },
);

it('where the buffer of a .gltf can’t be stored, its character is, as if it was created here', async () => {
  const store = memoryStore();
  const origins = new Origins();
  const given = triangle('');
  const { files } = await read(given);
  origins.learn(given, files);
  store.onWrite = ({ files: puts }) => {
    if (puts.length > 0) throw new Error('The file is gone.');
  };
  const state = stateOf(files);
  await new Keeper('s', store, origins).save(state, 0);
  const restored = await readSession('s', store, worker, new Origins(1000), reading);
  expect(restored.state.document.characters[0].skins).toEqual(state.document.characters[0].skins);
});
