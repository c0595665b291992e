/**
 * Rows whose length differs from their neighbours'.
 *
 * A row is a line that starts with a number, or lies between such lines. Its block is named by the first word of the
 * last other line above it that is no lone brace. In a block the usual length is that of most rows, over all blocks of
 * the same name; in a block with too few rows to tell, what the format says. A row of `skinweights` says its own
 * length.
 */
import { type Edit, quoted } from './edit.ts';
import type { TextLayout } from './layouts.ts';
import type { TextLines, TextToken } from './text-lines.ts';

interface Row {
  readonly line: number;
  readonly count: number;
  readonly hasBrace: boolean;
}

/** So many rows of one length outvote the format's own. */
const VOTES = 4;
/** Share of the rows of a block. */
const MAJORITY = 0.6;

/**
 * Edits for each row of an unusual length, alternatives of one row together, from the top; none if there are more than
 * `most`, so no usual one.
 */
export function irregularRows(lines: TextLines, layout: TextLayout, most: number): readonly (readonly Edit[])[] {
  const all: (readonly Edit[])[] = [];
  for (const [block, rows] of rowsByBlock(lines)) {
    const known = layout.rows.get(block);
    const length = known === 'pairs' ? known : (usualLength(rows) ?? known);
    if (length === undefined) continue;
    for (const row of rows) {
      const edits = length === 'pairs' ? pairs(lines, block, row, layout) : regular(lines, block, row, length, layout);
      if (edits.length) all.push(edits);
      if (all.length > most) return [];
    }
  }
  return all.sort((a, b) => a[0].line - b[0].line);
}

function rowsByBlock(lines: TextLines): ReadonlyMap<string, readonly Row[]> {
  const blocks = new Map<string, Row[]>();
  let block = '';
  let wasRow = false;
  let opens = true;
  lines.filled.forEach((line, i) => {
    const { first, count, hasBrace } = lines.row(line);
    const isRow = first === 'n' || isDamagedRow(lines, line, lines.filled[i + 1], wasRow, opens);
    if (isRow) {
      const rows = blocks.get(block);
      const row = { line, count, hasBrace };
      if (rows) rows.push(row);
      else blocks.set(block, [row]);
    } else if (first === 'w') block = lines.text(lines.head(line)).toLowerCase();
    wasRow = isRow;
    opens = !isRow && hasBrace && lines.tokens(line).at(-1)?.class === '{';
  });
  return blocks;
}

/** Whether a line that starts with something else than a number is a row, by the lines around it. */
function isDamagedRow(
  lines: TextLines,
  line: number,
  next: number | undefined,
  wasRow: boolean,
  opens: boolean,
): boolean {
  if (next === undefined || !(wasRow || opens)) return false;
  const own = lines.row(line);
  if (own.first !== 'w' && !(own.count > 1 && wasRow)) return false;
  if (lines.tokens(line).at(-1)?.class === '{') return false;
  const { first } = lines.row(next);
  return first === 'n' || (wasRow && first === '}');
}

function usualLength(rows: readonly Row[]): number | undefined {
  const votes = new Map<number, number>();
  for (const { count, hasBrace } of rows) if (!hasBrace) votes.set(count, (votes.get(count) ?? 0) + 1);
  let [length, most] = [0, 0];
  for (const [count, found] of votes) if (found > most) [length, most] = [count, found];
  return most >= VOTES && most >= MAJORITY * rows.length ? length : undefined;
}

/** The row with as many numbers as it should have. */
function regular(lines: TextLines, block: string, row: Row, length: number, layout: TextLayout): readonly Edit[] {
  if (row.count === length && !row.hasBrace) return [];
  const words = wordsOf(lines, row.line);
  const texts = words.map((word) => numberOf(lines, word, layout));
  const where = block === '' ? 'in this row' : `in this row of ${block}`;
  const message = `Expected ${length} numbers ${where}, as in neighbouring rows, found ${words.length}.`;
  const edit = (kept: readonly string[]) => rewritten(lines, row.line, kept, words, length, message);
  if (texts.length === length) return [edit(texts)];
  if (texts.length > length) return [edit(texts.slice(0, length)), edit(texts.slice(texts.length - length))];
  const zeros = Array.from({ length: length - texts.length }, () => '0');
  // The last number may be a count, as that of children is.
  const ends = ['1', '2', '3', '4', '5'].map((end) => [...texts, ...zeros.slice(1), end]);
  const plain = Array.from({ length }, () => '0');
  return [[...texts, ...zeros], plain, ['1', ...zeros.slice(1), ...texts], ...ends].map(edit);
}

/** A row that starts with its number of pairs. */
function pairs(lines: TextLines, block: string, row: Row, layout: TextLayout): readonly Edit[] {
  const count = lines.value(lines.head(row.line));
  const length = 1 + 2 * count;
  if (row.count === length && !row.hasBrace) return [];
  const words = wordsOf(lines, row.line);
  const [first] = words;
  if (!first) return [];
  const isCount = count >= 0 && count % 1 === 0;
  const texts = words.map((word) => numberOf(lines, word, layout));
  if (isCount && Math.abs(words.length - length) <= 1) {
    const kept = words.length < length ? [...texts, '0'] : texts.slice(0, length);
    const message = `This row of ${block} needs ${length} numbers: the count ${count}, then a joint and a weight for each. It has ${words.length}.`;
    return [rewritten(lines, row.line, kept, words, length, message)];
  }
  // The count itself is missing, or wrong.
  const rest = words.length % 2 === 0 ? texts : texts.slice(1);
  const expected = `Expected the number of attachments, ${rest.length / 2}, at the start of this row of ${block}`;
  const message = `${expected}, found ${quoted(lines, first)}.`;
  return [rewritten(lines, row.line, [`${rest.length / 2}`, ...rest], words, 0, message)];
}

function wordsOf(lines: TextLines, line: number): readonly TextToken[] {
  return lines.tokens(line).filter((token) => token.class === 'n' || token.class === 'w');
}

/** A token as a number: 0 for one that is none, since it may make others wrong. */
function numberOf(lines: TextLines, word: TextToken, { words }: TextLayout): string {
  const text = lines.text(word);
  return Number.isFinite(lines.value(word)) || words?.has(text.toLowerCase()) ? text : '0';
}

function rewritten(
  lines: TextLines,
  line: number,
  texts: readonly string[],
  words: readonly TextToken[],
  length: number,
  message: string,
): Edit {
  const tokens = lines.tokens(line);
  const at = (words[length] ?? words.at(-1) ?? tokens[0]).start;
  const code = words.length > length && length > 0 ? 'row-too-long' : 'row-incomplete';
  const { start: from } = tokens[0];
  return { from, to: tokens[tokens.length - 1].stop, put: ` ${texts.join(' ')} `, line, at, code, message };
}
