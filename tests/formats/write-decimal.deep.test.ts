import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { parseDecimal } from '../../src/formats/decimal.ts';
import { LONGEST_DECIMAL, putDecimal } from '../../src/formats/write-decimal.ts';

const bytes = new Uint8Array(LONGEST_DECIMAL + 2);

/** What is written for a value; undefined if it is left to `String`. */
function written(value: number): string | undefined {
  bytes.fill(0);
  const end = putDecimal(value, bytes, 1);
  if (end < 0) {
    expect(bytes.every((byte) => byte === 0)).toBe(true);
    return undefined;
  }
  expect(end).toBeLessThanOrEqual(1 + LONGEST_DECIMAL);
  return new TextDecoder().decode(bytes.subarray(1, end));
}

/** As captures have them: so many millionths. */
const decimals = fc
  .tuple(fc.maxSafeInteger(), fc.integer({ min: 0, max: 6 }))
  .map(([w, places]) => Math.trunc(w / 10) / 10 ** places);

describe('writing a decimal', () => {
  it('gives what String gives, or nothing, for any double', () => {
    fc.assert(
      fc.property(fc.oneof(fc.double(), fc.float(), decimals, fc.integer()), (value) => {
        const text = written(value);
        if (text !== undefined) expect(text).toBe(String(value));
      }),
      { numRuns: 10_000 },
    );
  });

  it('writes every number of up to six decimals below a thousand million, which reads back the very same', () => {
    const millionths = fc.integer({ min: -(10 ** 15) + 1, max: 10 ** 15 - 1 });
    const places = fc.integer({ min: 0, max: 6 });
    fc.assert(
      fc.property(millionths, places, (w, fewer) => {
        // As few decimals as that, and the number that such a text reads as.
        const value = Number(`${Math.trunc(w / 10 ** fewer)}e${fewer - 6}`);
        fc.pre(!Object.is(value, -0));
        const text = written(value);
        expect(text).toBe(String(value));
        const read = new TextEncoder().encode(text);
        expect(parseDecimal(read, 0, read.length)).toBe(value);
      }),
      { numRuns: 10_000 },
    );
  });

  it('leaves to String what has more decimals, is larger, or is no such number', () => {
    for (const value of [1e-7, 0.1234567, 0.1 + 0.2, 1e9, 1e300, -0, Number.NaN, Infinity, -Infinity]) {
      expect(written(value)).toBeUndefined();
    }
  });

  it('writes both sides of every length', () => {
    for (const value of [
      0, 1, 9, 10, 99, 100, 999, 1000, 999_999, 1_000_000, 999_999_999, 0.000001, 100.01, 1e-6, 0.5,
    ]) {
      expect(written(value)).toBe(String(value));
      if (value !== 0) expect(written(-value)).toBe(String(-value));
    }
    expect(written(999_999_999.999999)).toBe('999999999.999999');
  });
});
