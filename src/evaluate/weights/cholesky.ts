/**
 * Solves A·x = b for A = Laplacian + diagonal, symmetric and positive definite, by a sparse Cholesky factorisation A =
 * L·Lᵀ: row by row, with patterns from the elimination tree (T. Davis, "Direct Methods for Sparse Linear Systems",
 * 2006, chapter 4). One factorisation serves all joints; each then costs one pass over L.
 *
 * Conjugate gradients with an incomplete factorisation are slower: on a tube of 100,000 vertices with triangles five
 * times as long as wide they take 190 iterations per joint, a second each.
 */
import { type Steps, within } from '../steps.ts';
import { eliminationOrder } from './elimination-order.ts';
import type { Laplacian } from './laplacian.ts';

/** Multiplications between two yields: a few milliseconds. */
const WORK_A_STEP = 2e5;
const ROWS_A_STEP = 4000;
/** Fraction of the time for the elimination order. */
const ORDERED = 0.2;

interface Pattern {
  /** The matrix's entries left of the diagonal, in elimination order: row k starts at `start[k]`. */
  readonly start: Uint32Array;
  readonly columns: Uint32Array;
  readonly values: Float64Array;
  readonly diagonal: Float64Array;
  /** Parents in the elimination tree; -1 for a root. */
  readonly parents: Int32Array;
}

/** The factor L of one matrix, by which systems with any right side are solved. */
export class Cholesky {
  private readonly scratch: Float64Array;

  private constructor(
    private readonly order: Uint32Array,
    /** Column k of L: `start[k]` up to (excluding) `start[k + 1]`; its diagonal first. */
    private readonly start: Float64Array,
    private readonly rows: Uint32Array,
    private readonly values: Float64Array,
  ) {
    this.scratch = new Float64Array(order.length);
  }

  /**
   * Yields its progress every few milliseconds.
   * @param added to the Laplacian's diagonal; greater than 0 in at least one row of each connected part
   * @param positions x y z per vertex
   */
  static *of(matrix: Laplacian, added: Float64Array, positions: Float64Array): Steps<Cholesky> {
    const size = added.length;
    const order = yield* within(eliminationOrder(matrix, positions), 0, ORDERED);
    const pattern = yield* reordered(matrix, added, order);
    const { columns, values, diagonal } = pattern;
    const reach = new Reach(pattern);
    const start = new Float64Array(size + 1);
    for (let k = 0; k < size; k++) {
      start[k + 1]++;
      for (let i = reach.find(k); i < size; i++) start[reach.stack[i] + 1]++;
      if (k % ROWS_A_STEP === 0) yield ORDERED;
    }
    // As doubles: in very large meshes the sums exceed 2³².
    for (let k = 0; k < size; k++) start[k + 1] += start[k];
    const rows = new Uint32Array(start[size]);
    const factor = new Float64Array(start[size]);
    const end = start.slice(0, size);
    const row = new Float64Array(size);
    reach.restart();
    let work = 0;
    let all = 0;
    for (let k = 0; k < size; k++) {
      const first = reach.find(k);
      for (let e = pattern.start[k]; e < pattern.start[k + 1]; e++) row[columns[e]] = values[e];
      let left = diagonal[k];
      for (let s = first; s < size; s++) {
        const i = reach.stack[s];
        const from = start[i];
        const to = end[i];
        const value = row[i] / factor[from];
        row[i] = 0;
        for (let p = from + 1; p < to; p++) row[rows[p]] -= factor[p] * value;
        left -= value * value;
        rows[to] = k;
        factor[to] = value;
        end[i] = to + 1;
        work += to - from;
      }
      rows[end[k]] = k;
      // Positive in exact arithmetic.
      factor[end[k]++] = Math.sqrt(left > 1e-14 * diagonal[k] ? left : diagonal[k]);
      all += start[k + 1] - start[k];
      if (work > WORK_A_STEP) {
        work = 0;
        yield ORDERED + ((1 - ORDERED) * all) / start[size];
      }
    }
    return new Cholesky(order, start, rows, factor);
  }

  /** Yields every few milliseconds. */
  *solve(b: Float64Array, x: Float64Array): Generator<undefined, void> {
    const { order, start, rows, values, scratch: y } = this;
    const size = order.length;
    for (let k = 0; k < size; k++) y[k] = b[order[k]];
    let work = 0;
    for (let k = 0; k < size; k++) {
      // Leading zeros stay zero: heat from one joint starts in few rows.
      if (y[k] === 0) continue;
      const from = start[k];
      const to = start[k + 1];
      const value = y[k] / values[from];
      y[k] = value;
      for (let p = from + 1; p < to; p++) y[rows[p]] -= values[p] * value;
      work += to - from;
      if (work > WORK_A_STEP) {
        work = 0;
        yield;
      }
    }
    for (let k = size - 1; k >= 0; k--) {
      const from = start[k];
      const to = start[k + 1];
      let sum = y[k];
      for (let p = from + 1; p < to; p++) sum -= values[p] * y[rows[p]];
      y[k] = sum / values[from];
      x[order[k]] = y[k];
      work += to - from;
      if (work > WORK_A_STEP) {
        work = 0;
        yield;
      }
    }
  }
}

/** The matrix with rows and columns in elimination order, and the resulting tree. */
function* reordered(matrix: Laplacian, added: Float64Array, order: Uint32Array): Steps<Pattern> {
  const size = order.length;
  const place = new Uint32Array(size);
  for (let k = 0; k < size; k++) place[order[k]] = k;
  const start = new Uint32Array(size + 1);
  const columns = new Uint32Array(matrix.columns.length / 2);
  const values = new Float64Array(matrix.columns.length / 2);
  const diagonal = new Float64Array(size);
  const parents = new Int32Array(size).fill(-1);
  const ancestors = new Int32Array(size).fill(-1);
  let end = 0;
  for (let k = 0; k < size; k++) {
    if (k % ROWS_A_STEP === 0) yield ORDERED;
    const v = order[k];
    diagonal[k] = matrix.diagonal[v] + added[v];
    for (let e = matrix.start[v]; e < matrix.start[v + 1]; e++) {
      const column = place[matrix.columns[e]];
      if (column >= k) continue;
      columns[end] = column;
      values[end++] = -matrix.values[e];
      for (let i = column; i >= 0 && i < k; ) {
        const next = ancestors[i];
        ancestors[i] = k;
        if (next < 0) parents[i] = k;
        i = next;
      }
    }
    start[k + 1] = end;
  }
  return { start, columns, values, diagonal, parents };
}

/** The patterns of the rows of L, one at a time. */
class Reach {
  /** Result of `find`: from the returned index to the end. */
  readonly stack: Uint32Array;
  private readonly marks: Int32Array;
  private readonly path: Uint32Array;

  constructor(private readonly pattern: Pattern) {
    const size = pattern.diagonal.length;
    this.stack = new Uint32Array(size);
    this.path = new Uint32Array(size);
    this.marks = new Int32Array(size).fill(-1);
  }

  restart(): void {
    this.marks.fill(-1);
  }

  /**
   * Finds the columns of row k left of its diagonal, in an order in which they can be eliminated. @returns their start
   * in `stack`
   */
  find(k: number): number {
    const { marks, stack, path } = this;
    const { start, columns, parents } = this.pattern;
    let top = stack.length;
    marks[k] = k;
    for (let e = start[k]; e < start[k + 1]; e++) {
      let length = 0;
      for (let i = columns[e]; marks[i] !== k; i = parents[i]) {
        path[length++] = i;
        marks[i] = k;
      }
      while (length > 0) stack[--top] = path[--length];
    }
    return top;
  }
}
