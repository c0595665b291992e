import { afterEach, describe, expect, it, vi } from 'vitest';
import { Opener } from '../../src/app/opening.ts';
import { Unsaved } from '../../src/app/unsaved.ts';

import { setDofs } from '../../src/edit/commands/pose.ts';
import { addToReview } from '../../src/edit/commands/review.ts';
import { createRig } from '../../src/edit/commands/rig.ts';
import { setHidden } from '../../src/edit/commands/spaces.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { type Character, findCharacter } from '../../src/model/document.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import type { Loading } from '../../src/ui/state/workbench.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { character, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import { walkerFiles } from '../helpers/hero.ts';
import { GltfMaker } from '../import/make-gltf.ts';
import { InThisThread } from './in-this-thread.ts';

function openerOf(
  store: Store,
  {
    transport = observable(DEFAULT_PLAYBACK),
    reducesMotion = false,
    messages = new Messages(),
    loading = observable<Loading | undefined>(undefined),
    prepare = (_: Character): void => undefined,
  } = {},
): Opener {
  return new Opener({
    store,
    transport,
    messages,
    loading,
    viewport: { prepare },
    camera: { frameAll: () => undefined },
    worker: new InThisThread(),
    reducesMotion: () => reducesMotion,
  });
}
const sample = () => [{ path: 'walker.skel', blob: new Blob([saveCharacter(character(), 'skel')[0].text]) }];
const shown = ({ document: { characters, isOpeningSample } }: Store) => ({
  names: characters.map(({ name }) => name),
  isOpeningSample,
});

describe('the opening sample', () => {
  it('the opening example is shown without an undo step', async () => {
    const store = new Store();
    await openerOf(store).open(sample, { asOpeningSample: true });
    expect(shown(store)).toEqual({ names: ['walker'], isOpeningSample: true });
    expect(store.undoLabel).toBeUndefined();
  });

  it('the opening sample is not opened if something else was begun before', async () => {
    const store = new Store();
    const opening = openerOf(store).open(sample, { asOpeningSample: true });
    store.apply(createRig, {});
    await opening;
    expect(shown(store)).toEqual({ names: ['character'], isOpeningSample: false });
  });

  it('the opening example makes way for files only while nothing to be saved was changed in it', async () => {
    const store = new Store();
    const opener = openerOf(store);
    await opener.open(sample, { asOpeningSample: true });
    const dropSword = () =>
      opener.open(() => [{ path: 'sword.skel', blob: new Blob([saveCharacter(character(), 'skel')[0].text]) }]);
    const drop = { names: ['sword'], isOpeningSample: false };
    const beside = { names: ['walker', 'sword'], isOpeningSample: false };
    store.apply(setHidden, { ids: ['c1'], hidden: true });
    await dropSword();
    expect(shown(store)).toEqual(drop);
    store.undo();
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 0.5 }], timeSeconds: 0 });
    expect(shown(store)).toEqual({ names: ['walker'], isOpeningSample: 'changed' });
    await dropSword();
    expect(shown(store)).toEqual(beside);
    store.undo();
    store.undo();
    expect(shown(store)).toEqual({ names: ['walker'], isOpeningSample: true });
    await dropSword();
    expect(shown(store)).toEqual(drop);
    store.undo();
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 0.5 }], timeSeconds: 0, key: {} });
    store.apply(createRig, {});
    expect(shown(store).names).toEqual(['walker', 'character']);
    store.undo();
    store.apply(addToReview, { paths: ['a.bvh'] });
    expect(shown(store).names).toEqual(['walker']);
  });
});

it.each([1, 30])('opening %i characters at once is one change and one step', async (count) => {
  const store = new Store();
  let told = 0;
  store.subscribe(() => told++);
  await openerOf(store).open(() => walkerFiles(count));
  expect(store.document.characters).toHaveLength(count);
  expect(told).toBe(1);
  store.undo();
  expect(store.document.characters).toEqual([]);
});

