/**
 * Comparing numbers: named tolerances, and matchers that print both vectors at their difference.
 *
 * A number passes when |got − expected| ≤ tolerance · max(1, |expected|), as the reference files state it.
 */
import { expect } from 'vitest';

export const WITHIN = {
  /** What the reference files require of programs in doubles. */
  reference: 1e-7,
  /** The same in floats, relative to the largest coordinate of the model. */
  referenceFloat: 5e-6,
  /** Two ways to compute the same in doubles. */
  rounding: 1e-12,
} as const;

/** Fails with both lists and the largest difference. */
export function expectClose(
  got: ArrayLike<number>,
  expected: ArrayLike<number>,
  tolerance: number,
  what = 'numbers',
): void {
  let worst = -1;
  let excess = 0;
  for (let i = 0; i < Math.max(got.length, expected.length); i++) {
    const off = Math.abs(got[i] - expected[i]) / (tolerance * Math.max(1, Math.abs(expected[i])));
    // Written so that NaN and missing numbers are worse than any difference.
    if (!(off <= Math.max(1, excess))) {
      worst = i;
      excess = Number.isNaN(off) ? Infinity : off;
    }
  }
  if (worst < 0) return;
  const around = (list: ArrayLike<number>) => {
    const from = list.length > 24 ? Math.max(0, worst - 8) : 0;
    const shown = Array.from({ length: Math.min(24, list.length - from) }, (_, i) => list[from + i]);
    return `${from ? `… from ${from}: ` : ''}${shown.join('  ')}`;
  };
  const times = excess === Infinity ? '' : `, ${excess.toPrecision(3)} times the tolerance of ${tolerance}`;
  expect.fail(
    `${what} differ most at ${worst}: got ${got[worst]}, expected ${expected[worst]}${times}\n` +
      `got       ${around(got)}\nexpected  ${around(expected)}`,
  );
}
