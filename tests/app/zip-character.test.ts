import { strFromU8, unzipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { zipCharacter, zipDocument } from '../../src/app/zip-character.ts';
import { character, documentOf, skeleton, takeOfValues } from '../helpers/builders.ts';

const namesIn = (bytes: Uint8Array) => Object.keys(unzipSync(bytes)).sort();
const arm = (name: string, id: string) => character({ id, name, skeleton: skeleton(2) });

describe('characters as a zip', () => {
  it('characters of one name have a folder each', () => {
    const { bytes } = zipDocument(documentOf(arm('arm', 'c1'), arm('arm', 'c2')));
    const folders = new Set(namesIn(bytes).map((name) => name.split('/').slice(0, 2).join('/')));
    expect([...folders].sort()).toEqual(['marrow/arm', 'marrow/arm (2)']);
  });

  it('one that can’t be written is named, and the others are in the zip', () => {
    const broken = {
      ...arm('broken', 'c1'),
      get skins(): never {
        throw new Error('No skins.');
      },
    };
    const { bytes, characters, diagnostics } = zipDocument({
      ...documentOf(arm('whole', 'c2')),
      characters: [broken, arm('whole', 'c2')],
    });
    expect(characters.map(({ name }) => name)).toEqual(['whole']);
    expect(diagnostics.map(({ message }) => message)).toEqual(['broken is not in the zip. No skins.']);
    const skel = Object.entries(unzipSync(bytes)).find(([name]) => name.endsWith('.skel'));
    expect(skel && strFromU8(skel[1])).toContain('joint');
  });

  it('what is beside its plain files is in it', () => {
    const marked = { ...takeOfValues('walk', [0]), markers: [{ timeSeconds: 0, label: 'step' }] };
    const sets = { sets: [{ name: 'all', joints: [0] }], locked: [] };
    const { bytes } = zipCharacter({ ...arm('arm', 'c1'), takes: [marked], shownTake: 0, sets });
    const names = namesIn(bytes).map((name) => name.split('/').at(-1));
    expect(names).toEqual(expect.arrayContaining(['hero.sets.json', 'walk.markers.json']));
  });

  it('no name of a character leads out of the folder that the zip is unpacked to', () => {
    for (const name of ['..', '.', '', '../..', '..\\..', '/etc', 'C:\\x', '__proto__', 'constructor']) {
      for (const { bytes } of [zipCharacter(arm(name, 'c1')), zipDocument(documentOf(arm(name, 'c1')))]) {
        const names = namesIn(bytes);
        expect(names.length).toBeGreaterThan(0);
        for (const found of names) expect(found.split(/[/\\]/).filter((part) => /^\.*$/.test(part))).toEqual([]);
      }
    }
  });
});
