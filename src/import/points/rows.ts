/** Rows of cells in a text: found byte by byte, without a string or an object for each. */
import { parseDecimal } from '../../formats/decimal.ts';
import type { Place } from '../../formats/places.ts';
import { CR, LF } from '../../formats/scan.ts';
import { FARTHEST, fail } from './table.ts';

/** The byte of a tab. */
export const TAB = 9;
/** The byte of a comma. */
export const COMMA = 44;
const BLANK = 32;
const QUOTE = 34;
const POINT = 46;
const UTF8 = new TextDecoder('utf-8');

/** The rows of a text, one after the other. */
export class Rows {
  /** Of the current row, from 1. */
  line = 0;
  /** Cells of the current row; without those that are empty at its end. */
  count = 0;
  private starts: Int32Array = new Int32Array(64);
  private ends: Int32Array = new Int32Array(64);
  private at = 0;
  private lineStart = 0;
  private lineEnd = 0;

  /** @param separator of cells, a byte */
  constructor(
    readonly bytes: Uint8Array,
    private readonly separator: number,
  ) {
    if (bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf) this.at = 3;
  }

  /** Goes on to the next row; false if there is none. */
  next(): boolean {
    const { bytes, separator } = this;
    const end = bytes.length;
    if (this.at >= end) return false;
    this.line++;
    this.count = 0;
    this.lineStart = this.at;
    let cells = 0;
    let start = this.at;
    let at = start;
    let isQuoted = false;
    let isBlank = true;
    for (; ; at++) {
      const c = at < end ? bytes[at] : LF;
      // Quotes hold separators of tables, in cells that begin with one.
      if (c === QUOTE && (isQuoted || (isBlank && separator !== TAB))) isQuoted = !isQuoted;
      isBlank &&= c === BLANK;
      const isEnd = c === LF || c === CR;
      if (!isEnd && (c !== separator || isQuoted)) continue;
      if (this.cell(cells, start, at)) this.count = cells + 1;
      cells++;
      start = at + 1;
      isQuoted = false;
      isBlank = true;
      if (isEnd) break;
    }
    this.lineEnd = at;
    // Any number of CRs before an LF are one line end.
    let next = at;
    while (next < end && bytes[next] === CR) next++;
    this.at = next < end && bytes[next] === LF ? next + 1 : at + 1;
    return true;
  }

  /** Keeps the range of a cell, without blanks and quotes around it; false if nothing is left. */
  private cell(c: number, from: number, to: number): boolean {
    const { bytes, separator } = this;
    let [start, end] = [from, to];
    while (start < end && (bytes[start] === BLANK || bytes[start] === TAB)) start++;
    while (end > start && (bytes[end - 1] === BLANK || bytes[end - 1] === TAB)) end--;
    if (separator !== TAB && end - start > 1 && bytes[start] === QUOTE && bytes[end - 1] === QUOTE) {
      start++;
      end--;
    }
    if (c >= this.starts.length) {
      this.starts = grown(this.starts);
      this.ends = grown(this.ends);
    }
    this.starts[c] = start;
    this.ends[c] = end;
    return end > start;
  }

  /** Whether nothing is in a cell, or it says that it is no number. */
  isMissing(c: number): boolean {
    if (c >= this.count) return true;
    const { bytes, starts, ends } = this;
    const [start, length] = [starts[c], ends[c] - starts[c]];
    if (length === 0) return true;
    return (
      length === 3 && (bytes[start] | 32) === 110 && (bytes[start + 1] | 32) === 97 && (bytes[start + 2] | 32) === 110
    );
  }

  /** The number of a cell. @throws PointsError if it is none */
  number(c: number): number {
    const value = this.numberOrNone(c);
    if (Math.abs(value) < FARTHEST) return value;
    return fail('number-expected', `Expected a number, found ${this.found(c)}.`, this.place(c));
  }

  /** The number of a cell; NaN if it is none. */
  numberOrNone(c: number): number {
    if (c >= this.count) return Number.NaN;
    const value = parseDecimal(this.bytes, this.starts[c], this.ends[c]);
    return Number.isNaN(value) && this.separator !== COMMA ? this.numberWithComma(c) : value;
  }

  /** Where commas don't separate cells, one may be the decimal sign; NaN if it is none. */
  private numberWithComma(c: number): number {
    const { bytes, starts, ends } = this;
    const length = ends[c] - starts[c];
    const comma = bytes.subarray(starts[c], ends[c]).indexOf(COMMA);
    if (comma < 0 || length > pointed.length) return Number.NaN;
    pointed.set(bytes.subarray(starts[c], ends[c]));
    pointed[comma] = POINT;
    return parseDecimal(pointed, 0, length);
  }

  /** The text of a cell; empty if there is none. */
  text(c: number): string {
    return c < this.count ? UTF8.decode(this.bytes.subarray(this.starts[c], this.ends[c])) : '';
  }

  /** All cells of the row. */
  texts(): readonly string[] {
    return Array.from({ length: this.count }, (_, c) => this.text(c));
  }

  /** Whether a cell has the same text as one that was kept. */
  isSame(c: number, text: Uint8Array): boolean {
    if (c >= this.count) return text.length === 0;
    const { bytes, starts, ends } = this;
    if (ends[c] - starts[c] !== text.length) return false;
    for (let i = 0; i < text.length; i++) if (bytes[starts[c] + i] !== text[i]) return false;
    return true;
  }

  /** A copy of the bytes of a cell. */
  bytesOf(c: number): Uint8Array {
    return c < this.count ? this.bytes.slice(this.starts[c], this.ends[c]) : new Uint8Array(0);
  }

  /** Where a cell is; the start of the row of one that isn't there. */
  place(c = 0): Place {
    const { bytes, lineStart, lineEnd } = this;
    const start = c < this.count ? this.starts[c] : lineStart;
    const before = bytes.subarray(lineStart, start);
    return {
      line: this.line,
      column: UTF8.decode(before).length + 1,
      before: before.subarray(-SHOWN),
      after: bytes.subarray(start, Math.min(lineEnd, start + SHOWN)),
    };
  }

  /** For messages. */
  private found(c: number): string {
    return c < this.count ? `“${this.text(c)}”` : 'none';
  }
}

/** Scratch, longer than any number that a program prints. */
const pointed = new Uint8Array(64);

/** Bytes of a row that are shown under a message, to either side. */
const SHOWN = 200;

function grown(array: Int32Array): Int32Array {
  const larger = new Int32Array(2 * array.length);
  larger.set(array);
  return larger;
}

/**
 * Writes a point from three cells that follow each other, or at the columns given; what lacks a number is missing.
 * @throws PointsError if one of them is no number
 */
export function writePoint(rows: Rows, x: number, y: number, z: number, out: Float64Array, o: number): boolean {
  if (rows.isMissing(x) || rows.isMissing(y) || rows.isMissing(z)) return false;
  out[o] = rows.number(x);
  out[o + 1] = rows.number(y);
  out[o + 2] = rows.number(z);
  out[o + 3] = 1;
  return true;
}

/** How many rows a text has. */
export function lineCount(bytes: Uint8Array): number {
  let lines = 1;
  let crs = 0;
  for (let i = 0; i < bytes.length; i++) {
    const c = bytes[i];
    if (c === CR) crs++;
    else {
      // Before an LF they are part of that.
      lines += c === LF ? 1 : crs;
      crs = 0;
    }
  }
  return lines + crs;
}
