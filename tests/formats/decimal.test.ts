import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { parseDecimal } from '../../src/formats/decimal.ts';
import { type Scan, scanNumbers } from '../../src/formats/scan.ts';
import { bytesOf } from './read-in-pieces.ts';

/** Through both ways: the number loop, which has ways of its own for most spellings, and `parseDecimal`. */
function expectLikeNumber(text: string): void {
  const bytes = bytesOf(`${text} `);
  const expected = Number(text);
  const found = parseDecimal(bytes, 0, bytes.length - 1);
  if (!Object.is(found, expected)) expect.fail(`${text} is ${found}, but ${expected} is meant`);
  if (!Number.isFinite(expected)) return;
  const out = new Float64Array(2);
  const scan: Scan = { at: 0, count: 0, limit: 2, lineFeeds: 0 };
  scanNumbers(bytes, bytes.length, out, scan, undefined);
  if (scan.count !== 1 || !Object.is(out[0], expected)) {
    expect.fail(`${text} is ${scan.count} numbers in a loop, ${out[0]}, but ${expected} is meant`);
  }
}

const digits = (max: number) => fc.stringMatching(new RegExp(`^[0-9]{1,${max}}$`));
const double = fc.double({ noNaN: true, noDefaultInfinity: true });

describe('decimals', () => {
  it('decimals are the very doubles that Number gives, for the shortest text of any double', () => {
    fc.assert(
      fc.property(double, (x) => expectLikeNumber(String(x))),
      { numRuns: 3000 },
    );
  });

  it('decimals and for any number of digits of it', () => {
    const ordinary = fc.tuple(fc.double({ min: -1, max: 1, noNaN: true }), fc.integer({ min: -3, max: 6 }));
    fc.assert(
      fc.property(ordinary, fc.integer({ min: 1, max: 25 }), ([x, e], precision) => {
        expectLikeNumber((x * 10 ** e).toPrecision(precision));
        expectLikeNumber((x * 10 ** e).toFixed(Math.min(20, precision)));
      }),
      { numRuns: 3000 },
    );
  });

  it('decimals and for any spelling: signs, leading zeros, a bare point, exponents, very many digits', () => {
    const mantissa = fc.oneof(
      digits(40),
      fc.tuple(digits(25), digits(25)).map(([a, b]) => `${a}.${b}`),
      digits(30).map((a) => `.${a}`),
      digits(30).map((a) => `${a}.`),
      fc.tuple(fc.nat(30), digits(20)).map(([zeros, a]) => `0.${'0'.repeat(zeros)}${a}`),
    );
    const exponent = fc.oneof(
      fc.constant(''),
      fc.tuple(fc.constantFrom('e', 'E'), fc.constantFrom('', '+', '-'), fc.nat(340)).map((parts) => parts.join('')),
    );
    fc.assert(
      fc.property(fc.constantFrom('', '+', '-'), mantissa, exponent, (...parts) => expectLikeNumber(parts.join(''))),
      { numRuns: 5000 },
    );
  });

  it('round correctly next to and at the middle between two doubles', () => {
    fc.assert(
      fc.property(fc.integer({ min: 2 ** 52, max: 2 ** 53 - 1 }), fc.integer({ min: -12, max: 12 }), (m, power) => {
        const middle = (BigInt(m) * 2n + 1n) * 2n ** 12n;
        const text = power >= 0 ? `${middle * 2n ** BigInt(power)}` : middleText(middle, -power);
        expectLikeNumber(text);
        expectLikeNumber(text.includes('.') ? `${text}1` : `${text}.0000001`);
        expectLikeNumber(text.slice(0, 17));
        expectLikeNumber(text.slice(0, 18));
      }),
    );
  });

  it.each(['', '+', '-', '.', '-.', 'e5', '.e5', '1e', '1e+', '1e5.', '1.2.3', '12x5', '1,5', '--1', '+-1', '1_0'])(
    '%j is none',
    (text) => {
      const bytes = bytesOf(text);
      expect(parseDecimal(bytes, 0, bytes.length)).toBeNaN();
    },
  );

  it.each(['nan', 'NaN', 'inf', '-Infinity', '0x10', '0b1', '1f', '1e5d', '٣'])(
    '%j is none, whatever C says',
    (text) => {
      const bytes = bytesOf(text);
      expect(parseDecimal(bytes, 0, bytes.length)).toBeNaN();
    },
  );

  it('tell too large from too small', () => {
    expect(parseDecimal(bytesOf('1e999'), 0, 5)).toBe(Number.POSITIVE_INFINITY);
    expect(parseDecimal(bytesOf('-1e999'), 0, 6)).toBe(Number.NEGATIVE_INFINITY);
    expect(parseDecimal(bytesOf('-1e-999'), 0, 7)).toBe(-0);
    expect(parseDecimal(bytesOf('0e99999999999999999999'), 0, 22)).toBe(0);
  });
});

/** `middle / 2^power` as an exact decimal. */
function middleText(middle: bigint, power: number): string {
  const scaled = `${middle * 5n ** BigInt(power)}`;
  return `${scaled.slice(0, -power)}.${scaled.slice(-power)}`;
}
