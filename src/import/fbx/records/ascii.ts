/**
 * Text FBX.
 *
 *     file   = { record }                          comments from ; to the end of the line
 *     record = name ":" [ value { "," value } ] [ "{" { record } "}" ]
 *     value  = "text" | number | word | "*" count "{" "a:" numbers "}" | nothing, before a comma
 *
 * Numbers that are none (`-1.#IND`) are read as 0.
 */
import { parseDecimal } from '../../../formats/decimal.ts';
import type { FbxReport } from '../failure.ts';
import { integer } from './binary.ts';
import { NumberPool } from './number-pool.ts';
import { type FbxFile, type FbxRecord, type FbxValue, NO_RECORDS } from './record.ts';
import { Texts } from './texts.ts';

const MAX_DEPTH = 64;

/** The version that a text states; undefined if it states none in its first lines. */
export function textVersion(bytes: Uint8Array): number | undefined {
  const start = new TextDecoder().decode(bytes.subarray(0, 4096));
  const stated = /FBXVersion:\s*(\d+)/.exec(start)?.[1];
  if (stated !== undefined) return Number(stated);
  const [, major, minor = '0', patch = '0'] = /^(?:\uFEFF)?\s*;\s*FBX\s+(\d+)\.(\d)\.(\d)/.exec(start) ?? [];
  return major === undefined ? undefined : Number(major) * 1000 + Number(minor) * 100 + Number(patch) * 10;
}

/** The records of a text. Fails where it is no FBX. */
export function readAscii(bytes: Uint8Array, report: FbxReport): FbxFile {
  const pool = new NumberPool();
  return { version: textVersion(bytes) ?? 0, isText: true, pool, records: new AsciiReader(bytes, pool, report).file() };
}

const TAB = 9;
const LF = 10;
const SPACE = 32;
const QUOTE = 34;
const STAR = 42;
const PLUS = 43;
const COMMA = 44;
const MINUS = 45;
const COLON = 58;
const SEMICOLON = 59;
const OPEN = 123;
const CLOSE = 125;
const UTF8 = new TextDecoder();

