import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { FORMAT_KINDS, KINDS } from '../../src/files/kinds.ts';
import { expectEqual } from '../helpers/equal.ts';
import { expectLinearTime } from '../helpers/growth.ts';
import { bytesOf, read, readAsOpened, readInPieces } from './read-in-pieces.ts';
import { ALL_FILES, fileBytes } from './shared-files.ts';

/** One file of each kind. */
const NAMES = FORMAT_KINDS.map((kind) => `x.${KINDS[kind].extensions[0]}`);
/** Without images, whose bytes are kept as they are. */
const PARSED = NAMES.filter((_, i) => KINDS[FORMAT_KINDS[i]].content !== 'texture');

const VOCABULARY = [
  ...['{', '}', '{{', '}}', ' ', '\n', '\r', '\r\n', '\r\r\n', '\t', '"', '"a b"', 'x', 'ü', '骨', '\uFEFF', '\0'],
  ...[
    'balljoint',
    'offset',
    'pose',
    'limit',
    'rx',
    'rotxlimit',
    'boxmin',
    'role',
    'order',
    'xzy',
    'foo',
    'foo {',
    'name{',
  ],
  ...[
    'positions',
    'normals',
    'texcoords',
    'skinweights',
    'triangles',
    'bindings',
    'matrix',
    'material',
    'texture',
    'color',
  ],
  ...['animation', 'range', 'numchannels', 'channel', 'extrapolate', 'constant', 'bounce', 'keys', 'flat', 'smooth'],
  ...['channel 0 {', 'channel 7{', 'channel 1.5', 'matrix 0 {', 'balljoint 1 a {', 'balljoint a 1', 'keys x 2 {'],
  ...[
    'HIERARCHY',
    'ROOT',
    'ROOT a {',
    'JOINT b c',
    'End Site',
    'OFFSET',
    'CHANNELS',
    'Xposition',
    'Zrotation',
    'MOTION',
  ],
  ...['OFFSET 0 1 0 2 3 4', '0 1 0 -1\n', '1 2 3 0\n', '%YAML', '<html>', 'PK\u0003\u0004', '# x\n'],
  ...['Frames:', 'Frames:2', 'Frame', 'Time:', 'Frame Time: 0.1\n', '1 2\n', '1 2 3', '\n1 '],
  ...['rig', 'skeleton', 'skin', 'morphs', 'a.skel', 'b c.skin', 'd.morph'],
  ...[
    'world',
    'local:',
    'v 1 2 3\n',
    'vn',
    'ply\n',
    'end_header',
    '[',
    ']',
    '{"time":',
    ',',
    'joint 7 (a):',
    'time 1.5\n',
  ],
  ...[
    '0',
    '1',
    '-1',
    '2',
    '3',
    '0.5',
    '1e9',
    '1e999',
    'nan',
    '1,5',
    '12x5',
    '1e-7',
    '0.12345678901234567',
    '4294967296',
  ],
];

const text = fc
  .array(fc.tuple(fc.constantFrom(...VOCABULARY), fc.constantFrom(' ', '', '\n')), { maxLength: 60 })
  .map((parts) => bytesOf(parts.flat().join('')));
const bytes = fc.oneof(text, fc.uint8Array({ maxLength: 200 }));
const cuts = (length: number) =>
  fc.oneof(fc.constant(Array.from({ length }, (_, i) => i)), fc.array(fc.nat(length), { maxLength: 12 }));

