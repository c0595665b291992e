/**
 * Tokens over bytes that arrive in pieces, split anywhere: words, `{`, `}`, the end of the file; and number blocks,
 * which `scan.ts` reads without making tokens of them.
 *
 *     separators   blank, tab, CR, LF        braces are tokens also when glued to a word        a UTF-8 BOM is skipped
 *
 * There are no comments: a format that has them skips their line itself (`restOfLine`, which stops before a `{`).
 *
 * The grammar works on one piece of bytes at a time, cut between tokens by `pieces.ts`. Methods that may run out of
 * bytes are generators and suspend there; after that, offsets into the previous piece are invalid.
 */
import type { Severity } from '../model/diagnostic.ts';
import { parseDecimal } from './decimal.ts';
import { BytePieces, lineEnd } from './pieces.ts';
import { NO_PLACE, type Place, Places } from './places.ts';
import { ParseError, Report } from './report.ts';
import { AT_END, type BlockWords, CLOSED, CR, FULL, LF, type Scan, scanNumbers, tokenEnd } from './scan.ts';
import { LONGEST_KEYWORD, textOf, whyNoNumber } from './words.ts';

/** A word (a number is one too), a brace, or the end of the file. */
export type TokenKind = 'word' | '{' | '}' | 'end';

/** Words with a meaning in their context, in lower case, so that they are not taken as misspelt numbers. */
export type Keywords = ReadonlySet<string>;

/** Receives the numbers of a block. */
export interface NumberSink {
  /** Filled from `count` on. Must not be full after a flush. */
  values: Float64Array;
  count: number;
  /** Words allowed among the numbers. */
  readonly words?: BlockWords;
  /**
   * Whether the sink consumes the numbers, and so must be flushed before their bytes are released, while `placeOfSlot`
   * knows each number's place. Otherwise it is flushed when full.
   */
  readonly usesUp: boolean;
  /** Makes room: consumes the numbers and sets `count` to 0, or grows. */
  flush(t: Tokens): void;
  /** Handles a current token that is neither a number nor a known word, and counts as 0. Default: an error. */
  strange?(t: Tokens): void;
}

/** A token whose place may be needed later; see `mark`. */
export class Mark {
  /** Set once the token's bytes are released. */
  place: Place | undefined;

  constructor(
    readonly offset: number,
    /** Index among the marks that may still be needed, in the order of the file. */
    readonly index: number,
  ) {}
}

/** Number of marks at a time that keep their line, so that a chain of a million joints does not keep a million lines. */
const MARKS_WITH_LINES = 1000;
const QUOTE = 34;
/** Bytes after a keyword that are searched for a FILE's extension. */
const FILE_REACH = 1024;

/** The tokens of one file, in order, with the report of its problems. Grammars ask for them one by one. */
export class Tokens {
  readonly report: Report;
  /** The current token: bytes [start, stop) of the piece. */
  kind: TokenKind = 'end';
  private start = 0;
  private stop = 0;
  /** Whether it is the first of its line. */
  startsLine = true;

  private readonly places = new Places();
  private bytes: Uint8Array = new Uint8Array(0);
  private from = 0;
  private at = 0;
  private end = 0;
  private isLastPiece = false;
  private isHeld = false;
  private sawLineEnd = true;
  /** The offset in the file of the next piece's first byte. */
  private base = 0;
  private isFirstPiece = true;
  private readonly pieces = new BytePieces();
  /** Position from which the grammar needs the rest of a line in one piece; -1: none. */
  private lineFrom = -1;
  private marks: Mark[] = [];
  private marksMade = 0;
  /** The current token in lower case, cached on demand. */
  private lowered: string | undefined;
  /** End of the line last examined by `file`. */
  private lineStop = -1;
  private readonly scan: Scan = { at: 0, count: 0, limit: 0, lineFeeds: 0 };
  /** A walk over the numbers in a sink: number `slot` starts at or after `slotAt`. */
  private slotsFrom = 0;
  private slotAt = 0;
  private slot = 0;

