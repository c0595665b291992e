/** Where the text editor marks a problem of a file. */
import { Text } from '@codemirror/state';
import { expect, it } from 'vitest';
import type { Diagnostic } from '../../../../src/model/diagnostic.ts';
import { markOf } from '../../../../src/ui/editors/source/code-field.ts';

const problem = (line: number, column: number): Diagnostic => ({
  severity: 'error',
  code: 'number-expected',
  message: 'A number was expected.',
  file: 'a.skel',
  line,
  column,
});
const marked = (text: string, line: number, column: number) => {
  const doc = Text.of(text.split('\n'));
  const { from, to } = markOf(doc, problem(line, column));
  return doc.sliceString(from, to);
};

it('a problem is marked from its column to the end of its word', () => {
  expect(marked('offset 1 2 x3', 1, 12)).toBe('x3');
  expect(marked('balljoint a {\n  offset 1 two 3 }', 2, 12)).toBe('two');
});

it('a character beyond 16 bits before it is one column', () => {
  expect(marked('balljoint 🦊🦊 { offset 1 two 3 }', 1, 25)).toBe('two');
});

it('a column beyond the line is at its end', () => {
  expect(marked('offset 1', 1, 99)).toBe('');
});