describe('a file in pieces', () => {
  it.each(NAMES)('%s: reads the same as in one, whatever it holds, and never throws', (name) => {
    const property = fc.property(
      bytes.chain((b) => fc.tuple(fc.constant(b), cuts(b.length))),
      ([b, at]) => {
        expectEqual(readInPieces(name, b, at), read(name, b));
      },
    );
    fc.assert(property, { numRuns: 150 });
  });

  it('reads file names the same, wherever they are cut', () => {
    const part = fc.constantFrom(
      'skin',
      'skeleton',
      'morphs 2 {',
      '}',
      '"a b.skin"',
      '"a',
      '"',
      'b c.morph',
      'd',
      '\n',
      '"x"y',
    );
    const property = fc.property(
      fc.array(part, { maxLength: 12 }),
      fc.array(fc.nat(80), { maxLength: 9 }),
      (parts, at) => {
        const b = bytesOf(`rig x { ${parts.join(' ')} }`);
        const cuts = [at.filter((c) => c <= b.length), Array.from({ length: b.length }, (_, i) => i)];
        const whole = read('x.rig', b);
        for (const each of cuts) expectEqual(readInPieces('x.rig', b, each), whole);
      },
    );
    fc.assert(property, { numRuns: 250 });
  });

  it('reads a row of weights that is said to be endless the same, cut after a joint or after its weight', () => {
    const b = bytesOf(
      `positions 2 { 0 0 0 1 0 0 } skinweights 2 { 1e92 ${'5 0.5 '.repeat(9)}} bindings 1 { matrix { 1 0 0 0 1 0 0 0 1 0 0 0 } }`,
    );
    const whole = read('x.skin', b);
    expect(whole.diagnostics.some(({ message }) => message.includes('(and 8 more like it)'))).toBe(true);
    for (let at = 0; at <= b.length; at++) expectEqual(readInPieces('x.skin', b, [at]), whole);
  });

  it('a file in pieces has the same excerpts when a line is far longer than what is shown, or than a piece', () => {
    const long = fc.tuple(fc.nat(900), fc.constantFrom('a', 'ü', '骨', '\u{1F9B4}'), fc.nat(900));
    const property = fc.property(long, fc.array(fc.nat(6000), { maxLength: 20 }), ([before, filler, after], at) => {
      const b = bytesOf(`balljoint ${filler.repeat(before)} { offset 0 x 0 boo ${filler.repeat(after)}\n}`);
      const whole = read('x.skel', b);
      const cuts = at.filter((c) => c <= b.length);
      expectEqual(readInPieces('x.skel', b, cuts), whole);
      for (const { excerpt } of whole.diagnostics) {
        expect(excerpt?.text.length).toBeLessThanOrEqual(200);
        expect(excerpt?.text.slice(excerpt.caret)).toMatch(/^(x 0|boo)/);
      }
    });
    fc.assert(property, { numRuns: 150 });
  });

  it('a file in pieces of a few bytes has the same excerpts when hundreds of them wait for the rest of their line', () => {
    const word = fc.constantFrom('{', '}', 'ü', 'x1 ', ' ', '{ü');
    const property = fc.property(word, word, fc.integer({ min: 1, max: 9 }), fc.nat(3000), (a, b, size, rest) => {
      const bytes = bytesOf(`balljoint a {\n${(a + b).repeat(1500)}${'z'.repeat(rest)}\n}\n${b.repeat(900)}`);
      const cuts = Array.from({ length: Math.ceil(bytes.length / size) }, (_, i) => i * size);
      expectEqual(readInPieces('x.skel', bytes, cuts), read('x.skel', bytes));
    });
    fc.assert(property, { numRuns: 30 });
  });
});

