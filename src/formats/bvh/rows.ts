/**
 * The rows of a `.bvh`, from bytes directly into the sample array.
 *
 *     a row is as many numbers as there are channels        it may span several lines, but begins on a new line
 *
 * So a row is read without looking at line ends, by the same loop as all numbers (`scan.ts`), and it is only checked
 * that a line ends where the row does. If not, the current line contains too many numbers: either it began with the
 * row, or the previous row was short. Both end the reading, since from there on values can't be assigned.
 *
 * Anything but a complete row after the last one ends the motion with a warning: a truncated row, or words at the start
 * of a line. If more rows follow, it is a broken row in the middle.
 *
 * Memory: a declared count is trusted only as far as the available bytes, or the average size of a number so far,
 * support it.
 */
import { type GrammarPart, looksNumeric } from '../grammar.ts';
import { NO_PLACE, type Place } from '../places.ts';
import { ParseError } from '../report.ts';
import { AT_END, CR, FULL, LF, type Scan, scanNumbers } from '../scan.ts';
import type { Tokens } from '../tokens.ts';

/** Initial capacity in numbers where no count is declared; half a megabyte. */
const AT_FIRST = 65536;
/** A declared count is trusted up to this factor of the estimate from bytes. */
const TRUSTED = 1.3;

/** Reads the rows of MOTION into one array of frames, `width` numbers each, and reports where they break off. */
export class Rows {
  private values: Float64Array;
  /** Numbers read. */
  private count = 0;
  /** Index of the current row's first number. */
  private row = 0;
  /** Its position in the current piece; or `rowPlace` if those bytes were released. */
  private rowAt = 0;
  private rowPlace: Place | undefined;
  /** Numbers of the current line in released pieces. */
  private onLine = 0;
  /** Whether the current row contains something other than numbers, which was reported. */
  private isBroken = false;
  private bytesRead = 0;
  private readonly declared: number;
  private readonly scan: Scan = { at: 0, count: 0, limit: 0, lineFeeds: 0 };

  /**
   * @param width numbers per row
   * @param frames as declared
   * @param byteLength of the whole file
   */
  constructor(
    private readonly t: Tokens,
    private readonly width: number,
    frames: number | undefined,
    private readonly byteLength: number | undefined,
  ) {
    this.declared = frames !== undefined && frames > 0 ? Math.ceil(frames) * width : 0;
    const atHand = Math.min(t.numbersAtHand(), this.declared || AT_FIRST);
    this.values = new Float64Array(Math.max(width, Math.ceil(atHand / (width || 1)) * width));
  }

  /** Complete rows. */
  get frameCount(): number {
    return this.width === 0 ? 0 : Math.floor(this.count / this.width);
  }

  /** The numbers read, trimmed; a small rest of the memory is not worth a copy. */
  all(): Float64Array {
    const length = this.frameCount * this.width;
    return this.values.length - length > length / 8 ? this.values.slice(0, length) : this.values.subarray(0, length);
  }

  /** Everything to the end of the file. */
  *read(): GrammarPart<void> {
    const { t, width } = this;
    for (;;) {
      if ((yield* t.next()) === 'end') break;
      if (t.startsLine) this.onLine = 0;
      if (this.count - this.row === width) {
        if (!t.startsLine) this.failAtOverfull();
        this.row = this.count;
      }
      if (this.count === this.row) {
        this.rowAt = t.tokenAt;
        this.rowPlace = undefined;
        this.isBroken = false;
      }
      const value = t.value();
      if (width > 0 && value - value === 0) {
        t.again();
        this.scanRows();
        continue;
      }
      // From here on the row's bytes may be released any time.
      this.rowPlace ??= t.report.hasRoom('error') ? t.placeAt(this.rowAt) : NO_PLACE;
      if (width === 0 || (t.startsLine && !looksNumeric(t))) {
        yield* this.skipTrailing();
        break;
      }
      t.notANumber('a value of a channel');
      this.isBroken = true;
      this.makeRoom();
      this.values[this.count++] = 0;
    }
    this.tellIncomplete();
  }

