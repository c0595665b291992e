/**
 * The inner loop of every number block: bytes in, doubles out, without a string or call per number.
 *
 * The caller ensures that the last byte is a separator or a brace (see `pieces.ts`), so that tokens need no check for
 * the end of the bytes.
 *
 * Digits are collected in 32-bit integers, nine at a time: those before the point, the first nine after it, nine more.
 * Together they are an exact double up to 2^53, and one division by a power of ten rounds once; beyond that (17 digits)
 * `wide` continues from the same integers. All other spellings go to `parseDecimal`.
 *
 * Alternatives, as multiples of a bare loop (v = 10v + digit, then v += f·digit, nothing checked) that reads the same
 * bytes into a Float32Array at 460–660 MB/s (Node 20; xyz to 6 decimals | 15 digits | 17 digits):
 *     this                                                                         1.0 | 1.05 | 1.2
 *     one double for all digits, more than 15 of them in a second pass             1.0 | 0.9  | 2.3
 *     one 32-bit integer, more than nine digits in a second pass                   0.9 | 1.6  | 2.0
 *     all separators as one comparison c ≤ 32 (takes NUL for a blank)              1.0 | 0.95 | 2.3
 *     separators by a table of 256                                                 1.0 | 1.0  | 2.5
 *     the byte and its digit both kept, the separator looked at twice              1.1 | 1.1  | 2.4
 */
import { POWERS, parseDecimal, wide } from './decimal.ts';

/** The byte of a line feed. */
export const LF = 10;
/** The byte of a carriage return. */
export const CR = 13;
/** Integers up to here are exact doubles. */
const EXACT = Number.MAX_SAFE_INTEGER;
/** A local name for the loop: some module loaders look up imported ones at every use. */
const TENS = POWERS;
/** 10^k, and from `NEGATIVE` on -(10^k): dividing by it also applies the sign, even to 0. */
const NEGATIVE = POWERS.length;
const SIGNED_POWERS = Float64Array.from([...POWERS, ...POWERS.map((p) => -p)]);
const LAST_DIGIT = 57;
/** Bytes minus "0". */
const DOT = 46 - 48;
const BLANK = 32 - 48;
const TAB = 9 - 48;
const NEWLINE = 10 - 48;
const RETURN = 13 - 48;
const SMALL_E = 101 - 48;

/** Why the loop stopped; `Scan.at` is then … */
/** … the end of the bytes. */
export const AT_END = 0;
/** … at what follows the last number that fitted. */
export const FULL = 1;
/** … at a `}`. */
export const CLOSED = 2;
/** … at a token that is neither a number nor one of the words. */
export const STRANGE = 3;

/** Where the number loop is in its input and output; updated in place by each call. */
export interface Scan {
  /** Where to continue. */
  at: number;
  /** Numbers in `out` so far. */
  count: number;
  /** Limit to which `out` may be filled. */
  limit: number;
  /** LFs passed, so that they need not be counted again; -1 if there was a CR without an LF. */
  lineFeeds: number;
}

/**
 * Words allowed among the numbers, such as a key's `flat`. They are returned as values that no number has: NaN,
 * Infinity, -Infinity, in this order.
 */
export type BlockWords = readonly [Uint8Array, Uint8Array, Uint8Array];

/**
 * Words in front of numbers, each with its numbers on a line of its own: the rows of a table that are named. They are
 * compared four bytes at once.
 */
export interface Labels {
  /** Of the bytes that are read, from their start. */
  readonly view: DataView;
  /** Pairs of four bytes of a label as a number, and a mask of those that count. */
  readonly text: Int32Array;
  /** Of each, [from, to) in `text`, its length in bytes, and [from, to) of its numbers in `out`, from `base`. */
  readonly rows: Int32Array;
  base: number;
  /** The label to begin with; updated by each call to the first whose line was not read. */
  next: number;
  /** Where that line starts. */
  at: number;
}

/** For numbers without labels. */
const NO_LABELS: Labels = {
  view: new DataView(new ArrayBuffer(0)),
  text: new Int32Array(0),
  rows: new Int32Array(0),
  base: 0,
  next: 0,
  at: 0,
};
/** Numbers of a label in `rows`. */
const ROW = 5;

