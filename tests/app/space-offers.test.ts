/** What is told of characters whose file states no unit, or one that can hardly be, and the buttons that mend it. */
import { describe, expect, it } from 'vitest';
import { offerSpaces } from '../../src/app/space-offers.ts';
import { loadAny } from '../../src/cli/load.ts';
import { Store } from '../../src/edit/store.ts';
import { statedSpace } from '../../src/evaluate/space/metres.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { ParsedFile, WholeCharacter } from '../../src/model/files.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import { file } from '../helpers/builders.ts';
import { personSkeleton, takeOfRoots } from '../helpers/mocap.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

function capture(name: string, height = 150): ParsedFile {
  const skeleton = { ...personSkeleton({ height }), name };
  const take = { ...takeOfRoots(skeleton, [[0, height / 2, 0]]), name };
  const source = { name: `${name}.bvh`, path: `${name}.bvh`, bytes: 1 };
  return { ...capturedContent([{ skeleton, take }], source.name).value, source };
}

function stated(name: string, height: number, metres: number): ParsedFile {
  const skeleton = { ...personSkeleton({ height }), name };
  const takes = [{ ...takeOfRoots(skeleton, [[0, height / 2, 0]]), name }];
  const whole: WholeCharacter = { skeleton, skins: [], morphs: [], takes, textures: [], space: statedSpace(metres) };
  return file(`${name}.glb`, { kind: 'character', characters: [whole] });
}

/** Opens files as the page does. */
function opened(...files: readonly ParsedFile[]) {
  const store = new Store(openFiles(EMPTY_DOCUMENT, files).document);
  const messages = new Messages();
  const revealed: string[] = [];
  offerSpaces({ store, messages, camera: { reveal: (id) => void revealed.push(id) } }, store.document.characters);
  const press = (label: string) =>
    messages.list
      .get()
      .flatMap(({ offers = [] }) => offers)
      .find((offer) => offer.label === label)
      ?.run();
  const told = () => messages.list.get().map(({ text, offers = [] }) => [text, offers.map(({ label }) => label)]);
  return { store, messages, revealed, press, told };
}

describe('a guess', () => {
  it('is told with its other ways, in the line for a while and in the list', () => {
    const { messages, told } = opened(capture('walk'));
    expect(told()).toEqual([
      ['walk is guessed to be in centimetres, y up: 1.5 m tall.', ['Z up', 'Inches', '1.7 m tall']],
    ]);
    expect(messages.passing.get()).toBe(told()[0][0]);
    expect(messages.offers.map(({ label }) => label)).toEqual(['Z up', 'Inches', '1.7 m tall']);
  });

  it.each([
    ['Z up', { up: 'z', unit: 'centimetres' }],
    ['Inches', { up: 'y', unit: 'inches' }],
    ['1.7 m tall', { up: 'y', unit: 'own' }],
  ])('is mended by one click on %s, for all takes of the skeleton, and undone by one step', (label, space) => {
    const { store, press, told, revealed, messages } = opened(capture('walk'), capture('run'));
    const before = store.document;
    expect(told()).toHaveLength(1);
    press(label);
    for (const character of store.document.characters) expect(character.space).toMatchObject(space);
    expect([told(), messages.passing.get()]).toEqual([[], undefined]);
    expect(revealed).toEqual([before.characters[0].id]);
    store.undo();
    expect(store.document).toBe(before);
  });

  it('that is gone by now is not mended, which is said', () => {
    const { store, press, messages } = opened(capture('walk'));
    store.replace('Remove', { document: EMPTY_DOCUMENT });
    press('Z up');
    expect(messages.list.get().at(-1)?.text).toBe('walk is not open any more.');
  });
});

describe('a unit that a file states', () => {
  it('is believed without a word where it can be', () => {
    expect(opened(stated('hero', 1.7, 1), stated('ant', 3, 0.01), stated('hall', 20, 1)).told()).toEqual([]);
  });

  it('that makes a fox of 75 m stays, and the likely one is a click away', () => {
    const { store, press, told } = opened(stated('fox', 75, 1));
    expect(told()).toEqual([['fox is 75 m tall: its file states metres.', ['Centimetres', '1.7 m tall']]]);
    expect(store.document.characters[0].space?.unit).toBe('metres');
    press('Centimetres');
    expect(store.document.characters[0].space).toEqual({ up: 'y', unit: 'centimetres', lift: 0 });
  });
});

describeShared('real files whose unit can hardly be', () => {
  it.each([
    ['fbx/91_48.fbx', '91_48 is 169 m tall: its file states centimetres.', ['1.7 m tall']],
    ['gltf/Fox.glb', 'Fox is 60.5 m tall: its file states metres.', ['Centimetres', '1.7 m tall']],
  ])('the file %s is offered what it can be', async (path, text, labels) => {
    const { files } = await loadAny([sharedPath(`data/${path}`)], '/');
    expect(opened(...files).told()).toEqual([[text, labels]]);
  });
});
