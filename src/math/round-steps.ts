/**
 * Round steps, 1, 2 or 5 · 10ⁿ, for grid lines and snapping. Choosing the smallest sufficient one works for characters
 * of 0.02 units and of 200.
 */

/** The next is infinite. */
const LARGEST = 1e308;

/** The smallest number of the form 1, 2 or 5 · 10ⁿ not below `atLeast`, up to 1e308; 1 if that is not a positive number. */
export function roundStep(atLeast: number): number {
  if (!(atLeast > 0) || !Number.isFinite(atLeast)) return 1;
  const exponent = Math.floor(Math.log10(atLeast));
  for (const step of [1, 2, 5]) {
    const spacing = decimal(step, exponent);
    // Accepts a spacing that equals `atLeast` up to rounding.
    if (spacing >= atLeast * (1 - 1e-9)) return Math.min(spacing, LARGEST);
  }
  return Math.min(decimal(1, exponent + 1), LARGEST);
}

/**
 * The whole numbers from `from` to `to`, at most `most` of them: multiples of a step. None if they are so large that
 * one isn't told from the next, as in a window of a microsecond at a time in nanoseconds since 1970.
 */
export function wholeNumbers(from: number, to: number, most: number): number[] {
  const first = Math.ceil(from) + 0;
  const last = Math.floor(to);
  if (!Number.isSafeInteger(first) || !(last >= first)) return [];
  return Array.from({ length: Math.min(most, last - first + 1) }, (_, i) => first + i);
}

/** The number of unlabelled cells per labelled one: 2 is 4 × 0.5, 1 and 5 are 5 × 0.2. */
export function subdivisions(spacing: number): number {
  const leading = Number(spacing.toExponential(0).split('e')[0]);
  return leading === 2 ? 4 : 5;
}

/**
 * `steps` times the spacing, with only the decimals that the spacing needs: 3 × 0.05 is "0.15", not
 * 0.15000000000000002.
 */
export function gridLabel(steps: number, spacing: number): string {
  const value = steps * spacing;
  if (steps === 0) return '0';
  const exponent = Math.floor(Math.log10(spacing) + 1e-9);
  // Enough digits to tell this line from the next; exponential only if they are few.
  const digits = Math.max(0, Math.floor(Math.log10(Math.abs(value)) + 1e-9) - exponent);
  const isShort = (Math.abs(value) >= 1e6 || exponent < -4) && digits <= 3;
  const text = isShort ? value.toExponential(digits).replace('e+', 'e') : value.toFixed(Math.max(0, -exponent));
  // As in all labels of the interface.
  return text.replaceAll('-', '−');
}

/** Through text, so that 2 · 10⁻³ is the same double as 0.002. */
function decimal(digit: number, exponent: number): number {
  return Number(`${digit}e${exponent}`);
}
