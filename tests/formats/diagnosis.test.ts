import { describe, expect, it } from 'vitest';
import { diagnose, isWorthDiagnosing } from '../../src/formats/diagnose/diagnose.ts';
import { foldUnreadable } from '../../src/formats/diagnose/fold.ts';
import { TEXT_LAYOUTS } from '../../src/formats/diagnose/layouts.ts';
import { readWhole } from '../../src/formats/reader.ts';
import { skinReader } from '../../src/formats/skin/read.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { read, readAsOpened, told } from './read-in-pieces.ts';

/** Lines with one replaced; undefined removes it. */
function withLine(text: string, line: number, change: (line: string) => string | undefined): string {
  const lines = text.split('\n');
  const changed = change(lines[line - 1]);
  lines.splice(line - 1, 1, ...(changed === undefined ? [] : [changed]));
  return lines.join('\n');
}

const withoutWord = (index: number) => (line: string) => {
  let at = -1;
  return line.replace(/\S+/g, (word) => (++at === index ? '' : word));
};

const JOINT = (name: string) => `\tballjoint ${name} {\n\t\toffset 0 1 0\n\t\tpose 0 0 0\n\t}\n`;
const SKEL = `balljoint root {\n\toffset 0 0 0\n${['a', 'b', 'c', 'd'].map(JOINT).join('')}}\n`;

/** How often a `.skin` is read to find where its problems are. */
function readings(text: string): number {
  const bytes = new TextEncoder().encode(text);
  let made = 0;
  const reader = () => {
    made++;
    return skinReader('x.skin');
  };
  diagnose(bytes, readWhole(reader(), bytes).diagnostics, TEXT_LAYOUTS.skin, reader);
  return made;
}

it('a file of which nearly every word is a problem is read again a few times only', () => {
  const head = 'positions 3 {\n0 0 0\n1 0 0\n0 1 0\n}\n';
  expect(readings(`${head}${'}'.repeat(50_000)}`)).toBeLessThan(12);
  expect(readings(`${head}${'skinweights 1e154 {\n'.repeat(5000)}`)).toBeLessThan(12);
  expect(readings(`${head.replace('}\n', '')}triangles 1 {\n0 1 2\n}\n`)).toBeGreaterThan(1);
});

describeShared('values that are not numbers', () => {
  const take = new TextDecoder().decode(sharedBytes('data/bvh/boxing-extra-line.bvh'));
  const broken = (lines: number) => {
    const rows = take.split('\n');
    for (let i = 0; i < lines; i++) rows[133 + 20 * i] = rows[133 + 20 * i].replace(/^ *\S+/, 'NaN');
    return readAsOpened('take.bvh', rows.join('\n')).diagnostics.filter(({ severity }) => severity === 'error');
  };

  it('a few of them are told each on its line', () => {
    const few = broken(3);
    expect(few.map(({ line }) => line)).toEqual([134, 154, 174]);
    expect(foldUnreadable(few)).toEqual(few);
  });

  it('many of them are one message, which names the lines', () => {
    const all = broken(42);
    expect(all.map(({ line }) => line)).toEqual(Array.from({ length: 42 }, (_, i) => 134 + 20 * i));
    expect(foldUnreadable(all)).toMatchObject([
      {
        line: 134,
        message:
          'Expected a value of a channel, found "NaN", which is not a number. ' +
          'There are more on lines 154, 174, 194, 214, 234 and 36 more.',
      },
    ]);
    const folded = foldUnreadable(all);
    expect(foldUnreadable(folded)).toEqual(folded);
  });
});

describeShared('where the error of a real file is', () => {
  const wasp = new TextDecoder().decode(sharedBytes('data/cse169/wasp.skin'));

  it('a missing position on line 51 of the wasp’s skin is told there, and nothing else', () => {
    const text = withLine(wasp, 51, withoutWord(1));
    // Alone, the reader notices far below.
    expect(told(read('wasp.skin', text))[0]).toMatch(/ 69\d:/);
    const { diagnostics } = readAsOpened('wasp.skin', text);
    expect(told({ diagnostics })).toEqual(['error row-incomplete 51:25']);
    expect(diagnostics[0]).toMatchObject({
      message: 'Expected 3 numbers in this row of positions, as in neighbouring rows, found 2.',
      excerpt: { text: '      0.157529          1.299800' },
    });
  });

  it('a missing weight on line 1694 is told there, and nothing else', () => {
    const text = withLine(wasp, 1694, withoutWord(2));
    expect(told(read('wasp.skin', text)).length).toBeGreaterThan(3);
    expect(told(readAsOpened('wasp.skin', text))).toEqual(['error row-incomplete 1694:5']);
  });

  it('errors in several blocks, and several of one block, are told each at its place', () => {
    let text = withLine(wasp, 51, withoutWord(1));
    text = withLine(text, 60, withoutWord(0));
    text = withLine(text, 800, (line) => `${line} 7`);
    text = withLine(text, 1694, withoutWord(2));
    const { diagnostics } = readAsOpened('wasp.skin', text);
    expect(diagnostics.map(({ line }) => line)).toEqual([51, 60, 800, 1694]);
  });

  it('a lost } on line 27 of a skeleton is told on the line before', () => {
    const skel = new TextDecoder().decode(sharedBytes('data/cse169/wasp.skel'));
    expect(skel.split('\n')[26].trim()).toBe('}');
    const { diagnostics } = readAsOpened(
      'wasp.skel',
      withLine(skel, 27, () => undefined),
    );
    expect(diagnostics.map(({ line, code }) => [line, code])).toEqual([[26, 'brace-missing']]);
    expect(diagnostics[0].message).toContain('before line 27');
  });

  it('a row of weights without its last number is told on its own line, not on the next', () => {
    const { diagnostics } = readAsOpened('x.skin', sharedBytes('data/malformed/weights-missing-number.skin'));
    expect(diagnostics).toMatchObject([{ line: 13, code: 'row-incomplete' }]);
    expect(diagnostics[0].message).not.toContain('look there');
  });
});