  constructor(readonly fileName: string) {
    this.report = new Report(fileName);
  }

  // ——— bytes in ———

  /** Takes a chunk; `resume` runs the grammar until it suspends. */
  feed(chunk: Uint8Array, resume: () => void): void {
    this.pieces.feed(chunk, (bytes, from, to) => this.take(bytes, from, to, resume));
  }

  /** Ends the file. */
  finish(resume: () => void): void {
    this.isLastPiece = true;
    this.pieces.finish((bytes, from, to) => this.take(bytes, from, to, resume));
    this.places.finish();
  }

  private take(bytes: Uint8Array, from: number, to: number, resume: () => void): number {
    if (this.isFirstPiece) {
      this.isFirstPiece = false;
      if (bytes[from] === 0xef && bytes[from + 1] === 0xbb && bytes[from + 2] === 0xbf) {
        from += 3;
        this.base = 3;
      }
    }
    this.bytes = bytes;
    this.lineStop = -1;
    this.from = this.at = this.slotsFrom = this.slotAt = from;
    this.slot = 0;
    this.end = to;
    // The last byte of the last piece was added.
    this.places.enter(bytes, from, this.isLastPiece ? to - 1 : to, this.base);
    resume();
    if (this.isLastPiece) return to;
    const done = this.lineFrom >= 0 ? this.lineFrom : to;
    for (const mark of this.marks) this.placeOf(mark);
    this.marks = [];
    this.places.leave(done);
    this.base += done - from;
    return done;
  }

  // ——— tokens ———

  /** Moves to the next token. */
  *next(): Generator<void, TokenKind, void> {
    while (!this.step()) yield;
    return this.kind;
  }

  /** Makes the next `next()` return the current token again. Must not suspend in between. */
  again(): void {
    this.isHeld = true;
  }

  private step(): boolean {
    if (this.isHeld) {
      this.isHeld = false;
      return true;
    }
    const { bytes, end } = this;
    let i = this.at;
    let c = 0;
    for (; i < end; i++) {
      c = bytes[i];
      if (c === LF || c === CR) this.sawLineEnd = true;
      else if (c !== 32 && c !== 9) break;
    }
    if (i >= end) {
      this.at = i;
      if (!this.isLastPiece) return false;
      this.kind = 'end';
      this.start = this.stop = end - 1;
    } else {
      this.start = i;
      this.stop = c === 123 || c === 125 ? i + 1 : tokenEnd(bytes, i, end);
      this.kind = c === 123 ? '{' : c === 125 ? '}' : 'word';
      this.at = this.stop;
    }
    this.startsLine = this.sawLineEnd;
    this.sawLineEnd = false;
    this.lowered = undefined;
    return true;
  }

  /** The text of the current word. */
  text(): string {
    return textOf(this.bytes, this.start, this.stop);
  }

  /** The current word in lower case; '' for anything but a short word. */
  keyword(): string {
    if (this.kind !== 'word' || this.stop - this.start > LONGEST_KEYWORD) return '';
    this.lowered ??= this.text().toLowerCase();
    return this.lowered;
  }

  /** The current number; NaN for anything else, infinite on overflow. */
  value(): number {
    return this.kind === 'word' ? parseDecimal(this.bytes, this.start, this.stop) : Number.NaN;
  }

  /** The current token for a message. */
  found(): string {
    if (this.kind === 'end') return 'the end of the file';
    let text = textOf(this.bytes, this.start, Math.min(this.stop, this.start + 4 * LONGEST_KEYWORD));
    if (text.length > LONGEST_KEYWORD) text = `${text.slice(0, LONGEST_KEYWORD)}…`;
    return `"${text}"`;
  }

  /** The place of the current token. */
  place(): Place {
    return this.places.place(this.start);
  }

