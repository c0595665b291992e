import { describe, expect, it } from 'vitest';
import { removeCharacter } from '../../../src/edit/commands/characters.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import type { Character } from '../../../src/model/document.ts';
import { NO_MARKS } from '../../../src/model/part.ts';
import {
  animFile,
  file,
  morph,
  morphFile,
  skeleton,
  skelFile,
  skin,
  skinFile,
  takeOfValues,
} from '../../helpers/builders.ts';
import { broken, only, open, walk } from './opening.ts';

describe('files opened later', () => {
  it('files opened later never go to a character that comes with them because one of the same id was selected once', () => {
    const gone = removeCharacter.run(open([skelFile('a.skel', skeleton(2, 'a'))]).document, { characterId: 'c1' });
    const { document } = open(
      [
        skelFile('x/b.skel', skeleton(2, 'b')),
        skelFile('y/d.skel', skeleton(2, 'd')),
        animFile('z/s.anim', takeOfValues('s', [])),
      ],
      gone,
      'c1',
    );
    expect(document.characters.map((c) => [c.id, c.name, c.takes.length])).toEqual([
      ['c2', 'b', 0],
      ['c3', 'd', 0],
      ['c4', 's', 1],
    ]);
  });

  it('files opened later are two parts where two of one name come together', () => {
    const { document } = open([
      skelFile('hero.skel', skeleton()),
      skinFile('hero.skin', skin()),
      morphFile('a/hero_m.morph', morph('hero_m')),
      morphFile('b/hero_m.morph', morph('hero_m')),
    ]);
    expect(only(document).morphs).toHaveLength(2);
  });

  const hero = open([skelFile('hero.skel', skeleton()), skinFile('hero.skin', skin())]).document;

  it('files opened later go to the selected character when they come alone', () => {
    const two = open([skelFile('b.skel', skeleton(2, 'b'))], hero).document;
    const { document } = open(
      [
        animFile(
          'jump.anim',
          takeOfValues(
            'jump',
            walk.channels.map(() => 0),
          ),
        ),
      ],
      two,
      'c1',
    );
    expect(document.characters.map((c) => c.takes.length)).toEqual([1, 0]);
    expect(document.characters[0].shownTake).toBe(0);
  });

  it('replace the part that came from a file of the same name, and nothing else', () => {
    const other = skin('hero', 1);
    const { document } = open([skinFile('hero.skin', other)], hero);
    const now = only(document);
    expect(now.skins).toEqual([other]);
    expect(now.skeleton).toBe(hero.characters[0].skeleton);
    expect(now.id).toBe('c1');
  });

  it('replace a skeleton and keep what hangs on it', () => {
    const longer = skeleton(3);
    const { document } = open([skelFile('hero.skel', longer)], hero);
    const now = only(document);
    expect(now.skeleton).toBe(longer);
    expect(now.skins).toBe(hero.characters[0].skins);
    expect(now.pose).toHaveLength(3 + 9);
  });

  it('complete a skin or a take that waits for a skeleton', () => {
    const waiting = open([animFile('hero_walk.anim', walk)]).document;
    expect(only(waiting).skeleton).toBeUndefined();
    const { document } = open([skelFile('hero.skel', skeleton())], waiting);
    const now = only(document);
    expect(now.takes).toEqual([walk]);
    expect(now.skeleton?.joints).toHaveLength(2);
    expect(now.name).toBe('hero');
  });

  it('files opened later never attach to the opening sample, which makes way', () => {
    const sample = { ...hero, isOpeningSample: true };
    const { document } = open([animFile('hero_walk.anim', walk)], sample, 'c1');
    expect(only(document).skeleton).toBeUndefined();
    expect(only(document).id).not.toBe('c1');
    expect(document.isOpeningSample).toBe(false);
  });

  describe('of poses alone', () => {
    const sample = { ...hero, isOpeningSample: true };
    const ofJoints = (...names: readonly string[]) => {
      const joints = names.map((name) => ({ name, dofs: [{ name: 'rx', value: 0.5 }] }));
      return file('kept.pose', { kind: 'pose', poses: [{ name: 'kept', joints, weights: [] }] });
    };
    const own = only(sample).skeleton?.joints.map(({ name }) => name) ?? [];

    it('wait if they are of other joints, and the example stays', () => {
      const { document, diagnostics } = open([ofJoints(...own)], sample);
      expect(only(document)).toMatchObject({ id: 'c1', poses: [{ name: 'kept' }] });
      expect(document.isOpeningSample).toBe(false);
      expect(diagnostics).toEqual([]);
    });

    it('poses are read again from the file that the library is from, and join those of another file', () => {
      const called = (path: string, name: string) => {
        const joints = own.map((joint) => ({ name: joint, dofs: [{ name: 'rx', value: 0.5 }] }));
        return file(path, { kind: 'pose', poses: [{ name, joints, weights: [] }] });
      };
      const library = (c: Character) => [c.poses?.map(({ name }) => name), c.parts?.poses?.file?.source.name];
      const first = open([called('a.pose', 'sit')], hero).document;
      expect(library(only(first))).toEqual([['sit'], 'a.pose']);
      const again = open([called('A.POSE', 'lie')], first).document;
      expect(library(only(again))).toEqual([['lie'], 'A.POSE']);
      const both = open([called('b.pose', 'stand')], first).document;
      expect(library(only(both))).toEqual([['sit', 'stand'], undefined]);
      const three = open([called('b.pose', 'walk')], both).document;
      expect(library(only(three))).toEqual([['sit', 'stand', 'walk'], undefined]);
      expect(only(three).sources.filter(({ name }) => name.endsWith('.pose'))).toHaveLength(2);
    });

    it('a removed library leaves its file to no other poses', () => {
      const pose = ofJoints(...own);
      const first = open([pose], hero).document;
      const { poses: _poses, parts: { poses: _mark, ...parts } = NO_MARKS, ...rest } = only(first);
      const without = { ...first, characters: [{ ...rest, parts }] };
      const { document } = open([{ ...pose, source: { ...pose.source, name: 'new.pose', path: 'new.pose' } }], without);
      expect(only(document).parts?.poses?.file?.source.name).toBe('new.pose');
    });

    it('wait where they are of other joints, and the sample stays', () => {
      const { document } = open([ofJoints('tail', 'fin')], sample);
      expect(document).toMatchObject({ isOpeningSample: true, characters: sample.characters });
      expect(document.unused).toHaveLength(1);
    });

    it('poses opened with a skeleton are not added to the sample', () => {
      const { document } = open([ofJoints(...own), skelFile('other.skel', skeleton(1, 'tail'))], sample);
      expect(only(document).id).not.toBe('c1');
    });
  });

  it('leave the opening example if nothing could be opened', () => {
    const sample = { ...hero, isOpeningSample: true };
    const { document } = openFiles(sample, [], [broken('x.skel', 'skel')]);
    expect(document).toBe(sample);
  });
});
