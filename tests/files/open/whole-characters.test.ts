/** Characters that one file contains whole, as `.glb` and the like do. */
import { describe, expect, it } from 'vitest';
import { Unsaved } from '../../../src/app/unsaved.ts';
import { setSpace } from '../../../src/edit/commands/spaces.ts';
import { renameTake } from '../../../src/edit/commands/take.ts';
import { Store } from '../../../src/edit/store.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { ParsedFile, WholeCharacter } from '../../../src/model/files.ts';
import type { LengthUnit, Space } from '../../../src/model/space.ts';
import { file, morph, morphFile, paintedSkin, skeleton, skelFile, skin, takeOfValues } from '../../helpers/builders.ts';

const texture = { name: 'fur.png', mime: 'image/png', bytes: new Uint8Array(1) };
const fox: WholeCharacter = {
  skeleton: skeleton(2, 'fox'),
  skins: [paintedSkin('fur', { name: 'fur', texture: 'fur.png' }), skin('winter')],
  morphs: [morph('smile')],
  takes: [takeOfValues('run', new Array(10).fill(0)), takeOfValues('sit', new Array(10).fill(1))],
  textures: [texture],
};
const whole = (characters: readonly WholeCharacter[] = [fox], path = 'fox.glb') =>
  file(path, { kind: 'character', characters });
const open = (files: readonly ParsedFile[], document: Document = EMPTY_DOCUMENT) => openFiles(document, files);

describe('a file with whole characters', () => {
  it('opens with all its parts, the first skin and take shown', () => {
    const { document, diagnostics } = open([whole()]);
    expect(diagnostics).toEqual([]);
    const [character, ...others] = document.characters;
    expect(others).toEqual([]);
    expect(character).toMatchObject({ ...fox, name: 'fox', shownSkin: 0, shownTake: 0 });
    expect(character.pose).toHaveLength(3 + 6 + 1);
    expect(character.sources.map(({ name }) => name)).toEqual(['fox.glb']);
  });

  it('takes the place of its own parts when it is opened again, and shows its first ones', () => {
    const first = open([whole()]).document;
    const again = {
      ...fox,
      takes: [takeOfValues('run', new Array(10).fill(2)), takeOfValues('jump', new Array(10).fill(3))],
    };
    const { document } = open([whole([again])], first);
    const [character] = document.characters;
    expect(character.id).toBe(first.characters[0].id);
    expect(character.takes.map(({ name }) => name)).toEqual(['run', 'sit', 'jump']);
    expect(character).toMatchObject({ shownSkin: 0, shownTake: 0 });
    expect(character.skins).toHaveLength(2);
    expect(character.textures).toEqual([texture]);
    expect(character.pose).toHaveLength(3 + 6 + 1);
  });

  it('a file with whole characters has one character per root, and parts of other files don’t go to it by name', () => {
    const { document } = open([
      whole([fox, { ...fox, skeleton: skeleton(1, 'cub') }]),
      skelFile('fox.skel', skeleton(3)),
    ]);
    expect(document.characters.map(({ name }) => name)).toEqual(['fox', 'cub', 'hero']);
    const later = open([morphFile('fox_wink.morph', morph('fox_wink')), whole()]);
    expect(later.document.characters[0].morphs.map(({ name }) => name)).toEqual(['smile', 'fox_wink']);
  });

  it('counts as saved until a part is changed, which is saved as a file of its own', () => {
    const store = new Store();
    const unsaved = new Unsaved(store);
    const files = [whole()];
    store.replace('Open', openFiles(store.document, files).document);
    unsaved.opened(files);
    expect(unsaved.current()).toEqual([]);
    store.apply(renameTake, { characterId: 'c1', take: 0, name: 'walk' });
    expect(unsaved.current().map(({ name }) => name)).toEqual(['walk.anim']);
    store.undo();
    expect(unsaved.current()).toEqual([]);
  });

  it('a file with whole characters is written as the formats of its parts', () => {
    const [character] = open([whole()]).document.characters;
    const names = (['skel', 'skin', 'morph', 'anim', 'rig'] as const).flatMap((kind) =>
      saveCharacter(character, kind).map(({ name }) => name),
    );
    expect(names).toEqual(['fox.skel', 'fur.skin', 'winter.skin', 'smile.morph', 'run.anim', 'sit.anim', 'fox.rig']);
  });
});

describe('the unit of a character', () => {
  const stated = (unit: LengthUnit): WholeCharacter => ({
    ...fox,
    space: { space: { up: 'y', unit, lift: 0, known: 'stated' }, standing: 0 },
  });
  const unitsIn = ({ characters }: Document) => characters.map(({ space }) => space?.unit);

  it('the unit of a character is the one that its own file states, whatever another of the same joints states', () => {
    const { document } = open([whole([stated('metres')], 'a.glb'), whole([stated('centimetres')], 'b.fbx')]);
    expect(unitsIn(document)).toEqual(['metres', 'centimetres']);
    expect(unitsIn(open([whole([stated('inches')], 'c.fbx')], document).document)).toEqual([
      'metres',
      'centimetres',
      'inches',
    ]);
  });

  it('the unit of a character is the one that was set for its joints, of files that are opened later too', () => {
    const store = new Store(open([whole([stated('metres')])]).document);
    const space: Space = { up: 'y', unit: 'centimetres', lift: 0 };
    store.apply(setSpace, { characterId: store.document.characters[0].id, space });
    expect(store.document.characters[0].space).toEqual(space);
    expect(unitsIn(open([whole([stated('metres')], 'b.glb')], store.document).document)).toEqual([
      'centimetres',
      'centimetres',
    ]);
    expect(unitsIn(open([whole([stated('metres')])], store.document).document)).toEqual(['centimetres']);
    store.undo();
    expect(store.document.characters[0].space).toMatchObject({ unit: 'metres', known: 'stated' });
  });
});
