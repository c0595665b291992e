/** An optional number after the keyword of a block, in every text format: the order of the file counts. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { mapSource } from '../../src/formats/source/map-source.ts';
import { linesOf, type SourceTarget } from '../../src/model/source-map.ts';
import { bytesOf, read, readAsOpened, readInPieces, told } from './read-in-pieces.ts';

const KEYS = 'extrapolate constant linear\nkeys 2 {\n0 1 flat flat\n1 2 smooth 3\n}\n}\n';

/** Small files; `§` is a head without its index: the keyword of a block, its name if it has one, and its brace. */
const FILES: readonly (readonly [name: string, text: string])[] = [
  ['x.anim', `§animation {\nrange 0 1\nnumchannels 3\n§channel {\n${KEYS}§channel{\n${KEYS}§channel\t{\n${KEYS}}\n`],
  [
    'x.skin',
    'positions 1 {\n0 0 0\n}\nnormals 1 {\n0 0 1\n}\n§material cloth {\ncolor 1 0 0\n}\ntriangles 1 {\n0 0 0\n}\n' +
      `bindings 2 {\n${'§matrix {\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n}\n'.repeat(2)}}\nskinweights 1 {\n1 0 1\n}\n`,
  ],
  [
    'x.skel',
    '§balljoint hips {\noffset 0 1 0\n§balljoint knee{\npose 0 0 0\n}\n§hingejoint toe {\noffset 1 0 0\naxis 0 1 0\n}\n}\n',
  ],
  ['x.rig', '§rig wasp {\nskeleton a.skel\nmorphs 1 {\nb.morph\n}\n}\n'],
];