class AsciiReader {
  private readonly texts: Texts;
  private at = 0;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly pool: NumberPool,
    private readonly report: FbxReport,
  ) {
    this.texts = new Texts(bytes);
    if (bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf) this.at = 3;
  }

  file(): FbxRecord[] {
    const records: FbxRecord[] = [];
    for (this.skip(); this.at < this.bytes.length; this.skip()) records.push(this.record(0));
    return records;
  }

  /** Moves to the next byte that is neither space nor comment. */
  private skip(): void {
    const { bytes } = this;
    let { at } = this;
    for (; at < bytes.length; at++) {
      const byte = bytes[at];
      if (byte === SEMICOLON) {
        const end = bytes.indexOf(LF, at);
        at = end < 0 ? bytes.length : end;
      } else if (!(byte <= SPACE)) break;
    }
    this.at = at;
  }

  /** The end of a word that begins at an offset. */
  private wordEnd(offset: number): number {
    const { bytes } = this;
    let at = offset;
    while (at < bytes.length && isOfWord(bytes[at])) at++;
    return at;
  }

  private record(depth: number): FbxRecord {
    const { bytes, report } = this;
    const offset = this.at;
    if (depth > MAX_DEPTH) report.fail('too-deep', `Records are nested more than ${MAX_DEPTH} deep.`, offset);
    while (this.at < bytes.length && bytes[this.at] !== COLON && isOfName(bytes[this.at])) this.at++;
    if (bytes[this.at] !== COLON || this.at === offset) {
      report.fail('name-expected', `Expected a name and a colon, found ${this.found(offset)}.`, offset);
    }
    const name = this.texts.of(offset, this.at);
    this.at++;
    const values = this.values();
    this.skip();
    let children = NO_RECORDS;
    if (bytes[this.at] === OPEN) {
      const open = this.at++;
      const inside: FbxRecord[] = [];
      for (this.skip(); bytes[this.at] !== CLOSE; this.skip()) {
        if (this.at >= bytes.length) {
          report.fail('brace-missing', `Expected } for the { of ${name}, found the end of the file.`, open);
        }
        inside.push(this.record(depth + 1));
      }
      children = inside;
      this.at++;
    }
    return { name, values, children, offset };
  }

  private values(): FbxValue[] {
    const { bytes } = this;
    const values: FbxValue[] = [];
    // Only the first value may be on the line after the colon if a comma comes first.
    for (let expects = false; ; ) {
      if (expects) this.skip();
      else while (bytes[this.at] === SPACE || bytes[this.at] === TAB) this.at++;
      const value = this.value();
      if (value !== undefined) values.push(value);
      const before = this.at;
      this.skip();
      if (bytes[this.at] !== COMMA) {
        this.at = before;
        return values;
      }
      this.at++;
      expects = true;
    }
  }

  /** The value at the cursor; undefined if there is none. */
  private value(): FbxValue | undefined {
    const { bytes } = this;
    const byte = bytes[this.at];
    if (byte === QUOTE) return this.text();
    if (byte === STAR) return this.array();
    const start = this.at;
    this.at = this.wordEnd(start);
    if (this.at === start) return undefined;
    // A name: the record has no value here, and the next one begins.
    if (bytes[this.at] === COLON) {
      this.at = start;
      return undefined;
    }
    return this.numberOr(start, this.at) ?? this.texts.of(start, this.at);
  }

  /** The number of a word. Integers of more than 53 bits stay exact. */
  private numberOr(start: number, end: number): number | bigint | undefined {
    const { bytes } = this;
    if (end - start >= MIN_LONG_DIGITS && isDigits(bytes, start, end)) return longOf(this.texts.of(start, end));
    const number = parseDecimal(bytes, start, end);
    if (!Number.isNaN(number)) return number;
    // How Windows printed infinities and what is not a number.
    return /^[+-]?\d*\.#\w+$|^[+-]?(nan|inf)/i.test(this.texts.of(start, end)) ? 0 : undefined;
  }

  private text(): string {
    const { bytes } = this;
    const start = this.at + 1;
    const end = bytes.indexOf(QUOTE, start);
    if (end < 0) this.report.fail('quote-missing', 'Expected a closing ", found the end of the file.', this.at);
    this.at = end + 1;
    const text = this.texts.of(start, end);
    return text.includes('&') ? text.replaceAll('&quot;', '"') : text;
  }

  /** `*count { a: numbers }` */
  private array(): Float64Array {
    const { bytes, report } = this;
    const offset = this.at++;
    let count = 0;
    while (bytes[this.at] >= 48 && bytes[this.at] <= 57) count = 10 * count + bytes[this.at++] - 48;
    // Each number takes a digit and a comma.
    if (count > bytes.length)
      report.fail('bad-array', `An array claims ${count} numbers in a file of ${bytes.length} bytes.`, offset);
    this.skip();
    if (bytes[this.at] !== OPEN)
      report.fail('brace-missing', `Expected { with the array, found ${this.found(this.at)}.`, this.at);
    this.at++;
    this.skip();
    const out = this.pool.doubles(count);
    let read = 0;
    if (bytes[this.at] !== CLOSE) {
      this.at++;
      this.skip();
      if (bytes[this.at] !== COLON)
        report.fail('name-expected', `Expected a: with numbers, found ${this.found(this.at)}.`, this.at);
      this.at++;
      for (this.skip(); bytes[this.at] !== CLOSE; this.skip()) {
        const start = this.at;
        this.at = this.wordEnd(start);
        const number = this.numberOr(start, this.at);
        if (number === undefined) {
          report.fail('not-a-number', `Expected a number of the array, found ${this.found(start)}.`, start);
        }
        if (read < count) out[read] = Number(number);
        read++;
        this.skip();
        if (bytes[this.at] === COMMA) this.at++;
      }
    }
    this.at++;
    if (read !== count) report.fail('wrong-count', `Expected ${count} numbers, found ${read}.`, offset);
    return out;
  }

  /** Description of what is at an offset, for messages. */
  private found(offset: number): string {
    if (offset >= this.bytes.length) return 'the end of the file';
    const end = this.bytes.indexOf(LF, offset);
    const text = UTF8.decode(this.bytes.subarray(offset, Math.min(end < 0 ? this.bytes.length : end, offset + 20)));
    return `“${text.trim()}”`;
  }
}

/** Names have letters, digits and - | _; a blank ends none, for some have one. */
function isOfName(byte: number): boolean {
  return byte >= SPACE && byte !== QUOTE && byte !== COMMA && byte !== OPEN && byte !== CLOSE && byte !== SEMICOLON;
}

function isOfWord(byte: number): boolean {
  return byte > SPACE && byte !== COLON && isOfName(byte);
}

/** Digits of integers that doubles may not hold. */
const MIN_LONG_DIGITS = 16;
const MAX_LONG_DIGITS = 20;

/** Whether a word is a sign, if any, and digits. */
function isDigits(bytes: Uint8Array, start: number, end: number): boolean {
  const isSigned = bytes[start] === PLUS || bytes[start] === MINUS;
  for (let at = isSigned ? start + 1 : start; at < end; at++) if (!(bytes[at] >= 48 && bytes[at] <= 57)) return false;
  return true;
}

/** An integer of up to 64 bits exactly; of more digits, as a double. */
function longOf(word: string): number | bigint {
  const digits = word.replace(/^[+-]/, '').length;
  return digits >= MIN_LONG_DIGITS && digits <= MAX_LONG_DIGITS ? integer(BigInt(word.replace('+', ''))) : Number(word);
}