  /** Marks the current token: its place is found only if `placeOf` is called, or when its bytes are released. */
  mark(): Mark {
    const mark = new Mark(this.start, this.marksMade++);
    this.marks.push(mark);
    return mark;
  }

  /** The place of a mark will not be needed. Saves finding it if that is the last mark. */
  forget(mark: Mark): void {
    if (mark.index === this.marksMade - 1) this.forgetFrom(mark);
  }

  /** Neither the place of a mark will be needed nor those of later ones: what it opened is closed. */
  forgetFrom({ index }: Mark): void {
    this.marksMade = index;
    // Those of earlier pieces have their places and are in the list no more.
    while (this.marks.length > 0 && this.marks[this.marks.length - 1].index >= index) this.marks.pop();
  }

  /** For a diagnostic of that severity: not searched if it would only be counted. */
  placeOf(mark: Mark, severity?: Severity): Place {
    if (severity && !mark.place && !this.report.hasRoom(severity)) return NO_PLACE;
    mark.place ??= this.places.place(mark.offset, mark.index < MARKS_WITH_LINES);
    return mark.place;
  }

  /** The line of a mark, from 1. */
  lineOf(mark: Mark): number {
    return mark.place?.line ?? this.places.lineAt(mark.offset);
  }

  // ——— the rest of a line ———

  /**
   * Skips an unknown keyword's content: the rest of its line, and if that opens a brace, everything to the matching
   * one. A brace alone at the start of the next line belongs to it.
   */
  *skipUnknown(): Generator<void, void, void> {
    const stopped = yield* this.skipTo(0, true);
    if (stopped === 'skipped') return;
    if (stopped === 'end') this.failAtEnd(undefined, 'a block that is skipped');
    if ((yield* this.next()) === '{') yield* this.skipBlock();
    else this.again();
  }

  /** Skips to the `}` of the current `{`. */
  *skipBlock(): Generator<void, void, void> {
    const opened = this.mark();
    if ((yield* this.skipTo(1, false)) === 'end') this.failAtEnd(opened, 'a block that is skipped');
    this.forget(opened);
  }

  /** Stops after the `}` that returns to depth 0, before one that would go below, or before a line end at depth 0. */
  private *skipTo(depth: number, stopsAtLineEnd: boolean): Generator<void, 'skipped' | 'before' | 'end', void> {
    for (;;) {
      const { bytes, end } = this;
      for (let i = this.at; i < end; i++) {
        const c = bytes[i];
        if (c === 123) depth++;
        else if (c === 125 && depth === 1) {
          this.at = i + 1;
          return 'skipped';
        } else if (depth === 0 && (c === 125 || (stopsAtLineEnd && (c === LF || c === CR)))) {
          this.at = i;
          return 'before';
        } else if (c === 125) depth--;
      }
      this.at = end;
      if (this.isLastPiece) {
        this.step();
        return 'end';
      }
      yield;
    }
  }

  /**
   * A FILE, starting at the current word: a single token; or a name "in quotes"; or the rest of the line. A name with
   * blanks and without quotes ends with the first token that has one of the extensions, or else before a brace, a
   * keyword, or the end of the line.
   */
  *file(extensions: RegExp, keywords: Keywords): Generator<void, string, void> {
    this.at = this.start;
    yield* this.wholeLine();
    const { bytes, lineStop } = this;
    // The word may be in another piece by now.
    let from = this.at;
    this.start = from;
    this.stop = tokenEnd(bytes, from, lineStop);
    if (bytes[from] === QUOTE) {
      let close = from + 1;
      while (close < lineStop && bytes[close] !== QUOTE) close++;
      if (close < lineStop) {
        this.at = tokenEnd(bytes, close + 1, lineStop);
        if (this.at > close + 1)
          this.warn('quote-unexpected', 'Expected a space after "file name".', 'ignored the rest');
        return textOf(bytes, from + 1, close);
      }
      this.error('quote-missing', 'Expected a closing " on the same line, found none.');
      from++;
    }
    let stop = from;
    let isOpen = true;
    let reach = lineStop;
    for (let i = from; i < reach; ) {
      const c = bytes[i];
      if (c === 32 || c === 9) {
        i++;
        continue;
      }
      const end = tokenEnd(bytes, i, lineStop);
      // A brace ends it; but there is a first token, since the caller saw a word.
      if (end === i) break;
      const word = textOf(bytes, i, end);
      if (isOpen && i > from && keywords.has(word.toLowerCase())) {
        isOpen = false;
        reach = Math.min(reach, i + FILE_REACH);
      }
      if (isOpen) stop = end;
      if (extensions.test(word)) {
        stop = end;
        break;
      }
      i = end;
    }
    this.at = stop;
    return textOf(bytes, from, stop);
  }

