/**
 * Writes decimal numbers as bytes: exactly the digits of `String(value)`, without the string, for numbers of up to six
 * decimals. Captures consist mostly of these, twenty million in a file of 100 MB.
 *
 *     w = round(|value| · 10⁶) below 10¹⁵       and       w / 10⁶ = |value|
 *
 * Both w and 10⁶ are exact doubles, so the division rounds once, and gives the double that the decimal w·10⁻⁶ reads as.
 * If that is the value, w's digits are a decimal that reads back the same, and the shortest: no two decimals of up to
 * 15 digits read as the same double. Everything else goes to `String`.
 *
 * (Ryū or Grisu for all doubles need 64-bit products, in JavaScript BigInt: slower than `String`.)
 */

/** Upper bound for the numbers written here. */
export const LONGEST_DECIMAL = 24;

const ZERO = 48;
const MINUS = 45;
const DOT = 46;

/** The three digits of 0 … 999. */
const TRIPLES = Uint8Array.from({ length: 3000 }, (_, i) => ZERO + (Math.floor(i / 3 / 10 ** (2 - (i % 3))) % 10));

/**
 * Writes a number of up to six decimals at `at`, where `LONGEST_DECIMAL` bytes must be free.
 * @returns its end; −1, writing nothing, for all other numbers, including −0
 */
export function putDecimal(value: number, bytes: Uint8Array, at: number): number {
  if (value === 0) {
    if (1 / value < 0) return -1;
    bytes[at] = ZERO;
    return at + 1;
  }
  const size = value < 0 ? -value : value;
  const w = Math.floor(size * 1e6 + 0.5);
  // Also fails for NaN, and for 10⁻⁷, which rounds to 0.
  if (!(w < 1e15 && w / 1e6 === size)) return -1;
  if (value < 0) bytes[at++] = MINUS;
  const whole = Math.floor(w / 1e6);
  const rest = w - whole * 1e6;
  at = putWhole(whole, bytes, at);
  return rest === 0 ? at : putDecimals(rest, bytes, at);
}

/** 0 … 999,999,999, without leading zeros. */
function putWhole(whole: number, bytes: Uint8Array, at: number): number {
  if (whole < 1000) return putLeading(whole, bytes, at);
  const thousands = Math.floor(whole / 1000);
  if (thousands < 1000) at = putLeading(thousands, bytes, at);
  else at = putTriple(thousands % 1000, bytes, putLeading(Math.floor(thousands / 1000), bytes, at));
  return putTriple(whole % 1000, bytes, at);
}

/** 1 … 999,999 millionths, without trailing zeros. */
function putDecimals(millionths: number, bytes: Uint8Array, at: number): number {
  bytes[at] = DOT;
  const high = Math.floor(millionths / 1000);
  const low = millionths - 1000 * high;
  let end = putTriple(high, bytes, at + 1);
  if (low !== 0) end = putTriple(low, bytes, end);
  while (bytes[end - 1] === ZERO) end--;
  return end;
}

function putLeading(n: number, bytes: Uint8Array, at: number): number {
  const o = 3 * n;
  if (n >= 100) bytes[at++] = TRIPLES[o];
  if (n >= 10) bytes[at++] = TRIPLES[o + 1];
  bytes[at] = TRIPLES[o + 2];
  return at + 1;
}

function putTriple(n: number, bytes: Uint8Array, at: number): number {
  const o = 3 * n;
  bytes[at] = TRIPLES[o];
  bytes[at + 1] = TRIPLES[o + 1];
  bytes[at + 2] = TRIPLES[o + 2];
  return at + 3;
}
