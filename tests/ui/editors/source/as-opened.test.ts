import { describe, expect, it } from 'vitest';
import { addKey, removeKeys } from '../../../../src/edit/commands/keys.ts';
import { addJoint, removeJoint } from '../../../../src/edit/commands/rig.ts';
import { renameJoint } from '../../../../src/edit/commands/rig-joint.ts';
import { Store } from '../../../../src/edit/store.ts';
import { openFiles } from '../../../../src/files/open/open-files.ts';
import { mapSource } from '../../../../src/formats/source/map-source.ts';
import type { Document } from '../../../../src/model/document.ts';
import { EMPTY_DOCUMENT } from '../../../../src/model/document.ts';
import type { Selection } from '../../../../src/model/session.ts';
import { linesOf, targetAt } from '../../../../src/model/source-map.ts';
import { frameThen, type Known, originsIn, pickNow, targetsThen } from '../../../../src/ui/editors/source/as-opened.ts';
import { hasPartOfSelected } from '../../../../src/ui/editors/source/places.ts';
import { bytesOf, read } from '../../../formats/read-in-pieces.ts';

const joint = (name: string, inside = '') => `balljoint ${name} {\n${inside}}\n`;
const channel = (value: number) =>
  `channel {\nextrapolate constant constant\nkeys 2 {\n0 ${value} flat flat\n1 ${value + 1} flat flat\n}\n}\n`;
const TEXTS: Readonly<Record<string, string>> = {
  'a.skel': joint('hips', joint('leg', joint('foot')) + joint('arm')),
  'a.anim': `animation {\nrange 0 1\nnumchannels 15\n${Array.from({ length: 15 }, (_, c) => channel(c)).join('')}}`,
};
const BVH =
  'HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 3\nFrame Time: 0.5\n1\n2\n3\n';
const [LEG, FOOT, ARM] = [1, 2, 3];

function openedStore(texts = TEXTS) {
  const store = new Store();
  const files = Object.entries(texts).map(([name, text]) => {
    const { value } = read(name, text);
    if (!value) throw new Error(`${name} has errors`);
    return { ...value, source: { name, path: `my/${name}`, bytes: text.length } };
  });
  store.replace('Open', openFiles(EMPTY_DOCUMENT, files, [], undefined).document);
  const { characters } = store.document;
  const known: Known = {
    opened: () => ({ characters, given: undefined }),
    given: () => undefined,
    isUnsaved: () => false,
  };
  return { store, known, id: characters[0].id };
}

/** First lines in a file of what is selected. */
function lit(document: Document, known: Known, name: string, selection: Selection, dof?: number) {
  const map = mapSource(bytesOf(TEXTS[name]), name);
  const chosen = dof === undefined ? undefined : { characterId: selection.characterId ?? '', dof };
  return originsIn(document, `my/${name}`, known)
    .origins.flatMap((origin) => targetsThen(origin, selection, chosen))
    .flatMap((target) => linesOf(map, target))
    .map(({ from }) => from);
}

function picked(document: Document, known: Known, name: string, line: number) {
  const target = targetAt(mapSource(bytesOf(TEXTS[name]), name), line);
  return target && pickNow(originsIn(document, `my/${name}`, known).origins, target);
}

/** The line of channel c of the text above, and of its key k. */
const lineOfChannel = (c: number) => 4 + 7 * c;
const lineOfKey = (c: number, k: number) => lineOfChannel(c) + 3 + k;

describe('lines of a file whose parts were edited since it was opened', () => {
  it('are as before without an edit, and after it was undone', () => {
    const { store, known, id } = openedStore();
    const before = lit(store.document, known, 'a.skel', { characterId: id, joint: ARM });
    expect(before).toEqual([6]);
    store.apply(removeJoint, { characterId: id, joint: LEG, children: 'too' });
    expect(originsIn(store.document, 'my/a.skel', known).state).toBe('edited');
    store.undo();
    expect(originsIn(store.document, 'my/a.skel', known).state).toBe('same');
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: ARM })).toEqual(before);
  });

  it('are those of the same joint after another one was deleted, also of its channels', () => {
    const { store, known, id } = openedStore();
    const channelsOf = (joint: number) => lit(store.document, known, 'a.anim', { characterId: id, joint });
    const before = channelsOf(ARM);
    store.apply(removeJoint, { characterId: id, joint: FOOT, children: 'too' });
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: ARM - 1 })).toEqual([6]);
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: LEG })).toEqual([2, 5]);
    expect(channelsOf(ARM - 1)).toEqual(before);
    expect(before).toEqual([12, 13, 14].map(lineOfChannel));
  });

  it('are none of a joint that was added or renamed', () => {
    const { store, known, id } = openedStore();
    store.apply(addJoint, { characterId: id, parent: LEG, name: 'knee' });
    const { joints } = store.document.characters[0].skeleton ?? { joints: [] };
    const knee = joints.findIndex(({ name }) => name === 'knee');
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: knee })).toEqual([]);
    expect(lit(store.document, known, 'a.anim', { characterId: id, joint: knee })).toEqual([]);
    const arm = joints.findIndex(({ name }) => name === 'arm');
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: arm })).toEqual([6]);
    store.apply(renameJoint, { characterId: id, joint: arm, name: 'wing' });
    expect(lit(store.document, known, 'a.skel', { characterId: id, joint: arm })).toEqual([]);
  });

  it('are those of keys with the same time and value, none of keys that were added', () => {
    const { store, known, id } = openedStore();
    const of = (channel: number, ...indices: number[]) =>
      lit(store.document, known, 'a.anim', { characterId: id, joint: 0, keys: [{ channel, indices }] });
    store.apply(addKey, { characterId: id, channel: 4, timeSeconds: 0.5, value: 9 });
    expect(of(4, 0)).toEqual([lineOfKey(4, 0)]);
    expect(of(4, 1)).toEqual([]);
    expect(of(4, 2)).toEqual([lineOfKey(4, 1)]);
    expect(of(5, 1)).toEqual([lineOfKey(5, 1)]);
    store.apply(removeKeys, { characterId: id, keys: [{ channel: 4, indices: [0] }], timeSeconds: 0 });
    expect(of(4, 1)).toEqual([lineOfKey(4, 1)]);
  });

  it('are none if the file was given again but its new text was not opened', () => {
    const { store, known, id } = openedStore();
    const another: Known = { ...known, given: () => new Blob(['broken']) };
    expect(originsIn(store.document, 'my/a.skel', another)).toEqual({ state: 'other', origins: [] });
    expect(lit(store.document, another, 'a.skel', { characterId: id, joint: ARM })).toEqual([]);
  });

  it('stay lit where only the pose was changed, which the file also holds', () => {
    const { store, known, id } = openedStore();
    const posed = { ...known, isUnsaved: () => true };
    expect(originsIn(store.document, 'my/a.skel', posed).state).toBe('edited');
    expect(lit(store.document, posed, 'a.skel', { characterId: id, joint: ARM })).toEqual([6]);
  });

  it('after a restored session are those of parts without unsaved changes', () => {
    const { store, known, id } = openedStore();
    const restored = (isUnsaved: boolean): Known => ({ ...known, opened: () => undefined, isUnsaved: () => isUnsaved });
    expect(lit(store.document, restored(false), 'a.skel', { characterId: id, joint: ARM })).toEqual([6]);
    expect(lit(store.document, restored(true), 'a.skel', { characterId: id, joint: ARM })).toEqual([]);
    expect(originsIn(store.document, 'my/a.skel', restored(true)).state).toBe('edited');
  });
});

