/** A session as stored by version 1: `session-version-1.bin`, written by that version. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { deserialize } from 'node:v8';
import { beforeAll, describe, expect, it } from 'vitest';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { putBack } from '../../../src/app/autosave/put-back.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import { savingMarks } from '../../../src/app/autosave/saving-marks.ts';
import { DiskHandles } from '../../../src/app/disk-handles.ts';
import { Unsaved } from '../../../src/app/unsaved.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { Store } from '../../../src/edit/store.ts';
import type { SessionCard } from '../../../src/io/session-store.ts';
import type { Character } from '../../../src/model/document.ts';
import { ReviewState } from '../../../src/ui/state/review.ts';
import { Timeline } from '../../../src/ui/state/timeline.ts';
import { observable } from '../../../src/ui/widgets/observable.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { memoryStore } from './memory-store.ts';

/** Content of the file: card and head as stored in the browser, with files and arrays. */
interface Kept {
  readonly card: SessionCard;
  readonly head: unknown;
  readonly files: readonly {
    readonly id: number;
    readonly opening: number;
    readonly path: string;
    readonly text: string;
  }[];
  readonly pieces: readonly { readonly id: number; readonly bytes: Uint8Array<ArrayBuffer> }[];
}

async function restored() {
  const path = fileURLToPath(new URL('../../fixtures/session-version-1.bin', import.meta.url));
  const kept: Kept = deserialize(readFileSync(path));
  const sessions = memoryStore();
  await sessions.write({
    card: kept.card,
    head: kept.head,
    files: kept.files.map(({ id, opening, path, text }) => ({ id, opening, given: { path, blob: new Blob([text]) } })),
    pieces: kept.pieces.map(({ id, bytes }) => ({ id, size: bytes.length, bytes: () => bytes })),
    chunks: [],
    goneFiles: [],
    gonePieces: [],
    goneChunks: [],
    follows: false,
    atOnce: false,
  });
  const worker = {
    run: async (_job: 'parse', { files }: { files: readonly GivenBlob[] }) =>
      structuredClone(await parse({ files }, () => undefined)),
  };
  const { state } = await readSession('s', sessions, worker, new Origins(1000), {
    signal: new AbortController().signal,
    onProgress: () => undefined,
  });
  const store = new Store();
  const unsaved = new Unsaved(store);
  const handles = new DiskHandles();
  const parts = {
    store,
    transport: observable(DEFAULT_PLAYBACK),
    timeline: new Timeline(),
    viewport: { cameraView: state.camera },
    saving: savingMarks(unsaved, handles, new ReviewState()),
  };
  putBack(state, parts, false);
  const change = (edit: (character: Character) => Character, index: number) =>
    store.replace('Change', {
      document: {
        ...store.document,
        characters: store.document.characters.map((c, i) => (i === index ? edit(c) : c)),
      },
    });
  return { store, unsaved, handles, change, names: () => unsaved.current().map(({ name }) => name) };
}

describe('a session kept by version 1', () => {
  let page: Awaited<ReturnType<typeof restored>>;
  beforeAll(async () => {
    page = await restored();
  });

  it('restores characters, takes, poses and files of version 1', () => {
    const { characters } = page.store.document;
    expect(
      characters.map(({ name, clips, sources }) => [name, clips.map((c) => c.name), sources.map((s) => s.name)]),
    ).toEqual([
      [
        'hero',
        ['hero_walk', 'hero_run', 'hero_jump', 'hero_new'],
        [
          'hero.skel',
          'hero.skin',
          'hero_smile.morph',
          'hero_walk.anim',
          'hero_run.anim',
          'kept.pose',
          'hero_jump.anim',
        ],
      ],
      ['dance', ['dance'], ['dance.bvh']],
    ]);
    expect(characters[0].poses?.map(({ name }) => name)).toEqual(['sit']);
    expect(characters[0].clips[0].range).toEqual([0, 7]);
    expect(page.store.selection).toEqual({ characterId: 'c1', joint: 1 });
  });

  it('knows what is unsaved, and nothing else', () => {
    expect(page.names()).toEqual(['hero.skel', 'hero_walk.anim', 'hero_new.anim']);
  });

  it('a session of version 1 knows the locations of its files', () => {
    const [hero, dance] = page.store.document.characters;
    expect(page.handles.ofCharacter(hero).map(({ path }) => path)).toEqual([
      'hero/hero.skel',
      'hero/hero.skin',
      'hero/hero_smile.morph',
      'hero/hero_walk.anim',
      'hero/hero_run.anim',
      'hero/kept.pose',
      'hero_jump.anim',
    ]);
    expect(page.handles.ofCharacter(dance).map(({ path }) => path)).toEqual(['dance.bvh']);
  });

  it('marks later changes as unsaved, until undone', () => {
    page.change((c) => ({ ...c, clips: c.clips.map((clip, i) => (i === 2 ? { ...clip, range: [0, 5] } : clip)) }), 0);
    expect(page.names()).toEqual(['hero.skel', 'hero_walk.anim', 'hero_jump.anim', 'hero_new.anim']);
    page.store.undo();
    expect(page.names()).toEqual(['hero.skel', 'hero_walk.anim', 'hero_new.anim']);
  });
});
