/**
 * Dumps as text: what C++'s printf, glm, Eigen, numpy, Java and JavaScript print. Each line is one of
 *
 *     numbers                  a row, or the next part of one; commas, semicolons and brackets are skipped
 *     label numbers            `hip: …`, `hip (…)`, `hip vec3(…)`, `7: …`, `joint 7 (hip): …`, `hip,…`, `vertex[3] = …`
 *     label                    of the rows that follow, up to the next one
 *     time T, channel N        for the rows that follow, in a comment too
 *     target, one step         of inverse kinematics (`targets.ts`)
 *     columns                  `time,ch 0,ch 1`: names of the numbers of a row, as many as it has
 *     heading                  `local matrices:`, `normals 120 {`, `Project 3`; its numbers are no values
 *     anything else            skipped; a text with more of it than of numbers is no dump
 *
 * A row within one pair of brackets may continue over several lines.
 */
import type { DumpLabel } from '../../model/dump.ts';
import type { Report } from '../report.ts';
import type { Blocks } from './blocks.ts';
import {
  columnsOf,
  type Header,
  hasNamesInCells,
  headerOf,
  labelOfFields,
  type Table,
  tableOf,
  valuesOf,
} from './columns.ts';
import { labelledNumbers, MAX_LABEL_TOKENS, MAX_NAME_WORDS, nameOf } from './labels.ts';
import { linesOf, numberOfWord, numbersIn, timeIn } from './numbers.ts';
import { statesOneStep, targetIn } from './targets.ts';
import { isWhole, type LineTokens, lastWord, numbersOf, tokensOf, wordsOf } from './tokens.ts';
import {
  areColumns,
  isChannelWord,
  isComponent,
  isIndexWord,
  isPlain,
  isPlainColumn,
  isPluralNoun,
  kindOf,
} from './vocabulary.ts';

/** Lines without numbers that are longer are prose. */
const MAX_WORDS_LENGTH = 400;
/** Number of rows below which a few sentences beside them make a readme; above it, only many do. */
const FEW_ROWS = 3;
const MANY_TIMES = 4;
const NO_HEADER: Header = { names: [], delimiter: /\s+/ };

/** Reads a dump of plain text into `blocks`; prose with few numbers in it leaves them empty. */
export function readText(text: string, blocks: Blocks, report: Report): void {
  const lines = new Lines(blocks, report);
  let line = 0;
  for (const each of linesOf(text)) lines.read(each, ++line);
  const rows = blocks.settle();
  if (lines.prose > (rows < FEW_ROWS ? rows : MANY_TIMES * rows)) blocks.forget();
}

class Lines {
  prose = 0;
  private label: DumpLabel | null = null;
  private table: Table | undefined;
  /** A line that may be a header: it is one if the next row has as many numbers. */
  private header = NO_HEADER;
  /** Whether a bracket around the numbers of a row is open: what follows belongs to the row, or begins it. */
  private open: 'no' | 'before' | 'within' = 'no';

  constructor(
    private readonly blocks: Blocks,
    private readonly report: Report,
  ) {}

  read(line: string, number: number): void {
    const text = withoutSizes(line.trim().replace(NUMPY_SCALAR, '$1'));
    if (text === '') {
      this.open = 'no';
      return;
    }
    if (isShortened(text)) {
      const message = 'Expected all numbers, found "...": the program left some out. Print the whole list.';
      this.report.error('dump-shortened', message, { line: number, column: 1 });
      return;
    }
    const plain = numbersIn(text);
    if (plain) this.plain(plain, text, number);
    else if (!this.ofSolver(text, number) && !(this.table && this.fields(text, number, this.table)))
      this.mixed(text, number);
    this.open = openAfter(text, this.open);
  }