it('what is opened counts as saved in the same task: nothing unsaved is told to be replaced, also when it is opened again', async () => {
  const store = new Store();
  const opener = openerOf(store);
  const unsaved = new Unsaved(store);
  const replaced: string[] = [];
  opener.subscribe(({ files }) => replaced.push(...unsaved.opened(files)));
  await opener.open(sample);
  await opener.open(sample);
  expect(replaced).toEqual([]);
  expect(unsaved.current()).toEqual([]);
});

it('opening selects a new character, keeps the selection for a part of the selected one, and undo restores it', async () => {
  const store = new Store();
  const opener = openerOf(store);
  await opener.open(sample);
  expect(store.selection).toEqual({ characterId: 'c1' });
  const joint = { characterId: 'c1', joint: 1 };
  store.select(joint);
  const walk = saveCharacter(character({ takes: [takeOfValues('walker_walk', [1])] }), 'anim')[0].text;
  await opener.open(() => [{ path: 'walker_walk.anim', blob: new Blob([walk]) }]);
  expect(store.selection).toEqual(joint);
  const [{ blob }] = sample();
  await opener.open(() => [{ path: 'runner.skel', blob }]);
  expect(store.selection).toEqual({ characterId: 'c2' });
  store.undo();
  expect(store.selection).toEqual(joint);
});

it.each([false, true])('a new take starts to play unless motion is to be reduced: %s', async (reducesMotion) => {
  const transport = observable({ ...DEFAULT_PLAYBACK, timeSeconds: 1.5 });
  const opener = openerOf(new Store(), { transport, reducesMotion });
  const walk = saveCharacter(character({ takes: [takeOfValues('walker_walk', [1])] }), 'anim')[0].text;
  await opener.open(() => [...sample(), { path: 'walker_walk.anim', blob: new Blob([walk]) }]);
  expect(transport.get().playing).toBe(!reducesMotion);
  expect(transport.get().timeSeconds).toBe(transport.get().range[0]);
});

describe('a file with errors', () => {
  const file = (path: string, text: string) => ({ path, blob: new Blob([text]) });
  const parts = (['skel', 'skin', 'anim'] as const).map((kind) => {
    const hero = character({ skins: [skin()], takes: [takeOfValues('hero_walk', new Array(9).fill(0))], shownTake: 0 });
    const [{ name, text }] = saveCharacter(hero, kind);
    return { whole: file(name, text), broken: file(name, text.replace(/ [0-9.]+/, ' 1x')) };
  });
  const textsOf = (messages: Messages) => messages.list.get().map(({ text }) => text);

  it.each(['skel', 'skin', 'anim'])(
    'a .%s with errors takes them away when it is mended, and is open',
    async (kind) => {
      const [store, messages] = [new Store(), new Messages()];
      const opener = openerOf(store, { messages });
      const lost = parts.filter(({ whole: { path } }) => path.endsWith(kind));
      await opener.open(() => parts.map((part) => (lost.includes(part) ? part.broken : part.whole)));
      const open = () => store.document.characters.map(({ skins, takes }) => [skins.length, takes.length]);
      expect(open()).toEqual({ skel: [], skin: [[0, 1]], anim: [[1, 0]] }[kind]);
      const fate = kind === 'skel' ? /not opened\. / : /not opened; the character was opened without it/;
      expect(textsOf(messages).at(-1)).toMatch(fate);
      await opener.open(() => lost.map(({ whole }) => whole));
      expect(open()).toEqual([[1, 1]]);
      expect(textsOf(messages)).toEqual([]);
    },
  );
});

