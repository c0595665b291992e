/** Facts about a matrix: whether it only turns, and whether it mirrors. */

/** The largest element of |RᵀR − I|, R the upper left 3×3: 0 for a rotation. */
export function orthonormalityError(m: Float64Array, o = 0): number {
  let most = 0;
  for (let a = 0; a < 3; a++) {
    for (let b = a; b < 3; b++) {
      let dot = a === b ? -1 : 0;
      for (let r = 0; r < 3; r++) dot += m[o + 4 * a + r] * m[o + 4 * b + r];
      // Not Math.max: NaN is an error too.
      if (!(Math.abs(dot) <= most)) most = Math.abs(dot);
    }
  }
  return most;
}
