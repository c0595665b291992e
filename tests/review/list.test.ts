/** Lists of takes, as CSV and as JSON, there and back; and as spreadsheets and people write them. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { NO_REVIEW, tagsOf, VERDICTS } from '../../src/model/takes/review.ts';
import type { Flag } from '../../src/review/flags.ts';
import { type ListedTake, listedTake } from '../../src/review/list.ts';
import { isTakeList, readList } from '../../src/review/read-list.ts';
import { listAsCsv, listAsJson } from '../../src/review/write-list.ts';

const TEXT = fc.oneof(
  fc.string({ unit: 'grapheme' }),
  fc.constantFrom('=1+1', "'=a", '-2', '+x', '@SUM', '"', 'a;b', 'a,b', 'two\nlines', 'a\r\nb', "'", ' =1', '\t'),
);
const PATH = TEXT.map((text) => text.replaceAll('\\', '/').trim()).filter((text) => text !== '');
const TAGS = fc.array(TEXT).map((texts) => tagsOf(texts.join(';')));

const TAKE: fc.Arbitrary<ListedTake> = fc.record(
  {
    path: PATH,
    verdict: fc.constantFrom(...VERDICTS, '' as const),
    stars: fc.integer({ min: 0, max: 5 }),
    tags: TAGS,
    notes: TEXT,
    frames: fc.nat(),
    fps: fc.double({ min: 1, max: 1000, noNaN: true }),
    seconds: fc.double({ min: 0, max: 1000, noNaN: true }).map((s) => s || 0),
    joints: fc.nat(),
    worst: fc.double({ min: 0, max: 1000, noNaN: true }).map((s) => s || 0),
    unit: fc.constantFrom('m', 's', 'frames', 'deg'),
    kind: fc.constantFrom('spike', 'limit'),
    flags: fc.array(fc.constantFrom('spike 1.2 LeftHand', 'slide 2-2.5 RightFoot')),
  },
  { requiredKeys: ['path', 'verdict', 'stars', 'tags', 'notes'] },
);
const TAKES = fc.uniqueArray(TAKE, { selector: ({ path }) => path, minLength: 1, maxLength: 8 });

describe('a list of takes', () => {
  it('written as CSV and read again is the same list', () => {
    fc.assert(
      fc.property(TAKES, (takes) => {
        const { takes: read, diagnostics } = readList(listAsCsv(takes), 'list.csv');
        expect(diagnostics).toEqual([]);
        // A cell without flags is one of a take that was not checked, as far as a table can say.
        expect(read).toEqual(takes.map((take) => withoutEmptyFlags(take)));
      }),
    );
  });

  it('written as JSON and read again is the same list', () => {
    fc.assert(
      fc.property(TAKES, (takes) => {
        const { takes: read, diagnostics } = readList(listAsJson(takes), 'list.json');
        expect(diagnostics).toEqual([]);
        expect(read).toEqual(takes);
      }),
    );
  });

  it('has no cell that a spreadsheet would run', () => {
    fc.assert(
      fc.property(TAKES, (takes) => {
        const cells = takes.flatMap(({ path, notes, tags }) => [path, notes, tags.join('; ')]);
        const text = listAsCsv(takes);
        for (const cell of cells) {
          if (/^\s*[=+\-@]/.test(cell)) expect(text).toContain(`'${cell.replaceAll('"', '""')}`);
        }
      }),
    );
    expect(listAsCsv([{ path: '=cmd|A1.bvh', verdict: 'bad', stars: 0, tags: [], notes: '@x' }])).toBe(
      "path,verdict,stars,tags,notes,frames,fps,seconds,joints,worst,unit,kind,flags\r\n'=cmd|A1.bvh,bad,,,'@x,,,,,,,,\r\n",
    );
  });

  it('states how large the worst flag of a take is, whatever kinds its flags are of', () => {
    const flag = (kind: Flag['kind'], amount: number): Flag => ({ kind, from: 1, to: 1, amount });
    const worst = (...flags: Flag[]) => {
      const made = listedTake('a', NO_REVIEW, { frames: 1, fps: 30, seconds: 0, joints: 1, flags });
      return [made.worst, made.unit, made.kind];
    };
    expect(worst(flag('spike', 0.05), flag('spike', 0.3126), flag('slide', 0.4))).toEqual([0.313, 'm', 'spike']);
    expect(worst(flag('limit', (Math.PI * 170) / 180), flag('jitter', 0.006))).toEqual([170, 'deg', 'limit']);
    expect(worst(flag('frozen', 2.5), flag('duplicate', 3))).toEqual([2.5, 's', 'frozen']);
    expect(worst(flag('duplicate', 30))).toEqual([30, 'frames', 'duplicate']);
    expect(worst()).toEqual([undefined, undefined, undefined]);
  });

  it('of plain paths, one a line, is read', () => {
    const { takes } = readList('\ufeffa/walk.bvh\r\n\r\n  b/two words, one comma.bvh\n', 'list.txt');
    expect(takes.map(({ path }) => path)).toEqual(['a/walk.bvh', 'b/two words, one comma.bvh']);
  });

  it('saved by a spreadsheet, with semicolons, decimal commas and columns of its own, is read', () => {
    const text = 'Comment;Stars;Path;FPS;Verdict\r\nok;4;C\\takes\\a.bvh;29,97;GOOD\r\n;;b.bvh;;\r\n';
    const { takes, diagnostics } = readList(text, 'list.csv');
    expect(diagnostics).toEqual([]);
    expect(takes[0]).toEqual({ path: 'C/takes/a.bvh', verdict: 'good', stars: 4, tags: [], notes: '', fps: 29.97 });
    expect(takes[1].path).toBe('b.bvh');
  });

  it('says at which line a verdict or the stars are unknown, and goes on', () => {
    const { takes, diagnostics } = readList('path,verdict,stars\na,"maybe\nnot",9\nb,bad,\n', 'list.csv');
    expect(takes.map(({ verdict, stars }) => [verdict, stars])).toEqual([
      ['', 0],
      ['bad', 0],
    ]);
    expect(diagnostics.map(({ code, line, severity }) => [code, line, severity])).toEqual([
      ['verdict-unknown', 2, 'warning'],
      ['stars-expected', 2, 'warning'],
    ]);
    expect(readList('path,verdict\n\n\nb,no\n', 'x.csv').diagnostics.map(({ line }) => line)).toEqual([4]);
  });

  it.each([
    ['nothing', '', 'list-empty'],
    ['a heading alone', 'path,verdict\n', 'list-empty'],
    ['a quote that nothing closes', 'path\n"a\nb\n', 'quote-unclosed'],
    ['broken JSON', '[{"path": ', 'json-expected'],
    ['a JSON object', '{"path": "a"}', 'list-expected'],
    ['numbers in JSON', '[1, 2]', 'take-expected'],
  ])('with %s is an error', (_, text, code) => {
    const { takes, diagnostics } = readList(text, 'list');
    expect(takes).toEqual([]);
    expect(diagnostics.map((d) => [d.code, d.severity])).toContainEqual([code, 'error']);
  });

  it('that names a take twice says so, and its last row counts', () => {
    const { takes, diagnostics } = readList('path,verdict\na,good\nb,\na,bad\n', 'list.csv');
    expect(takes.map(({ path, verdict }) => `${path} ${verdict}`)).toEqual(['b ', 'a bad']);
    expect(diagnostics.map(({ code, line }) => [code, line])).toEqual([['path-repeated', 4]]);
  });

  it.each([
    ['plain paths', 'a\r\n\r\r\nb\rc\n\na', 6],
    ['a table', 'path\r\na\r\r\nb\r\na', 4],
  ])('of %s says in which line a path comes a second time', (_, text, line) => {
    expect(readList(text, 'list.csv').diagnostics.map((each) => [each.code, each.line])).toEqual([
      ['path-repeated', line],
    ]);
  });

  it.each([
    ['warnings', 'a\n'.repeat(5001), 1],
    ['errors', `[${'1,'.repeat(4999)}1]`, 0],
  ])('keeps a hundred %s and counts the others', (what, text, takes) => {
    const read = readList(text, 'list');
    expect(read.takes).toHaveLength(takes);
    expect(read.diagnostics).toHaveLength(101);
    expect(read.diagnostics.at(-1)).toMatchObject({ code: `more-${what}`, message: `And 4900 more ${what}.` });
  });

  it('has columns as far as spreadsheets do', () => {
    const read = (cells: number) => readList(`${','.repeat(cells)}path\n${','.repeat(cells)}a`, 'list.csv').takes;
    expect(read(16_383)).toHaveLength(1);
    expect(isTakeList(`${','.repeat(16_384)}path\n`)).toBe(false);
  });

  it('is told from other tables and JSON by its columns', () => {
    expect(isTakeList('path,verdict\n')).toBe(true);
    expect(isTakeList('Verdict;"Path"\r\n')).toBe(true);
    expect(isTakeList(listAsJson([{ path: 'a', verdict: '', stars: 0, tags: [], notes: '' }]))).toBe(true);
    expect(isTakeList('time,x,y\n0,1,2\n')).toBe(false);
    expect(isTakeList('[[1, 2], [3, 4]]')).toBe(false);
  });
});

function withoutEmptyFlags({ flags, ...take }: ListedTake): ListedTake {
  return flags?.length ? { ...take, flags } : take;
}
