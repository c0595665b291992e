/**
 * Dumps as text: what C++'s printf, glm, Eigen, numpy, Java and JavaScript print. Each line is one of
 *
 *     numbers                  a row, or the next part of one; commas, semicolons and brackets are skipped
 *     label numbers            `hip: …`, `7: …`, `joint 7 (hip): …`, `hip,…`, `vertex[3] = …`
 *     label                    of the rows that follow, up to the next one
 *     time T, channel N        for the rows that follow, in a comment too
 *     heading                  `local matrices:`, `normals 120 {`, `time,ch0,ch1`
 *     anything else            skipped; a text with more of it than of numbers is no dump
 */
import type { DumpLabel } from '../../model/dump.ts';
import type { Report } from '../report.ts';
import type { Blocks } from './blocks.ts';
import { linesOf, numberOfWord, numbersIn, timeIn } from './numbers.ts';
import { areColumns, isChannelWord, isComponent, isIndexWord, isLabelColumn, isPlain, kindOf } from './vocabulary.ts';

/** Words of a name at most. */
const MAX_NAME_WORDS = 6;
/** Words and marks of a label at most. */
const MAX_LABEL_TOKENS = 24;
const LETTER = /[A-Za-z_\u0080-\uffff]/;
/** Lines without numbers that are longer are prose. */
const MAX_WORDS_LENGTH = 400;

export function readText(text: string, blocks: Blocks, report: Report): void {
  const lines = new Lines(blocks, report);
  let line = 0;
  for (const each of linesOf(text)) lines.read(each, ++line);
  if (lines.prose > lines.rows) blocks.forget();
}

interface Token {
  readonly kind: 'number' | 'word' | 'mark';
  readonly text: string;
  readonly value: number;
  readonly from: number;
  readonly to: number;
}

interface Table {
  readonly delimiter: RegExp;
  /** Index among a line's fields. */
  readonly indexAt: number;
  readonly nameAt: number;
}

class Lines {
  prose = 0;
  rows = 0;
  private label: DumpLabel | null = null;
  private table: Table | undefined;

  constructor(
    private readonly blocks: Blocks,
    private readonly report: Report,
  ) {}

  read(line: string, number: number): void {
    const text = withoutSizes(line.trim().replace(NUMPY_SCALAR, '$1'));
    if (text === '') return;
    if (isShortened(text)) {
      const message = 'Expected all numbers, found "...": the program left some out. Print the whole list.';
      this.report.error('dump-shortened', message, { line: number, column: 1 });
      return;
    }
    const plain = numbersIn(text);
    if (plain) this.plain(plain, text, number);
    else if (!(this.table && this.fields(text, number, this.table))) this.mixed(text, number);
  }

