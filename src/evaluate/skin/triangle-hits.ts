/** Where a segment passes through triangles. */

/** Triangles by their vertices. */
export interface TriangleMesh {
  /** x y z per vertex. */
  readonly positions: ArrayLike<number>;
  /** Three vertices each. */
  readonly triangles: ArrayLike<number>;
}

/** Hits of a segment, overwritten by each query. Grows. */
export class Hits {
  count = 0;
  /** Positions on the segment, 0 to 1, ascending. */
  times = new Float64Array(32);
  /** Triangle indices. */
  triangles = new Uint32Array(32);
  /** Whether the segment runs along the triangle's normal (a, b, c counterclockwise seen from its tip). */
  along = new Uint8Array(32);

  /** Inserts a hit, sorted by `time`, its position on the segment from 0 to 1. */
  add(time: number, triangle: number, along: boolean): void {
    if (this.count === this.times.length) {
      this.times = grown(this.times, new Float64Array(2 * this.count));
      this.triangles = grown(this.triangles, new Uint32Array(2 * this.count));
      this.along = grown(this.along, new Uint8Array(2 * this.count));
    }
    let at = this.count++;
    for (; at > 0 && this.times[at - 1] > time; at--) {
      this.times[at] = this.times[at - 1];
      this.triangles[at] = this.triangles[at - 1];
      this.along[at] = this.along[at - 1];
    }
    this.times[at] = time;
    this.triangles[at] = triangle;
    this.along[at] = along ? 1 : 0;
  }
}

function grown<T extends Float64Array | Uint32Array | Uint8Array>(old: T, wide: T): T {
  wide.set(old);
  return wide;
}

/**
 * Adds where a segment passes through a triangle, by Möller and Trumbore's test. The segment starts at (ox, oy, oz),
 * and (dx, dy, dz) leads to its end.
 *
 * @param t index of the triangle
 * @param vertex triangles at it are passed over; -1: none
 */
export function hitTriangle(
  { positions: p, triangles }: TriangleMesh,
  t: number,
  vertex: number,
  ox: number,
  oy: number,
  oz: number,
  dx: number,
  dy: number,
  dz: number,
  hits: Hits,
): void {
  const i = triangles[3 * t];
  const j = triangles[3 * t + 1];
  const k = triangles[3 * t + 2];
  if (i === vertex || j === vertex || k === vertex) return;
  const ax = p[3 * i];
  const ay = p[3 * i + 1];
  const az = p[3 * i + 2];
  const ux = p[3 * j] - ax;
  const uy = p[3 * j + 1] - ay;
  const uz = p[3 * j + 2] - az;
  const vx = p[3 * k] - ax;
  const vy = p[3 * k + 1] - ay;
  const vz = p[3 * k + 2] - az;
  const qx = dy * vz - dz * vy;
  const qy = dz * vx - dx * vz;
  const qz = dx * vy - dy * vx;
  const determinant = ux * qx + uy * qy + uz * qz;
  if (determinant === 0) return;
  const sx = ox - ax;
  const sy = oy - ay;
  const sz = oz - az;
  const u = (sx * qx + sy * qy + sz * qz) / determinant;
  // Slightly enlarged, so that nothing slips through between two.
  if (u < -1e-9 || u > 1 + 1e-9) return;
  const rx = sy * uz - sz * uy;
  const ry = sz * ux - sx * uz;
  const rz = sx * uy - sy * ux;
  const v = (dx * rx + dy * ry + dz * rz) / determinant;
  if (v < -1e-9 || u + v > 1 + 1e-9) return;
  const time = (vx * rx + vy * ry + vz * rz) / determinant;
  // The determinant is −d · (u × v).
  if (time > 0 && time < 1) hits.add(time, t, determinant < 0);
}