  /** After the current token: the rest of its line up to a `{`, trimmed. */
  *restOfLine(): Generator<void, string, void> {
    yield* this.wholeLine();
    const { bytes, lineStop } = this;
    let from = this.at;
    let stop = from;
    while (stop < lineStop && bytes[stop] !== 123) stop++;
    this.at = stop;
    while (from < stop && isBlank(bytes[from])) from++;
    while (from < stop && isBlank(bytes[stop - 1])) stop--;
    return textOf(bytes, from, stop);
  }

  /** Ensures that everything from `at` to the end of the line, `lineStop`, is available. */
  private *wholeLine(): Generator<void, void, void> {
    while (this.lineStop < this.at) {
      const lineStop = lineEnd(this.bytes, this.at, this.end);
      if (lineStop < this.end) this.lineStop = lineStop;
      else {
        this.lineFrom = this.at;
        yield;
        this.lineFrom = -1;
      }
    }
  }

  /** Ends the current word after so many bytes. It is the next token again, and the rest the one after it. */
  splitAt(length: number): void {
    this.stop = this.at = this.start + length;
    this.lowered = undefined;
    this.again();
  }

  /** Ends the current word after the first such byte in it; the rest is the next token. */
  endBehind(byte: number): void {
    for (let i = this.start; i < this.stop; i++) {
      if (this.bytes[i] !== byte) continue;
      this.stop = this.at = i + 1;
      this.lowered = undefined;
      return;
    }
  }

  // ——— a format's own loop ———

  /** The current piece of bytes: [from, end), of which those before `at` are read. */
  pieceAtHand(): { readonly bytes: Uint8Array; readonly from: number; readonly at: number; readonly end: number } {
    return { bytes: this.bytes, from: this.from, at: this.isHeld ? this.start : this.at, end: this.end };
  }

  /** Declares that bytes [from, to) of the piece have this many LFs, as `Scan` counts them. */
  passed(from: number, to: number, lineFeeds: number): void {
    this.places.passed(from, to, lineFeeds);
  }

  /** Continues reading there, after a token. */
  goOnFrom(at: number): void {
    this.isHeld = false;
    this.at = at;
  }

  /** Position of the current token in the current piece. */
  get tokenAt(): number {
    return this.start;
  }

  /** The place of a byte of the current piece. */
  placeAt(at: number): Place {
    return this.places.place(at);
  }

  // ——— numbers ———

  /** Maximum number of numbers in the available bytes: the limit of what a declared count may allocate. */
  numbersAtHand(): number {
    return (this.end - this.at) / 2 + 1;
  }

