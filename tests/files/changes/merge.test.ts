import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type MergedText, mergeChanges } from '../../../src/files/changes/merge.ts';
import { splitLines } from '../../../src/files/changes/text-lines.ts';
import type { LineHunk } from '../../../src/model/text-changes.ts';
import { applyHunks } from './apply-hunks.ts';

const text = (...lines: string[]) => `${lines.join('\n')}\n`;
const lineOf = ({ oldFrom, oldTo, newFrom, newTo }: LineHunk) => `${oldFrom}-${oldTo} > ${newFrom}-${newTo}`;

/** The hunks in words, after it was checked that they lead from the original to the text. */
function hunksOf(original: string, merged: MergedText): string[] {
  expect(applyHunks(original, merged)).toBe(merged.text);
  return merged.hunks.map(lineOf);
}

describe('changes carried over to a file’s own text', () => {
  const before = text('joint a {', '\toffset 0 1 0', '\tpose 0.5 0 0', '\tjoint b {', '\t\toffset 0 1 0', '\t}', '}');

  it('change the tokens that differ, and no blank', () => {
    const original = 'joint a{\r\n   offset   0.00  1.0 0\r\n  pose 0.50 0 0\r\njoint b {\r\n offset 0 1 0\r\n}\r\n}';
    const merged = mergeChanges(original, before, before.replace('pose 0.5 0 0', 'pose 0.5 0 -2'));
    expect(merged.text).toBe(original.replace('pose 0.50 0 0', 'pose 0.50 0 -2'));
    expect(hunksOf(original, merged)).toEqual(['3-4 > 3-4']);
  });

  it('find a field that the file has in another place of its block', () => {
    const original = text('joint a {', 'pose 0.5 0 0', 'offset 0 1 0', 'joint b {', 'offset 0 1 0', '}', '}');
    const merged = mergeChanges(original, before, before.replace('pose 0.5', 'pose 0.75'));
    expect(merged.text).toBe(original.replace('pose 0.5', 'pose 0.75'));
    expect(hunksOf(original, merged)).toEqual(['2-3 > 2-3']);
  });

  it('replace a default that writers leave out', () => {
    const original = before.replace('\t\toffset 0 1 0', '\t\toffset 0 1 0\n\t\tpose 0.0 0 0');
    const after = before.replace('\t\toffset 0 1 0', '\t\toffset 0 1 0\n\t\tpose 0 0 3');
    const merged = mergeChanges(original, before, after);
    expect(merged.text).toBe(original.replace('pose 0.0 0 0', 'pose 0.0 0 3'));
    expect(hunksOf(original, merged)).toEqual(['6-7 > 6-7']);
  });

  it('drop defaults of a block whose first line changed, if they are not to be kept', () => {
    const original = before.replace('\t\toffset 0 1 0', '\t\toffset 0 1 0\n\t\tpose 0.0 0 0');
    const after = before.replace('joint b {', 'hinge b {');
    expect(mergeChanges(original, before, after).text).toBe(original.replace('joint b {', 'hinge b {'));
    const merged = mergeChanges(original, before, after, false);
    expect(merged.text).toBe(after);
    expect(hunksOf(original, merged)).toEqual(['4-5 > 4-5', '6-7 > 6-6']);
  });

  it('remove a block with what only the file has in it, and leave what is around it', () => {
    const original = text(
      '# mine',
      'joint a {',
      'offset 0 1 0',
      'pose 0.5 0 0',
      '',
      'joint b {',
      'offset 0 1 0',
      '# x',
      '}',
      '}',
    );
    const after = text('joint a {', '\toffset 0 1 0', '\tpose 0.5 0 0', '}');
    const merged = mergeChanges(original, before, after);
    expect(merged.text).toBe(text('# mine', 'joint a {', 'offset 0 1 0', 'pose 0.5 0 0', '', '}'));
    expect(hunksOf(original, merged)).toEqual(['6-10 > 6-6']);
  });

  it('add lines with the indentation and the line ends of the file', () => {
    const original = 'joint a {\r\n  offset 0 1 0\r\n  pose 0.5 0 0\r\n  joint b {\r\n    offset 0 1 0\r\n  }\r\n}\r\n';
    const after = before.replace('\t}\n', '\t}\n\tjoint c {\n\t\toffset 1 0 0\n\t}\n');
    const merged = mergeChanges(original, before, after);
    expect(merged.text).toBe(original.replace('  }\r\n', '  }\r\n  joint c {\r\n    offset 1 0 0\r\n  }\r\n'));
    expect(hunksOf(original, merged)).toEqual(['7-7 > 7-10']);
  });

  it('at the end of a file without a line end, too', () => {
    const original = before.trimEnd();
    const merged = mergeChanges(original, before, `${before}joint z {\n}\n`);
    expect(merged.text).toBe(`${original}\njoint z {\n}`);
    expect(hunksOf(original, merged)).toEqual(['8-8 > 8-10']);
  });

  it('write anew only the rows whose line breaks are others', () => {
    const original = text('rows 3 {', '1 2', '3 4 5', '6', '7 8 9', '}');
    const written = text('rows 3 {', '\t1 2 3', '\t4 5 6', '\t7 8 9', '}');
    expect(hunksOf(original, mergeChanges(original, written, written.replace('8', '8.5')))).toEqual(['5-6 > 5-6']);
    const merged = mergeChanges(original, written, written.replace('5', '5.5'));
    expect(splitLines(merged.text).lines).toEqual(['rows 3 {', '1 2 3', '4 5.5 6', '7 8 9', '}', '']);
    expect(hunksOf(original, merged)).toEqual(['2-5 > 2-4']);
  });

  it('of any two writings lead to the second one, if the file is the first one in another layout', () => {
    const row = fc.tuple(fc.nat(5), fc.nat(2)).map(([a, b]) => `${a} ${b}.5`);
    const some = fc.array(row, { maxLength: 20 });
    const layout = fc.constantFrom<(line: string) => string>(
      (line) => `  ${line.replace(' ', '   ')}`,
      (line) => line.replace(/(\d) /, '$1.000 '),
      (line) => line.replace('{', '\t{'),
    );
    fc.assert(
      fc.property(some, some, layout, fc.constantFrom('\n', '\r\n', '\r'), (rowsBefore, rowsAfter, inLayout, end) => {
        const written = (rows: string[]) => text(`rows ${rows.length} {`, ...rows.map((r) => `\t${r}`), '}');
        const original = splitLines(written(rowsBefore)).lines.map(inLayout).join(end);
        const merged = mergeChanges(original, written(rowsBefore), written(rowsAfter));
        expect(applyHunks(original, merged)).toBe(merged.text);
        const plain = (any: string) =>
          splitLines(any).lines.map((line) => line.replace(/\.0+ /, ' ').trim().split(/\s+/));
        expect(plain(merged.text)).toEqual(plain(written(rowsAfter)));
      }),
    );
  });
});
