/** Removes from sums the last digits that binary addition leaves. */

/** Decimal digits that a double is sure to keep. */
const KEPT = 15;

/**
 * The nearest decimal number whose last digit is the 15th of `size`: 0.4726 for 0.47259999999999996.
 * @param size magnitude of the summands, which sets the size of the error
 */
export function withoutRoundOff(value: number, size: number): number {
  const decimals = KEPT - 1 - Math.floor(Math.log10(Math.max(Math.abs(value), size)));
  // `toFixed` takes at most 100. Adding 0 removes −0, which would be written with its sign.
  return Number.isFinite(decimals) ? Number(value.toFixed(Math.max(0, Math.min(100, decimals)))) + 0 : value;
}
