/**
 * Bounds for how far points are off, so that most needn't be looked at. A point p of a node whose matrix is off by D is
 * off by
 *
 *     |D p| ≤ |D c| + ‖D‖ · |p − c|
 *
 * with c the middle of the node's points; one that follows several nodes by no more than the weighted sum.
 */
import type { Watch } from './watch.ts';

/** The middles of the nodes' points, and how far points are from these. */
export interface PointBounds {
  /** The middle of the points of each node, in its space: x y z each. */
  readonly middles: Float64Array;
  /** How far each pair's point is from it, times the pair's weight; endless where morphs move it. */
  readonly levers: Float64Array;
}

/** More than what rounding adds to a bound. */
const ROUNDING = 1 + 1e-9;

/** Computes the bounds of all watched points. */
export function bounded({ nodeOf, local, morphStart }: Watch, nodeCount: number): PointBounds {
  const least = new Float64Array(3 * nodeCount).fill(Infinity);
  const greatest = new Float64Array(3 * nodeCount).fill(-Infinity);
  nodeOf.forEach((n, i) => {
    for (let k = 0; k < 3; k++) {
      least[3 * n + k] = Math.min(least[3 * n + k], local[4 * i + k]);
      greatest[3 * n + k] = Math.max(greatest[3 * n + k], local[4 * i + k]);
    }
  });
  // A node without points has its middle where it is.
  const middles = least.map((low, i) => (low <= greatest[i] ? (low + greatest[i]) / 2 : 0));
  const levers = Float64Array.from(nodeOf, (n, i) => {
    if (morphStart[i + 1] > morphStart[i]) return Infinity;
    const [x, y, z] = [0, 1, 2].map((k) => local[4 * i + k] - middles[3 * n + k]);
    return ROUNDING * local[4 * i + 3] * Math.hypot(x, y, z);
  });
  return { middles, levers };
}