  /** Reads all rows in the current piece, and the start of another. The current token is a number. */
  private scanRows(): void {
    const { t, width, scan } = this;
    const { bytes, from, at, end } = t.pieceAtHand();
    // Position up to which passed LFs were reported, and their number since.
    let since = at;
    let lineFeeds = 0;
    let rowsFeeds = 0;
    let why = AT_END;
    // Numbers before the current row, or the part of it in this piece.
    let before = this.count;
    scan.at = at;
    for (;;) {
      this.makeRoom();
      scan.count = this.count;
      scan.limit = this.row + width;
      const start = scan.at;
      before = this.count;
      why = scanNumbers(bytes, end, this.values, scan, undefined);
      this.bytesRead += scan.at - start;
      lineFeeds = scan.lineFeeds;
      this.count = scan.count;
      if (why !== FULL || !startsLine(bytes, scan.at, at)) break;
      rowsFeeds = rowsFeeds < 0 || lineFeeds < 0 ? -1 : rowsFeeds + lineFeeds;
      lineFeeds = 0;
      this.row = this.count;
      this.rowAt = since = scan.at;
      this.rowPlace = undefined;
      this.isBroken = false;
      this.onLine = 0;
    }
    // In two parts, so that the position between them is found without counting.
    t.passed(at, since, rowsFeeds);
    t.passed(since, scan.at, lineFeeds);
    if (why === AT_END) {
      this.rowPlace ??= t.placeAt(this.rowAt);
      this.onLine = lineFeeds === 0 ? this.onLine + this.count - before : this.numbersOnLine(bytes, from, end);
    }
    // The tokeniser determines whether the next token starts a line.
    let behind = scan.at;
    while (behind > at && isSeparator(bytes[behind - 1])) behind--;
    t.goOnFrom(behind);
  }

  /** Numbers before `to` on its line if there is nothing else, including those in released pieces. */
  private numbersOnLine(bytes: Uint8Array, from: number, to: number): number {
    let numbers = 0;
    for (let i = to - 1; i >= from; i--) {
      const c = bytes[i];
      if (c === LF || c === CR) return numbers;
      if (!isSeparator(c) && (i === from || isSeparator(bytes[i - 1]))) numbers++;
    }
    return this.onLine + numbers;
  }

  /** For the current row. */
  private makeRoom(): void {
    const needed = this.row + this.width;
    if (needed <= this.values.length) return;
    const grown = new Float64Array(Math.max(needed, this.nextLength()));
    grown.set(this.values);
    this.values = grown;
  }

  /** Estimated capacity for the rest of the file from the bytes per number so far; otherwise half as much again. */
  private nextLength(): number {
    const { byteLength, bytesRead, count, declared } = this;
    const length = 1.5 * this.values.length;
    const expected = byteLength && bytesRead > 0 ? (byteLength / bytesRead) * count : length;
    if (declared > count && declared <= TRUSTED * Math.max(expected, length)) return declared;
    return Math.ceil(Math.max(1.02 * expected, length));
  }

  /** The current row is full but its line is not: the current token is one too many. */
  private failAtOverfull(): never {
    const { t, width } = this;
    // Most likely an extra word.
    if (this.isBroken) throw new ParseError('row');
    const { bytes, from } = t.pieceAtHand();
    const before = width - this.numbersOnLine(bytes, from, t.tokenAt);
    if (before <= 0)
      t.error('row-too-long', `Expected ${width} numbers per row, one per channel, found more on this line.`);
    else {
      const { line } = t.place();
      const message = `Expected ${width} numbers per row, one per channel, found ${before}; line ${line} has too many to complete it.`;
      t.report.error('row-incomplete', message, this.rowPlace ?? t.placeAt(this.rowAt));
    }
    throw new ParseError('row');
  }

  /** At the start of a line that is no row: warns, and skips to the end, which must not contain more rows. */
  private *skipTrailing(): GrammarPart<void> {
    const { t, width } = this;
    const found = t.found();
    const place = t.place();
    let numbers = 0;
    while ((yield* t.next()) !== 'end') {
      const value = t.value();
      numbers = value - value === 0 && (numbers > 0 || t.startsLine) ? numbers + 1 : 0;
      if (numbers < width || width === 0) continue;
      t.report.error(
        'row-expected',
        `Expected a row of ${width} numbers, found ${found}, with more rows below.`,
        place,
      );
      throw new ParseError('row-expected');
    }
    const expected = width === 0 ? 'no rows, since there are no channels' : `a row of ${width} numbers`;
    t.report.warn('rows-end', `Expected ${expected}, found ${found}.`, place, 'motion ends before it');
  }

  /** The last row is short. */
  private tellIncomplete(): void {
    const { t, width } = this;
    const found = this.count - this.row;
    if (found === 0 || found === width) return;
    const message = `Expected ${width} numbers in the last row, one per channel, found ${found}.`;
    t.report.warn('row-incomplete', message, this.rowPlace ?? t.placeAt(this.rowAt), 'motion ends before it');
  }
}

/** Whether there are only blanks between a line end and `at`. */
function startsLine(bytes: Uint8Array, at: number, from: number): boolean {
  let i = at - 1;
  while (i >= from && (bytes[i] === 32 || bytes[i] === 9)) i--;
  return i >= from && (bytes[i] === LF || bytes[i] === CR);
}

function isSeparator(c: number): boolean {
  return c === 32 || c === LF || c === 9 || c === CR;
}
