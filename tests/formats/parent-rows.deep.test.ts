/** `.skel` of other courses: `x y z parent` on each line. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { beginsParents, PARENTS_HEAD_BYTES } from '../../src/formats/skel/read-parents.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { mapSource } from '../../src/formats/source/map-source.ts';
import { targetAt } from '../../src/model/source-map.ts';
import { expectLinearTime } from '../helpers/growth.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';
import { bytesOf, read, readAsOpened, readInPieces } from './read-in-pieces.ts';
import { ALL_FILES, fileBytes } from './shared-files.ts';

const ROWS = ['0.5 0.75 0.5 -1', '0 -0.14 -0.04 0', '0 -0.2 0.05 1', '-0.1 -0.02 0 0'];
const TEXT = `${ROWS.join('\n')}\n`;

/** Names, parents and offsets. */
function treeOf(text: string) {
  const { value, diagnostics } = readAsOpened('x.skel', text);
  const skeletons = value?.kind === 'skel' ? value.skeletons : [];
  const joints = skeletons.flatMap((skeleton) => skeleton.joints);
  return {
    roots: skeletons.length,
    names: joints.map(({ name }) => name),
    parents: joints.map(({ parent }) => parent),
    offsets: joints.map(({ offset }) => offset),
    told: diagnostics.map(({ severity, code, line, column }) => `${severity} ${code} ${line}:${column}`),
  };
}

const OFFSETS = ROWS.map((row) => row.split(' ').slice(0, 3).map(Number));
const PLAIN = { roots: 1, parents: [-1, 0, 1, 0], offsets: OFFSETS };

