/**
 * The lines of an Acclaim file: words between blanks, up to a `#`. LF, CR and CRLF end a line.
 *
 * Both kinds of files are read whole: a skeleton is small, and a motion needs its skeleton first.
 */
import { parseDecimal } from '../decimal.ts';
import { type Place, Places } from '../places.ts';
import type { Report } from '../report.ts';
import { shortName, textOf, whyNoNumber } from '../words.ts';

const LF = 10;
const CR = 13;
const HASH = 35;

/** A word of the current line: bytes [from, to). */
export interface Word {
  readonly from: number;
  readonly to: number;
}

/** Goes through the lines of a file, and reports problems at their words. */
export class AcclaimLines {
  /** The words of the current line, without a comment. Parentheses are blanks. */
  words: Word[] = [];
  /** Bytes [start, stop) of the current line, a comment included. */
  start = 0;
  stop = 0;
  private next = 0;
  private places: Places | undefined;

  constructor(
    readonly bytes: Uint8Array,
    readonly report: Report,
  ) {
    if (bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf) this.next = 3;
  }

  /** Moves to the next line that starts at or after `from`; false at the end. */
  line(from = this.next): boolean {
    const { bytes } = this;
    let i = from;
    if (i >= bytes.length) return false;
    this.start = i;
    const words: Word[] = [];
    let word = -1;
    let isComment = false;
    for (; i < bytes.length; i++) {
      const c = bytes[i];
      if (c === LF || c === CR) break;
      if (isComment) continue;
      const isBlank = c === 32 || c === 9 || c === 40 || c === 41;
      if (c === HASH) isComment = true;
      if ((isBlank || isComment) && word >= 0) {
        words.push({ from: word, to: i });
        word = -1;
      } else if (!isBlank && !isComment && word < 0) word = i;
    }
    if (word >= 0) words.push({ from: word, to: i });
    this.stop = i;
    this.words = words;
    if (bytes[i] === CR && bytes[i + 1] === LF) i++;
    this.next = i + 1;
    return true;
  }

  /** Where the line after the current one starts. */
  get after(): number {
    return this.next;
  }

  /** The text of a word of the current line; '' if it has no such word. */
  text(index: number): string {
    const word = this.words[index];
    return word ? textOf(this.bytes, word.from, word.to) : '';
  }

  /** A word of the current line in lower case; '' if it has no such word, or a long one. */
  keyword(index: number): string {
    const word = this.words[index];
    return word && word.to - word.from < 64 ? this.text(index).toLowerCase() : '';
  }

  /** The current line as it is, without blanks around it. */
  whole(): string {
    return textOf(this.bytes, this.start, this.stop).trim();
  }

  /** The text from a word to the end of the line, a comment left out. */
  rest(index: number): string {
    const [first, last] = [this.words[index], this.words.at(-1)];
    return first && last ? textOf(this.bytes, first.from, last.to) : '';
  }

  /** A number; undefined, and an error, if the word is none or missing. @param what such as `the length` */
  number(index: number, what: string): number | undefined {
    const word = this.words[index];
    if (!word) {
      this.error('number-expected', `Expected ${what}, found the end of the line.`, index);
      return undefined;
    }
    const value = parseDecimal(this.bytes, word.from, word.to);
    if (value - value === 0) return value;
    const { code, why } = whyNoNumber(this.text(index));
    this.error(code, `Expected ${what}, found "${shortName(this.text(index))}"${why}.`, index);
    return undefined;
  }

  /** The place of a word, or of the end of the line if it has no such word. */
  place(index: number): Place {
    const { words, start, stop } = this;
    return this.placeAt(words[index]?.from ?? Math.max(start, Math.min(stop, this.bytes.length) - 1));
  }

  /** The place of a byte, which must not be a line end. */
  placeAt(at: number): Place {
    const { bytes } = this;
    if (!this.places) {
      this.places = new Places();
      this.places.enter(bytes, 0, bytes.length, 0);
    }
    return this.places.place(Math.min(at, Math.max(0, bytes.length - 1)));
  }

  /** Reports an error at a word of the current line. */
  error(code: string, message: string, index = 0): void {
    if (this.report.hasRoom('error')) this.report.error(code, message, this.place(index));
    else this.report.error(code, message, { line: 0, column: 0 });
  }

  /** Reports a warning at a word of the current line. @param assumed what was done instead */
  warn(code: string, message: string, assumed: string, index = 0): void {
    this.report.warn(
      code,
      message,
      this.report.hasRoom('warning') ? this.place(index) : { line: 0, column: 0 },
      assumed,
    );
  }

  /** A warning about an unknown word, once for all that are equal. */
  warnUnknown(what: string, expected: string): void {
    const word = shortName(this.text(0));
    if (this.report.foldsInto('keyword-unknown', `${what} ${word}`)) return;
    const message = `Expected ${expected} in ${what}, found "${word}".`;
    this.report.warnFolded('keyword-unknown', `${what} ${word}`, message, this.place(0), 'skipped its line');
  }
}
