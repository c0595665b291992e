/**
 * Words that a line has before, between and behind its numbers:
 *
 *     label numbers      `hip: …`, `hip (…)`, `hip vec3(…)`, `7: …`, `joint 7 (hip) …`, `hip,…`, `vertex[3] = …`, `-1.9: …`
 *     numbers label      `… hip`
 *     heading            `Project 3 output`: words on both sides of its numbers, which are few
 */
import type { DumpLabel } from '../../model/dump.ts';
import { isIndex, isStrange, isTelling, type LineTokens, lastWord, numbersOf, type Token, wordsOf } from './tokens.ts';
import { isComponent, isIndexWord, isPlain } from './vocabulary.ts';

/** Words of a name at most. */
export const MAX_NAME_WORDS = 6;
/** Words and marks of a label at most. */
export const MAX_LABEL_TOKENS = 24;
/** Letters of a label at most. */
const MAX_LABEL_LENGTH = 400;
const LETTER = /[A-Za-z_\u00aa-\u1fff\u2c00-\uffff]/;

/** A line taken apart. */
export interface LabelledNumbers {
  readonly numbers: readonly number[];
  readonly label: DumpLabel | null;
  /** Words of the label, in lower case. */
  readonly words: readonly string[];
  /** Whether words stand among or behind the numbers as in a sentence, or too many for any row. */
  readonly isProse: boolean;
  /** Whether it may be a heading, or a sentence, whose numbers are no values: it has words, and few or whole numbers. */
  readonly mayBeHeading: boolean;
}

/** Label and numbers of a line with a number. */
export function labelledNumbers({ tokens, more, strange: strangeMore }: LineTokens): LabelledNumbers {
  const { prefix, rest: all } = split(tokens);
  const last = all.findLastIndex(({ kind }) => kind === 'number');
  const ends = more.length === 0 && last >= 0;
  const rest = ends ? all.slice(0, last + 1) : all;
  const tail = ends ? all.slice(last + 1) : [];
  const numbers = numbersOf(rest, more);
  const strange = strangeMore + all.filter(isStrange).length;
  const isNamedBehind = tail.some(isStrange) && numbers.length >= MIN_VALUES && labelIn(prefix) === null;
  const isSentence = tail.some(isStrange) && numbers.length < MIN_VALUES && numbers.length > 0;
  const isFew =
    numbers.length < MIN_VALUES || rest.every(({ kind, text }) => kind !== 'number' || /^[-+]?\d+$/.test(text));
  return {
    numbers,
    label: labelIn(isNamedBehind ? tail : prefix),
    words: wordsOf(prefix),
    isProse: strange > MAX_NAME_WORDS || strange > numbers.length + 1,
    mayBeHeading: isSentence || (isFew && more.length === 0 && tokens.some((_, i) => isTelling(tokens, i))),
  };
}

/** Number of values that make a row a joint, a vertex or a channel at several times. */
const MIN_VALUES = 3;

interface Split {
  readonly prefix: readonly Token[];
  readonly rest: readonly Token[];
}

function split(tokens: readonly Token[]): Split {
  const boundary = boundaryOf(tokens);
  const first = tokens.findIndex(({ kind }) => kind === 'number');
  const at = (end: number, begin = end): Split => ({ prefix: tokens.slice(0, end), rest: tokens.slice(begin) });
  if (boundary >= 0) return withName(at(boundary, boundary + 1));
  const isIndexed = isIndex(tokens[first]);
  // `joint 7 (hip) 1 0 0 …`, `7 hip 1 0 0 …`
  const isNumbered = first > 0 && isIndexWord(lastWord(tokens, first));
  if (isIndexed && (isNumbered || (first === 0 && tokens[1]?.kind === 'word'))) {
    const named = tokens.slice(first + 1).findIndex(({ kind }) => kind === 'number');
    return at(named < 0 ? tokens.length : first + 1 + named);
  }
  return withName(at(first));
}