  private plain(numbers: readonly number[], text: string, line: number): void {
    if (numbers.length === 0) return;
    if (this.open === 'within') {
      this.blocks.extend(numbers, line);
      return;
    }
    this.useHeader(numbers.length);
    const isIndexed = numbers.length > 3 && /^\[\d+\]\s*[^\s\],]/.test(text);
    if (isIndexed) this.row(numbers.slice(1), line, { index: numbers[0] });
    else if (this.table) this.ofTable(this.table, numbers, line);
    else this.row(numbers, line);
  }

  private ofTable(table: Table, all: readonly number[], line: number): void {
    // A column without a name is the first: pandas' index.
    const numbers = all.length === table.roles.length + 1 ? all.slice(1) : all;
    if (numbers.length !== table.roles.length) {
      this.row(all, line);
      return;
    }
    const index = table.roles.indexOf('index');
    this.row(valuesOf(table, numbers), line, index < 0 ? null : { index: numbers[index] });
  }

  private row(numbers: readonly number[], line: number, label: DumpLabel | null = null, mayBeHeading = false): void {
    this.blocks.row(numbers, line, label ?? this.label, mayBeHeading);
    this.label = null;
  }

  /** The names of the line before become columns if the row has as many numbers, or one more, its index. */
  private useHeader(count: number): void {
    const { header } = this;
    this.header = NO_HEADER;
    const { length } = header.names;
    if (length > 1 && (length === count || length === count - 1)) this.setTable(header);
  }

  private setTable({ names, delimiter }: Header): void {
    this.table = tableOf(names, delimiter);
    this.label = null;
    this.blocks.say({ columns: columnsOf(this.table, names) });
  }

  /** A line of a table with a header. */
  private fields(text: string, line: number, table: Table): boolean {
    const fields = text
      .replace(/^\||\|$/g, '')
      .split(table.delimiter)
      .map((field) => field.trim().replace(/^["']|["']$/g, ''));
    if (fields.at(-1) === '') fields.pop();
    const numbers = fields.map(numberOfWord);
    const values = valuesOf(table, numbers);
    if (values.length === 0 || !values.every((value) => value !== undefined)) return false;
    this.row(values, line, labelOfFields(table, fields));
    return true;
  }

  /** Whether a line says what a solver of inverse kinematics was to do. */
  private ofSolver(text: string, line: number): boolean {
    const target = targetIn(text);
    if (target) this.blocks.target(target, line);
    const isOneStep = statesOneStep(text);
    this.blocks.isOneStep ||= isOneStep;
    return isOneStep || target !== undefined;
  }

  private mixed(text: string, line: number): void {
    const isComment = /^(#(?!\d)|\/\/|%|\/\*)/.test(text);
    const found = tokensOf(text.replace(/^(#(?!\d)|\/\/+|%+|\/\*|-{2,}|={2,}|\*{2,})\s*/, ''));
    const first = found.tokens.findIndex(({ kind }) => kind === 'number');
    if (first < 0 && text.length <= MAX_WORDS_LENGTH) this.wordsOnly(text, wordsOf(found.tokens), isComment);
    else if (hasNamesInCells(text)) this.named(headerOf(text));
    else if (first < 0 || first > MAX_LABEL_TOKENS) this.prose++;
    else if (!this.stated(text, found, line) && !isComment) this.labelled(found, line);
  }

  /** Whether the names alone tell a header; if only some are those of columns, the next row does. */
  private named(header: Header): boolean {
    const isTold = areColumns(header.names);
    if (isTold) this.setTable(header);
    else this.header = header.names.some(isPlainColumn) ? header : NO_HEADER;
    return isTold;
  }

  private wordsOnly(text: string, words: readonly string[], isComment: boolean): void {
    if (this.named(headerOf(text))) return;
    if (words.every(isPlain) || (words.length <= MAX_NAME_WORDS && words.some(isPluralNoun))) {
      const holds = kindOf(words);
      if (holds) this.say({ holds });
    } else if (words.length > MAX_NAME_WORDS) this.prose++;
    else if (words.length > 0) {
      const name = nameOf(text.replace(/^(#|\/\/)\s*/, '').replace(/^(joint|bone|node)\s+(?=\w)/i, ''));
      // Comments more often say something else; as a label it would need a joint of that name.
      if (name && !isComment) this.label = { name };
    }
  }

  /** Lines that state something about the rows that follow. */
  private stated(text: string, { tokens, more }: LineTokens, line: number): boolean {
    const words = wordsOf(tokens);
    const numbers = tokens.filter(({ kind }) => kind === 'number');
    const count = numbers.length + more.length;
    const first = tokens.findIndex(({ kind }) => kind === 'number');
    const before = lastWord(tokens, first);
    const last = tokens.findLastIndex(({ kind }) => kind === 'number');
    if (before === 'times' && count > 1) {
      this.say({ times: Float64Array.from(numbersOf(tokens, more)) });
      return true;
    }
    if (this.timed(text, { tokens, more, strange: 0 }, line)) return true;
    if (isChannelWord(before) && Number.isInteger(tokens[first].value)) {
      const index = tokens[first].value;
      const isOfCount = count === 2 && /\bof\b|\//.test(text);
      if (count === 1 || isOfCount) this.say({ holds: 'channels', channel: index });
      else {
        this.say({ holds: 'channels' });
        this.row(numbersOf(tokens.slice(first + 1), more), line, { index });
      }
      return true;
    }
    // `local 2 matrices`, `Channels of sample 2, 45 rows`
    if (count < 3 && numbers.every(isWhole) && words.some(isPluralNoun)) {
      const holds = kindOf(words);
      if (holds) this.say({ holds });
      return true;
    }
    // `frame 12` says nothing about what follows, and so does a count behind a word.
    return count === 1 && first === last && /^(frame|frames|joints|count|numjoints|size)$/.test(before);
  }

  /** `time T` for the rows that follow, or a row of a time and values. */
  private timed(text: string, { tokens, more }: LineTokens, line: number): boolean {
    const time = timeIn(text);
    if (time === undefined) return false;
    const words = wordsOf(tokens);
    const numbers = tokens.filter(({ kind }) => kind === 'number');
    const others = numbers.filter(({ value }) => value !== time);
    const isPlainLine = words.every((word) => isPlain(word) || isChannelWord(word) || isComponent(word));
    const isCount = numbers.length > 2 && numbers.every(({ value }, i) => value === i);
    if (isPlainLine && isCount && words.length === 1) {
      // Numbered columns beside that of times.
      const names = ['time', ...numbers.map(({ text: digits }) => digits)];
      this.setTable({ names, delimiter: /\s*[,;\t|\s]\s*/ });
      return true;
    }
    const isOfFrame = words.some((word) => !/^(time|t|s|sec|secs|seconds?)$/.test(word));
    if (more.length === 0 && (numbers.length === 1 || (others.length < 3 && others.every(isWhole) && isOfFrame))) {
      const holds = kindOf(words);
      this.say({ time, ...(holds && { holds }) });
      return true;
    }
    if (!isPlainLine) return false;
    const at = numbers.findIndex(({ value }) => value === time);
    // What is before the time counts the frames.
    this.say({ holds: 'channels' });
    this.row(numbersOf(numbers.slice(at), more), line);
    return true;
  }

  /** A row with a label, or a label alone. */
  private labelled(found: LineTokens, line: number): void {
    const { numbers, label, words, isProse, mayBeHeading } = labelledNumbers(found);
    if (isProse) {
      this.prose++;
      return;
    }
    if (!mayBeHeading) this.useHeader(numbers.length + (label ? 1 : 0));
    const holds = words.every(isPlain) || words.some(isIndexWord) ? kindOf(words.filter(isPlain)) : undefined;
    if (holds && holds !== 'positions') this.say({ holds });
    if (numbers.length > 0) this.row(numbers, line, label, mayBeHeading);
    else if (label) this.label = label;
  }

  private say(change: Parameters<Blocks['say']>[0]): void {
    const { holds } = change;
    const { heading } = this.blocks;
    const isOther = holds !== undefined && holds !== heading.holds;
    // Times may be stated before the first heading.
    const isAnother = isOther && heading.holds !== undefined;
    this.blocks.say({
      ...(isOther && { channel: undefined, columns: undefined }),
      ...(isAnother && { times: undefined }),
      ...change,
    });
    if (isOther) this.table = undefined;
  }
}

/** `np.float64(1.5)`, as numpy 2 prints its numbers in lists. */
const NUMPY_SCALAR = /\bnp\.(?:float|int)\d{1,3}\(([^()\s]{1,64})\)/g;

/** Sizes that JavaScript prints before lists, and numpy's shapes. */
function withoutSizes(text: string): string {
  const counted = text.replace(/^\(\d+\) ?(?=\[)/, '');
  if (counted.length > MAX_WORDS_LENGTH || !/[(=]/.test(counted)) return counted;
  return counted.replace(/\b\w*(?:Array|Matrix|Vector|List)\w*\(\d+\)|\bshape=\([^)]*\)/g, '');
}

function isShortened(text: string): boolean {
  return /^[\s[({.]*(\.{3}|…)[\s.,…\])}]*$|[\d,]\s+(\.{3}|…)[\s,]+[-+.\d]|\.{3} \d+ more items/.test(text);
}

/** Whether the numbers of the lines below are of one row with those in brackets that this line leaves open. */
function openAfter(text: string, before: 'no' | 'before' | 'within'): 'no' | 'before' | 'within' {
  const last = Math.max(...['[', '(', ']', ')'].map((bracket) => text.lastIndexOf(bracket)));
  if (last < 0) return before === 'no' ? 'no' : 'within';
  if (text[last] === ']' || text[last] === ')') return 'no';
  if (last === text.length - 1) return 'before';
  return /^[\s[(]*[-+.\d]/.test(text.slice(last + 1, last + 8)) ? 'within' : 'no';
}
