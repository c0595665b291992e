import { describe, expect, it } from 'vitest';
import { canReload } from '../../src/app/disk-handles.ts';
import { Opener } from '../../src/app/opening.ts';
import { reload } from '../../src/app/reload.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { DiskError } from '../../src/io/disk-access.ts';
import type { DiskFile } from '../../src/io/disk-files.ts';
import type { Character } from '../../src/model/document.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import type { Loading } from '../../src/ui/state/workbench.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { character, skeleton, takeOfValues } from '../helpers/builders.ts';
import { pageWith } from './disk.ts';
import { InThisThread } from './in-this-thread.ts';

const SKEL = saveCharacter(character(), 'skel')[0].text;
const animOf = (value: number, name = 'hero_walk') =>
  saveCharacter(character({ takes: [takeOfValues(name, new Array(9).fill(value), [0, 2])] }), 'anim')[0].text;
const HERO = { 'hero.skel': SKEL, 'hero_walk.anim': animOf(0.5) };

async function page(texts: Readonly<Record<string, string>> = HERO) {
  const base = await pageWith(texts);
  const { store, messages, handles, unsaved, disk } = base;
  const transport = observable({ ...DEFAULT_PLAYBACK, timeSeconds: 1.25, playing: true });
  let framed = 0;
  const opener = new Opener({
    store,
    transport,
    messages,
    loading: observable<Loading | undefined>(undefined),
    viewport: { prepare: () => undefined },
    camera: { frameAll: () => void framed++ },
    worker: new InThisThread(),
    reducesMotion: () => false,
  });
  opener.subscribe(({ given, files }) => {
    handles.note(given);
    unsaved.opened(files);
  });
  const parts = {
    store,
    messages,
    opener,
    unsaved,
    handles,
    async readAgain({ path, handle }: DiskFile) {
      const text = handle && disk.files.get(handle);
      if (text === undefined) throw new DiskError('It is gone.', true);
      return { path, blob: new Blob([text]), version: text, ...(handle && { handle }) };
    },
  };
  const edit = (name: string, text: string) => {
    const handle = base.handle(name);
    if (handle) disk.files.set(handle, text);
  };
  const reloadIt = () => reload(parts, 'c1');
  const own = () => store.document.characters[0];
  return { ...base, transport, edit, reloadIt, own, parts, framed: () => framed };
}

const longer = (c: Character): Character => ({ ...c, takes: c.takes.map((own) => ({ ...own, range: [0, 7] })) });
const value = (c: Character) => keysOf(c.takes[0].channels[0]).values[0];