  /**
   * Reads the numbers of a block into a sink, up to its `}`, which is then the current token. A keyword or the end of
   * the file among them is a missing `}`.
   */
  *numbers(sink: NumberSink, what: string, keywords: Keywords): Generator<void, void, void> {
    const { scan } = this;
    if (this.isHeld) {
      this.isHeld = false;
      this.at = this.start;
    }
    this.holdSlots();
    for (;;) {
      scan.at = this.at;
      scan.count = sink.count;
      scan.limit = sink.values.length;
      const why = scanNumbers(this.bytes, this.end, sink.values, scan, sink.words);
      this.places.passed(this.at, scan.at, scan.lineFeeds);
      this.at = scan.at;
      sink.count = scan.count;
      if (why === FULL) this.flush(sink);
      else if (why === AT_END) {
        if (sink.usesUp) this.flush(sink);
        if (this.isLastPiece) {
          this.step();
          this.braceMissing(what);
          return;
        }
        yield;
        this.holdSlots();
      } else {
        // Before what follows is reported, to keep the order of the file.
        if (sink.usesUp) this.flush(sink);
        this.step();
        if (why === CLOSED) return;
        if (this.kind === '{') {
          this.error('brace-unexpected', `Expected a number in ${what}, found "{".`);
          this.holdSlots();
        } else if (keywords.has(this.keyword())) {
          this.braceMissing(what);
          return;
        } else {
          if (sink.strange) sink.strange(this);
          else this.notANumber(`a number in ${what}`);
          sink.values[sink.count++] = 0;
        }
      }
    }
  }

  /** Only in a sink's `flush`: the place of the number `values[slot]`. Fastest in ascending order. */
  placeOfSlot(slot: number): Place {
    return this.places.place(this.offsetOfSlot(slot));
  }

  /** Only its line. */
  lineOfSlot(slot: number): number {
    return this.places.lineAt(this.offsetOfSlot(slot));
  }

  private offsetOfSlot(slot: number): number {
    if (slot < this.slot) {
      this.slot = 0;
      this.slotAt = this.slotsFrom;
    }
    const { bytes, end } = this;
    let at = this.slotAt;
    for (;;) {
      while (at < end && (bytes[at] === 32 || bytes[at] === LF || bytes[at] === 9 || bytes[at] === CR)) at++;
      if (this.slot === slot) break;
      at = tokenEnd(bytes, at, end);
      this.slot++;
    }
    this.slotAt = at;
    return at;
  }

  private holdSlots(): void {
    this.slotsFrom = this.slotAt = this.at;
    this.slot = 0;
  }

  private flush(sink: NumberSink): void {
    sink.flush(this);
    this.holdSlots();
  }

  // ——— errors common to all formats ———

  /** An error at the current token. */
  error(code: string, message: string): void {
    // If it will not be kept, its place is not worth finding.
    this.report.error(code, message, this.report.hasRoom('error') ? this.place() : NO_PLACE);
  }

  /** A warning at the current token. */
  warn(code: string, message: string, assumed?: string): void {
    this.report.warn(code, message, this.report.hasRoom('warning') ? this.place() : NO_PLACE, assumed);
  }

  /**
   * A warning at the current token that may occur often: equal ones have the same `key`, and only the first calls
   * `message`.
   */
  warnOnce(code: string, key: string, message: () => string, assumed: string): void {
    if (this.report.foldsInto(code, key)) return;
    const place = this.report.hasRoom('warning') ? this.place() : NO_PLACE;
    this.report.warnFolded(code, key, message(), place, assumed);
  }

  /** The current word is in place of a number: reports what is wrong with it. */
  notANumber(expected: string): void {
    const { code, why } = this.report.hasRoom('error') ? whyNoNumber(this.text()) : TOO_MANY;
    this.error(code, `Expected ${expected}, found ${this.found()}${why}.`);
  }

  /** Something else is in place of a `}`; it will be read again. */
  braceMissing(what: string): void {
    this.error('brace-missing', `Expected "}" after ${what}, found ${this.found()}.`);
    this.again();
  }

  /** The end of the file with a `}` missing: reading stops. */
  failAtEnd(opened: Mark | undefined, what: string): never {
    const where = opened ? `, opened on line ${this.placeOf(opened).line}` : '';
    this.error('brace-missing', `Expected "}" to close ${what}${where}, found the end of the file.`);
    throw new ParseError('brace-missing');
  }
}

function isBlank(c: number): boolean {
  return c === 32 || c === 9;
}

const TOO_MANY = { code: 'not-a-number', why: '' };
