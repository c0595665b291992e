/**
 * Lines, columns and excerpts for bytes that arrive in pieces and are not kept.
 *
 * A reader knows byte offsets; lines are counted only when something is reported, by a cursor that never passes a byte
 * twice (except for a step back within one piece), so that 100 warnings in 100 MB cost one count. A piece is counted
 * when it is released, four bytes at a time, and the end of its last line is kept for later excerpts.
 *
 * A run of CRs followed by LF is one line end; any other CR is one each. Columns are counted in characters (code
 * points), from 1. An excerpt that reaches past the available bytes is completed by the following pieces, so that
 * diagnostics are the same however a file was cut.
 *
 * Rejected: keeping the whole file (peak memory); counting lines in the number loop (costs a tenth of its speed, for
 * nothing in a valid file).
 */
import type { Excerpt } from '../model/diagnostic.ts';
import { lineEnd } from './pieces.ts';

/** Maximum number of characters shown of a line. */
const SHOWN = 200;
/** Bytes kept on either side of a place: four for each character shown. */
const WINDOW = 4 * SHOWN;
/** Shorter ranges are counted again rather than remembered. */
const SHORT = 256;
/** Bytes of lines kept in one array. */
const POOL = 16384;
const NOTHING = new Uint8Array(0);
/** Local names for the loops: some module loaders look up imported ones at every use. */
const LF = 10;
const CR = 13;

/** A position in a file. Cheap to create, so that it can be recorded before it is known to be needed. */
export interface Place {
  /** From 1; 0 for none. */
  readonly line: number;
  /** From 1, in characters; 0 for none. */
  readonly column: number;
  /** The line's bytes before it, at most `WINDOW`; absent if there is no line to show. */
  readonly before?: Uint8Array;
  /** The bytes from it on; completed when the line ends. */
  after?: Uint8Array;
}

/** For the file as a whole, e.g. that it is empty. */
export const WHOLE_FILE: Place = { line: 1, column: 1 };
/** For problems without a position. */
export const NO_PLACE: Place = { line: 0, column: 0 };

interface Unfinished {
  readonly place: Place;
  /** Offset in the file of the next byte needed, and of the first one that isn't even if the line continues. */
  readonly wants: number;
  readonly full: number;
}

/** Finds line, column and excerpt for byte offsets in a stream whose past pieces are gone. */
export class Places {
  /** The current piece: bytes [from, to), the first at `base` in the file. */
  private bytes: Uint8Array = NOTHING;
  private from = 0;
  private to = 0;
  private base = 0;
  /** The cursor: everything before it is counted. */
  private at = 0;
  private line = 1;
  /** Characters from the start of the line to the cursor. */
  private characters = 0;
  /** CRs right before the cursor, not counted yet, since that depends on what follows. */
  private pendingCrs = 0;
  /** Start of the cursor's line, or -1: before this piece. */
  private lineStart = -1;
  /** The end of that line's part before this piece. */
  private head: Uint8Array = NOTHING;
  /** The state at the start of the piece, for stepping back. */
  private startLine = 1;
  private startCharacters = 0;
  private startPendingCrs = 0;
  private unfinished: Unfinished[] = [];
  /** Bytes that follow in their line, kept once for all of them: bytes [tailBase, tailEnd) of the file. */
  private readonly tail = new Uint8Array(2 * WINDOW);
  private tailBase = 0;
  private tailEnd = 0;
  /** Pool for the kept parts of lines: many small arrays would cost more than their content. */
  private pool: Uint8Array = NOTHING;
  private poolAt = 0;
  /** Ranges of the piece with a known number of LFs: start, end, LFs, and so on. */
  private stretches: number[] = [];
  /** The first of them that the cursor has not passed. */
  private stretch = 0;

  /** A new piece. `base`: its first byte's offset in the file; the piece may start with bytes not released yet. */
  enter(bytes: Uint8Array, from: number, to: number, base: number): void {
    this.bytes = bytes;
    this.from = this.at = from;
    this.to = to;
    this.base = base;
    this.startLine = this.line;
    this.startCharacters = this.characters;
    this.startPendingCrs = this.pendingCrs;
    this.lineStart = -1;
    this.stretches.length = this.stretch = 0;
    if (this.unfinished.length) this.continueTail();
  }

  /**
   * Declares that bytes [from, to) of the current piece have this many LFs, and no CR except right before one of them;
   * -1: unknown.
   */
  passed(from: number, to: number, lineFeeds: number): void {
    if (lineFeeds >= 0 && to - from > SHORT) this.stretches.push(from, to, lineFeeds);
  }

  /** Releases the bytes before `until`. */
  leave(until: number): void {
    this.advance(until);
    const { bytes, lineStart } = this;
    if (lineStart >= 0) this.head = this.copy(NOTHING, bytes, Math.max(lineStart, until - WINDOW), until);
    else this.head = this.lastBytes(this.head, this.from, until);
    this.lineStart = -1;
  }

