import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { removeCharacter } from '../../../src/edit/commands/characters.ts';
import { type ChannelClip, keysOf } from '../../../src/model/clip.ts';
import { type Character, type Document, EMPTY_DOCUMENT, shownClip } from '../../../src/model/document.ts';
import type { BrokenFile, ParsedFile } from '../../../src/model/files.ts';
import { NO_MARKS } from '../../../src/model/part.ts';
import { openFiles } from '../../../src/project/open/open-files.ts';
import { saveCharacter } from '../../../src/project/save/saving.ts';
import { read } from '../../formats/read-in-pieces.ts';
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
import { bvhFigure, bvhJoint } from '../../helpers/bvh.ts';

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
  it('a file that does not fit is left out, and the rest of its character opens', () => {
    const { document, diagnostics } = open([
      skelFile('hero.skel', skeleton(2)),
      skinFile('hero.skin', skin('hero', 7)),
      morphFile('hero_smile.morph', morph('hero_smile')),
      animFile('hero_walk.anim', walk),
    ]);
    expect(only(document)).toMatchObject({ name: 'hero', skins: [], morphs: [], clips: [walk] });
    expect(diagnostics).toMatchObject([
      { severity: 'error', code: 'joint-missing', file: 'hero.skin' },
      { severity: 'info', code: 'held-back', file: 'hero_smile.morph' },
    ]);
  });

  it('a skeleton that does not fit what its character had leaves that as it was', () => {
    const before = open([skelFile('hero.skel', skeleton(2)), skinFile('hero.skin', skin('hero', 1))]).document;
    const result = open(
      [skelFile('hero.skel', skeleton(1)), animFile('hero_jump.anim', clip('hero_jump', new Array(6).fill(0)))],
      before,
    );
    expect(result.document).toBe(before);
    expect(result.diagnostics.map(({ severity, file }) => [severity, file])).toEqual([
      ['error', 'hero.skin'],
      ['info', 'hero.skel'],
      ['info', 'hero_jump.anim'],
    ]);
  });

  it('a file that does not fit changes nothing that was there', () => {
    const before = documentOf(character());
    const result = open([skinFile('hero.skin', skin('hero', 7))], before);
    expect(result.document).toBe(before);
    expect(result.opened).toEqual([]);
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

describe('a file with errors', () => {
  const parts = {
    skel: skelFile('hero.skel', skeleton()),
    skin: skinFile('hero.skin', skin()),
    morph: morphFile('hero_smile.morph', morph('hero_smile')),
    anim: animFile('hero_walk.anim', walk),
  };
  type PartName = keyof typeof parts;
  const names = Object.keys(parts) as PartName[];
  const without = (...lost: readonly PartName[]) =>
    openFiles(
      EMPTY_DOCUMENT,
      names.filter((name) => !lost.includes(name)).map((name) => parts[name]),
      lost.map((name) => broken(parts[name].source.path, parts[name].kind)),
    );
  const held = ({ characters }: Document) =>
    characters.map(({ skeleton: own, skins, morphs, clips }) => [
      own ? 1 : 0,
      skins.length,
      morphs.length,
      clips.length,
    ]);

  it.each([
    ['skel', [], ['hero.skin', 'hero_smile.morph', 'hero_walk.anim']],
    ['skin', [[1, 0, 0, 1]], ['hero_smile.morph']],
    ['morph', [[1, 1, 0, 1]], []],
    ['anim', [[1, 1, 1, 0]], []],
  ] as const)('a %s with errors holds back only what depends on it, and says so', (lost, opened, waiting) => {
    const { document, diagnostics } = without(lost);
    expect(held(document)).toEqual(opened);
    expect(document.unused.map(({ file }) => file.source.name)).toEqual(waiting);
    const said = (code: string) => diagnostics.filter((d) => d.code === code).map((d) => d.file);
    expect(said('held-back')).toEqual(waiting);
    expect(said('opened-without')).toEqual(opened.length > 0 ? [parts[lost].source.name] : []);
  });

  it('any files with errors, mended later in any order, become the character that they would have been', () => {
    const whole = held(without().document);
    fc.assert(
      fc.property(fc.subarray(names, { minLength: 1 }), fc.boolean(), (lost, isTogether) => {
        const first = without(...lost).document;
        // A lone take would go to the other character while its own isn't open.
        const others = lost.includes('skel') ? [] : [skelFile('other.skel', skeleton(3, 'other'))];
        const drops = isTogether
          ? [lost]
          : fc.sample(fc.shuffledSubarray(lost, { minLength: lost.length }), 1)[0].map((name) => [name]);
        let document = open(others, first).document;
        for (const drop of drops)
          document = open(
            drop.map((name) => parts[name]),
            document,
            'c9',
          ).document;
        expect(held(document).filter(([, skins, , clips]) => skins + clips > 0)).toEqual(whole);
        expect(document.unused).toEqual([]);
        expect(document.characters.every(({ unread }) => unread === undefined)).toBe(true);
      }),
      { numRuns: 60 },
    );
  });

  it('a rig with a part that has errors opens with the others, and waits with them for its skeleton', () => {
    const rig = { name: 'Hero', skeleton: 'bones.skel', skin: 'body.skin', morphs: [], animation: 'walk.anim' };
    const bound = file('x.rig', { kind: 'rig', rig });
    const bones = skelFile('bones.skel', skeleton(2, 'bones'));
    const body = skinFile('body.skin', skin());
    const first = openFiles(EMPTY_DOCUMENT, [bound, bones, body], [broken('walk.anim', 'anim')]);
    expect(held(first.document)).toEqual([[1, 1, 0, 0]]);
    const second = openFiles(EMPTY_DOCUMENT, [bound, body], [broken('bones.skel', 'skel')]);
    expect(held(second.document)).toEqual([]);
    expect(only(open([bones], second.document).document)).toMatchObject({
      name: 'Hero',
      skins: [body.kind === 'skin' && body.skin],
    });
  });

  it('a file with errors goes to the character that lacks it, whichever is selected', () => {
    const lacking = without('anim').document;
    const two = open([skelFile('other.skel', skeleton(3, 'other'))], lacking).document;
    const { document } = open([parts.anim], two, two.characters[1].id);
    expect(document.characters.map(({ clips }) => clips.length)).toEqual([1, 0]);
  });
});

describe('a take goes to the only character', () => {
  const wave = animFile('wave.anim', clip('wave', [0, 0, 0, 1, 0, 0, 0, 0, 0]));
  const fox = (path: string) =>
    file(path, {
      kind: 'character',
      characters: [{ skeleton: skeleton(2, 'fox'), skins: [], morphs: [], clips: [], textures: [] }],
    });
  const figure = bvhFigure({ name: 'cap', joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'])] }, [
    [0, 0, 0, 0, 0, 0],
  ]);
  const capture = file('cap.bvh', { kind: 'bvh', figures: [figure] });
  const turn = animFile('turn.anim', clip('turn', [1, 2, 3, 0.1, 0.2, 0.3]));

  it.each([
    ['a whole character', [fox('fox.glb'), wave]],
    ['the same, after it', [wave, fox('fox.glb')]],
    ['one in another folder', [fox('a/fox.glb'), wave]],
    ['motion capture', [capture, turn]],
  ] as const)('a take goes to the only character there: %s', (_, files) => {
    const together = only(open([...files]).document);
    expect(together.clips.map(({ name }) => name)).toContain(files.includes(wave) ? 'wave' : 'turn');
    const one = open([files[0]]).document;
    const later = only(open([files[1]], one).document);
    expect(later.clips.map(({ name }) => name).toSorted()).toEqual(together.clips.map(({ name }) => name).toSorted());
  });

  it('takes that were opened before their skeleton go to it, several too', () => {
    const takes = open([wave, animFile('run.anim', clip('run', [0, 0, 0, 2, 0, 0, 0, 0, 0]))]).document;
    expect(takes.characters).toHaveLength(2);
    const { document } = open([fox('fox.glb')], takes);
    expect(
      only(document)
        .clips.map(({ name }) => name)
        .toSorted(),
    ).toEqual(['run', 'wave']);
    expect(only(document).parts?.clips.every(({ file: from }) => from?.kind === 'anim')).toBe(true);
  });

  it('a take of a .skel drives motion capture by the names of its DOFs, and is saved as it was', () => {
    const character = only(open([capture, turn]).document);
    const at = character.clips.findIndex(({ name }) => name === 'turn');
    const values = character.clips[at].channels.map((channel) => keysOf(channel).values[0]);
    // In the file x y z before rx ry rz; in the capture rz rx ry.
    expect(values).toEqual([1, 2, 3, 0.3, 0.1, 0.2]);
    const saved = saveCharacter(character, 'anim').find(({ name }) => name === 'turn.anim');
    const again = read('turn.anim', saved?.text ?? '').value;
    expect(again?.kind === 'anim' && again.clip.channels.map((c) => keysOf(c).values[0])).toEqual([
      1, 2, 3, 0.1, 0.2, 0.3,
    ]);
  });

  it('of several, a skeleton that is made for takes has it, or the one that it is named after', () => {
    const clipsOf = (...files: ParsedFile[]) =>
      open(files).document.characters.map(({ name, clips }) => [name, clips.length]);
    expect(clipsOf(fox('fox.glb'), skelFile('hero.skel', skeleton()), wave)).toEqual([
      ['fox', 0],
      ['hero', 1],
    ]);
    const named = animFile('b_wave.anim', clip('b_wave', [0, 0, 0, 1, 0, 0, 0, 0, 0]));
    const other = { ...fox('b.glb') };
    expect(clipsOf(fox('a.glb'), other, named)).toEqual([
      ['a', 0],
      ['b', 1],
    ]);
  });
});

describe('names of what was opened', () => {
  const whole = (path: string, ...takes: readonly string[]) =>
    file(path, {
      kind: 'character',
      characters: [
        {
          skeleton: skeleton(1, path.slice(path.lastIndexOf('/') + 1, path.lastIndexOf('.'))),
          skins: [],
          morphs: [],
          clips: takes.map((name) => clip(name, [0, 0, 0, 0, 0, 0])),
          textures: [],
        },
      ],
    });
  const takesOf = ({ characters }: Document) => characters.map(({ clips }) => clips.map(({ name }) => name));

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

describe('the take that is shown first', () => {
  const still = clip('T-Pose', [0, 0, 0, 1, 0, 0]);
  const { channels } = still;
  const moving: ChannelClip = {
    ...still,
    name: 'walk',
    channels: channels.map((channel, c) => {
      if (c !== 3 || channel.kind !== 'keys') return channel;
      const flat = { kinds: Uint8Array.of(0, 0), slopes: Float64Array.of(0, 0) };
      return {
        ...channel,
        times: Float64Array.of(0, 1),
        values: Float64Array.of(0, 1),
        tangentsIn: flat,
        tangentsOut: flat,
      };
    }),
  };
  const scene = (...clips: ChannelClip[]) =>
    file('fox.glb', {
      kind: 'character',
      characters: [{ skeleton: skeleton(1), skins: [], morphs: [], clips, textures: [] }],
    });
  const shown = (...files: ParsedFile[]) => shownClip(only(open(files).document))?.name;

  it('the first take that moves is shown, of a scene or of several files', () => {
    const empty = { ...still, name: 'Take 001', channels: [] };
    expect(shown(scene(empty, still, moving))).toBe('walk');
    expect(shown(scene(still, empty))).toBe('T-Pose');
    const hero = skelFile('hero.skel', skeleton(1));
    expect(shown(hero, animFile('hero_a.anim', still), animFile('hero_b.anim', moving))).toBe('walk');
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
