/** That a file was not given is said while its character lacks it, and no longer. */
import { describe, expect, it } from 'vitest';
import { Opener } from '../../src/app/opening.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { leaveRefusalsBehind } from '../../src/ui/shell/stale-messages.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { character, paintedSkin, skin } from '../helpers/builders.ts';
import { GltfMaker } from '../import/make-gltf.ts';
import { workbench } from '../ui/builders.ts';
import { InThisThread } from './in-this-thread.ts';

/** A page with nothing open; `drop` opens files of these texts by their names, `said` is what is listed then. */
function page() {
  const store = new Store();
  const messages = new Messages();
  leaveRefusalsBehind({ store, messages, posing: workbench().wb.posing });
  const opener = new Opener({
    store,
    messages,
    transport: observable(DEFAULT_PLAYBACK),
    loading: observable(undefined),
    viewport: { prepare: () => undefined },
    camera: { frameAll: () => undefined },
    worker: new InThisThread(),
    reducesMotion: () => true,
  });
  const drop = (files: Readonly<Record<string, string | Uint8Array<ArrayBuffer>>>) =>
    opener.open(() => Object.entries(files).map(([path, content]) => ({ path, blob: new Blob([content]) })));
  const said = () =>
    messages.list
      .get()
      .flatMap(({ diagnostics }) => diagnostics)
      .map(({ file, missing }) => `${file} lacks ${missing}`);
  return { store, messages, drop, said };
}

const png = new Uint8Array([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
const textOf = (kind: 'skel' | 'skin' | 'rig', change: Parameters<typeof character>[0] = {}) =>
  saveCharacter(character(change), kind)[0].text;
const painted = paintedSkin('hero', { name: 'face', texture: 'tex/Face.png' }, { name: 'coat', texture: 'coat.png' });

/** A triangle with a texture in a file of its own. */
function gltf(): string {
  const maker = new GltfMaker();
  const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0));
  const { json, buffers } = maker.made({
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION }, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }],
    images: [{ uri: 'a%20face.png' }],
  });
  const [bytes] = buffers;
  const uri = `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
  return JSON.stringify({ ...json, buffers: [{ uri, byteLength: bytes.length }] });
}

describe('that a file was not given', () => {
  it('that textures were not given leaves the list with each that comes, and returns with undo', async () => {
    const { store, messages, drop, said } = page();
    await drop({ 'hero.skel': textOf('skel'), 'hero.skin': textOf('skin', { skins: [painted] }) });
    expect(said()).toEqual(['hero.skin lacks Face.png', 'hero.skin lacks coat.png']);
    expect(messages.list.get()).toMatchObject([{ unread: true, text: expect.stringContaining('2 warnings') }]);
    await drop({ 'face.png': png });
    expect(said()).toEqual(['hero.skin lacks coat.png']);
    expect(messages.list.get()[0].text).toBe(
      'hero.skin: opened. The texture "coat.png" named by the skin was not among the files.',
    );
    await drop({ 'coat.png': png });
    expect(said()).toEqual([]);
    store.undo();
    expect(said()).toEqual(['hero.skin lacks coat.png']);
    store.undo();
    expect(said()).toEqual(['hero.skin lacks Face.png', 'hero.skin lacks coat.png']);
    store.redo();
    store.redo();
    expect(said()).toEqual([]);
  });

  it('that a part of a rig was not given leaves the list when it comes, and returns with undo', async () => {
    const { store, drop, said } = page();
    await drop({ 'hero.skel': textOf('skel'), 'x.rig': textOf('rig', { skins: [skin()] }) });
    expect(said()).toEqual(['x.rig lacks hero.skin']);
    await drop({ 'hero.skin': textOf('skin', { skins: [skin()] }) });
    expect(store.document.characters.map(({ skins }) => skins.length)).toEqual([1]);
    expect(said()).toEqual([]);
    store.undo();
    expect(said()).toEqual(['x.rig lacks hero.skin']);
  });

  it('that a texture of a glTF file was not given leaves the list when it comes, and returns with undo', async () => {
    const { store, drop, said } = page();
    await drop({ 'tri.gltf': gltf() });
    expect(said()).toEqual(['tri.gltf lacks a face.png']);
    await drop({ 'a face.png': png });
    expect(store.document.characters.map(({ textures }) => textures.length)).toEqual([1]);
    expect(said()).toEqual([]);
    store.undo();
    expect(said()).toEqual(['tri.gltf lacks a face.png']);
  });

  it('a file of that name that another character takes ends nothing', async () => {
    const { drop, said } = page();
    await drop({ 'a/hero.skel': textOf('skel'), 'a/x.rig': textOf('rig', { skins: [skin()] }) });
    await drop({ 'b/hero.skel': textOf('skel'), 'b/hero.skin': textOf('skin', { skins: [skin()] }) });
    expect(said()).toEqual(['x.rig lacks hero.skin']);
  });

  it('what was dismissed doesn’t return', async () => {
    const { store, messages, drop, said } = page();
    await drop({ 'hero.skel': textOf('skel'), 'hero.skin': textOf('skin', { skins: [painted] }) });
    await drop({ 'face.png': png });
    messages.dismissAll();
    store.undo();
    expect(said()).toEqual([]);
  });
});