  /** The place of the byte at `offset` of the current piece, which must not be a line end; with or without its line. */
  place(offset: number, keepsLine = true): Place {
    this.advance(offset);
    const { bytes, to } = this;
    let { line, lineStart, characters } = this;
    if (this.pendingCrs > 0) {
      line += this.pendingCrs;
      lineStart = offset;
      characters = 0;
    }
    if (!keepsLine) return { line, column: characters + 1 };
    const before =
      lineStart >= 0
        ? this.copy(NOTHING, bytes, Math.max(lineStart, offset - WINDOW), offset)
        : this.lastBytes(this.head, this.from, offset);
    const limit = Math.min(to, offset + WINDOW);
    const end = lineEnd(bytes, offset, limit);
    const place: Place = { line, column: characters + 1, before, after: this.copy(NOTHING, bytes, offset, end) };
    if (end === to && to < offset + WINDOW) this.await(place, this.base + offset - this.from);
    return place;
  }

  /** The line of a byte of the current piece. */
  lineAt(offset: number): number {
    this.advance(offset);
    return this.line + this.pendingCrs;
  }

  /** Completes the excerpts whose lines end with the file. */
  finish(): void {
    this.complete(true);
  }

  /** Has an excerpt, of the byte at `offset` of the file, completed by what follows. */
  private await(place: Place, offset: number): void {
    const wants = this.base + this.to - this.from;
    if (!this.unfinished.length) this.tailBase = this.tailEnd = wants;
    this.unfinished.push({ place, wants, full: offset + WINDOW });
  }

  /** Adds what the current piece has of the line, rather than to each excerpt: hundreds may wait, for bytes one by one. */
  private continueTail(): void {
    const { bytes, to, tail, tailEnd } = this;
    const start = this.from + tailEnd - this.base;
    if (start >= to) return;
    const end = lineEnd(bytes, start, Math.min(to, start + WINDOW));
    if (tailEnd - this.tailBase + end - start > tail.length) {
      // Excerpts that wait for bytes before these would be full.
      tail.copyWithin(0, tailEnd - WINDOW - this.tailBase, tailEnd - this.tailBase);
      this.tailBase = tailEnd - WINDOW;
    }
    tail.set(bytes.subarray(start, end), tailEnd - this.tailBase);
    this.tailEnd += end - start;
    this.complete(end < to);
  }

  /** Gives excerpts what they wait for, if they are full now or the line is over. */
  private complete(isOver: boolean): void {
    const { tail, tailBase, tailEnd } = this;
    if (!isOver && !this.unfinished.some(({ full }) => full <= tailEnd)) return;
    this.unfinished = this.unfinished.filter(({ place, wants, full }) => {
      if (!isOver && full > tailEnd) return true;
      const until = Math.min(full, tailEnd);
      place.after = this.copy(place.after ?? NOTHING, tail, wants - tailBase, until - tailBase);
      return false;
    });
  }

  /** The last `WINDOW` bytes of `head` followed by bytes [from, to) of the current piece. */
  private lastBytes(head: Uint8Array, from: number, to: number): Uint8Array {
    if (to - from >= WINDOW) return this.copy(NOTHING, this.bytes, to - WINDOW, to);
    return this.copy(head.subarray(Math.max(0, head.length + to - from - WINDOW)), this.bytes, from, to);
  }

  /** A copy of `head` followed by [from, to) of `bytes`, which will be released. */
  private copy(head: Uint8Array, bytes: Uint8Array, from: number, to: number): Uint8Array {
    const length = head.length + to - from;
    if (length === 0) return NOTHING;
    if (this.poolAt + length > this.pool.length) {
      this.pool = new Uint8Array(Math.max(POOL, length));
      this.poolAt = 0;
    }
    const start = this.poolAt;
    this.poolAt += length;
    this.pool.set(head, start);
    this.pool.set(bytes.subarray(from, to), start + head.length);
    return this.pool.subarray(start, this.poolAt);
  }

  private advance(until: number): void {
    if (until < this.at) {
      this.at = this.from;
      this.line = this.startLine;
      this.characters = this.startCharacters;
      this.pendingCrs = this.startPendingCrs;
      this.lineStart = -1;
      this.stretch = 0;
    }
    const { stretches } = this;
    for (; this.stretch < stretches.length && stretches[this.stretch] < until; this.stretch += 3) {
      const from = stretches[this.stretch];
      const to = stretches[this.stretch + 1];
      if (from < this.at) continue;
      if (to > until) break;
      this.count(from, -1);
      // A CR right before it may belong to an LF at its start.
      this.count(to, this.pendingCrs > 0 ? -1 : stretches[this.stretch + 2]);
    }
    this.count(until, -1);
  }

