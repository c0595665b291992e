import { describe, expect, it } from 'vitest';
import { readRig } from '../../src/formats/rig/read.ts';
import { writeRig } from '../../src/formats/rig/write.ts';
import { told } from './read-in-pieces.ts';

const rig = (text: string) => readRig(text, 'hero.rig');

describe('reading .rig', () => {
  it('reads every part, on one line or many', () => {
    const expected = {
      name: 'wasp',
      skeleton: 'wasp.skel',
      skin: 'wasp.skin',
      morphs: ['a.morph', 'b.morph'],
      animation: 'walk.anim',
    };
    const text = 'rig wasp { skeleton wasp.skel skin wasp.skin morphs 2 { a.morph b.morph } animation walk.anim }';
    expect(rig(text)).toEqual({ value: expected, diagnostics: [] });
    expect(rig(text.replaceAll(' ', '\r\n'))).toEqual({ value: expected, diagnostics: [] });
    expect(rig(text.replaceAll('{ ', '{').replaceAll(' }', '}'))).toEqual({ value: expected, diagnostics: [] });
  });

  it('reading .rig takes each part as optional', () => {
    expect(rig('rig x { }')).toEqual({ value: { name: 'x', morphs: [] }, diagnostics: [] });
    expect(rig('RIG { Skin a.skin }').value).toEqual({ name: 'hero', skin: 'a.skin', morphs: [] });
  });

  it.each([
    ['skeleton my old hero.skel', 'my old hero.skel'],
    ['skeleton my skin hero.skel skin b.skin', 'my skin hero.skel'],
    ['skeleton "a {b}.skel" skin b.skin', 'a {b}.skel'],
    ['skeleton hero skin b.skin', 'hero'],
    ['skeleton hero of mine', 'hero of mine'],
    ['skeleton hero}', 'hero'],
    ['skeleton ""', ''],
    ['skeleton skin', 'skin'],
    ['skeleton\n\thero.skel', 'hero.skel'],
  ])('takes a FILE as one token, in quotes, or as the rest of the line: %j', (line, skeleton) => {
    expect(rig(`rig x {\n${line}\n}`).value?.skeleton).toBe(skeleton);
  });

  it('reading .rig takes morphs with blanks', () => {
    expect(rig('rig x {\nmorphs 4 { "a b" my first.morph c.morph\nmy second\n}\n}').value?.morphs).toEqual([
      'a b',
      'my first.morph',
      'c.morph',
      'my second',
    ]);
  });

  it('warns of what is glued to a closing quote', () => {
    const { value, diagnostics } = rig('rig x {\nskin "a.skin"b\n}');
    expect(value?.skin).toBe('a.skin');
    expect(told({ diagnostics })).toEqual(['warning quote-unexpected 2:6']);
  });

  it('warns of another count of morphs, of parts that come twice and of unknown ones', () => {
    const { value, diagnostics } = rig('rig x {\nskin a.skin\nskin b.skin\nmorphs 1 {\n}\ncolour red\n}\n}');
    expect(value?.skin).toBe('b.skin');
    expect(told({ diagnostics })).toEqual([
      'warning repeated 3:1',
      'warning count-mismatch 4:8',
      'warning keyword-unknown 6:1',
      'warning brace-unexpected 8:1',
    ]);
  });

  it.each([
    ['', 'error rig-missing 1:1'],
    ['rig x {', 'error brace-missing 1:8'],
    ['rig x\nskin a.skin }', 'error brace-missing 2:1'],
    ['rig x {\nskin\n}', 'error file-expected 3:1'],
    ['rig x {\nskeleton\nskin a.skin\n}', 'error file-expected 3:1'],
    ['rig x {\nmorphs {\n}\n}', 'error number-expected 2:8'],
    ['rig x {\nmorphs 1.5 {\n}\n}', 'error count-fractional 2:8'],
    ['rig x {\nskin "a.skin\n}', 'error quote-missing 2:6'],
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = rig(text);
    expect(result.value).toBeUndefined();
    expect(told(result)[0]).toBe(expected);
  });
});

describe('writing .rig', () => {
  it('writing .rig writes what the course writes', () => {
    const text = 'rig wasp {\n\tskeleton wasp.skel\n\tskin wasp.skin\n\tmorphs 0 {\n\t}\n}\n';
    const { value } = rig(text);
    expect(value && writeRig(value).text).toBe(text);
  });

  it('puts in quotes what is more than one token, and changes what quotes can not hold', () => {
    const { text, diagnostics } = writeRig({ name: 'a b', skeleton: 'my "x".skel', morphs: ['c d.morph'] });
    expect(text).toBe('rig a_b {\n\tskeleton "my _x_.skel"\n\tmorphs 1 {\n\t\t"c d.morph"\n\t}\n}\n');
    expect(diagnostics.map((d) => d.code)).toEqual(['name-changed', 'name-changed']);
  });
});