describe('the opener, of a .gltf and its buffers', () => {
  /** A triangle, `tall` high; its numbers are in another file. */
  function triangle(name: string, tall: number, buffers = [`${name}.bin`]) {
    const maker = new GltfMaker();
    const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 1, 0, 0, 0, tall, 0));
    const made = maker.made({
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION } }] }],
    });
    const [bytes] = made.buffers;
    const json = { ...made.json, buffers: buffers.map((uri) => ({ uri, byteLength: bytes.length })) };
    return [
      { path: `${name}.gltf`, blob: new Blob([JSON.stringify(json)]) },
      { path: `${name}.bin`, blob: new Blob([bytes]) },
    ] as const;
  }
  const tops = ({ document: { characters } }: Store) =>
    characters.map(({ name, skins: [skin] }) => [name, Math.max(...(skin?.positions ?? []))]);

  it.each(['.gltf first', '.bin first'])('what was dropped one by one comes together, %s', async (order) => {
    const store = new Store();
    const messages = new Messages();
    const opener = openerOf(store, { messages });
    const parts = triangle('tri', 2);
    const [first, second] = order === '.bin first' ? parts.toReversed() : parts;
    const told = await opener.open(() => [first]);
    expect(store.document.characters).toEqual([]);
    expect(told).toMatchObject(
      order === '.bin first'
        ? [{ severity: 'info', code: 'file-unused', assumed: 'kept for a matching file' }]
        : [{ severity: 'error', code: 'part-not-given', message: expect.stringContaining('needs "tri.bin"') }],
    );
    await opener.open(() => [second]);
    expect(tops(store)).toEqual([['tri', 2]]);
    expect(messages.list.get().map(({ text }) => text)).toEqual(
      order === '.bin first' ? [expect.stringContaining('Read with tri.bin, given before')] : [],
    );

    // Edited in another program: its buffer is that which was given.
    const [again] = triangle('tri', 2);
    expect(await opener.open(() => [again])).toMatchObject([
      { code: 'part-given-before', message: expect.stringContaining('tri.bin') },
    ]);
    expect(tops(store)).toEqual([['tri', 2]]);
    // Exported again, with other numbers.
    const [, other] = triangle('tri', 3);
    expect(await opener.open(() => [other])).toEqual([]);
    expect(tops(store)).toEqual([['tri', 3]]);
    expect(store.document.characters).toHaveLength(1);
    store.undo();
    expect(tops(store)).toEqual([['tri', 2]]);
  });

  it('a .gltf of two buffers waits for both, and names those that are missing', async () => {
    const store = new Store();
    const opener = openerOf(store);
    const [gltf, bin] = triangle('two', 1, ['two.bin', 'more.bin']);
    expect(await opener.open(() => [gltf])).toMatchObject([
      { message: expect.stringContaining('needs "two.bin", "more.bin" for its buffers') },
    ]);
    expect(await opener.open(() => [bin])).toMatchObject([{ message: expect.stringContaining('needs "more.bin"') }]);
    await opener.open(() => [{ path: 'more.bin', blob: new Blob([new Uint8Array(48)]) }]);
    expect(tops(store)).toEqual([['two', 1]]);
  });

  it('a buffer of the same name in another folder is not taken for that of a .gltf given before', async () => {
    const store = new Store();
    const opener = openerOf(store);
    const inFolder = (folder: string, tall: number) =>
      triangle('scene', tall).map(({ path, blob }) => ({ path: `${folder}/${path}`, blob }));
    await opener.open(() => inFolder('a', 1));
    await opener.open(() => inFolder('b', 5));
    expect(tops(store).map(([, top]) => top)).toEqual([1, 5]);
    const [, bin] = inFolder('c', 7);
    expect(await opener.open(() => [bin])).toMatchObject([{ code: 'file-unused' }]);
    expect(tops(store).map(([, top]) => top)).toEqual([1, 5]);
  });

  it('a buffer of a glTF file dropped alone is said to be kept: nothing else tells that it was read', async () => {
    const messages = new Messages();
    await openerOf(new Store(), { messages }).open(() => [triangle('tri', 2)[1]]);
    expect(messages.passing.get()).toMatch(/^tri\.bin is kept for a matching file\. /);
  });

  it('files given before are noted as those of what they opened, for reloading', async () => {
    const opener = openerOf(new Store());
    const [gltf, bin] = triangle('tri', 2);
    const noted: string[][] = [];
    opener.subscribe(({ given }) => noted.push(given.map(({ path }) => path)));
    await opener.open(() => [gltf]);
    await opener.open(() => [bin]);
    expect(noted).toEqual([['tri.bin', 'tri.gltf']]);
  });
});