/** Without remarks. */
const problems = (fileName: string, text: string) =>
  told(readAsOpened(fileName, text)).filter((line) => !line.startsWith('info'));

describe('where the error is', () => {
  it.each([
    ['a number missing at the end of a line', 4, withoutWord(3), 'error number-expected 4:12'],
    ['a word in place of a number', 4, (line: string) => line.replace('1', 'one'), 'error not-a-number 4:12'],
    ['a missing {', 3, (line: string) => line.replace(' {', ''), 'error brace-missing 3:12'],
    ['a { in place of a number', 4, (line: string) => line.replace('1', '{'), 'error number-expected 4:12'],
    ['a } in place of a number', 4, (line: string) => line.replace('1', '}'), 'error number-expected 4:12'],
    ['a } at the end of a line', 4, (line: string) => `${line} }`, 'warning brace-unexpected 4:16'],
    ['a keyword at the end of a line', 4, (line: string) => `${line} balljoint`, 'error keyword-unexpected 4:16'],
    ['a word in place of a }', 6, () => '\tfoo', 'error keyword-unknown 6:2'],
    ['a missing }', 6, () => '', 'error brace-missing 5:12'],
    ['a second name', 3, (line: string) => line.replace(' a', ' a b'), 'warning name-unexpected 3:14'],
  ])('%s is told there, and nothing else', (_, line, change, expected) => {
    expect(problems('x.skel', withLine(SKEL, line, change))).toEqual([expected]);
  });

  it('a } too many leaves a file loaded, so it is a warning that says what was assumed', () => {
    const { value, diagnostics } = readAsOpened(
      'x.skel',
      withLine(SKEL, 4, (line) => `${line} }`),
    );
    expect(value).toBeDefined();
    expect(diagnostics.filter(({ severity }) => severity !== 'info')).toMatchObject([
      { severity: 'warning', assumed: expect.any(String) },
    ]);
  });

  it('of several errors on a line, the first is told', () => {
    const text = withLine(SKEL, 4, () => '\t\toffset 0,5 1,5 2,5');
    expect(told(read('x.skel', text))).toHaveLength(3);
    expect(problems('x.skel', text)).toEqual(['error not-a-number 4:10']);
  });

  it('errors that are where they are told stay as they are', () => {
    let text = withLine(SKEL, 4, (line) => line.replace('1', '1,5'));
    text = withLine(text, 12, (line) => line.replace('1', 'nan'));
    expect(readAsOpened('x.skel', text)).toEqual(read('x.skel', text));
  });

  it('rows that are broken over lines are no shorter than others', () => {
    const text = 'positions 4 {\n0 0 0 1\n0 0 0 1\n0 0 0 x\n}\ntriangles 1 {\n0 1 2\n}\n';
    expect(problems('x.skin', text)).toEqual(['error not-a-number 4:7']);
  });

  it('a file without indentation is told of at its end, as by its reader', () => {
    const text = SKEL.replaceAll('\t', '').replace('}\nballjoint b', 'balljoint b');
    const [{ message }] = readAsOpened('x.skel', text).diagnostics;
    expect(message).toBe(read('x.skel', text).diagnostics[0].message);
    expect(problems('x.skel', text)).toEqual(['error brace-missing 18:1']);
  });

  it('blanks and tabs may be mixed', () => {
    const text = withLine(SKEL, 6, () => '').replaceAll('\t\toffset', '        offset');
    expect(problems('x.skel', text)).toEqual(['error brace-missing 5:12']);
  });

  it('line ends of CR CR LF, as in the course’s files, count as one', () => {
    const text = withLine(SKEL, 6, () => '').replaceAll('\n', '\r\r\n');
    expect(problems('x.skel', text)).toEqual(['error brace-missing 5:12']);
  });

  it('numbers lost in two rows of a block are told on both', () => {
    const rows = Array.from({ length: 9 }, (_, i) => `${i} 0 ${i}`);
    rows[2] = '2 0';
    rows[6] = '6 6';
    expect(problems('x.skin', `positions 9 {\n${rows.join('\n')}\n}\n`)).toEqual([
      'error row-incomplete 4:3',
      'error row-incomplete 8:3',
    ]);
  });

  it('a byte-order mark does not shift columns', () => {
    const line = '\uFEFFballjoint a { offset 0 1 }';
    expect(told(readAsOpened('x.skel', line))).toEqual(['error number-expected 1:26']);
  });
});

