/**
 * The lines and tokens of a whole file in memory, for the search for the place of an error. Only lines with tokens
 * count as neighbours; line numbers are those of `places.ts`: a run of CRs followed by LF is one line end, any other CR
 * is one each.
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { parseDecimal } from '../decimal.ts';
import { excerptOf, type Place, Places } from '../places.ts';
import { CR, LF, tokenEnd } from '../scan.ts';
import { textOf } from '../words.ts';

const TAB = 9;
const BLANK = 32;
const OPEN = 123;
const CLOSE = 125;

/** A number, or meant as one; any other word; a brace. */
export type TokenClass = 'n' | 'w' | '{' | '}';

/** Bytes [start, stop). */
export interface TextToken {
  readonly start: number;
  readonly stop: number;
  readonly class: TokenClass;
}

/** Facts that the search for an error needs to know about a line, without its tokens. */
export interface RowFacts {
  /** Class of the first token. */
  readonly first: TokenClass;
  /** Number of tokens. */
  readonly count: number;
  readonly hasBrace: boolean;
}

const CLASSES = ['n', 'w', '{', '}'] as const satisfies readonly TokenClass[];
const HAS_BRACE = 4;

/** The lines and tokens of a whole file in UTF-8, with or without BOM. */
export class TextLines {
  /** Offset of each line's first byte, and behind them the length of the file. */
  private readonly starts: number[] = [];
  /** A number for each line: 8 · its tokens, `HAS_BRACE`, and the class of its first. */
  private readonly facts: number[] = [];
  /** The lines that have tokens, from 1, ascending. */
  readonly filled: number[] = [];
  private readonly places = new Places();

  constructor(readonly bytes: Uint8Array) {
    const bom = bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf ? 3 : 0;
    this.places.enter(bytes, bom, bytes.length, bom);
    let start = bom;
    let facts = 0;
    const endLine = (next: number) => {
      this.starts.push(start);
      this.facts.push(facts);
      if (facts > 0) this.filled.push(this.starts.length);
      start = next;
      facts = 0;
    };
    for (let i = bom; i < bytes.length; ) {
      const c = bytes[i];
      if (c === BLANK || c === TAB) i++;
      else if (c === LF) endLine(++i);
      else if (c === CR) {
        let last = i;
        while (bytes[last] === CR) last++;
        if (bytes[last] === LF) endLine(last + 1);
        // Without an LF behind them, each is a line end.
        else for (let each = i; each < last; each++) endLine(each + 1);
        i = Math.max(last, start);
      } else {
        const isBrace = c === OPEN || c === CLOSE;
        if (facts === 0) facts = CLASSES.indexOf(classOf(bytes, i));
        facts += 8;
        if (isBrace) facts |= HAS_BRACE;
        i = isBrace ? i + 1 : tokenEnd(bytes, i, bytes.length);
      }
    }
    endLine(bytes.length);
    this.starts.push(bytes.length);
  }

  /** Number of lines, those without tokens too. */
  get count(): number {
    return this.starts.length - 1;
  }

  /** Tokens of a line, from 1. */
  tokens(line: number): readonly TextToken[] {
    return this.tokensTo(line, Number.POSITIVE_INFINITY);
  }

  /** The first token of a line that has one. */
  head(line: number): TextToken {
    return this.tokensTo(line, 1)[0];
  }

  private tokensTo(line: number, most: number): TextToken[] {
    const { bytes } = this;
    const end = this.starts[line];
    const tokens: TextToken[] = [];
    for (let i = this.starts[line - 1]; i < end && tokens.length < most; ) {
      const c = bytes[i];
      if (c === BLANK || c === TAB || c === CR || c === LF) {
        i++;
        continue;
      }
      const stop = c === OPEN || c === CLOSE ? i + 1 : tokenEnd(bytes, i, end);
      tokens.push({ start: i, stop, class: classOf(bytes, i) });
      i = stop;
    }
    return tokens;
  }

  /** Facts about a line, without a list of its tokens. */
  row(line: number): RowFacts {
    const facts = this.facts[line - 1];
    return { first: CLASSES[facts & 3], count: facts >> 3, hasBrace: (facts & HAS_BRACE) !== 0 };
  }

  /** Columns before a line's first token. */
  indent(line: number, tabWidth: number): number {
    let column = 0;
    for (let i = this.starts[line - 1]; i < this.starts[line]; i++) {
      if (this.bytes[i] === TAB) column += tabWidth - (column % tabWidth);
      else if (this.bytes[i] === BLANK) column++;
      else break;
    }
    return column;
  }

  /** The text of a token, as it is in the file. */
  text({ start, stop }: TextToken): string {
    return textOf(this.bytes, start, stop);
  }

  /** NaN if it is not a number. */
  value({ start, stop }: TextToken): number {
    return parseDecimal(this.bytes, start, stop);
  }

  /** The last line with tokens before one; 0 if there is none. */
  lineBefore(line: number): number {
    return this.filled[this.indexOf(line) - 1] ?? 0;
  }

  /** The first line with tokens after one; 0 if there is none. */
  lineAfter(line: number): number {
    const at = this.indexOf(line);
    return this.filled[this.filled[at] === line ? at + 1 : at] ?? 0;
  }

  /** The token at a column, from 1 in characters, or the first one after it on its line. */
  tokenAt(line: number, column: number): { readonly tokens: readonly TextToken[]; readonly index: number } | undefined {
    if (line < 1 || line > this.count) return undefined;
    let at = this.starts[line - 1];
    for (let left = column - 1; left > 0 && at < this.starts[line]; left--) {
      at++;
      while ((this.bytes[at] & 0xc0) === 0x80) at++;
    }
    const tokens = this.tokens(line);
    const index = tokens.findIndex(({ stop }) => stop > at);
    return index < 0 ? undefined : { tokens, index };
  }

  /** Where a byte that is no line end is, and its line to show. */
  at(offset: number): Pick<Diagnostic, 'line' | 'column' | 'excerpt'> {
    const place: Place = this.places.place(offset);
    const excerpt = excerptOf(place);
    return { line: place.line, column: place.column, ...(excerpt && { excerpt }) };
  }

  /** Index of the first of `filled` that is not before a line. */
  private indexOf(line: number): number {
    const { filled } = this;
    let low = 0;
    let high = filled.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (filled[middle] < line) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

function classOf(bytes: Uint8Array, at: number): TokenClass {
  const c = bytes[at];
  if (c === OPEN) return '{';
  if (c === CLOSE) return '}';
  return looksNumeric(c, bytes[at + 1]) ? 'n' : 'w';
}

function looksNumeric(first: number, second: number): boolean {
  if (isDigit(first)) return true;
  return (first === 43 || first === 45 || first === 46) && (isDigit(second) || second === 46);
}

function isDigit(c: number): boolean {
  return c >= 48 && c <= 57;
}
