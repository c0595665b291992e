import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import {
  animFile,
  character,
  documentOf,
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

describe('a file that does not fit', () => {
  it('a file that does not fit is left out, and the rest of its character opens', () => {
    const { document, diagnostics } = open([
      skelFile('hero.skel', skeleton(2)),
      skinFile('hero.skin', skin('hero', 7)),
      morphFile('hero_smile.morph', morph('hero_smile')),
      animFile('hero_walk.anim', walk),
    ]);
    expect(only(document)).toMatchObject({ name: 'hero', skins: [], morphs: [], takes: [walk] });
    expect(diagnostics).toMatchObject([
      { severity: 'error', code: 'joint-missing', file: 'hero.skin' },
      { severity: 'info', code: 'held-back', file: 'hero_smile.morph' },
    ]);
  });

  it('a skeleton that does not fit what its character had leaves that as it was', () => {
    const before = open([skelFile('hero.skel', skeleton(2)), skinFile('hero.skin', skin('hero', 1))]).document;
    const result = open(
      [skelFile('hero.skel', skeleton(1)), animFile('hero_jump.anim', takeOfValues('hero_jump', new Array(6).fill(0)))],
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

  it('warns when a take has more or fewer channels than the skeleton needs', () => {
    const { document, diagnostics } = open([
      skelFile('hero.skel', skeleton()),
      animFile('hero.anim', takeOfValues('hero', [0, 0, 0, 0])),
    ]);
    expect(only(document).takes).toHaveLength(1);
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
    characters.map(({ skeleton: own, skins, morphs, takes }) => [
      own ? 1 : 0,
      skins.length,
      morphs.length,
      takes.length,
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
        expect(held(document).filter(([, skins, , takes]) => skins + takes > 0)).toEqual(whole);
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
    expect(document.characters.map(({ takes }) => takes.length)).toEqual([1, 0]);
  });
});
