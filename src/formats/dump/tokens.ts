/** Words, numbers and marks of a line of a dump. Digits within a word, as of `vec3` and `hip_03_r`, are part of it. */
import { numberOfWord } from './numbers.ts';
import { isComponent, isPlain } from './vocabulary.ts';

/** A number, a word or any other character of a line; offsets are into the line, `to` excluded. */
export interface Token {
  readonly kind: 'number' | 'word' | 'mark';
  readonly text: string;
  /** NaN of what is not a number. */
  readonly value: number;
  /** Behind a number, without a space: `s`, `deg`; empty if it has none. */
  readonly unit: string;
  readonly from: number;
  readonly to: number;
}

/** A line's tokens, as far as they can be of a label; of what follows, only what a row needs. */
export interface LineTokens {
  /** At most `MAX_TOKENS`. */
  readonly tokens: readonly Token[];
  /** The numbers behind them. */
  readonly more: readonly number[];
  /** Words behind them that may be somebody's name. */
  readonly strange: number;
}

/** More than any label or heading has; all tokens of a line of a hundred thousand would take fifty times its bytes. */
const MAX_TOKENS = 400;

/** The tokens of a line; numbers past `MAX_TOKENS` are only kept as values. */
export function tokensOf(text: string): LineTokens {
  const tokens: Token[] = [];
  const more: number[] = [];
  let strange = 0;
  for (const found of text.matchAll(TOKEN)) {
    const [all, date, number, unit = '', special, name] = found;
    const word = date ?? name;
    const digits = number ?? special;
    const value = digits === undefined ? Number.NaN : (numberOfWord(digits) ?? Number.NaN);
    const kind = digits !== undefined ? 'number' : word === undefined ? 'mark' : 'word';
    const token: Token = { kind, text: all, value, unit, from: found.index, to: found.index + all.length };
    if (tokens.length < MAX_TOKENS) tokens.push(token);
    else if (kind === 'number') more.push(value);
    else if (isStrange(token)) strange++;
  }
  return { tokens, more, strange };
}

/**
 * A date or the time of a day, which is a word; a number, with a float's f or a unit; what is not finite; a word such
 * as `mixamorig:Hips` or `Spine.001`; any other character. Arrows and other signs are no letters.
 */
const TOKEN =
  /(\d{4}-\d\d-\d\dT\d\d:\d\d(?::\d\d(?:[.,]\d{1,9})?)?(?:Z|[-+]\d\d:?\d\d)?(?![\w.:])|\d{1,4}-\d\d?-\d\d?(?![\w.-])|\d\d?:\d\d:\d\d(?:[.,]\d{1,6})?(?![\w.:])|\d{1,4}\/\d\d?\/\d{1,4}(?![\w./]))|([-+\u2212]?(?:\d{1,40}\.?\d{0,40}|\.\d{1,40})(?:[eEdD][-+]?\d{1,4})?[fFdDlL]?)(s|sec|secs|ms|deg|rad|mm|cm|m|fps|hz)?(?![\w.])|([-+]?(?:nan(?:\([a-z]*\))?|inf|infinity)(?!\w)|[-+]?\d\.#\w+)|([\w\u00aa-\u1fff\u2c00-\uffff][\w.\-\u00aa-\u1fff\u2c00-\uffff]*(?::[A-Za-z_][\w.-]*)*)|(\S)/gi;

/** The words among the tokens, in lower case. */
export function wordsOf(tokens: readonly Token[]): string[] {
  return tokens.filter(({ kind }) => kind === 'word').map(({ text }) => text.toLowerCase());
}

/** Whether it may be somebody's name, or of a sentence. */
export function isStrange({ kind, text }: Token): boolean {
  return kind === 'word' && !isPlain(text.toLowerCase());
}

/** Whether it is neither a component's name nor, as in `vec3(`, that of a function. */
export function isTelling(tokens: readonly Token[], at: number): boolean {
  const { kind, text, to } = tokens[at];
  if (kind !== 'word' || isComponent(text.toLowerCase())) return false;
  const next = tokens.at(at + 1);
  return !(next && /^[([{]$/.test(next.text) && (next.from === to || isPlain(text.toLowerCase())));
}

/** Whether a token can be an index: digits alone, less than 10⁹. */
export function isIndex({ kind, text, value }: Token): boolean {
  return kind === 'number' && /^\d+$/.test(text) && value < 1e9;
}

/** Whether a token is a whole number, with or without a sign. */
export function isWhole({ text }: Token): boolean {
  return /^[-+]?\d+$/.test(text);
}

/** The last word before token `before`, in lower case; empty if there is none. */
export function lastWord(tokens: readonly Token[], before: number): string {
  for (let i = before - 1; i >= 0; i--) if (tokens[i].kind === 'word') return tokens[i].text.toLowerCase();
  return '';
}

/**
 * All numbers of a line, in order.
 * @param more those behind the tokens
 */
export function numbersOf(tokens: readonly Token[], more: readonly number[]): number[] {
  const numbers = tokens.filter(({ kind }) => kind === 'number').map(({ value }) => value);
  for (const value of more) numbers.push(value);
  return numbers;
}