describe('reloading', () => {
  it('replaces the part whose file has changed, and nothing else', async () => {
    const here = await page();
    const before = here.own();
    here.edit('hero_walk.anim', animOf(2));
    await here.reloadIt();
    expect(value(here.own())).toBe(2);
    expect(here.own().skeleton).toBe(before.skeleton);
    expect(here.store.document.characters).toHaveLength(1);
    expect(here.names()).toEqual([]);
    expect(here.messages.passing.get()).toBe('Reloaded hero_walk.anim.');
  });

  it('reloading keeps time, playback, camera and selection', async () => {
    const here = await page();
    const selection = { characterId: 'c1', joint: 1 };
    here.store.select(selection);
    const before = here.transport.get();
    here.edit('hero_walk.anim', animOf(2));
    here.edit('hero.skel', SKEL.replace('offset 0 1 0', 'offset 0 3 0'));
    await here.reloadIt();
    expect(here.own().skeleton?.joints[0].offset).toEqual([0, 3, 0]);
    expect(here.transport.get()).toBe(before);
    expect(here.framed()).toBe(0);
    expect(here.store.selection).toEqual(selection);
  });

  it('reloading several files is one step, whose undo restores an edit', async () => {
    const here = await page();
    here.change(longer);
    const edited = here.store.document;
    here.edit('hero_walk.anim', animOf(2));
    here.edit('hero.skel', SKEL.replace('offset 0 1 0', 'offset 0 3 0'));
    await here.reloadIt();
    expect(here.store.undoLabel).toBe('Reload hero.skel and 1 more');
    here.store.undo();
    expect(here.store.document).toEqual(edited);
  });

  it('reloading keeps the character of a removed joint selected, and undo selects the joint again', async () => {
    const here = await page({ 'hero.skel': SKEL });
    const selection = { characterId: 'c1', joint: 1 };
    here.store.select(selection);
    here.edit('hero.skel', saveCharacter(character({ skeleton: skeleton(1) }), 'skel')[0].text);
    await here.reloadIt();
    expect(here.store.selection).toEqual({ characterId: 'c1' });
    here.store.undo();
    expect(here.store.selection).toEqual(selection);
  });

  it('reloading keeps keys of unchanged channels selected, and deselects others', async () => {
    const here = await page();
    const keys = [0, 4].map((channel) => ({ channel, indices: [0] }));
    here.store.select({ characterId: 'c1', keys });
    here.edit('hero.skel', SKEL.replace('offset 0 1 0', 'offset 0 3 0'));
    await here.reloadIt();
    expect(here.store.selection.keys).toEqual(keys);
    const other = takeOfValues('hero_walk', new Array(9).fill(0.5), [0, 2]);
    const text = saveCharacter(
      character({ takes: [{ ...other, channels: other.channels.map((c, i) => (i === 4 ? restChannel() : c)) }] }),
      'anim',
    )[0].text;
    here.edit('hero_walk.anim', text);
    await here.reloadIt();
    expect(here.store.selection.keys).toEqual([keys[0]]);
  });

  it('reloading keeps showing the same take', async () => {
    const here = await page({ ...HERO, 'hero_run.anim': animOf(1, 'hero_run') });
    const [run, walk] = ['hero_run', 'hero_walk'].map((name) => here.own().takes.findIndex((c) => c.name === name));
    here.change((c) => ({ ...c, shownTake: walk }));
    here.edit('hero_run.anim', animOf(3, 'hero_run'));
    await here.reloadIt();
    expect(here.own().shownTake).toBe(walk);
    expect(keysOf(here.own().takes[run].channels[0]).values[0]).toBe(3);
  });

  it('changes nothing if a file is broken, and loads it once it is corrected', async () => {
    const here = await page();
    const before = here.store.document;
    here.edit('hero_walk.anim', animOf(2).replace('numchannels 9', 'numchannels nine'));
    const diagnostics = await here.reloadIt();
    expect(here.store.document).toBe(before);
    expect(diagnostics.some((d) => d.severity === 'error' && d.file === 'hero_walk.anim')).toBe(true);
    here.edit('hero_walk.anim', animOf(2));
    await here.reloadIt();
    expect(value(here.own())).toBe(2);
    expect(here.messages.list.get()).toEqual([]);
  });

  it('reverts edits if the file itself has not changed', async () => {
    const here = await page();
    here.change(longer);
    await here.reloadIt();
    expect(here.own().takes[0].range).toEqual([0, 2]);
    expect(here.names()).toEqual([]);
    here.store.undo();
    expect(here.names()).toEqual(['hero_walk.anim']);
  });

  it('reloading keeps edits here if another file has changed', async () => {
    const here = await page();
    here.change(longer);
    here.edit('hero.skel', SKEL.replace('offset 0 1 0', 'offset 0 3 0'));
    await here.reloadIt();
    expect(here.own().takes[0].range).toEqual([0, 7]);
    expect(here.names()).toEqual(['hero_walk.anim']);
  });

  it('reloads a pose library', async () => {
    const poses = (...values: number[]) =>
      saveCharacter(character({ poses: values.map((v) => ({ name: `pose ${v}`, values: [v] })) }), 'pose')[0].text;
    const here = await page({ ...HERO, 'hero.pose': poses(1, 2) });
    const names = () => here.own().poses?.map(({ name }) => name);
    expect(names()).toEqual(['pose 1', 'pose 2']);
    here.edit('hero.pose', poses(2, 3));
    await here.reloadIt();
    expect(names()).toEqual(['pose 2', 'pose 3']);
    expect(here.names()).toEqual([]);
    here.change(({ poses: [first] = [], ...c }) => ({ ...c, poses: [{ ...first, name: 'mine' }] }));
    await here.reloadIt();
    expect(names()).toEqual(['pose 2', 'pose 3']);
    expect(here.own().sources.filter(({ name }) => name === 'hero.pose')).toHaveLength(1);
  });

  it('reloading reports that nothing has changed', async () => {
    const here = await page();
    const before = here.store.document;
    await here.reloadIt();
    expect(here.store.document).toBe(before);
    expect(here.messages.passing.get()).toBe('Nothing has changed on disk.');
  });

  it('names a file that can’t be read, and reads the others', async () => {
    const here = await page();
    const gone = here.handle('hero.skel');
    if (gone) here.disk.files.delete(gone);
    here.edit('hero_walk.anim', animOf(2));
    await here.reloadIt();
    expect(value(here.own())).toBe(2);
    expect(here.messages.list.get().map((m) => m.text)).toEqual(['hero.skel: Not reloaded. It is gone.']);
  });

  it('reloads a take that was created here and saved', async () => {
    const here = await page();
    here.change((c) => ({
      ...c,
      takes: [...c.takes, takeOfValues('new', new Array(9).fill(1), [0, 3])],
      shownTake: 1,
    }));
    const handle = here.disk.put('new.anim', '');
    here.disk.picks = handle;
    await here.saver.saveChanged();
    here.disk.files.set(handle, animOf(6, 'new'));
    await here.reloadIt();
    expect(here.own().takes.map((c) => c.name)).toEqual(['hero_walk', 'new']);
    expect(keysOf(here.own().takes[1].channels[0]).values[0]).toBe(6);
  });

  it('reloading is available only for content of files, and not for the opening example', async () => {
    const here = await page();
    expect(canReload(here.parts.store.document, here.parts.handles, 'c1')).toBe(true);
    expect(canReload(here.parts.store.document, here.parts.handles, 'c9')).toBe(false);
    here.store.amend({ ...here.store.document, isOpeningSample: true });
    expect(canReload(here.parts.store.document, here.parts.handles, 'c1')).toBe(false);
    const without = await pageWith({ 'hero.skel': SKEL }, false);
    expect(canReload(without.store.document, without.handles, 'c1')).toBe(false);
  });
});