  private plain(numbers: readonly number[], text: string, line: number): void {
    if (numbers.length === 0) return;
    const isIndexed = numbers.length > 3 && /^\[\d+\]\s*[^\s\],]/.test(text);
    if (isIndexed) this.row(numbers.slice(1), line, { index: numbers[0] });
    else if (this.table && this.table.indexAt === 0) this.row(numbers.slice(1), line, { index: numbers[0] });
    else this.row(numbers, line);
  }

  private row(numbers: readonly number[], line: number, label: DumpLabel | null = null): void {
    this.blocks.row(numbers, line, label ?? this.label);
    this.label = null;
    this.rows++;
  }

  /** A line of a table with a header. */
  private fields(text: string, line: number, { delimiter, indexAt, nameAt }: Table): boolean {
    const fields = text.split(delimiter).map((field) => field.trim().replace(/^["']|["']$/g, ''));
    const numbers: number[] = [];
    for (let i = 0; i < fields.length; i++) {
      if (i === indexAt || i === nameAt) continue;
      if (fields[i] === '' && i === fields.length - 1) continue;
      const value = numberOfWord(fields[i]);
      if (value === undefined) return false;
      numbers.push(value);
    }
    if (numbers.length === 0) return false;
    const index = indexAt >= 0 ? numberOfWord(fields[indexAt]) : undefined;
    // A column of joints has names or indices.
    const name = nameAt >= 0 ? fields[nameAt] : index === undefined && indexAt >= 0 ? fields[indexAt] : undefined;
    this.row(numbers, line, labelWith(index, name));
    return true;
  }

  private mixed(text: string, line: number): void {
    const isComment = /^(#(?!\d)|\/\/|%|\/\*)/.test(text);
    const found = tokensOf(text.replace(/^(#(?!\d)|\/\/+|%+|\/\*|-{2,}|={2,}|\*{2,})\s*/, ''));
    const first = found.tokens.findIndex(({ kind }) => kind === 'number');
    const isProse = first < 0 ? text.length > MAX_WORDS_LENGTH : first > MAX_LABEL_TOKENS;
    if (isProse) this.prose++;
    else if (first < 0) this.wordsOnly(text, wordsOf(found.tokens), isComment);
    else if (!this.stated(text, found, line) && !isComment) this.labelled(found, line);
  }

  private wordsOnly(text: string, words: readonly string[], isComment: boolean): void {
    const names = text.replace(/^[#%/\s]+/, '').split(/[,;\t]/.test(text) ? /\s*[,;\t]\s*/ : /\s+/);
    const plain = names
      .map((name) =>
        name
          .trim()
          .toLowerCase()
          .replace(/^["']|["']$/g, ''),
      )
      .filter((name) => name !== '');
    if (areColumns(plain)) {
      const at = (pattern: RegExp) => plain.findIndex((name) => pattern.test(name));
      const nameAt = at(/^name$/);
      const indexAt = at(/^(joint|bone|node|vertex|vert|index|idx|id|i|#)$/);
      this.table = { delimiter: /[,;\t]/.test(text) ? /[,;\t]/ : /\s+/, indexAt, nameAt };
      this.blocks.say({ columns: plain.filter((name) => !isLabelColumn(name)) });
    } else if (words.every(isPlain) || (words.length <= MAX_NAME_WORDS && words.some(isPluralNoun))) {
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
    const count = tokens.filter(({ kind }) => kind === 'number').length + more.length;
    const first = tokens.findIndex(({ kind }) => kind === 'number');
    const before = lastWord(tokens, first);
    const last = tokens.findLastIndex(({ kind }) => kind === 'number');
    const isPlainLine = words.every((word) => isPlain(word) || isChannelWord(word) || isComponent(word));
    if (before === 'times' && count > 1) {
      this.say({ times: Float64Array.from(numbersOf(tokens, more)) });
      return true;
    }
    const time = timeIn(text);
    const isHeading = isPlainLine && words.some(isPluralNoun) && count === 2;
    if (time !== undefined && (count === 1 || isHeading || (count === 2 && words.includes('frame')))) {
      const holds = kindOf(words);
      this.say({ time, ...(holds && { holds }) });
      return true;
    }
    if (time !== undefined && isPlainLine && (before === 'time' || before === 't')) {
      this.say({ holds: 'channels' });
      this.row(numbersOf(tokens, more), line);
      return true;
    }
    if (isChannelWord(before) && Number.isInteger(tokens[first].value)) {
      const index = tokens[first].value;
      if (count === 1) this.say({ holds: 'channels', channel: index });
      else {
        this.say({ holds: 'channels' });
        this.row(numbersOf(tokens.slice(first + 1), more), line, { index });
      }
      return true;
    }
    if (count === 1 && Number.isInteger(tokens[first].value) && words.some(isPluralNoun)) {
      const holds = kindOf(words);
      if (holds) this.say({ holds });
      return true;
    }
    // `frame 12` says nothing about what follows, and so does a count behind a word.
    return count === 1 && first === last && /^(frame|frames|joints|count|numjoints|size)$/.test(before);
  }

  /** A row with a label, or a label alone. */
  private labelled({ tokens, more, strange: strangeMore }: LineTokens, line: number): void {
    const boundary = boundaryOf(tokens);
    const first = tokens.findIndex(({ kind }) => kind === 'number');
    let prefix = tokens.slice(0, boundary >= 0 ? boundary : first);
    let rest = tokens.slice(boundary >= 0 ? boundary + 1 : first);
    const lastBefore = lastWord(tokens, first);
    if (boundary < 0 && first > 0 && isIndexWord(lastBefore) && isIndex(tokens[first])) {
      // `joint 7 (hip) 1 0 0 …`
      const named = tokens.slice(first + 1).findIndex(({ kind }) => kind === 'number');
      const end = named < 0 ? tokens.length : first + 1 + named;
      prefix = tokens.slice(0, end);
      rest = tokens.slice(end);
    } else if (boundary < 0 && first === 0 && isIndex(tokens[0]) && tokens[1]?.kind === 'word') {
      // `7 hip 1 0 0 …`
      const named = tokens.slice(1).findIndex(({ kind }) => kind === 'number');
      const end = named < 0 ? tokens.length : 1 + named;
      prefix = tokens.slice(0, end);
      rest = tokens.slice(end);
    }
    const numbers = numbersOf(rest, more);
    const strange = strangeMore + rest.filter((token) => isStrange(token)).length;
    if (strange > MAX_NAME_WORDS || strange > numbers.length + 1) {
      this.prose++;
      return;
    }
    const words = wordsOf(prefix);
    const holds = words.every(isPlain) || words.some(isIndexWord) ? kindOf(words.filter(isPlain)) : undefined;
    if (holds && holds !== 'positions') this.say({ holds });
    const label = labelIn(prefix);
    if (numbers.length > 0) this.row(numbers, line, label);
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

/** A line's tokens, as far as they can be of a label; of what follows, only what a row needs. */
interface LineTokens {
  /** At most `MAX_TOKENS`. */
  readonly tokens: readonly Token[];
  /** The numbers behind them. */
  readonly more: readonly number[];
  /** Words behind them that may be somebody's name. */
  readonly strange: number;
}

/** More than any label or heading has; all tokens of a line of a hundred thousand would take fifty times its bytes. */
const MAX_TOKENS = MAX_WORDS_LENGTH;

function tokensOf(text: string): LineTokens {
  const tokens: Token[] = [];
  const more: number[] = [];
  let strange = 0;
  for (const found of text.matchAll(TOKEN)) {
    const [all, number, word] = found;
    const value = number === undefined ? Number.NaN : (numberOfWord(number) ?? Number.NaN);
    const kind = number === undefined ? (word === undefined ? 'mark' : 'word') : 'number';
    const token: Token = { kind, text: all, value, from: found.index, to: found.index + all.length };
    if (tokens.length < MAX_TOKENS) tokens.push(token);
    else if (kind === 'number') more.push(value);
    else if (isStrange(token)) strange++;
  }
  return { tokens, more, strange };
}

function wordsOf(tokens: readonly Token[]): string[] {
  return tokens.filter(({ kind }) => kind === 'word').map(({ text }) => text.toLowerCase());
}

function isStrange({ kind, text }: Token): boolean {
  return kind === 'word' && !isPlain(text.toLowerCase());
}

/** A number, a word such as `mixamorig:Hips` or `Spine.001`, or any other character. */
const TOKEN =
  /([-+\u2212]?(?:\d{1,40}\.?\d{0,40}|\.\d{1,40})(?:[eEdD][-+]?\d{1,4})?[fFdDlL]?(?![\w.])|[-+]?(?:nan(?:\([a-z]*\))?|inf|infinity)(?!\w)|[-+]?\d\.#\w+)|([\w\u0080-\uffff][\w.\-\u0080-\uffff]*(?::[A-Za-z_][\w.-]*)*)|(\S)/gi;

/** `np.float64(1.5)`, as numpy 2 prints its numbers in lists. */
const NUMPY_SCALAR = /\bnp\.(?:float|int)\d{1,3}\(([^()\s]{1,64})\)/g;

/** Sizes that JavaScript prints before lists, and numpy's shapes. */
function withoutSizes(text: string): string {
  const counted = text.replace(/^\(\d+\) ?(?=\[)/, '');
  if (counted.length > MAX_WORDS_LENGTH || !/[(=]/.test(counted)) return counted;
  return counted.replace(/\b\w*(?:Array|Matrix|Vector|List)\w*\(\d+\)|\bshape=\([^)]*\)/g, '');
}

function isShortened(text: string): boolean {
  return /^[\s[({]*(\.{3}|…)[\s,\])}]*$|[\d,]\s+(\.{3}|…)[\s,]+[-+.\d]|\.{3} \d+ more items/.test(text);
}

/** Where a label ends: a colon, an equals sign, or the comma or tab after a name. -1 if nowhere. */
function boundaryOf(tokens: readonly Token[]): number {
  for (let i = 1; i < Math.min(tokens.length, MAX_LABEL_TOKENS); i++) {
    const { text } = tokens[i];
    const prefix = tokens.slice(0, i);
    const words = prefix.filter(({ kind }) => kind === 'word').map((token) => token.text.toLowerCase());
    const counted = prefix.filter(({ kind }) => kind === 'number').length;
    if (text === ':' || text === '=') {
      // `x: 1, y: 2, z: 3` and `M11:1 M12:0` label numbers, not rows.
      if (words.length > 0 && words.every(isComponent) && counted === 0) return -1;
      if (counted > 1 && words.length === 0) return -1;
      return i;
    }
    if (text === ',' || text === ';') {
      if (words.length > 0 && !words.every(isPlain)) return i;
      if (words.length === 0 && counted === 1 && tokens[i + 1]?.kind === 'word' && isIndex(tokens[0])) return i;
      return -1;
    }
    if (counted > 1) return -1;
  }
  return -1;
}

function labelIn(prefix: readonly Token[]): DumpLabel | null {
  const number = prefix.find(isIndex);
  const text = prefix
    .map((token, i) => (i > 0 && token.from > prefix[i - 1].to ? ' ' : '') + token.text)
    .join('')
    .slice(0, MAX_WORDS_LENGTH);
  const inside = bracketedName(text);
  const words = prefix.filter(({ kind }) => kind === 'word');
  const own = words.filter(({ text: word }) => !isPlain(word.toLowerCase()));
  if (!number && own.length === 0) return null;
  // Of `joint 7 hip` the name is what follows the index.
  const after = number
    ? words
        .filter(({ from }) => from > number.from)
        .map((word) => word.text)
        .join(' ')
    : '';
  const name =
    inside ?? (after || (own.length > 0 ? nameOf(text.replace(/^(joint|bone|node)\s+(?=\D)/i, '')) : nameOf(text)));
  return labelWith(number?.value, LETTER.test(name ?? '') ? name : undefined);
}

/** What is between brackets or quotes, if it has a letter. */
function bracketedName(text: string): string | undefined {
  for (const [, inside] of text.matchAll(/[("'[<]([^()"'[\]<>]*)(?=[)"'\]>])/g))
    if (LETTER.test(inside)) return inside.trim();
  return undefined;
}

function labelWith(index: number | undefined, name: string | undefined): DumpLabel | null {
  const isWhole = index !== undefined && Number.isInteger(index) && index >= 0;
  if (!isWhole && !name) return null;
  return { ...(isWhole && { index }), ...(name && { name }) };
}

/** Without the punctuation around it. */
function nameOf(text: string): string | undefined {
  const name = text.replace(/^[\s"'([{<*=-]+|[\s"')\]}>:=,;*([{-]+$/g, '');
  return name === '' ? undefined : name;
}

function isIndex({ kind, text, value }: Token): boolean {
  return kind === 'number' && /^\d+$/.test(text) && value < 1e9;
}

function isPluralNoun(word: string): boolean {
  return /^(matrices|positions|vertices|verts|normals|channels|transforms|transformations|joints|bones)$/.test(word);
}

function lastWord(tokens: readonly Token[], before: number): string {
  for (let i = before - 1; i >= 0; i--) if (tokens[i].kind === 'word') return tokens[i].text.toLowerCase();
  return '';
}

/** @param more those behind the tokens */
function numbersOf(tokens: readonly Token[], more: readonly number[]): number[] {
  const numbers = tokens.filter(({ kind }) => kind === 'number').map(({ value }) => value);
  for (const value of more) numbers.push(value);
  return numbers;
}