/** Labels of rows, none read yet. @param rows the bytes of each, and [from, to) of its numbers in `out` */
export function labelsOf(
  bytes: Uint8Array,
  rows: readonly { readonly label: Uint8Array; readonly from: number; readonly to: number }[],
): Labels {
  const text: number[] = [];
  const listed = rows.flatMap(({ label, from, to }) => {
    const first = text.length;
    for (let i = 0; i < label.length; i += 4) {
      const four = new Uint8Array(4);
      four.set(label.subarray(i, i + 4));
      const mask = four.map((_, k) => (i + k < label.length ? 255 : 0));
      text.push(...[four, mask].map(({ buffer }) => new DataView(buffer).getInt32(0, true)));
    }
    return [first, text.length, label.length, from, to];
  });
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  return { ...NO_LABELS, view, text: Int32Array.from(text), rows: Int32Array.from(listed) };
}

const WORD_VALUES = [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY] as const;

/**
 * Reads numbers from `bytes[scan.at]` into `out[scan.count]` up to `out[scan.limit]`. Returns why it stopped: FULL only
 * if something follows, at which it stops.
 * @param labels in front of numbers: then `scan.at` is the start of a line, `scan.count` equals `scan.limit`, and it
 *     stops at the first line that is not the next label with its numbers; one that ends the bytes is not counted as read
 */
