/**
 * Parts that the writers share: numbers as the shortest decimals that read back the same, names adapted to the format,
 * text built from pieces.
 *
 * Tabs, LF, one blank between numbers, as in the course's own files. Rejected: aligned columns, which need two passes,
 * make files a third larger, and would not align the shortest decimals at their points anyway.
 */

import type { Diagnostic } from '../model/diagnostic.ts';
import { cutMessage } from '../model/names/cut-text.ts';
import { oneToken, restOfLine, wellFormed } from '../model/names/written-names.ts';
import { UserError } from '../model/user-error.ts';
import { NO_PLACE } from './places.ts';
import type { WriteResult } from './reader.ts';
import { Report } from './report.ts';

/** Thrown for a number that no file can hold, such as NaN; the message says which. No file is written then. */
export class UnwritableError extends UserError {
  override readonly name = 'UnwritableError';
}

/** Pieces joined at a time, so that a million rows are not held as a million strings. */
const BATCH = 1024;
/** Deeper nesting is not indented further: a chain of 100,000 joints would be 10 GB of tabs. */
const DEEPEST = 40;

/** Builds a text file line by line, in batches, and reports what the format can't hold. */
export class Text {
  private subject = '';
  /** The row of the subject that is being written, from 1; 0 for none. */
  row = 0;
  private readonly report: Report;
  private lines: string[] = [];
  private readonly done: string[] = [];

  constructor(fileName: string) {
    this.report = new Report(fileName);
  }

  /** Names what the numbers that follow belong to, for errors: `joint 3 "hand"`. */
  about(subject: string): void {
    this.subject = subject;
    this.row = 0;
  }

  /** Adds a line, indented by `depth` tabs, 40 at most. */
  line(depth: number, text: string): void {
    this.lines.push('\t'.repeat(Math.min(depth, DEEPEST)) + text);
    if (this.lines.length < BATCH) return;
    this.done.push(`${this.lines.join('\n')}\n`);
    this.lines = [];
  }

  /** `what N {`, rows of `width` numbers, `}`. */
  rows(what: string, width: number, values: ArrayLike<number>): void {
    const count = Math.floor(values.length / width);
    this.line(0, `${what} ${count} {`);
    this.about(what);
    for (let i = 0; i < count; i++) {
      this.row = i + 1;
      let row = this.number(values[width * i]);
      for (let k = 1; k < width; k++) row += ` ${this.number(values[width * i + k])}`;
      this.line(1, row);
    }
    this.line(0, '}');
  }

  /** The numbers, each as the shortest decimal that reads back the same, with blanks between. */
  numbers(values: readonly number[]): string {
    return values.map((v) => this.number(v)).join(' ');
  }

  /**
   * The shortest decimal that reads back the same; -0 too.
   * @throws UnwritableError for a number that isn't finite: any other number in its place would be another model
   */
  number(value: number): string {
    if (value === 0) return Object.is(value, -0) ? '-0' : '0';
    if (value - value === 0) return `${value}`;
    const where = `${this.subject && ` in ${this.subject}`}${this.row ? `, row ${this.row}` : ''}`;
    const message = `Expected finite numbers, found ${value}${where}. Change or remove it, and save again.`;
    throw new UnwritableError(cutMessage(message));
  }

  /** A name as one token, preceded by a blank; nothing for an empty one. */
  name(name: string, what: string): string {
    if (name === '') return '';
    return ` ${this.changed(name, oneToken(name), what)}`;
  }

  /** A name as the rest of its line, preceded by a blank; nothing for an empty one. */
  lineName(name: string, what: string): string {
    if (name === '') return '';
    return ` ${this.changed(name, restOfLine(name), what)}`;
  }

  /** A file name: unquoted if it is a single token, else in quotes. */
  file(name: string, what: string): string {
    const fit = this.changed(name, wellFormed(name).replace(/[\r\n"]/g, '_'), what);
    return /^[^ \t{}]+$/.test(fit) ? fit : `"${fit}"`;
  }

  /** An info about what the format can't store. */
  left(code: string, message: string): void {
    this.report.info(code, message, NO_PLACE, 'left out');
  }

  /** An info that the file's form had to change. */
  changedForm(message: string): void {
    this.report.info('form-changed', message, NO_PLACE, 'wrote the hierarchy form');
  }

  private changed(name: string, fit: string, what: string): string {
    if (fit !== name) {
      const message = `The ${what} ${JSON.stringify(name)} can't be written as it is.`;
      this.report.info('name-changed', message, NO_PLACE, `wrote ${JSON.stringify(fit)}`);
    }
    return fit;
  }

  /** Takes the lines so far; `result` then contains only those after them. */
  takeText(): string {
    const rest = this.lines.length ? `${this.lines.join('\n')}\n` : '';
    const text = this.done.join('') + rest;
    this.lines = [];
    this.done.length = 0;
    return text;
  }

  /** The text since the last `takeText`, with all diagnostics. */
  result(): WriteResult {
    const text = this.takeText();
    const diagnostics: readonly Diagnostic[] = this.report.finish();
    return { text, diagnostics };
  }
}
