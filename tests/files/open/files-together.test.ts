import { describe, expect, it } from 'vitest';
import {
  animFile,
  file,
  morph,
  morphFile,
  paintedSkin,
  skeleton,
  skelFile,
  skin,
  skinFile,
  takeOfValues,
} from '../../helpers/builders.ts';
import { only, open, texture, walk } from './opening.ts';

describe('files opened together', () => {
  it('files opened together become one character when their stems begin with the skeleton’s', () => {
    const { document, opened, diagnostics, label } = open([
      skelFile('hero.skel', skeleton()),
      skinFile('hero.skin', skin()),
      animFile('hero_walk.anim', walk),
    ]);
    const hero = only(document);
    expect(hero).toMatchObject({ id: 'c1', name: 'hero', shownSkin: 0, shownTake: 0 });
    expect(hero.takes[0]).toBe(walk);
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
        takeOfValues(
          'jump',
          walk.channels.map(() => 0),
        ),
      ),
      skelFile('b/other.skel', skeleton(2, 'other')),
    ]);
    expect(document.characters.map((c) => c.takes.length)).toEqual([1, 0]);
  });

  it('files opened together go to the only skeleton given where their own folder has none', () => {
    const { document } = open([skelFile('a/hero.skel', skeleton()), animFile('b/jump.anim', takeOfValues('jump', []))]);
    expect(only(document).takes).toHaveLength(1);
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
