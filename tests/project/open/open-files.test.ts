import { describe, expect, it } from 'vitest';
import { removeCharacter } from '../../../src/edit/commands/characters.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { BrokenFile, ParsedFile } from '../../../src/model/files.ts';
import { NO_MARKS } from '../../../src/model/part.ts';
import { openFiles } from '../../../src/project/open/open-files.ts';
import {
  animFile,
  character,
  clip,
  documentOf,
  file,
  morph,
  morphFile,
  paintedSkin,
  skeleton,
  skelFile,
  skin,
  skinFile,
} from '../../helpers/builders.ts';

const open = (files: ParsedFile[], document: Document = EMPTY_DOCUMENT, selected?: string) =>
  openFiles(document, files, [], selected);
const only = (document: Document): Character => {
  expect(document.characters).toHaveLength(1);
  return document.characters[0];
};
const broken = (path: string, kind: BrokenFile['kind']): BrokenFile => ({
  kind,
  source: { path, name: path.slice(path.lastIndexOf('/') + 1), bytes: 1 },
});
const texture = (path: string) =>
  file(path, { kind: 'texture', texture: { name: path, mime: 'image/png', bytes: new Uint8Array(1) } });
const walk = clip('hero_walk', [0, 1, 0, 0, 0, 0, 0, 0, 0]);

describe('files opened together', () => {
  it('files opened together become one character when their stems begin with the skeleton’s', () => {
    const { document, opened, diagnostics, label } = open([
      skelFile('hero.skel', skeleton()),
      skinFile('hero.skin', skin()),
      animFile('hero_walk.anim', walk),
    ]);
    const hero = only(document);
    expect(hero).toMatchObject({ id: 'c1', name: 'hero', shownSkin: 0, shownClip: 0 });
    expect(hero.clips[0]).toBe(walk);
    expect(hero.sources.map((s) => s.name)).toEqual(['hero.skel', 'hero.skin', 'hero_walk.anim']);
    expect(opened).toEqual(['c1']);
    expect(diagnostics).toEqual([]);
    expect(label).toBe('Open hero.skel and 2 more');
  });

  it('files opened together go to the longest fitting stem', () => {
    const { document } = open([
      skelFile('wasp.skel', skeleton(2, 'wasp')),
      skelFile('wasp_p1.skel', skeleton(2, 'wasp_p1')),
      skinFile('wasp.skin', skin('wasp')),
      skinFile('wasp_p1.skin', skin('wasp_p1')),
      skinFile('wasp_p2.skin', skin('wasp_p2')),
    ]);
    expect(document.characters.map((c) => [c.name, c.skins.map((s) => s.name)])).toEqual([
      ['wasp', ['wasp', 'wasp_p2']],
      ['wasp_p1', ['wasp_p1']],
    ]);
    expect(document.characters[0].shownSkin).toBe(0);
  });

  it('belong to the only skeleton of their folder, whatever their names', () => {
    const { document } = open([
      skelFile('a/hero.skel', skeleton()),
      animFile(
        'a/jump.anim',
        clip(
          'jump',
          walk.channels.map(() => 0),
        ),
      ),
      skelFile('b/other.skel', skeleton(2, 'other')),
    ]);
    expect(document.characters.map((c) => c.clips.length)).toEqual([1, 0]);
  });

  it('files opened together go to the only skeleton given where their own folder has none', () => {
    const { document } = open([skelFile('a/hero.skel', skeleton()), animFile('b/jump.anim', clip('jump', []))]);
    expect(only(document).clips).toHaveLength(1);
  });

  it('need no skeleton: morphs go to the skin given with them', () => {
    const { document } = open([morphFile('a.morph', morph('a')), skinFile('head.skin', skin('head'))]);
    expect(only(document).morphs).toHaveLength(1);
  });

  it('need no skeleton: morphs belong to the skin with the longest matching prefix', () => {
    const { document } = open([
      skelFile('wasp.skel', skeleton(2, 'wasp')),
      skinFile('wasp.skin', skin('wasp')),
      skelFile('other.skel', skeleton(1, 'other')),
      morphFile('head1.morph', morph('head1')),
      skinFile('head.skin', skin('head')),
    ]);
    expect(document.characters.map((c) => [c.name, c.morphs.length])).toEqual([
      ['wasp', 0],
      ['other', 0],
      ['head', 1],
    ]);
  });

  it('files opened together are bound by a rig, morphs in its order, with what it does not name added after', () => {
    const rig = { name: 'Hero', skeleton: 'bones.skel', skin: 'body.skin', morphs: ['smile.morph', 'blink.morph'] };
    const { document } = open([
      morphFile('blink.morph', morph('blink')),
      skinFile('body.skin', skin('body')),
      skelFile('bones.skel', skeleton(2, 'bones')),
      file('hero.rig', { kind: 'rig', rig }),
      morphFile('smile.morph', morph('smile')),
      morphFile('bones_wink.morph', morph('bones_wink')),
    ]);
    const hero = only(document);
    expect(hero.name).toBe('Hero');
    expect(hero.morphs.map((m) => m.name)).toEqual(['smile', 'blink', 'bones_wink']);
    expect(hero.pose).toHaveLength(3 + 6 + 3);
  });

  it('say which part of a rig was not given', () => {
    const rig = { name: 'Hero', skeleton: 'hero.skel', skin: 'sub/nowhere.skin', morphs: [] };
    const { diagnostics } = open([skelFile('hero.skel', skeleton()), file('x.rig', { kind: 'rig', rig })]);
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'part-not-given', file: 'x.rig' }]);
    expect(diagnostics[0].message).toContain('nowhere.skin');
  });

  it('make a character of each root', () => {
    const { document } = open([
      skelFile('two.skel', skeleton(2, 'two'), skeleton(1, 'two_2')),
      skinFile('two.skin', skin('two')),
    ]);
    expect(document.characters.map((c) => [c.name, c.skins.length])).toEqual([
      ['two', 1],
      ['two_2', 0],
    ]);
  });

  it('dress a skin in the texture that it names, without regard to case', () => {
    const painted = paintedSkin('hero', { name: 'face', texture: 'Head.PNG' });
    const head = texture('head.png');
    const { document, diagnostics } = open([skelFile('hero.skel', skeleton()), skinFile('hero.skin', painted), head]);
    expect(only(document).textures.map((t) => t.name)).toEqual(['head.png']);
    expect(diagnostics).toEqual([]);
    expect(document.unused).toEqual([]);
  });

  it('warn of a texture that was not given, and take it when it comes', () => {
    const painted = paintedSkin('hero', { name: 'face', texture: 'head.png' });
    const first = open([skelFile('hero.skel', skeleton()), skinFile('hero.skin', painted)]);
    expect(first.diagnostics).toMatchObject([{ severity: 'warning', code: 'texture-not-given', file: 'hero.skin' }]);
    const second = open([texture('head.png')], first.document);
    expect(only(second.document).textures).toHaveLength(1);
    expect(second.opened).toEqual(['c1']);
  });

  it('dress a skin in the textures of all its materials, and warn of each that was not given', () => {
    const material = (name: string) => ({ name, texture: `tex/${name}.png` });
    const painted = paintedSkin('hero', ...['face', 'coat', 'face', 'boots'].map(material), { name: 'bare' });
    const files = [skelFile('hero.skel', skeleton()), skinFile('hero.skin', painted), texture('Coat.png')];
    const { document, diagnostics } = open(files);
    expect(only(document).textures.map((t) => t.name)).toEqual(['Coat.png']);
    expect(diagnostics.map(({ code, message }) => [code, /"(.*)"/.exec(message)?.[1]])).toEqual([
      ['texture-not-given', 'tex/face.png'],
      ['texture-not-given', 'tex/boots.png'],
    ]);
    const later = open([texture('boots.png'), texture('face.png')], document);
    expect(only(later.document).textures.map((t) => t.name)).toEqual(['Coat.png', 'face.png', 'boots.png']);
    expect(later.document.unused).toEqual([]);
  });

  it('files opened together are placed beside existing characters', () => {
    const { document } = open([skelFile('a.skel', skeleton(2, 'a')), skelFile('b.skel', skeleton(2, 'b'))]);
    const [a, b] = document.characters.map((c) => c.placements[0].position);
    expect(a).toEqual([0, 0, 0]);
    expect(b[0]).toBeGreaterThan(0.1);
  });
});