it('a reloaded skeleton has its file pose, and counts as saved', async () => {
  const here = await page({ 'hero.skel': SKEL });
  here.change((c) => ({ ...c, pose: c.pose.map((v, i) => (i === 4 ? 0.5 : v)) }));
  expect(here.names()).toEqual(['hero.skel']);
  here.edit('hero.skel', saveCharacter(character({ skeleton: skeleton(3) }), 'skel')[0].text);
  await here.reloadIt();
  expect(here.own().skeleton?.joints).toHaveLength(3);
  expect(here.own().pose.every((v) => v === 0)).toBe(true);
  expect(here.names()).toEqual([]);
});

describe('reloading a .gltf', () => {
  const GLTF = JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: 'post', mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    buffers: [{ uri: 'post.bin', byteLength: 36 }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 }],
  });
  /** Floats whose bytes are characters: 0, 0.5 and 2. */
  const buffer = (...values: readonly (0 | 0.5 | 2)[]) =>
    values.map((v) => `\0\0\0${{ 0: '\0', 0.5: '?', 2: '@' }[v]}`).join('');
  const FILES = { 'a/post.gltf': GLTF, 'a/post.bin': buffer(0, 0, 0, 2, 0, 0, 0, 2, 0) };
  const across = (c: Character) => c.skins[0].positions[3];

  it.each([
    ['its buffer', { 'post.bin': buffer(0, 0, 0, 0.5, 0, 0, 0, 2, 0) }, 0.5, 'post', 'Reloaded post.bin.'],
    ['itself', { 'post.gltf': GLTF.replace('"post"', '"pole"') }, 2, 'pole', 'Reloaded post.gltf.'],
  ])('reads all of its files when only %s has changed', async (_, changed, wide, joint, said) => {
    const here = await page(FILES);
    expect(across(here.own())).toBe(2);
    for (const [name, text] of Object.entries(changed)) here.edit(name, text);
    expect(await here.reloadIt()).toEqual([]);
    expect(here.store.document.characters).toHaveLength(1);
    expect(here.own().skins).toHaveLength(1);
    expect(across(here.own())).toBe(wide);
    expect(here.own().skeleton?.joints.at(-1)?.name).toBe(joint);
    expect(here.messages.passing.get()).toBe(said);
  });

  it('reads nothing when none of its files has changed', async () => {
    const here = await page(FILES);
    await here.reloadIt();
    expect(here.messages.passing.get()).toBe('Nothing has changed on disk.');
  });
});
