/**
 * An elimination order of a mesh's vertices that keeps the matrix factor sparse: nested dissection (A. George 1973), by
 * recursive bisection in space. The separator comes after both halves:
 *
 *     order   [ half, its halves likewise | other half | vertices of that one with neighbours in the first ]
 *
 * On a surface of n vertices the separators have about √n vertices, and the factor has n·log n entries.
 */
import type { Steps } from '../steps.ts';
import type { Laplacian } from './laplacian.ts';
import { longestAxis, selectMiddle } from './select.ts';

/** Too few to be split further. */
const LEAF = 24;
/** Vertices sorted between two yields. */
const SORTED_A_STEP = 20000;

/**
 * The vertices in elimination order. Yields its progress every few milliseconds.
 * @param positions x y z per vertex
 */
export function* eliminationOrder(matrix: Laplacian, positions: Float64Array): Steps<Uint32Array> {
  const count = positions.length / 3;
  const { start, columns } = matrix;
  const order = Uint32Array.from({ length: count }, (_, v) => v);
  /** For each vertex, the last bisection in which it was in the first half. */
  const halving = new Uint32Array(count);
  let halvings = 0;
  let done = 0;
  let work = 0;
  const open = [0, count];
  while (open.length > 0) {
    const to = open.pop() ?? 0;
    const from = open.pop() ?? 0;
    work += to - from + LEAF;
    if (work > SORTED_A_STEP) {
      work = 0;
      yield done / count;
    }
    if (to - from <= LEAF) {
      done += to - from;
      continue;
    }
    const half = (from + to) >> 1;
    selectMiddle(order, positions, longestAxis(order, positions, from, to - 1), from, to - 1, half);
    const mark = ++halvings;
    for (let i = from; i < half; i++) halving[order[i]] = mark;
    let end = to;
    for (let i = half; i < end; ) {
      const v = order[i];
      let separates = false;
      for (let e = start[v]; e < start[v + 1] && !separates; e++) separates = halving[columns[e]] === mark;
      if (separates) {
        order[i] = order[--end];
        order[end] = v;
      } else i++;
    }
    done += to - end;
    open.push(half, end, from, half);
  }
  return order;
}
