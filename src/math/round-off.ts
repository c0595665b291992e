/** Sums without what adding in binary leaves in their last digits. */

/** Digits of a decimal number that a double surely keeps. */
const KEPT = 15;

/**
 * The nearest decimal number whose last digit is the 15th of `size`: 0.4726 for 0.47259999999999996.
 * @param size of what it was added up from: so far up its errors begin
 */
export function withoutRoundOff(value: number, size: number): number {
  const decimals = KEPT - 1 - Math.floor(Math.log10(Math.max(Math.abs(value), size)));
  // `toFixed` has no more; without -0, which would be written with its sign.
  return Number.isFinite(decimals) ? Number(value.toFixed(Math.max(0, Math.min(100, decimals)))) + 0 : value;
}