describe('a hostile file', () => {
  const HOSTILE = [
    '{',
    '}',
    '} ',
    'x',
    'x\n',
    '"',
    '"a" ',
    '\r',
    '\0',
    '骨',
    'balljoint x{',
    'texture a ',
    'positions 1e9 {',
    'JOINT a {',
    '1 2 ',
    '1\n',
    '1\r\n',
  ];
  const START = [
    '',
    'balljoint x { pose ',
    'positions 1e9 { ',
    'skinweights 9 { ',
    'rig x { morphs 9 { ',
    'material x { ',
    'HIERARCHY ROOT x { ',
    'HIERARCHY ROOT x { OFFSET 0 0 0 CHANNELS 2 Xposition Zrotation } MOTION Frames: 1e9 Frame Time: 1\n',
  ];

  /** A kind of file, and how it begins. */
  const BEGINS = / $|skel ball|skin (pos|skinw|mat)|morph pos|rig rig|bvh HIER/;

  it.each(PARSED)(
    '%s: reads the same over and over, in pieces or not, in a time that grows with its length',
    (name) => {
      const cuts = Array.from({ length: 40 }, (_, i) => 1000 * i);
      const turn = PARSED.indexOf(name);
      for (const [s, start] of START.entries())
        for (const [e, each] of HOSTILE.entries()) {
          // A file that begins as another kind has another twelfth of them for each kind.
          if (!BEGINS.test(`${name} ${start}`) && (turn + s + e) % 12 > 0) continue;
          const both = (length: number) => {
            const bytes = bytesOf(start + each.repeat(length / each.length));
            const whole = read(name, bytes);
            expect(whole.diagnostics.length).toBeLessThan(205);
            expectEqual(readInPieces(name, bytes, cuts), whole);
          };
          expectLinearTime(both, 5000, `time of 4 n by that of n, for ${JSON.stringify([start, each])}`);
        }
    },
  );

  const REPEATED = [
    'a { ',
    'a {\n',
    '} ',
    '}\n',
    'balljoint x { ',
    'skinweights 1e9 {\n',
    'channel { keys 0 { ',
    'a 1 b\n',
  ];

  it.each(PARSED)('%s: the places of its problems are found in a time that grows with its length', (name) => {
    for (const each of REPEATED) {
      const opened = (length: number) => void readAsOpened(name, each.repeat(length / each.length));
      expectLinearTime(opened, 10_000, `time of 4 n by that of n, for ${JSON.stringify(each)}`);
    }
  });

  it.each([
    ['joints', (n: number) => [`[${Array(n).fill('{"joints": [{"name": "a", "world": [1, 0, 0]}]}').join(', ')}]`]],
    ['lines of Python', (n: number) => Array<string>(n).fill("{'world': [[1, 0, 0]]}")],
    [
      'kinds of keys',
      (n: number) => [`{${Array.from({ length: n }, (_, i) => `"world_${i}": [[1, 0, 0]]`).join(', ')}}`],
    ],
  ])('a dump of many %s is read in a time that grows with their number', (_, lines) => {
    expectLinearTime((n) => void read('x.json', lines(n).join('\n')), 2000);
  });
});

describe('the files at hand in pieces', () => {
  it.each(ALL_FILES)('%s reads the same in pieces, also when it is damaged', (path) => {
    const original = fileBytes(path);
    const damage = fc.oneof(
      fc.record({ at: fc.nat(original.length), cut: fc.constant(0), put: fc.constantFrom(...VOCABULARY) }),
      fc.record({ at: fc.nat(original.length), cut: fc.nat(40), put: fc.constant('') }),
      fc.record({ at: fc.nat(original.length), cut: fc.constant(original.length), put: fc.constant('') }),
    );
    const property = fc.property(
      fc.array(damage, { maxLength: 3 }),
      fc.array(fc.nat(), { maxLength: 6 }),
      (all, at) => {
        let b = original;
        for (const { at, cut, put } of all) b = spliced(b, Math.min(at, b.length), cut, bytesOf(put));
        const whole = read(path, b);
        expect(whole.value === undefined).toBe(whole.diagnostics.some((d) => d.severity === 'error'));
        const cuts = at.map((c) => c % (b.length + 1));
        expectEqual(readInPieces(path, b, cuts), whole);
        const lines = new TextDecoder().decode(b).split(/\r*\n|\r/).length;
        for (const { line, excerpt } of whole.diagnostics) {
          expect(line).toBeLessThanOrEqual(lines);
          expect(excerpt?.text.length ?? 0).toBeLessThanOrEqual(200);
        }
      },
    );
    fc.assert(property, { numRuns: original.length > 50000 ? 3 : 8 });
  });
});

function spliced(bytes: Uint8Array, at: number, cut: number, put: Uint8Array): Uint8Array {
  const after = bytes.subarray(Math.min(bytes.length, at + cut));
  const result = new Uint8Array(at + put.length + after.length);
  result.set(bytes.subarray(0, at));
  result.set(put, at);
  result.set(after, at + put.length);
  return result;
}