export function scanNumbers(
  bytes: Uint8Array,
  end: number,
  out: Float64Array,
  scan: Scan,
  words: BlockWords | undefined,
  labels?: Labels,
): number {
  let capacity = scan.limit;
  let i = scan.at;
  let n = scan.count;
  let why = AT_END;
  let lineFeeds = 0;
  let sawCr = false;
  // Labels passed, lines of them read to their end, and where the next starts.
  let labelled = 0;
  let linesRead = 0;
  let lineAt = i;
  const hasLabels = labels !== undefined;
  const { view, text, rows, base } = labels ?? NO_LABELS;
  const lastWord = view.byteLength - 4;
  let row = labels === undefined ? 0 : ROW * labels.next;
  while (i < end) {
    let c = bytes[i];
    if (c === 32 || c === 9) {
      i++;
      continue;
    }
    if (c === 10) {
      lineFeeds++;
      i++;
      continue;
    }
    if (c === 13) {
      // At the end of the bytes it is unknown what follows.
      if (i + 1 < end && bytes[i + 1] === 10) {
        lineFeeds++;
        i++;
      } else sawCr = true;
      i++;
      continue;
    }
    if (n === capacity) {
      // One line feed a label, right before the next.
      if (hasLabels && lineFeeds === labelled && !sawCr && bytes[i - 1] === 10) {
        lineAt = i;
        linesRead = labelled++;
        if (row < rows.length) {
          const to = rows[row + 1];
          let k = rows[row];
          while (k < to && i <= lastWord && (view.getInt32(i, true) & text[k + 1]) === text[k]) {
            k += 2;
            i += 4;
          }
          i = lineAt + rows[row + 2];
          c = bytes[i];
          if (k === to && (c === 32 || c === 9 || c === 10 || c === 13)) {
            n = base + rows[row + 3];
            capacity = base + rows[row + 4];
            row += ROW;
            if (c === 32) i++;
            continue;
          }
          i = lineAt;
        }
        why = FULL;
        break;
      }
      // A list of the declared length must not grow for the brace after it.
      why = c === 125 ? CLOSED : FULL;
      break;
    }
    const start = i;
    let sign = 0;
    if (c === 45) {
      sign = NEGATIVE;
      c = bytes[++i];
    } else if (c === 43) c = bytes[++i];
    let whole = 0;
    let d = c - 48;
    const digits = i;
    while (d >>> 0 < 10) {
      whole = (Math.imul(whole, 10) + d) | 0;
      d = bytes[++i] - 48;
    }
    let count = i - digits;
    if (count <= 9) {
      let value = whole;
      let decimals = 0;
      if (d === DOT) {
        const first = ++i;
        const tenth = first + 9;
        d = bytes[i] - 48;
        let fraction = 0;
        while (d >>> 0 < 10 && i < tenth) {
          fraction = (Math.imul(fraction, 10) + d) | 0;
          d = bytes[++i] - 48;
        }
        decimals = i - first;
        count += decimals;
        value = whole * TENS[decimals] + fraction;
        if (d >>> 0 < 10) {
          const high = value;
          let low = 0;
          while (d >>> 0 < 10) {
            low = (Math.imul(low, 10) + d) | 0;
            d = bytes[++i] - 48;
          }
          const lowDigits = i - tenth;
          decimals += lowDigits;
          value = lowDigits <= 9 ? high * TENS[lowDigits] + low : Number.POSITIVE_INFINITY;
          if (
            value > EXACT &&
            high <= EXACT &&
            lowDigits <= 9 &&
            (d === BLANK || d === NEWLINE || d === TAB || d === RETURN)
          ) {
            const long = wide(high, low, lowDigits, -decimals);
            if (long - long === 0) {
              out[n++] = sign ? -long : long;
              if (d === BLANK) i++;
              continue;
            }
          }
        }
      }
      if (count > 0 && value <= EXACT && (d === BLANK || d === NEWLINE || d === TAB || d === RETURN)) {
        out[n++] = value / SIGNED_POWERS[sign + decimals];
        if (d === BLANK) i++;
        else if (hasLabels && d === NEWLINE) {
          // Of a few numbers a line, most are the last.
          lineFeeds++;
          i++;
        }
        continue;
      }
      if (d === SMALL_E && count > 0 && value <= EXACT) {
        let k = i + 1;
        const isNegative = bytes[k] === 45;
        if (isNegative || bytes[k] === 43) k++;
        const first = k;
        let power = 0;
        d = bytes[k] - 48;
        while (d >>> 0 < 10 && k < first + 4) {
          power = 10 * power + d;
          d = bytes[++k] - 48;
        }
        power = decimals + (isNegative ? power : -power);
        // One exact double by another rounds once.
        if (
          k > first &&
          power < NEGATIVE &&
          power > -NEGATIVE &&
          (d === BLANK || d === NEWLINE || d === TAB || d === RETURN)
        ) {
          out[n++] = power >= 0 ? value / SIGNED_POWERS[sign + power] : value * SIGNED_POWERS[sign - power];
          i = k;
          continue;
        }
      }
    }
    // Very many digits, a large exponent, or a brace directly after it; else a word, a brace, or an invalid token.
    c = bytes[start];
    const stop = tokenEnd(bytes, start, end);
    if (stop > start) {
      const isWord = words !== undefined && c > LAST_DIGIT;
      const value = isWord ? wordValue(bytes, start, stop, words) : parseDecimal(bytes, start, stop);
      if (isWord ? value !== 0 : value - value === 0) {
        out[n++] = value;
        i = stop;
        continue;
      }
    }
    i = start;
    why = c === 125 && stop === start ? CLOSED : STRANGE;
    break;
  }
  scan.at = i;
  scan.count = n;
  scan.lineFeeds = sawCr ? -1 : lineFeeds;
  if (labels !== undefined) {
    labels.next += linesRead;
    labels.at = lineAt;
  }
  return why;
}

/** The first separator or brace from `i` on. */
export function tokenEnd(bytes: Uint8Array, i: number, end: number): number {
  while (i < end) {
    const c = bytes[i];
    if (c === 32 || c === 10 || c === 9 || c === 13 || c === 125 || c === 123) break;
    i++;
  }
  return i;
}

/** 0 if it is none of the words. */
function wordValue(bytes: Uint8Array, start: number, end: number, words: BlockWords): number {
  for (let w = 0; w < 3; w++) if (sameWord(bytes, start, end, words[w])) return WORD_VALUES[w];
  return 0;
}

/** Whether bytes [start, end) are the (lower-case, ASCII) word, in any case. */
function sameWord(bytes: Uint8Array, start: number, end: number, word: Uint8Array): boolean {
  if (end - start !== word.length) return false;
  for (let k = 0; k < word.length; k++) if ((bytes[start + k] | 32) !== word[k]) return false;
  return true;
}