describe('a second reading', () => {
  it('is worth it for errors and for warnings about structure, and not for files that are right or too large', () => {
    const worth = (text: string, length = text.length) => isWorthDiagnosing(read('x.skel', text).diagnostics, length);
    expect(worth(SKEL)).toBe(false);
    expect(worth(SKEL.replace('offset 0 0 0', 'offset 0 0'))).toBe(true);
    expect(worth(SKEL.replace('offset 0 0 0', 'mass 2'))).toBe(true);
    expect(worth(SKEL.replace('offset 0 0 0', 'mass 2'), 1e8)).toBe(false);
    expect(worth(SKEL.replace('offset 0 0 0', 'rotxlimit 1 0'))).toBe(false);
    expect(worth(SKEL.replace('offset 0 0 0', 'offset 0 0'), 1e9)).toBe(false);
  });
});

describe('a brace too many, or one too few', () => {
  const CHANNEL = '\tchannel 0 {\n\t\textrapolate constant linear\n\t\tkeys 1 {\n\t\t\t0 1 flat flat\n\t\t}\n\t}\n';
  const MATRIX = '\tmatrix {\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n\t\t0 0 0\n\t}\n';
  const END = '\t\tOFFSET 0 1 0\n\t\tCHANNELS 1 Zrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 1 0\n\t\t}\n';
  const FILES: readonly (readonly [name: string, text: string])[] = [
    ['x.skel', SKEL],
    [
      'x.anim',
      `animation {\n\trange 0 1\n\tnumchannels 3\n${[0, 1, 2].map((i) => CHANNEL.replace('0', `${i}`)).join('')}}\n`,
    ],
    ['x.skin', `positions 1 {\n\t0 0 0\n}\nbindings 2 {\n${MATRIX.repeat(2)}}\nskinweights 1 {\n\t1 0 1\n}\n`],
    [
      'x.bvh',
      `HIERARCHY\nROOT a\n{\n\tOFFSET 0 0 0\n\tCHANNELS 1 Zrotation\n\tJOINT b\n\t{\n${END}\t}\n\tJOINT c\n\t{\n${END}\t}\n}\nMOTION\nFrames: 1\nFrame Time: 1\n1 2 3\n`,
    ],
    [
      'x.pose',
      'pose a {\n\troot 0 1 0\n\tjoint b {\n\t\trx 1\n\t}\n\tjoint c {\n\t\trx 1\n\t}\n}\npose d {\n\troot 0 1 0\n}\n',
    ],
  ];

  it.each(FILES)('%s: an extra } is told on its line, where the indentation first disagrees', (name, text) => {
    const lines = text.split('\n');
    lines.forEach((line, i) => {
      if (line.trim() !== '}') return;
      for (const extra of [line, `\t${line}`]) {
        const changed = [...lines.slice(0, i + 1), extra, ...lines.slice(i + 1)].join('\n');
        const at = readAsOpened(name, changed).diagnostics.filter(({ severity }) => severity !== 'info');
        expect(at, changed).toMatchObject([{ code: 'brace-unexpected', line: i + 2 }]);
      }
    });
  });

  it.each(FILES)('%s: a missing } is told where the indentation first disagrees', (name, text) => {
    const lines = text.split('\n');
    lines.forEach((line, i) => {
      if (line.trim() !== '}') return;
      const changed = [...lines.slice(0, i), ...lines.slice(i + 1)].join('\n');
      const at = readAsOpened(name, changed).diagnostics.filter(({ severity }) => severity === 'error');
      expect(at, changed).toMatchObject([{ code: 'brace-missing', line: i }]);
    });
  });
});

describe('a file of something else', () => {
  it.each([
    ['<!DOCTYPE html>\n<html></html>', 'a web page'],
    ['PK\u0003\u0004rest', 'a zip archive'],
    ['{ "asset": { "version": "2.0" } }', 'a JSON file'],
    ['; FBX 7.5.0 project file', 'an FBX file'],
  ])('%j is recognised', (content, name) => {
    const { diagnostics } = readAsOpened('x.skel', content);
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'other-kind' }]);
    expect(diagnostics[0].message).toContain(`looks like ${name}, not a .skel file.`);
  });

  it('a file that is read with warnings under another extension stays loaded, and says how it was read', () => {
    const text = 'positions 3 {\n0 0 0 0\n1 0 0 0\n2 0 0 0\n}\n';
    const { value, diagnostics } = readAsOpened('x.skin', text);
    expect(value).toBeDefined();
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'other-kind', assumed: 'read as .skin' }]);
  });
});
