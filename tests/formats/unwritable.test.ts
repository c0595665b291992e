/** Numbers that no file can hold: an error names them, and nothing else is written in their place. */
import { describe, expect, it } from 'vitest';
import { saveCharacter } from '../../src/files/save/saving.ts';
import type { FileContent } from '../../src/model/files.ts';
import { cutMessage, cutText, MAX_SHOWN } from '../../src/model/names/cut-text.ts';
import { character, joint, morph, skin, takeOfValues } from '../helpers/builders.ts';
import { bvhJoint } from '../helpers/bvh.ts';
import { writeFile } from '../helpers/write-file.ts';
import { read } from './read-in-pieces.ts';

const ARM = joint(-1, { name: 'arm' });
const WALK = takeOfValues('walk', [0, 1, 2]);
const SKIN = skin('hero');
const MORPH = morph('smile');

const CASES: readonly (readonly [string, FileContent, string])[] = [
  [
    'x.skel',
    { kind: 'skel', skeletons: [{ name: 'x', joints: [{ ...ARM, offset: [0, Infinity, 0] }] }] },
    'found Infinity in joint 0 "arm".',
  ],
  [
    'x.skel',
    { kind: 'skel', skeletons: [{ name: 'x', joints: [{ ...ARM, limits: [{ min: -Infinity, max: 1 }] }] }] },
    'found -Infinity in joint 0 "arm".',
  ],
  ['x.anim', { kind: 'anim', take: { ...WALK, range: [0, Number.NaN] } }, 'found NaN in the range.'],
  [
    'x.anim',
    { kind: 'anim', take: { ...WALK, channels: [{ ...WALK.channels[0], kind: 'rest', value: Infinity }] } },
    'found Infinity in channel 0.',
  ],
  ['x.anim', { kind: 'anim', take: { ...WALK, channels: [] } }, 'Expected channels in walk, found none'],
  [
    'x.skin',
    { kind: 'skin', skin: { ...SKIN, positions: SKIN.positions.with(4, Number.NaN) } },
    'found NaN in positions, row 2.',
  ],
  [
    'x.morph',
    {
      kind: 'morph',
      morph: { ...MORPH, positions: { ...MORPH.positions, values: MORPH.positions.values.with(0, -Infinity) } },
    },
    'found -Infinity in positions, row 1.',
  ],
  [
    'x.pose',
    {
      kind: 'pose',
      poses: [{ name: 'sit', joints: [{ name: 'arm', dofs: [{ name: 'rx', value: Number.NaN }] }], weights: [] }],
    },
    'found NaN in pose "sit".',
  ],
  [
    'x.markers.json',
    { kind: 'markers', markers: [{ timeSeconds: Number.NaN, label: 'step' }] },
    'found NaN in marker 1.',
  ],
  ['x.sets.json', { kind: 'sets', sets: { sets: [], locked: [], others: { made: Number.NaN } } }, 'found NaN in made.'],
  [
    'x.layers.json',
    { kind: 'layers', layers: { base: 'b.anim', layers: [], others: { made: Number.NaN } } },
    'found NaN in made.',
  ],
  ['x.limbs.json', { kind: 'limbs', limbs: { limbs: [], others: { made: Number.NaN } } }, 'found NaN in made.'],
];

describe('a number that no file can hold', () => {
  it.each(CASES)('a number that %s can not hold is an error that names it', (name, content, message) => {
    expect(() => writeFile(content, name)).toThrow(message);
  });

  it('a name of any length in such an error is cut', () => {
    const joints = [{ ...ARM, name: 'a'.repeat(1e6), offset: [Number.NaN, 0, 0] as const }];
    expect(() => writeFile({ kind: 'skel', skeletons: [{ name: 'x', joints }] }, 'x.skel')).toThrow(/^.{1,1000}$/);
  });
});

describe('a joint without any limits', () => {
  it('a joint without any limits is written without a line for them', () => {
    const motion = { kind: 'translational' } as const;
    const none = { min: -Infinity, max: Infinity };
    const skeleton = { name: 'x', joints: [joint(-1, { motion, limits: [none, none, none], pose: [2e5, 0, 0] })] };
    const [{ text }] = saveCharacter(character({ skeleton }), 'skel');
    expect(text).not.toContain('limit');
    const { value } = read('x.skel', text);
    expect(value).toMatchObject({ skeletons: [{ joints: [{ limits: [{ max: 1e5 }, { max: 1e5 }, { max: 1e5 }] }] }] });
  });
});

describe('motion capture without a take', () => {
  const skeleton = {
    name: 'x',
    joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rx'], { offset: [1, 2, 3], pose: [1, 2, 3, 0] })],
  };

  it('motion capture without a take is written without frames at its offsets, and otherwise with its pose as one', () => {
    expect(saveCharacter(character({ skeleton }), 'bvh')[0].text).toMatch(/Frames: 0\n/);
    const posed = character({ skeleton, pose: [1, 2, 3, Math.PI] });
    expect(saveCharacter(posed, 'bvh')[0].text).toMatch(/Frames: 1\nFrame Time: .*\n1 2 3 (-?180|0)/);
  });
});

describe('text for messages', () => {
  it('text for messages keeps its beginning and end, and no half of a character', () => {
    expect(cutText('short')).toBe('short');
    expect(cutText('abcdefghij', 5)).toBe('ab…ij');
    for (const length of [300, 301]) {
      const cut = cutText('😀'.repeat(length));
      expect(cut.length).toBeLessThanOrEqual(MAX_SHOWN);
      expect(cut).not.toMatch(/\p{Surrogate}/u);
    }
  });

  it('text for messages has long words and quoted names cut, and the rest as it is', () => {
    const long = 'x'.repeat(1e6);
    expect(cutMessage(`Expected a number, found "${long}".`)).toMatch(/^Expected a number, found "x{99}…x{98}"\.$/);
    expect(cutMessage(`Joint ${long} is twice here.`)).toMatch(/^Joint x{100}…x{99} is twice here\.$/);
    expect(cutMessage(`The joint "${'a b '.repeat(1e5)}" is cut.`)).toHaveLength('The joint  is cut.'.length + 200);
    expect(cutMessage('word '.repeat(1e5))).toHaveLength(1000);
  });
});
