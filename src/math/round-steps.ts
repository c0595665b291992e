/**
 * Round steps, 1, 2 or 5 · 10ⁿ: what lines of a grid are apart, and what numbers snap to. The least that is large enough
 * suits a character of 0.02 units and one of 200.
 */

/** The least number of the form 1, 2 or 5 · 10ⁿ that is not below `atLeast`; 1 where that is no positive number. */
export function roundStep(atLeast: number): number {
  if (!(atLeast > 0) || !Number.isFinite(atLeast)) return 1;
  const exponent = Math.floor(Math.log10(atLeast));
  for (const step of [1, 2, 5]) {
    const spacing = decimal(step, exponent);
    // A spacing that is `atLeast` but for rounding will do.
    if (spacing >= atLeast * (1 - 1e-9)) return spacing;
  }
  return decimal(1, exponent + 1);
}

/** Into how many cells lines without a label divide one cell of a labelled spacing: 2 is 4 × 0.5, 1 and 5 are 5 × 0.2. */
export function subdivisions(spacing: number): number {
  const leading = Number(spacing.toExponential(0).split('e')[0]);
  return leading === 2 ? 4 : 5;
}

/** `steps` times the spacing, with just the decimals that the spacing needs: 3 × 0.05 is "0.15", not 0.15000000000000002. */
export function gridLabel(steps: number, spacing: number): string {
  const value = steps * spacing;
  if (steps === 0) return '0';
  const exponent = Math.floor(Math.log10(spacing) + 1e-9);
  // As many digits as tell this line from the next; short only where they are few.
  const digits = Math.max(0, Math.floor(Math.log10(Math.abs(value)) + 1e-9) - exponent);
  if ((Math.abs(value) >= 1e6 || exponent < -4) && digits <= 3) {
    return value.toExponential(digits).replace('e+', 'e');
  }
  return value.toFixed(Math.max(0, -exponent));
}

/** Through text, so that 2 · 10⁻³ is the double that 0.002 is. */
function decimal(digit: number, exponent: number): number {
  return Number(`${digit}e${exponent}`);
}