  /** Advances to `until`, using the number of LFs if known. */
  private count(until: number, known: number): void {
    const { bytes, at } = this;
    const feeds = known >= 0 ? known : this.pendingCrs > 0 ? -1 : countLineFeeds(bytes, at, until);
    if (feeds < 0) {
      this.countByByte(until);
      return;
    }
    let start = at;
    if (feeds > 0) {
      start = until;
      while (bytes[start - 1] !== LF) start--;
      this.line += feeds;
      this.lineStart = start;
      this.characters = 0;
    }
    this.characters += countCharacters(bytes, start, until);
    this.at = until;
  }

  /** The same if there are CRs. */
  private countByByte(until: number): void {
    const { bytes } = this;
    let { line, characters, pendingCrs, lineStart } = this;
    for (let i = this.at; i < until; i++) {
      const c = bytes[i];
      if (c === CR) pendingCrs++;
      else if (c === LF) {
        line++;
        pendingCrs = 0;
        characters = 0;
        lineStart = i + 1;
      } else {
        if (pendingCrs > 0) {
          line += pendingCrs;
          pendingCrs = 0;
          characters = 0;
          lineStart = i;
        }
        if ((c & 0xc0) !== 0x80) characters++;
      }
    }
    this.at = until;
    this.line = line;
    this.characters = characters;
    this.pendingCrs = pendingCrs;
    this.lineStart = lineStart;
  }
}

/** The line of a place, cut to 200 characters around it. */
export function excerptOf(place: Place): Excerpt | undefined {
  if (!place.before || !place.after) return undefined;
  const before = decodeCut(place.before, true);
  const after = decodeCut(place.after, false);
  if (before.length + after.length <= SHOWN) return { text: before + after, caret: before.length };
  const text = before + after;
  let start = Math.max(0, Math.min(before.length - SHOWN / 2, text.length - SHOWN));
  let end = start + SHOWN;
  if (isLowSurrogate(text, start)) start++;
  if (isLowSurrogate(text, end)) end--;
  return { text: text.slice(start, end), caret: before.length - start };
}

/** Decodes part of a line, without a character cut by the window's far edge. */
function decodeCut(bytes: Uint8Array, cutAtStart: boolean): string {
  let start = 0;
  let end = bytes.length;
  if (end === WINDOW) {
    if (cutAtStart) while (start < 3 && (bytes[start] & 0xc0) === 0x80) start++;
    else {
      let back = 1;
      while (back < 4 && (bytes[end - back] & 0xc0) === 0x80) back++;
      if (bytes[end - back] >= 0xc0) end -= back;
    }
  }
  return UTF8.decode(bytes.subarray(start, end));
}

/** Keeps byte-order marks inside names. */
const UTF8 = new TextDecoder('utf-8', { ignoreBOM: true });

function isLowSurrogate(text: string, at: number): boolean {
  const c = text.charCodeAt(at);
  return c >= 0xdc00 && c <= 0xdfff;
}

/** Bytes that start a UTF-8 character. */
function countCharacters(bytes: Uint8Array, from: number, to: number): number {
  let n = 0;
  for (let i = from; i < to; i++) if ((bytes[i] & 0xc0) !== 0x80) n++;
  return n;
}

/** LFs in [from, to); -1 if there is a CR among them. */
function countLineFeeds(bytes: Uint8Array, from: number, to: number): number {
  let n = 0;
  let i = from;
  const aligned = Math.min(to, i + (-(bytes.byteOffset + i) & 3));
  for (; i < aligned; i++) {
    if (bytes[i] === LF) n++;
    else if (bytes[i] === CR) return -1;
  }
  const words = (to - i) >> 2;
  if (words > 0) {
    const w = new Int32Array(bytes.buffer, bytes.byteOffset + i, words);
    let cr = 0;
    for (let k = 0; k < words; ) {
      // Each byte of `lanes` counts the LFs in its position, up to 255.
      let lanes = 0;
      for (const stop = Math.min(words, k + 255); k < stop; k++) {
        // A byte equal to LF is 0 after the exclusive or; only then its top bit becomes 0.
        const x = w[k] ^ 0x0a0a0a0a;
        const y = w[k] ^ 0x0d0d0d0d;
        lanes = (lanes + ((~(((x & 0x7f7f7f7f) + 0x7f7f7f7f) | x) >>> 7) & 0x01010101)) | 0;
        cr |= ~(((y & 0x7f7f7f7f) + 0x7f7f7f7f) | y) & 0x80808080;
      }
      n += (lanes & 0xff) + ((lanes >>> 8) & 0xff) + ((lanes >>> 16) & 0xff) + (lanes >>> 24);
    }
    if (cr !== 0) return -1;
    i += words << 2;
  }
  for (; i < to; i++) {
    if (bytes[i] === LF) n++;
    else if (bytes[i] === CR) return -1;
  }
  return n;
}