describe('a click on a line of a file that was edited since', () => {
  it('selects the joint, channel and key where they are now, and tells what has gone', () => {
    const { store, known, id } = openedStore();
    store.apply(removeJoint, { characterId: id, joint: FOOT, children: 'too' });
    expect(picked(store.document, known, 'a.skel', 6)).toMatchObject({
      selection: { characterId: id, joint: ARM - 1 },
    });
    expect(picked(store.document, known, 'a.skel', 3)).toEqual({ gone: 'Joint foot' });
    expect(picked(store.document, known, 'a.anim', lineOfKey(12, 1))).toMatchObject({
      selection: { joint: ARM - 1, keys: [{ channel: 9, indices: [1] }] },
      dof: { dof: 9, name: 'rx' },
      timeSeconds: 1,
    });
    expect(picked(store.document, known, 'a.anim', lineOfKey(9, 1))).toHaveProperty('gone');
  });
});

describe('the frame of a capture in its file', () => {
  it('is that of the current time', () => {
    const { store, known } = openedStore({ 'b.bvh': BVH });
    const [origin] = originsIn(store.document, 'my/b.bvh', known).origins;
    expect(frameThen(origin, 0.6)).toEqual({ kind: 'frame', frame: 1 });
  });
});

describe('a file of many characters', () => {
  const BARE = Array.from({ length: 300 }, (_, i) => `balljoint r${i} {\n}\n`).join('');

  it('has each of them at its own skeleton, each with what is edited of it', () => {
    const { store, known } = openedStore({ 'many.skel': BARE });
    const { characters } = store.document;
    expect(characters).toHaveLength(300);
    const before = originsIn(store.document, 'my/many.skel', known);
    expect(before.state).toBe('same');
    expect(before.origins.map(({ file }) => file.root)).toEqual(characters.map((_, i) => i));
    expect(
      before.origins.every(({ now, file }) => now.root === file.root && now.character.id === file.character.id),
    ).toBe(true);
    store.apply(renameJoint, { characterId: characters[7].id, joint: 0, name: 'other' });
    const after = originsIn(store.document, 'my/many.skel', known);
    expect(after.state).toBe('edited');
    expect(after.origins[7].now.character.skeleton?.joints[0].name).toBe('other');
    expect(after.origins[7].file.character.skeleton?.joints[0].name).toBe('r7');
  });

  it('is not looked through for each of them', () => {
    const { store, known } = openedStore({ 'many.skel': BARE });
    let looks = 0;
    for (const character of store.document.characters) {
      const { parts } = character;
      const get = () => {
        looks++;
        return parts;
      };
      Object.defineProperty(character, 'parts', { enumerable: true, get });
    }
    originsIn(store.document, 'my/many.skel', known);
    expect(looks).toBeLessThan(30 * 300);
  });
});

it('only the selected character is asked what it has from a file', () => {
  const { store } = openedStore({ ...TEXTS, 'b.skel': TEXTS['a.skel'] });
  const [a, b] = store.document.characters.map(({ id }) => id);
  const paths = ['my/a.skel', 'my/a.anim', 'my/b.skel', 'a.skel'];
  const from = (characterId?: string) =>
    paths.filter((path) => hasPartOfSelected(store.document, { ...(characterId && { characterId }) }, path));
  expect(from(a)).toEqual(['my/a.skel', 'my/a.anim']);
  expect(from(b)).toEqual(['my/b.skel']);
  expect(from()).toEqual([]);
  expect(from('gone')).toEqual([]);
});