describe('reading x y z parent', () => {
  it('is a tree of ball joints at their offsets, and says so', () => {
    expect(treeOf(TEXT)).toEqual({ ...PLAIN, names: ['', '', '', ''], told: ['info parent-rows 1:1'] });
    const { value } = readSkel(TEXT, 'arm.skel');
    expect(value?.[0].joints[1].motion).toEqual({ kind: 'ball', order: 'xyz' });
    expect(value?.[0].name).toBe('arm');
  });

  it.each([
    ['a count', `4\n${TEXT}`],
    ['commas', TEXT.replaceAll(' ', ', ')],
    ['commas alone, and CR LF', TEXT.replaceAll(' ', ',').replaceAll('\n', '\r\n')],
    ['an index', ROWS.map((row, i) => `${i} ${row}`).join('\r')],
    [
      'an index from 1',
      ROWS.map(
        (row, i) =>
          `${i + 1}\t${row.replace(/(\d)$/, (p) => `${p === '1' && i === 0 ? 1 : Number(p) + 1}`).replace('-2', '-1')}`,
      ).join('\n'),
    ],
    ['comments and blank lines', `# x y z parent\n\n${ROWS.join('   // joint\n\n')} # end`],
    ['a heading', `x y z parent\n${TEXT}`],
    ['a byte-order mark', `\uFEFF${TEXT}`],
  ])('%s changes nothing', (_, text) => {
    expect(treeOf(text)).toMatchObject({ ...PLAIN, told: ['info parent-rows 1:1'] });
  });

  it('a line may have the name of its joint, first or last', () => {
    const names = ['hips', 'knee', 'toe', 'arm'];
    expect(treeOf(ROWS.map((row, i) => `${names[i]} ${row}`).join('\n'))).toMatchObject({ ...PLAIN, names });
    expect(treeOf(ROWS.map((row, i) => `${row} ${names[i]}`).join('\n'))).toMatchObject({ ...PLAIN, names });
  });

  it('joints in another order are put into that of their tree, which is said', () => {
    const found = treeOf('0 0 0 -1\n1 0 0 3\n2 0 0 0\n3 0 0 0\n4 0 0 2\n');
    expect(found.offsets.map(([x]) => x)).toEqual([0, 2, 4, 3, 1]);
    expect(found.parents).toEqual([-1, 0, 1, 0, 3]);
    expect(found.told).toEqual(['info parent-rows 1:1', 'info joints-reordered 3:1']);
  });

  it.each([
    ['last', '0 2 0 1\n0 1 0 2\n0 0 0 -1\n', [0, 1, 2]],
    ['in the middle', '0 1 0 1\n0 0 0 -1\n0 2 0 0\n', [0, 1, 2]],
    ['last, of whole numbers that six by six are none', '3 4 5 3\n1 1 1 0\n2 2 2 1\n1 0 0 -1\n', [0, 4, 1, 2]],
    ['last, with an index on each line', '0 0 2 0 1\n1 0 1 0 2\n2 0 0 0 -1\n', [0, 1, 2]],
  ])('the root may come %s', (_, text, heights) => {
    const { roots, offsets, told } = treeOf(text);
    expect([roots, offsets.map(([, y]) => y)]).toEqual([1, heights]);
    expect(told[0]).toBe('info parent-rows 1:1');
  });

  it('joints of six numbers are of the axis-angle form, wherever its lines end, with any numbers', () => {
    // Two joints, of which all lines of four end in a whole number, one in -1.
    const text = '1 0 0 1\n0 1 2 -1\n1 1 0 0\n';
    expect(beginsParents(bytesOf(text))).toBe(false);
    expect(treeOf('1 0 0 1\n0 1 1 1\n0 -1 30 0\n').told).toEqual([]);
  });

  it('several roots are skeletons of their own', () => {
    const found = treeOf('0 0 0 -1\n1 0 0 -1\n2 0 0 1\n3 0 0 0\n');
    expect(found).toMatchObject({ roots: 2, parents: [-1, 0, -1, 0] });
    expect(found.offsets.map(([x]) => x)).toEqual([0, 3, 1, 2]);
    expect(found.told).toContain('info several-roots 2:1');
  });

  it.each([
    ['1 2 0', 'error row-incomplete', 5],
    ['1 2 3 0 9', 'error row-too-long', 9],
    ['1 x2 3 0', 'error not-a-number', 3],
    ['1 nan 3 0', 'error not-a-number', 3],
    ['1 2 3 0.5', 'error index-fractional', 7],
    ['1 2 3 1e9', 'error index-out-of-range', 7],
    ['1 2 3 -2', 'error index-out-of-range', 7],
    ['1 2 3 1025', 'error index-out-of-range', 7],
    ['1 2 3 1026\n1 2 3 1025', 'error parent-cycle', 7],
  ])('%j is an error where it is wrong', (rows, expected, column) => {
    // After rows that fill what tells the form: its own index is 1025.
    const text = `0 0 0 -1\n${'0 0 0 0\n'.repeat(1024)}${rows}\n`;
    expect(text.length).toBeGreaterThan(2 * PARENTS_HEAD_BYTES - 20);
    expect(treeOf(text)).toMatchObject({ roots: 0, told: ['info parent-rows 1:1', `${expected} 1026:${column}`] });
  });

  it('an index that comes twice is an error, and so is a parent that no line has', () => {
    const rows = Array.from({ length: 600 }, (_, i) => `${i} 1 2 3 ${i === 0 ? -1 : 0}`).join('\n');
    expect(treeOf(`${rows}\n7 1 2 3 0`).told).toContain('error index-repeated 601:1');
    expect(treeOf('0 0 0 -1\n1 2 3 7\n').told).toContain('error index-out-of-range 2:7');
  });

  it('a count that is not that of the rows is a warning there', () => {
    expect(treeOf(`9\n${TEXT}`).told).toEqual(['info parent-rows 1:1', 'warning count-mismatch 1:1']);
  });

  it('the axis-angle form is read as before, however its lines are broken', () => {
    const axisAngle = ['1 0 0 -1 30 2', '1 0 1 0 45 0', '2 1 0 0 -1 0'];
    const number = axisAngle.join(' ').split(' ');
    const expected = readSkel(axisAngle.join('\n'), 'x.skel').value;
    expect(expected?.[0].form).toBe('axis-angle');
    const breaks = fc.array(fc.constantFrom(' ', ' ', ' ', '\n', '\t', '\r\n'), { minLength: 18, maxLength: 18 });
    const property = fc.property(breaks, (each) => {
      const text = number.map((word, i) => word + each[i]).join('');
      expect(readSkel(text, 'x.skel').value).toEqual(expected);
    });
    fc.assert(property);
  });

  it('reads the same in pieces, and in a time that grows with its length', () => {
    const part = fc.constantFrom(
      ...ROWS,
      '1 2 3 0',
      '-1',
      '0',
      '4',
      ',',
      '#',
      'a',
      '\n',
      '\r',
      '1.5',
      '{',
      'balljoint a {',
    );
    const property = fc.property(fc.array(part, { maxLength: 20 }), fc.array(fc.nat(300)), (parts, at) => {
      const bytes = bytesOf(`0 0 0 -1\n${parts.join('\n')}`);
      const cuts = at.map((cut) => cut % (bytes.length + 1));
      expect(readInPieces('x.skel', bytes, cuts)).toEqual(read('x.skel', bytes));
    });
    fc.assert(property, { numRuns: 150 });
    for (const row of ['1 2 3 0\n', '1 2 3 9\n', 'x\n', '1 2\n']) {
      expectLinearTime((n) => void readAsOpened('x.skel', `0 0 0 -1\n${row.repeat(n / row.length)}`), 20_000);
    }
  });

  it('the lines of its joints are found, in any order', () => {
    const map = mapSource(bytesOf('0 0 0 -1\n1 0 0 3\n2 0 0 0\n3 0 0 0\n4 0 0 2\n'), 'x.skel');
    const joints = [1, 2, 3, 4, 5].map((line) => targetAt(map, line));
    expect(joints).toEqual([0, 4, 1, 3, 2].map((joint) => ({ kind: 'joint', root: 0, joint })));
  });

  it.each(['3\n0 0 0 -1\n1 0 0 0\n2 0 0 1\n', '0 0 0 -1 hip\n1 0 0 0 leg\n'])(
    'no wrong lines are found in %j',
    (text) => {
      const map = mapSource(bytesOf(text), 'x.skel');
      expect([1, 2, 3, 4].map((line) => targetAt(map, line)?.kind)).not.toContain('joint');
    },
  );

  it('is written in the hierarchy form, which reads back the same', () => {
    const [skeleton] = readSkel(TEXT, 'x.skel').value ?? [];
    const { text, diagnostics } = writeSkel([skeleton]);
    expect(diagnostics).toEqual([]);
    expect(text).toContain('balljoint {');
    expect(readSkel(text, 'x.skel')).toEqual({ value: [skeleton], diagnostics: [] });
  });
});

describe('the files at hand', () => {
  it('are none of other courses', () => {
    for (const path of ALL_FILES) expect(beginsParents(fileBytes(path)), path).toBe(false);
    if (hasShared) expect(beginsParents(sharedBytes('data/field/parent-index.skel'))).toBe(true);
  });
});
