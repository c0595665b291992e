/**
 * Distance of two motions with time warp: what remains when each frame of one may be compared with an earlier or later
 * one of the other, in order. Dynamic time warping with the symmetric steps of H. Sakoe and S. Chiba, *Dynamic
 * programming algorithm optimization for spoken word recognition*, IEEE Trans. ASSP 26 (1978), P = 0:
 *
 *     D(i, j) = min( D(i − 1, j) + d,  D(i − 1, j − 1) + 2d,  D(i, j − 1) + d )        D(0, 0) = 2d
 *
 * d is the mean distance of the joints in frames i and j. D at the end is divided by the sum of the weights, which is
 * the number of frames of both: a mean distance, the same in either order.
 */
import type { Steps } from '../steps.ts';

/** The distance of two motions with time warp, and the frames that were compared for it. */
export interface TimeWarp {
  /** Mean over the path, in the unit of the positions. */
  readonly distance: number;
  /** Pairs of frames, i and j in turn, from the first ones to the last ones. */
  readonly path: Int32Array;
}

/** How far a frame may be moved, as a part of the take. */
export const WARP_WINDOW = 0.1;

/** Cells between two progress reports, a few milliseconds at most. */
const CELLS_AT_A_TIME = 8192;

/**
 * Yields progress, 0 to 1. The window is around the line from the first to the last frames, and contains it.
 * @param one x y z of each joint, frame by frame; at least one frame
 * @param two the same joints
 * @param width numbers per frame, at least 3
 */
export function* timeWarp(
  one: Float64Array,
  two: Float64Array,
  width: number,
  window: number = WARP_WINDOW,
): Steps<TimeWarp> {
  const n = one.length / width;
  const m = two.length / width;
  // Cells with |i (m − 1) − j (n − 1)| up to this; those beside the line always.
  const reach = window * (n - 1) * (m - 1) + Math.max(n - 1, m - 1);
  const first = new Int32Array(n);
  const start = new Int32Array(n + 1);
  for (let i = 0; i < n; i++) {
    const middle = i * (m - 1);
    const to = n > 1 ? Math.min(m - 1, Math.floor((middle + reach) / (n - 1))) : m - 1;
    first[i] = n > 1 ? Math.max(0, Math.ceil((middle - reach) / (n - 1))) : 0;
    start[i + 1] = start[i] + to - first[i] + 1;
  }
  const steps = new Uint8Array(start[n]);
  let above = new Float64Array(m + 1).fill(Number.POSITIVE_INFINITY);
  let row = new Float64Array(m + 1);
  let cells = 0;
  for (let i = 0; i < n; i++) {
    // Cell j is at j + 1, so that there is one before the first.
    row.fill(Number.POSITIVE_INFINITY);
    const end = first[i] + start[i + 1] - start[i];
    for (let j = first[i]; j < end; j++) {
      if (++cells % CELLS_AT_A_TIME === 0) yield i / n;
      const d = meanDistance(one, i * width, two, j * width, width);
      let least = i === 0 && j === 0 ? 2 * d : above[j] + 2 * d;
      let step = DIAGONAL;
      if (above[j + 1] + d < least) {
        least = above[j + 1] + d;
        step = FROM_ABOVE;
      }
      if (row[j] + d < least) {
        least = row[j] + d;
        step = FROM_LEFT;
      }
      row[j + 1] = least;
      steps[start[i] + j - first[i]] = step;
    }
    [above, row] = [row, above];
  }
  return { distance: above[m] / (n + m), path: pathOf(steps, first, start, n, m) };
}

const DIAGONAL = 0;
const FROM_ABOVE = 1;
const FROM_LEFT = 2;

function pathOf(steps: Uint8Array, first: Int32Array, start: Int32Array, n: number, m: number): Int32Array {
  const path: number[] = [];
  let i = n - 1;
  let j = m - 1;
  for (;;) {
    path.push(j, i);
    if (i === 0 && j === 0) break;
    const step = steps[start[i] + j - first[i]];
    if (step !== FROM_LEFT) i--;
    if (step !== FROM_ABOVE) j--;
  }
  return Int32Array.from(path.reverse());
}

function meanDistance(a: Float64Array, ao: number, b: Float64Array, bo: number, width: number): number {
  let sum = 0;
  for (let k = 0; k < width; k += 3) {
    const x = a[ao + k] - b[bo + k];
    const y = a[ao + k + 1] - b[bo + k + 1];
    const z = a[ao + k + 2] - b[bo + k + 2];
    sum += Math.sqrt(x * x + y * y + z * z);
  }
  return (3 * sum) / width;
}
