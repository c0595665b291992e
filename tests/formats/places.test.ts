import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bytesOf, read, readInPieces, told } from './read-in-pieces.ts';

/** Where a file's only unknown keyword `?` is said to be. */
function placeOf(text: string): string {
  const { diagnostics } = read('x.skel', `balljoint root {${text}`);
  return diagnostics
    .filter((d) => d.code === 'keyword-unknown')
    .map((d) => `${d.line}:${d.column}`)
    .join();
}

describe('lines and columns', () => {
  it('lines and columns begin at 1', () => {
    expect(told(read('x.skel', '? \nballjoint x {}'))).toEqual(['warning keyword-unknown 1:1']);
  });

  it.each([
    ['LF', '\n', '2:3'],
    ['CR LF', '\r\n', '2:3'],
    ['CR CR LF, as dragon.skel has', '\r\r\n', '2:3'],
    ['many CRs and an LF', '\r\r\r\r\n', '2:3'],
    ['a lone CR', '\r', '2:3'],
    ['two lone CRs', '\r\r', '3:3'],
    ['LF CR', '\n\r', '3:3'],
    ['LF LF', '\n\n', '3:3'],
    ['CR LF CR', '\r\n\r', '3:3'],
  ])('%s is counted as a line end', (_, end, place) => {
    expect(placeOf(`${end}\t ?\n}`)).toBe(place);
  });

  it('count characters, not bytes, and a byte-order mark at the start not at all', () => {
    expect(told(read('x.skel', '\uFEFF?\nballjoint x {}'))).toEqual(['warning keyword-unknown 1:1']);
    expect(told(read('x.skel', 'balljoint äöü骨\u{1F9B4} { ?\n}'))).toEqual(['warning keyword-unknown 1:19']);
  });

  it('lines and columns are right after a block of numbers, whatever its line ends', () => {
    for (const end of ['\n', '\r\n', '\r\r\n', '\r']) {
      const rows = Array.from({ length: 3000 }, (_, i) => `\t${i} 0.5 -1`).join(end);
      const { diagnostics } = read('x.skin', `positions 3000 {${end}${rows}${end}} ?${end}`);
      expect(diagnostics.find((d) => d.code === 'keyword-unknown')).toMatchObject({ line: 3002, column: 3 });
    }
  });

  it('lines and columns are right for a number inside a block of many lines', () => {
    const rows = Array.from({ length: 5000 }, (_, i) => `  0 1 ${i === 4321 ? 7 : 2}`).join('\n');
    const { diagnostics } = read('x.skin', `positions 3 { 0 0 0 1 0 0 0 1 0 }\ntriangles 5000 {\n${rows}\n}`);
    expect(diagnostics.find((d) => d.severity === 'error')).toMatchObject({ line: 4324, column: 7 });
  });
});

describe('the place of anything', () => {
  it('equals counting in the text, whatever precedes it and however it is cut', () => {
    const filler = fc.constantFrom('\n', '\r', '\r\n', '\r\r\n', ' ', '\t', '1 ', '0.25\n', ' 3\r\n', '-7\r');
    const block = fc.array(filler, { maxLength: 400 }).map((parts) => ` ${parts.join('')} `);
    const name = fc.constantFrom('a', 'ü', '骨', '\u{1F9B4}');
    const property = fc.property(
      name,
      block,
      block,
      fc.array(fc.nat(1500), { maxLength: 8 }),
      (a, before, after, at) => {
        const text = `${a} {} positions 0 {${before}x${after}}`;
        const bytes = bytesOf(text);
        const { diagnostics } = readInPieces(
          'x.skin',
          bytes,
          at.filter((c) => c <= bytes.length),
        );
        const lines = text.slice(0, text.indexOf('x', text.indexOf('{', 5))).split(/\r*\n|\r/);
        const [line, column] = [lines.length, [...(lines.at(-1) ?? '')].length + 1];
        expect(diagnostics.find((d) => d.code === 'not-a-number')).toMatchObject({ line, column });
      },
    );
    fc.assert(property, { numRuns: 500 });
  });
});

describe('excerpts', () => {
  it('show the offending line and where in it', () => {
    const { diagnostics } = read('x.skel', 'balljoint root {\n\toffset 0 1,5 0\r\n}');
    expect(diagnostics[0].excerpt).toEqual({ text: '\toffset 0 1,5 0', caret: 10 });
  });

  it('cut a long line to 200 characters around the caret', () => {
    const text = `balljoint x { ${'é'.repeat(500)} offset 0 nan 0 ${'é'.repeat(500)} }`;
    const { diagnostics } = read('x.skel', text.replace('é ', ' { } '));
    const excerpt = diagnostics.find((d) => d.code === 'not-a-number')?.excerpt;
    expect(excerpt?.text).toHaveLength(200);
    expect(excerpt?.text.slice(excerpt.caret)).toMatch(/^nan 0 é+$/);
    expect(excerpt?.caret).toBe(100);
  });

  it('excerpts end with the file', () => {
    const { diagnostics } = read('x.skel', 'balljoint x { offset 0 nan');
    expect(diagnostics.map((d) => d.excerpt)).toEqual([
      { text: 'balljoint x { offset 0 nan', caret: 23 },
      { text: 'balljoint x { offset 0 nan', caret: 26 },
      { text: 'balljoint x { offset 0 nan', caret: 26 },
    ]);
  });
});

describe('a report', () => {
  it('folds equal unknown keywords into one warning with a count', () => {
    const { value, diagnostics } = read(
      'x.skel',
      `balljoint x {${'\n orient 1 2 3'.repeat(30)}\n Orient {\n } \n mass 2\n}`,
    );
    expect(value).toBeDefined();
    expect(diagnostics).toMatchObject([
      { severity: 'warning', code: 'keyword-unknown', line: 2 },
      { severity: 'warning', code: 'keyword-unknown', line: 34 },
    ]);
    expect(diagnostics[0].message).toContain('31 times');
  });

  it('a report keeps 100 warnings and counts the rest', () => {
    const joints = '\nballjoint x { rotxlimit 1 0 }'.repeat(250);
    const { value, diagnostics } = read('x.skel', `balljoint root {${joints}\n}`);
    expect(value).toBeDefined();
    expect(diagnostics).toHaveLength(101);
    expect(diagnostics[100]).toMatchObject({ severity: 'warning', code: 'more-warnings', line: 0 });
    expect(diagnostics[100].message).toContain('150');
  });

  it('a report keeps 100 errors and counts the rest, quickly', () => {
    const { value, diagnostics } = read('x.skin', `positions 1 { ${'0,5 '.repeat(300000)} }`);
    expect(value).toBeUndefined();
    expect(diagnostics.filter((d) => d.severity === 'error')).toHaveLength(101);
    expect(diagnostics.at(-1)?.message).toContain('299900');
  });
});