/** With a name behind the label and at most one number: `0: hip 1 0 0`, `build 12 hip 1 0 0`. */
function withName({ prefix, rest }: Split): Split {
  const name = rest.findLastIndex(isStrange);
  if (name < 0) return { prefix, rest };
  const isNumber = ({ kind }: Token) => kind === 'number';
  const before = rest.slice(0, name).filter(isNumber).length;
  if (before > 1 || !rest.slice(name).some(isNumber) || before + prefix.filter(isNumber).length > 1)
    return { prefix, rest };
  return { prefix: [...prefix, ...rest.slice(0, name + 1)], rest: rest.slice(name + 1) };
}

/** Where a label ends: a colon, an equals sign, or the comma or tab after a name. -1 if nowhere. */
function boundaryOf(tokens: readonly Token[]): number {
  for (let i = 1; i < Math.min(tokens.length, MAX_LABEL_TOKENS); i++) {
    const { text } = tokens[i];
    const prefix = tokens.slice(0, i);
    const words = wordsOf(prefix);
    const counted = prefix.filter(({ kind }) => kind === 'number').length;
    if (text === ':' || text === '=') {
      // `x: 1, y: 2, z: 3` and `M11:1 M12:0` label numbers, not rows.
      if (words.length > 0 && words.every(isComponent) && counted === 0) return -1;
      if (counted > 1 && words.length === 0) return -1;
      return i;
    }
    if (text === ',' || text === ';') {
      if (counted === 0) return words.length > 0 && !words.every(isPlain) ? i : -1;
      if (words.length === 0 && counted === 1 && tokens[i + 1]?.kind === 'word' && isIndex(tokens[0])) return i;
      return -1;
    }
    if (counted > 1) return -1;
  }
  return -1;
}

/** The index and the name that a label has; null if neither. */
function labelIn(all: readonly Token[]): DumpLabel | null {
  const prefix = withoutFunction(all);
  const numbers = prefix.filter(({ kind }) => kind === 'number');
  const number = prefix.find(isIndex);
  const text = prefix
    .map((token, i) => (i > 0 && token.from > prefix[i - 1].to ? ' ' : '') + token.text)
    .join('')
    .slice(0, MAX_LABEL_LENGTH);
  const words = prefix.filter(({ kind }) => kind === 'word');
  // A time, or any other number: whose it is is decided with a character available.
  if (words.length === 0 && numbers.length === 1) return { index: numbers[0].value };
  const own = words.filter(isStrange);
  const within = bracketedName(text);
  // Of `neck (parent torso)` the name is not what the brackets say alone.
  const outside = own.filter((word) => !within?.includes(word.text));
  const inside = outside.length > 0 ? undefined : within;
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
  // `evaluate(0.5)`
  if (!number && numbers.length === 1 && own.length === 1) return { index: numbers[0].value, name: own[0].text };
  return labelWith(number?.value, LETTER.test(name ?? '') ? name : undefined);
}

/** Without the `vec3(` of `hip vec3(`. */
function withoutFunction(prefix: readonly Token[]): readonly Token[] {
  let end = prefix.length;
  while (end > 0 && /^[([{<]$/.test(prefix[end - 1].text)) end--;
  const name = prefix.findLastIndex(isStrange);
  return end < prefix.length && name >= 0 ? prefix.slice(0, Math.max(name + 1, lastMark(prefix, end))) : prefix;
}

/** Behind the last of the tokens up to `end` that is no word. */
function lastMark(tokens: readonly Token[], end: number): number {
  while (end > 0 && tokens[end - 1].kind === 'word') end--;
  return end;
}

/** Name between brackets or quotes, if it has a letter. */
function bracketedName(text: string): string | undefined {
  for (const [, inside] of text.matchAll(/[("'[<]([^()"'[\]<>]*)(?=[)"'\]>])/g))
    if (LETTER.test(inside)) return inside.trim();
  return undefined;
}

/** A label of an index, a name or both; null if the index is no whole number from 0 and there is no name. */
export function labelWith(index: number | undefined, name: string | undefined): DumpLabel | null {
  const isWhole = index !== undefined && Number.isInteger(index) && index >= 0;
  if (!isWhole && !name) return null;
  return { ...(isWhole && { index }), ...(name && { name }) };
}

/** Without the punctuation around it. */
export function nameOf(text: string): string | undefined {
  const name = text.replace(/^[\s"'([{<*=-]+|[\s"')\]}>:=,;|*([{-]+$/g, '');
  return name === '' ? undefined : name;
}
