/**
 * Cuts chunks, which may be split anywhere, into pieces that end between tokens.
 *
 *     chunk   ┊pos│itions 3 { 0 0 1 … 0.2│5 0 ┊          pieces   [posi│tions 3 { … ]  [0.25 ]  [0 ]
 *
 * A piece's last byte is a separator or a brace, so every token in it is complete and loops need no check for its end.
 * The rest of a chunk is carried over and completed by the head of the next one: a copy of a few bytes, never of a
 * chunk. An added separator ends the last token of the file.
 */
import { LF, tokenEnd } from './scan.ts';

/**
 * Takes bytes [from, to). Returns `to`, or the start of a rest that it wants again, together with everything to the end
 * of its line.
 */
export type TakePiece = (bytes: Uint8Array, from: number, to: number) => number;

/** Cuts a stream of chunks into pieces that end between tokens. */
export class BytePieces {
  private carry = new Uint8Array(0);
  private carried = 0;
  /** Whether the next piece has to end with a line. */
  private wantsLine = false;

  /** Gives `take` the complete pieces of the next chunk, in order, and keeps the rest for the one after it. */
  feed(chunk: Uint8Array, take: TakePiece): void {
    let from = 0;
    while (from < chunk.length) {
      const { wantsLine } = this;
      if (this.carried > 0) {
        // Completes the token that was cut.
        const last = wantsLine ? lineEnd(chunk, from, chunk.length) : tokenEnd(chunk, from, chunk.length);
        const until = Math.min(last + 1, chunk.length);
        this.keep(chunk, from, until);
        from = until;
        if (last < chunk.length) this.giveCarried(take);
      } else {
        const until = (wantsLine ? lastLineEnd(chunk, from) : lastSeparator(chunk, from)) + 1;
        if (until > from) this.give(chunk, from, until, take);
        else this.keep(chunk, from, chunk.length);
        from = until > from ? until : chunk.length;
      }
    }
  }

  /** The last piece: the rest, plus a LF that is not in the file. */
  finish(take: TakePiece): void {
    this.keep(Uint8Array.of(LF), 0, 1);
    this.giveCarried(take);
  }

  private keep(chunk: Uint8Array, from: number, to: number): void {
    const needed = this.carried + to - from;
    if (needed > this.carry.length) {
      // Doubling, so that even a file without separators is copied only a few times.
      const grown = new Uint8Array(Math.max(256, needed, 2 * this.carry.length));
      grown.set(this.carry.subarray(0, this.carried));
      this.carry = grown;
    }
    this.carry.set(chunk.subarray(from, to), this.carried);
    this.carried = needed;
  }

  private giveCarried(take: TakePiece): void {
    const piece = this.carry.slice(0, this.carried);
    this.carried = 0;
    this.give(piece, 0, piece.length, take);
  }

  private give(bytes: Uint8Array, from: number, to: number, take: TakePiece): void {
    const done = take(bytes, from, to);
    this.wantsLine = done < to;
    if (this.wantsLine) this.keep(bytes, done, to);
  }
}

/** The first CR or LF from `i` on; `end` if there is none. */
export function lineEnd(bytes: Uint8Array, i: number, end: number): number {
  while (i < end && bytes[i] !== 10 && bytes[i] !== 13) i++;
  return i;
}

/** The last CR or LF not before `from`; `from - 1` if there is none. */
function lastLineEnd(bytes: Uint8Array, from: number): number {
  let i = bytes.length - 1;
  while (i >= from && bytes[i] !== 10 && bytes[i] !== 13) i--;
  return i;
}

/** The last separator or brace not before `from`; `from - 1` if there is none. */
function lastSeparator(bytes: Uint8Array, from: number): number {
  let i = bytes.length - 1;
  for (; i >= from; i--) {
    const c = bytes[i];
    if (c === 32 || c === 10 || c === 9 || c === 13 || c === 125 || c === 123) break;
  }
  return i;
}
