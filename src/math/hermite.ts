/**
 * The cubic Hermite curve between two keys, as a polynomial in the time since the first:
 *
 *     p(τ) = a + b·τ + c·τ² + d·τ³      p(0) = v0, p′(0) = m0, p(h) = v1, p′(h) = m1
 *
 *     a = v0        c = (3·(v1 − v0)/h − 2·m0 − m1) / h
 *     b = m0        d = (m0 + m1 − 2·(v1 − v0)/h) / h²
 *
 * In seconds rather than in u = τ/h, so that evaluation needs no division and slopes stay values per second.
 */

/**
 * Writes a, b, c, d to `out[o …]`. If values are too large or the segment too short for a cubic in doubles, the segment
 * becomes a straight line, or a step if even that overflows; the result is always finite.
 */
export function hermiteCubic(
  v0: number,
  m0: number,
  v1: number,
  m1: number,
  h: number,
  out: Float64Array,
  o: number,
): void {
  const secant = (v1 - v0) / h;
  const c = (3 * secant - 2 * m0 - m1) / h;
  const d = (m0 + m1 - 2 * secant) / (h * h);
  out[o] = v0;
  if (Number.isFinite(c) && Number.isFinite(d)) {
    out[o + 1] = m0;
    out[o + 2] = c;
    out[o + 3] = d;
  } else {
    out[o + 1] = Number.isFinite(secant) ? secant : 0;
    out[o + 2] = 0;
    out[o + 3] = 0;
  }
}
