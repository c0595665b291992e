/**
 * One light pass over the bytes of a text file, in pieces: an index of its lines, and its tokens for a locator. It
 * checks nothing, and doesn't convert numbers that no one asks for.
 *
 * Lines are those of `places.ts`: a run of CRs followed by LF is one line end, any other CR is one each.
 */
import type { LineIndex } from '../../model/source-map.ts';
import { parseDecimal } from '../decimal.ts';
import { CR, LF } from '../scan.ts';
import type { Locator } from './locator.ts';

/** Lines, or bytes if they are long, from one entry of the index to the next. */
const ENTRY_LINES = 256;
const ENTRY_BYTES = 65536;
/** Longer tokens are cut: no keyword and no sensible number is. */
const TOKEN_BYTES = 64;
const OPEN = 123;
const CLOSE = 125;

/** Indexes the lines of a file and passes its tokens to a locator. */
export class SourceScanner {
  private line = 1;
  /** CRs of which it isn't known whether an LF follows. */
  private returns = 0;
  /** The offset of the next piece. */
  private base = 0;
  private entryLine = 1;
  private entryOffset = 0;
  private readonly lines: number[] = [1];
  private readonly offsets: number[] = [0];
  private readonly token = new Uint8Array(TOKEN_BYTES);
  private length = 0;
  private readonly read = () => parseDecimal(this.token, 0, Math.min(this.length, TOKEN_BYTES));

  /** @param locator absent: only lines are indexed */
  constructor(private readonly locator?: Locator) {}

  /** Takes the next bytes of the file, which may be split anywhere. */
  feed(bytes: Uint8Array): void {
    const { token, locator } = this;
    const from = this.base === 0 && bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf ? 3 : 0;
    for (let i = from; i < bytes.length; i++) {
      const c = bytes[i];
      if (c === LF || c === CR) {
        if (this.length > 0) this.endToken();
        if (c === CR) this.returns++;
        else {
          this.returns = 0;
          this.startLine(1, this.base + i + 1);
        }
        continue;
      }
      if (this.returns > 0) {
        const ends = this.returns;
        this.returns = 0;
        this.startLine(ends, this.base + i);
      }
      if (!locator) continue;
      if (c === 32 || c === 9) {
        if (this.length > 0) this.endToken();
      } else if (c === OPEN || c === CLOSE) {
        if (this.length > 0) this.endToken();
        if (c === OPEN) locator.open(this.line);
        else locator.close(this.line);
      } else {
        if (this.length < TOKEN_BYTES) token[this.length] = c;
        this.length++;
      }
    }
    this.base += bytes.length;
  }

  /** Ends the file. */
  finish(): LineIndex {
    if (this.length > 0) this.endToken();
    if (this.returns > 0) this.startLine(this.returns, this.base);
    this.locator?.end(this.line);
    return {
      lines: Float64Array.from(this.lines),
      offsets: Float64Array.from(this.offsets),
      count: this.line,
      bytes: this.base,
    };
  }

  private startLine(ends: number, offset: number): void {
    this.line += ends;
    if (this.line - this.entryLine < ENTRY_LINES && offset - this.entryOffset < ENTRY_BYTES) return;
    this.lines.push(this.line);
    this.offsets.push(offset);
    this.entryLine = this.line;
    this.entryOffset = offset;
  }

  private endToken(): void {
    const { locator, token, line } = this;
    const stop = Math.min(this.length, TOKEN_BYTES);
    if (locator) {
      if (locator.inRows || isNumeric(token[0], stop > 1 ? token[1] : 0)) locator.value(line, this.read);
      else locator.word(textOf(token, stop), line);
    }
    this.length = 0;
  }
}

/** Whether a token that starts with these bytes is a number, or meant as one. */
function isNumeric(first: number, second: number): boolean {
  if (isDigit(first)) return true;
  return (first === 43 || first === 45 || first === 46) && (isDigit(second) || second === 46);
}

function isDigit(c: number): boolean {
  return c >= 48 && c <= 57;
}

/** In lower case. Other than ASCII is in names only, which are not compared. */
function textOf(bytes: Uint8Array, stop: number): string {
  let text = '';
  for (let i = 0; i < stop; i++)
    text += String.fromCharCode(bytes[i] >= 65 && bytes[i] <= 90 ? bytes[i] + 32 : bytes[i]);
  return text;
}
