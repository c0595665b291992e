/** Triangles of a mesh. */

/**
 * Twice the area of a triangle, times its normal: (b − a) × (c − a). It points to the side from which the corners run
 * anticlockwise.
 *
 * @param positions x y z per vertex
 * @param a offset of the first corner's x in `positions`; `b` and `c` likewise
 * @param out x, y, z: written, so that a loop over triangles allocates nothing
 */
export function areaNormal(positions: Float64Array, a: number, b: number, c: number, out: Float64Array): void {
  const ux = positions[b] - positions[a];
  const uy = positions[b + 1] - positions[a + 1];
  const uz = positions[b + 2] - positions[a + 2];
  const vx = positions[c] - positions[a];
  const vy = positions[c + 1] - positions[a + 1];
  const vz = positions[c + 2] - positions[a + 2];
  out[0] = uy * vz - uz * vy;
  out[1] = uz * vx - ux * vz;
  out[2] = ux * vy - uy * vx;
}
