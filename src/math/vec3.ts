/** x, y, z. */
export type Vec3 = readonly [number, number, number];

export const ZERO: Vec3 = [0, 0, 0];

/**
 * Makes `a[o …]` a vector of length 1, in place, however long or short it is. False, and nothing changed, where it has
 * no direction: zero, or not finite.
 */
export function normalizeAt(a: Float64Array, o: number): boolean {
  const x = a[o];
  const y = a[o + 1];
  const z = a[o + 2];
  const square = x * x + y * y + z * z;
  if (square > 1e-200 && square < 1e200) {
    const s = 1 / Math.sqrt(square);
    a[o] = x * s;
    a[o + 1] = y * s;
    a[o + 2] = z * s;
    return true;
  }
  // Squares would leave the range of doubles: measure in units of the largest component.
  const largest = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
  if (!(largest > 0 && largest < Infinity)) return false;
  const s = 1 / Math.hypot(x / largest, y / largest, z / largest);
  a[o] = (x / largest) * s;
  a[o + 1] = (y / largest) * s;
  a[o + 2] = (z / largest) * s;
  return true;
}