/** The file with what its heads get, by how many heads of the same keyword were before. */
function withHeads(text: string, put: (head: string, index: number) => string): string {
  const counts = new Map<string, number>();
  return text.replace(/§([^\n]*)/g, (_, head: string) => {
    const keyword = head.split(/[\s{]/, 1)[0].replace(/^(ball|hinge)joint$/, 'joint');
    const index = counts.get(keyword) ?? 0;
    counts.set(keyword, index + 1);
    return put(head, index);
  });
}

const plain = (text: string) => withHeads(text, (head) => head);
const beforeBrace = (extra: string) => (head: string) => head.replace(/\s*\{/, ` ${extra}{`);
const numbered =
  (shift = 0) =>
  (head: string, index: number) =>
    beforeBrace(`${index + shift}`)(head);

describe('numbers between the keyword of a block and its brace', () => {
  it.each(FILES)('%s: an index costs nothing, and nothing is said of it', (name, text) => {
    const expected = read(name, bytesOf(plain(text)));
    expect(expected.diagnostics).toEqual([]);
    expect(read(name, bytesOf(withHeads(text, numbered())))).toEqual(expected);
    for (const lineEnd of ['\r', '\r\n', '\r\r\n']) {
      const other = withHeads(text, numbered()).replaceAll('\n', lineEnd);
      expect(read(name, bytesOf(other))).toEqual(expected);
    }
  });

  it.each(FILES)(
    '%s: right behind the keyword, an index or count costs nothing, and nothing is said of it',
    (name, text) => {
      const glued = (head: string, index: number) => head.replace(/^\w+/, (keyword) => `${keyword}${index}`);
      const counted = withHeads(text, glued).replace(/^(keys|positions|bindings) (?=\d)/gm, '$1');
      const expected = read(name, bytesOf(withHeads(text, numbered())));
      const found = read(name, bytesOf(counted));
      expect(found).toEqual(expected);
      expect(
        readInPieces(
          name,
          bytesOf(counted),
          Array.from(counted, (_, i) => i),
        ),
      ).toEqual(expected);
    },
  );

  it.each(FILES)('%s: a number that is not the index is one warning for a keyword, and no more', (name, text) => {
    const { value, diagnostics } = readAsOpened(name, withHeads(text, numbered(1)));
    expect(value).toEqual(read(name, bytesOf(plain(text))).value);
    expect(diagnostics.length).toBeGreaterThan(0);
    for (const { severity, code, assumed } of diagnostics) {
      expect([severity, code, assumed]).toEqual(['warning', 'index-mismatch', 'read in the order of the file']);
    }
    expect(new Set(diagnostics.map(({ message }) => message.split(/ as the number of this |,/)[1])).size).toBe(
      diagnostics.length,
    );
  });

  it.each(FILES)('%s: a fraction is an error there', (name, text) => {
    const heads = text.split('§').length - 1;
    for (let wrong = 0; wrong < heads; wrong++) {
      let at = 0;
      const put = (head: string, index: number) => beforeBrace(at++ === wrong ? '1.5' : `${index}`)(head);
      const { value, diagnostics } = readAsOpened(name, withHeads(text, put));
      expect(value).toBeUndefined();
      expect(diagnostics.map(({ code }) => code)).toEqual(['index-fractional']);
      const [{ excerpt }] = diagnostics;
      expect(excerpt?.text.slice(excerpt.caret)).toMatch(/^1\.5/);
    }
  });

  it.each(FILES)('%s: a word is a warning there, is skipped, and costs nothing', (name, text) => {
    for (const word of ['hip_tx', '#1', '1:', '0 // first', '3,5', 'infinite']) {
      const { value, diagnostics } = readAsOpened(name, withHeads(text, beforeBrace(word)));
      expect(value, word).toEqual(read(name, bytesOf(plain(text))).value);
      const words = diagnostics.filter(({ code }) => code !== 'index-mismatch');
      expect(words.length, word).toBeGreaterThan(0);
      for (const { severity, code, excerpt } of words) {
        expect([severity, code]).toEqual(['warning', 'name-unexpected']);
        expect(excerpt?.text.slice(excerpt.caret)).toMatch(/^(hip_tx|#1|1:|\/\/|3,5|infinite)/);
      }
    }
  });

  it('an index may also be before a name, and a number alone is the name', () => {
    const { value, diagnostics } = read(
      'x.skel',
      bytesOf('balljoint 0 hips {\nballjoint 7 knee {\n}\nballjoint 2 {\n}\n}'),
    );
    expect(told({ diagnostics })).toEqual(['warning index-mismatch 2:11']);
    const names = value?.kind === 'skel' && value.skeletons[0].joints.map((joint) => joint.name);
    expect(names).toEqual(['hips', 'knee', '2']);
  });

  it('names beside a count are skipped with one warning for the keyword', () => {
    const text = `animation {\nrange 0 1\n${KEYS.replace('extra', 'channel {\nextra').replace('keys 2', 'keys tx 2 keys of')}}`;
    const { value, diagnostics } = readAsOpened('x.anim', text.replace(' keys of', ' of it'));
    expect(told({ diagnostics })).toEqual(['warning name-unexpected 5:6']);
    expect(value?.kind === 'anim' && value.take.channels).toHaveLength(1);
  });

  it('channels of another keyword are told on their lines, and no braces, which agree', () => {
    const channel = (c: number) =>
      `\tchan${c} {\n\t\textrapolate constant constant\n\t\tkeys 2 {\n\t\t\t0 ${c} linear linear\n\t\t\t1 2 linear linear\n\t\t}\n\t}\n`;
    const text = `animation {\n\trange 0 1\n\tnumchannels 3\n${[0, 1, 2].map(channel).join('')}}\n`;
    const { diagnostics } = readAsOpened('x.anim', text);
    expect(told({ diagnostics })).toContain('error keyword-unknown 4:2');
    expect(diagnostics.map(({ code }) => code)).not.toContain('brace-missing');
  });

  it('a channel without its brace is still told on its line', () => {
    const text = withHeads(FILES[0][1], numbered()).replace('channel 1{', 'channel 1');
    const { value, diagnostics } = readAsOpened('x.anim', text);
    expect(value).toBeUndefined();
    expect(told({ diagnostics })).toEqual(['error brace-missing 11:9']);
  });

  it.each(FILES)('%s: reads the same in pieces', (name, text) => {
    const extras = fc.array(fc.constantFrom('0', '1', '2', '-1', '1.5', 'tx', 'keys', '#', '\n', '\r', ' '), {
      maxLength: 3,
    });
    const property = fc.property(
      fc.array(extras, { minLength: 8, maxLength: 8 }),
      fc.array(fc.nat(400)),
      (heads, at) => {
        let head = 0;
        const put = withHeads(text, (each) => beforeBrace(heads[head++ % 8].join(' '))(each));
        const bytes = bytesOf(put);
        const cuts = at.map((cut) => cut % (bytes.length + 1));
        expect(readInPieces(name, bytes, cuts)).toEqual(read(name, bytes));
        const each = Array.from(bytes.keys());
        expect(readInPieces(name, bytes, each)).toEqual(read(name, bytes));
      },
    );
    fc.assert(property, { numRuns: 60 });
  });
});

describe('the lines of numbered and named blocks', () => {
  const targets: Readonly<Record<string, readonly SourceTarget[]>> = {
    'x.anim': [
      { kind: 'channel', channel: 2 },
      { kind: 'key', channel: 1, key: 1 },
    ],
    'x.skin': [
      { kind: 'binding', joint: 1 },
      { kind: 'vertex', vertex: 0 },
      { kind: 'triangle', triangle: 0 },
    ],
    'x.skel': [0, 1, 2].map((joint) => ({ kind: 'joint', root: 0, joint })),
  };

  it.each(FILES.slice(0, 3))('%s: parts are on the lines where they are without numbers', (name, text) => {
    const map = mapSource(bytesOf(plain(text)), name);
    for (const put of [numbered(), numbered(1), beforeBrace('positions 3 channel'), beforeBrace('0 keys')]) {
      const other = mapSource(bytesOf(withHeads(text, put)), name);
      for (const target of targets[name]) {
        expect(linesOf(map, target).length).toBeGreaterThan(0);
        expect(linesOf(other, target)).toEqual(linesOf(map, target));
      }
    }
  });
});
