import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Document } from '../../../src/model/document.ts';
import { trackedOf } from '../../../src/model/takes/tracked-take.ts';
import { file, skeleton, skelFile, takeOfValues, trackedTake } from '../../helpers/builders.ts';
import { open } from './opening.ts';

describe('names of what was opened', () => {
  const whole = (path: string, ...takes: readonly string[]) =>
    file(path, {
      kind: 'character',
      characters: [
        {
          skeleton: skeleton(1, path.slice(path.lastIndexOf('/') + 1, path.lastIndexOf('.'))),
          skins: [],
          morphs: [],
          takes: takes.map((name) => takeOfValues(name, [0, 0, 0, 0, 0, 0])),
          textures: [],
        },
      ],
    });
  const takesOf = ({ characters }: Document) => characters.map(({ takes }) => takes.map(({ name }) => name));

  it('characters of one name are named by their files, with as many folders as tell them apart', () => {
    const rigs = ['a', 'b'].flatMap((stem) => [
      skelFile(`${stem}.skel`, skeleton(2, stem)),
      file(`${stem}.rig`, { kind: 'rig', rig: { name: 'walker', skeleton: `${stem}.skel`, morphs: [] } }),
    ]);
    expect(open(rigs).document.characters.map(({ name }) => name)).toEqual(['a', 'b']);
    const folders = ['class/ada', 'class/bob'].map((folder) => skelFile(`${folder}/test.skel`, skeleton(2, 'test')));
    expect(open(folders).document.characters.map(({ name }) => name)).toEqual(['ada_test', 'bob_test']);
  });

  it('takes of one name in several files are named by them; others keep their names', () => {
    const files = [whole('wave.fbx', 'mixamo.com'), whole('all.fbx', 'Mixamo.com', 'Run')];
    const { document } = open(files);
    expect(takesOf(document)).toEqual([['wave'], ['all_Mixamo.com', 'Run']]);
    expect(takesOf(open([files[0]]).document)).toEqual([['mixamo.com']]);
    // Opened again, it is the same take.
    const again = open([whole('wave.fbx', 'mixamo.com')], document).document;
    expect(takesOf(again)).toEqual(takesOf(document));
    expect(takesOf(open([whole('nod.fbx', 'mixamo.com')], open([files[0]]).document).document)).toEqual([
      ['mixamo.com'],
      ['nod'],
    ]);
  });

  it('takes whose channels are yet to be made keep waiting for them under other names, all but the shown one', () => {
    const made: string[] = [];
    const files = ['a.glb', 'b.glb'].map((path) => {
      const takes = ['walk', 'run'].map((name) => trackedTake(name, () => made.push(`${path} ${name}`)));
      return file(path, {
        kind: 'character',
        characters: [{ skeleton: skeleton(2), skins: [], morphs: [], takes, textures: [] }],
      });
    });
    const { document } = open(files);
    expect(takesOf(document)).toEqual([
      ['a_walk', 'a_run'],
      ['b_walk', 'b_run'],
    ]);
    expect(made).toEqual(['a.glb walk', 'b.glb walk']);
    const [{ takes }] = document.characters;
    expect(trackedOf(takes[1])?.name).toBe('a_run');
    expect(takes[1].channels).toHaveLength(9);
    expect(made).toEqual(['a.glb walk', 'b.glb walk', 'a.glb run']);
    // Read again, they have the names that they were given.
    const again = open(files, document).document;
    expect(takesOf(again)).toEqual(takesOf(document));
    expect(made).toHaveLength(3);
  });

  it('no two characters, and no two takes of files, have the same name', () => {
    const paths = fc.uniqueArray(
      fc.constantFrom('a/x.glb', 'b/x.glb', 'A/y.glb', 'x.glb', 'a/b/x.glb', 'b_x.glb', 'y.fbx'),
      { minLength: 1 },
    );
    const takes = fc.uniqueArray(fc.constantFrom('mixamo.com', 'x', 'a_x', 'Take 001'), { minLength: 1 });
    fc.assert(
      fc.property(paths, fc.array(takes, { minLength: 7, maxLength: 7 }), (files, names) => {
        const { document } = open(files.map((path, i) => whole(path, ...names[i])));
        for (const all of [document.characters.map(({ name }) => name), takesOf(document).flat()]) {
          expect(new Set(all.map((name) => name.toLowerCase())).size).toBe(all.length);
        }
      }),
    );
  });
});
