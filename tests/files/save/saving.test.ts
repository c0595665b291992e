import { describe, expect, it } from 'vitest';
import { zipCharacter } from '../../../src/app/zip-character.ts';
import { KINDS, SAVED_KINDS } from '../../../src/files/kinds.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { parse } from '../../../src/worker/parse.ts';
import { character, morph, paintedSkin, skeleton, takeOfValues } from '../../helpers/builders.ts';

const FACE = { name: 'face', texture: 'face.png' };
const hero = character({
  skins: [paintedSkin('hero', FACE, { name: 'coat', texture: 'coat.png', color: [0.5, 1, 0] }, FACE)],
  morphs: [morph('hero_smile')],
  takes: [takeOfValues('hero_walk', new Array(10).fill(0.5), [0, 2])],
  shownTake: 0,
  textures: ['face.png', 'coat.png'].map((name, i) => ({ name, mime: 'image/png', bytes: Uint8Array.of(1, 2, i) })),
});

describe('saving a character', () => {
  it('gives each part the name of the file it came from', () => {
    const names = (['skel', 'skin', 'morph', 'anim', 'rig'] as const).flatMap((k) => saveCharacter(hero, k));
    expect(names.map((f) => f.name)).toEqual([
      'hero.skel',
      'hero.skin',
      'hero_smile.morph',
      'hero_walk.anim',
      'hero.rig',
    ]);
  });

  it.each(SAVED_KINDS.filter((kind) => KINDS[kind].save.has(hero)))(
    'a character that has something for files of kind %s is saved in at least one',
    (kind) => expect(saveCharacter(hero, kind)).not.toEqual([]),
  );

  it('writes the pose as it is now', () => {
    const posed = { ...hero, pose: hero.pose.map((v, i) => (i === 4 ? 0.25 : v)) };
    expect(saveCharacter(posed, 'skel')[0].text).toContain('0.25');
  });

  it('saving a character has nothing of what is not there', () => {
    expect(saveCharacter(character({ skeleton: skeleton() }), 'skin')).toEqual([]);
  });

  it('zips a whole character, which opens again as it was', async () => {
    const { name, bytes } = zipCharacter(hero);
    expect(name).toBe('hero.zip');
    const { files, diagnostics } = await parse({ files: [{ path: name, blob: new Blob([bytes]) }] }, () => undefined);
    expect(diagnostics).toEqual([]);
    const { document } = openFiles(EMPTY_DOCUMENT, files);
    expect(document.characters).toHaveLength(1);
    const [again] = document.characters;
    expect(again.skeleton).toEqual(hero.skeleton);
    expect(again.skins).toEqual(hero.skins);
    expect(again.morphs).toEqual(hero.morphs);
    expect(again.takes).toEqual(hero.takes);
    expect(again.textures).toEqual(hero.textures);
  });
});