describe('a file that does not fit', () => {
  it('a file that does not fit keeps its character from being opened, and no other', () => {
    const { document, diagnostics } = open([
      skelFile('hero.skel', skeleton(2)),
      skinFile('hero.skin', skin('hero', 7)),
      skelFile('other.skel', skeleton(1, 'other')),
    ]);
    expect(only(document).name).toBe('other');
    expect(diagnostics).toMatchObject([
      { severity: 'error', code: 'joint-missing', file: 'hero.skin' },
      { severity: 'info', code: 'held-back', file: 'hero.skel' },
    ]);
  });

  it('a file that does not fit changes nothing that was there', () => {
    const before = documentOf(character());
    const result = open([skinFile('hero.skin', skin('hero', 7))], before);
    expect(result.document).toBe(before);
    expect(result.opened).toEqual([]);
  });

  it('holds back what belongs with it when it could not be read, and says so', () => {
    const result = openFiles(EMPTY_DOCUMENT, [skinFile('hero.skin', skin())], [broken('hero.skel', 'skel')]);
    expect(result.document).toBe(EMPTY_DOCUMENT);
    expect(result.diagnostics).toMatchObject([{ severity: 'info', code: 'held-back', file: 'hero.skin' }]);
  });

  it('a file that does not fit is listed as unused, and used when what it needs is opened', () => {
    const first = open([morphFile('hero_smile.morph', morph('smile'))]);
    expect(first.document.characters).toEqual([]);
    expect(first.document.unused).toMatchObject([{ file: { source: { name: 'hero_smile.morph' } } }]);
    const second = open([skelFile('hero.skel', skeleton()), skinFile('hero.skin', skin())], first.document);
    expect(only(second.document).morphs).toHaveLength(1);
    expect(second.document.unused).toEqual([]);
  });

  it('warns when a clip has more or fewer channels than the skeleton needs', () => {
    const { document, diagnostics } = open([
      skelFile('hero.skel', skeleton()),
      animFile('hero.anim', clip('hero', [0, 0, 0, 0])),
    ]);
    expect(only(document).clips).toHaveLength(1);
    expect(diagnostics).toMatchObject([{ severity: 'warning', file: 'hero.anim' }]);
  });
});

