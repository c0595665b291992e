/**
 * Parses decimal numbers from bytes, correctly rounded: exactly the double that `Number(text)` gives, without the text.
 *
 *     [+-] ( digits [. digits*] | . digits ) [ (e|E) [+-] digits ]        as C's strtod, without nan, inf and hex
 *
 * With w the digits as an integer and 10^x the power of ten to apply:
 * - w < 2^53 and |x| ≤ 22: both are exact doubles, so one multiplication or division rounds once (Clinger 1990).
 * - w up to 18 digits and |x| ≤ 80: double-double arithmetic (Dekker 1971), about 104 bits. The remainder below the
 *   rounded result is compared with the error bound; only if the two sides of the bound would round differently (about
 *   one number in 10^14, and halfway cases) the digits go to `Number`.
 * - Everything else goes to `Number`.
 *
 * Rejected: Eisel-Lemire as in fast_float, which needs 64×64-bit products; in JavaScript these take BigInt, ten times
 * slower.
 */
const DOT = 46;
const MINUS = 45;
const PLUS = 43;

/** 10^k, exact up to 22. */
export const POWERS = Float64Array.from({ length: 23 }, (_, k) => Number(`1e${k}`));

const MAX_POWER = 80;
/** 10^k as the unevaluated sum of two doubles. */
const POWER_HIGH = new Float64Array(MAX_POWER + 1);
const POWER_LOW = new Float64Array(MAX_POWER + 1);
for (let k = 0; k <= MAX_POWER; k++) {
  const exact = 10n ** BigInt(k);
  POWER_HIGH[k] = Number(exact);
  POWER_LOW[k] = Number(exact - BigInt(POWER_HIGH[k]));
}

/** 2^27 + 1 splits a double into two halves whose products are exact. */
const SPLITTER = 134217729;

/** The value of bytes [start, end): NaN if they are no decimal, ±Infinity on overflow, 0 on underflow. */
export function parseDecimal(bytes: Uint8Array, start: number, end: number): number {
  let i = start;
  let c = bytes[i];
  const negative = c === MINUS;
  if (negative || c === PLUS) i++;
  // The first nine significant digits, then nine more; further ones only shift the exponent.
  let high = 0;
  let low = 0;
  let significant = 0;
  let dropped = 0;
  let digits = 0;
  let afterDot = 0;
  let dot = false;
  for (; i < end; i++) {
    c = bytes[i];
    const d = c - 48;
    if (d >>> 0 < 10) {
      digits++;
      if (dot) afterDot++;
      if (significant === 0 && d === 0) continue;
      if (significant < 9) high = high * 10 + d;
      else if (significant < 18) low = low * 10 + d;
      else dropped++;
      significant++;
    } else if (c === DOT && !dot) dot = true;
    else break;
  }
  if (digits === 0) return Number.NaN;
  let exponent = dropped - afterDot;
  if (i < end) {
    if ((c | 32) !== 101) return Number.NaN;
    i++;
    const negativeExponent = bytes[i] === MINUS;
    if (negativeExponent || bytes[i] === PLUS) i++;
    if (i >= end) return Number.NaN;
    let e = 0;
    for (; i < end; i++) {
      const d = bytes[i] - 48;
      if (d >>> 0 >= 10) return Number.NaN;
      if (e < 1e9) e = e * 10 + d;
    }
    exponent += negativeExponent ? -e : e;
  }
  const value =
    dropped > 0 ? Number.NaN : significant <= 9 ? scale(high, 0, exponent) : wide(high, low, significant - 9, exponent);
  // NaN: undecided. The text is a valid decimal, so Number parses it.
  if (Number.isNaN(value)) return Number(text(bytes, start, end));
  return negative ? -value : value;
}

/**
 * `(high · 10^lowDigits + low) · 10^exponent` rounded once, with integers `high` up to 2^53 and `low` of `lowDigits` ≤
 * 9 digits. NaN if undecided.
 */
export function wide(high: number, low: number, lowDigits: number, exponent: number): number {
  const p = POWERS[lowDigits];
  const product = high * p;
  const sum = product + low;
  return scale(sum, low - (sum - product) + productError(high, p, product), exponent);
}

/** `(a + b) · 10^exponent` rounded once, for |b| ≤ an ulp of a, and a below 10^25; NaN if undecided. */
function scale(a: number, b: number, exponent: number): number {
  if (a === 0) return 0;
  if (b === 0 && a <= Number.MAX_SAFE_INTEGER) {
    if (exponent >= 0) {
      if (exponent <= 22) return a * POWERS[exponent];
    } else if (exponent >= -22) return a / POWERS[-exponent];
  }
  if (exponent > MAX_POWER || exponent < -MAX_POWER) return Number.NaN;
  let result: number;
  let rest: number;
  if (exponent >= 0) {
    const p = POWER_HIGH[exponent];
    result = a * p;
    rest = productError(a, p, result) + (b * p + a * POWER_LOW[exponent]);
  } else {
    const p = POWER_HIGH[-exponent];
    result = a / p;
    const product = result * p;
    const remainder = a - product - productError(result, p, product);
    rest = (remainder + (b - result * POWER_LOW[-exponent])) / p;
  }
  // `rest` is off by a few of its own ulps, and by the cancellation of its two parts.
  const bound = Math.abs(result) * 1e-30;
  const rounded = result + (rest - bound);
  return rounded === result + (rest + bound) ? rounded : Number.NaN;
}

/** The exact `x · y − product`, for `product` the rounded x · y. */
function productError(x: number, y: number, product: number): number {
  const u = SPLITTER * x;
  const xh = u - (u - x);
  const xl = x - xh;
  const v = SPLITTER * y;
  const yh = v - (v - y);
  const yl = y - yh;
  return xh * yh - product + xh * yl + xl * yh + xl * yl;
}

function text(bytes: Uint8Array, start: number, end: number): string {
  return UTF8.decode(bytes.subarray(start, end));
}

const UTF8 = new TextDecoder('utf-8');