it('a file of a kind that is not read is not said to be opened', async () => {
  const messages = new Messages();
  await openerOf(new Store(), { messages }).open(() => [{ path: 'notes.md', blob: new Blob(['# Notes']) }]);
  expect(messages.list.get().map(({ text }) => text)).toEqual([
    expect.stringMatching(/^notes\.md: Marrow does not read this type of file; it reads \.skel /),
  ]);
});

describe('opening in slices', () => {
  afterEach(() => {
    vi.restoreAllMocks();
  });

  /** A clock by which each step takes most of a slice; `then` happens in the pause after the first one. */
  function slowClock(then: () => void = () => undefined): void {
    let looks = 0;
    vi.spyOn(performance, 'now').mockImplementation(() => {
      if (++looks === 3) queueMicrotask(then);
      return 5 * looks;
    });
  }
  const three = () => ['a', 'b', 'c'].flatMap((name) => sample().map(({ blob }) => ({ path: `${name}.skel`, blob })));

  it('what is put together in slices is the same, as one step', async () => {
    const [atOnce, store] = [new Store(), new Store()];
    await openerOf(atOnce).open(three);
    slowClock();
    await openerOf(store).open(three);
    expect(store.document.characters).toEqual(atOnce.document.characters);
    expect(store.undoLabel).toBe('Open a.skel and 2 more');
    store.undo();
    expect(store.document.characters).toEqual([]);
  });

  it('a change of the document between two slices is kept, beside what is opened', async () => {
    const store = new Store();
    slowClock(() => store.apply(createRig, {}));
    await openerOf(store).open(three);
    expect(shown(store).names).toEqual(['character', 'a', 'b', 'c']);
    store.undo();
    expect(shown(store).names).toEqual(['character']);
  });

  it('opening that is cancelled between two slices changes nothing, and says so', async () => {
    const [store, messages] = [new Store(), new Messages()];
    const loading = observable<Loading | undefined>(undefined);
    slowClock(() => loading.get()?.cancel());
    await openerOf(store, { messages, loading }).open(three);
    expect(store.document.characters).toEqual([]);
    expect(messages.passing.get()).toBe('Open cancelled. Nothing was changed.');
  });

  it('what shows many characters is made ready before they are in the document, and of few with them', async () => {
    const store = new Store();
    const prepared: Character[] = [];
    const early: boolean[] = [];
    const opener = openerOf(store, {
      prepare: (character) => {
        prepared.push(character);
        early.push(findCharacter(store.document, character.id) === undefined);
      },
    });
    await opener.open(three);
    expect(prepared).toEqual([]);
    const [{ blob }] = sample();
    await opener.open(() => Array.from({ length: 150 }, (_, i) => ({ path: `d${i}.skel`, blob })));
    expect(prepared.map(({ id }) => id)).toEqual(store.document.characters.slice(3).map(({ id }) => id));
    expect(early.every(Boolean)).toBe(true);
    prepared.length = 0;
    const [{ text }] = saveCharacter(character({ skeleton: skeleton(5000) }), 'skel');
    await opener.open(() => [{ path: 'long.skel', blob: new Blob([text]) }]);
    expect(prepared.map(({ skeleton }) => skeleton?.joints.length)).toEqual([5000]);
  });

  it('the opening sample gives way to what was begun between two slices', async () => {
    const store = new Store();
    slowClock(() => store.apply(createRig, {}));
    await openerOf(store).open(sample, { asOpeningSample: true });
    expect(shown(store)).toEqual({ names: ['character'], isOpeningSample: false });
  });
});