describe('files that lay unused', () => {
  const tube = open([skelFile('tube.skel', skeleton(2, 'tube'))]).document;
  const waiting = open([morphFile('head1.morph', morph('head1', 99))], tube);

  it('files that lay unused are reported, and kept', () => {
    expect(waiting.diagnostics).toMatchObject([{ severity: 'info', code: 'file-unused', file: 'head1.morph' }]);
    expect(waiting.document.unused).toHaveLength(1);
    expect(waiting.document.characters).toBe(tube.characters);
  });

  it('don’t get in the way of what has nothing to do with them', () => {
    const { document, diagnostics } = open(
      [skelFile('wasp.skel', skeleton(2, 'wasp')), skinFile('wasp.skin', skin('wasp'))],
      waiting.document,
    );
    expect(document.characters.map((c) => c.name)).toEqual(['tube', 'wasp']);
    expect(diagnostics).toEqual([]);
    expect(document.unused).toHaveLength(1);
  });

  it('files that lay unused keep waiting, silently, if they fit by name but not in content', () => {
    const { document, diagnostics } = open([skinFile('head.skin', skin('head'))], waiting.document, 'c1');
    expect(diagnostics).toEqual([]);
    expect(document.unused).toHaveLength(1);
  });

  it('files that lay unused are still there when the opening example is replaced', () => {
    const sample = { ...tube, isOpeningSample: true };
    const dropped = open([morphFile('head1.morph', morph('head1'))], sample);
    expect(dropped.document.isOpeningSample).toBe(true);
    const { document } = open(
      [skelFile('head.skel', skeleton(1, 'head')), skinFile('head.skin', skin('head'))],
      dropped.document,
    );
    expect(only(document).morphs).toHaveLength(1);
  });

  it('files that lay unused come with a rig that names them', () => {
    const rig = { name: 'Hero', skeleton: 'bones.skel', skin: 'body.skin', morphs: ['head1.morph'] };
    const first = open([morphFile('head1.morph', morph('head1'))]).document;
    const files = [
      skelFile('bones.skel', skeleton()),
      skinFile('body.skin', skin()),
      file('x.rig', { kind: 'rig', rig }),
    ];
    const { document, diagnostics } = open(files, first);
    expect(only(document).morphs).toHaveLength(1);
    expect(diagnostics).toEqual([]);
  });
});

describe('files opened later', () => {
  it('files opened later never go to a character that comes with them because one of the same id was selected once', () => {
    const gone = removeCharacter.run(open([skelFile('a.skel', skeleton(2, 'a'))]).document, { characterId: 'c1' });
    const { document } = open(
      [
        skelFile('x/b.skel', skeleton(2, 'b')),
        skelFile('y/d.skel', skeleton(2, 'd')),
        animFile('z/s.anim', clip('s', [])),
      ],
      gone,
      'c1',
    );
    expect(document.characters.map((c) => [c.id, c.name, c.clips.length])).toEqual([
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
          clip(
            'jump',
            walk.channels.map(() => 0),
          ),
        ),
      ],
      two,
      'c1',
    );
    expect(document.characters.map((c) => c.clips.length)).toEqual([1, 0]);
    expect(document.characters[0].shownClip).toBe(0);
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

  it('complete a skin or a clip that waits for a skeleton', () => {
    const waiting = open([animFile('hero_walk.anim', walk)]).document;
    expect(only(waiting).skeleton).toBeUndefined();
    const { document } = open([skelFile('hero.skel', skeleton())], waiting);
    const now = only(document);
    expect(now.clips).toEqual([walk]);
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

describe('markers beside a take', () => {
  const step = { timeSeconds: 0.5, label: 'step' };
  const markers = (path: string) => file(path, { kind: 'markers', markers: [step] });
  const hero = [skelFile('hero.skel', skeleton()), animFile('hero_walk.anim', walk)];

  it('markers are given to the take that they are called after, in one drop or later', () => {
    expect(only(open([...hero, markers('hero_walk.markers.json')]).document).clips).toEqual([
      { ...walk, markers: [step] },
    ]);
    const { document } = open([markers('Hero_Walk.markers.json')], open(hero).document);
    expect(only(document).clips[0].markers).toEqual([step]);
    // The animation's own file has none.
    expect(only(open([animFile('hero_walk.anim', walk)], document).document).clips[0].markers).toEqual([step]);
  });

  it('markers of a take that is not open wait for it', () => {
    const { document, diagnostics } = open([markers('hero_walk.markers.json')]);
    expect(diagnostics[0].message).toContain('No open take');
    expect(only(open(hero, document).document).clips[0].markers).toEqual([step]);
  });
});
