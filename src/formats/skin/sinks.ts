/**
 * Sinks for the blocks of a `.skin` whose numbers are indices. They process a few thousand numbers at a time, while
 * these are in the cache and their bytes are available, so that errors get exact places.
 */
import type { Attachments } from '../../model/skin.ts';
import { MAX_COUNT, nextLength, WrongIndices } from '../grammar.ts';
import { BATCH, NUMBERS } from '../number-batch.ts';
import type { Place } from '../places.ts';
import type { Mark, NumberSink, Tokens } from '../tokens.ts';
import { Stairs } from './stairs.ts';

/** Larger indices can't be stored. */
const LIMIT = MAX_COUNT - 1;
/** Before the first numbers: thousands of blocks may have none. */
const NO_INDICES = new Uint32Array(0);
const NO_WEIGHTS = new Float64Array(0);
/** Tolerance of the sum of a vertex's weights. */
const SUM_TOLERANCE = 0.01;

/** `triangles M { a b c … }`, of all such blocks one after the other. */
export class TriangleSink implements NumberSink {
  readonly values = NUMBERS;
  count = 0;
  readonly usesUp = true;
  found = 0;
  private indices: Uint32Array = new Uint32Array(0);
  private expected = 0;
  private wrong: WrongIndices;
  /** Used while the number of vertices is unknown. */
  private readonly stairs: Stairs | undefined;

  /** `vertices`: their number, if positions were read already. */
  constructor(private readonly vertices: number | undefined) {
    this.stairs = vertices === undefined ? new Stairs() : undefined;
    this.wrong = wrongVertices(vertices);
  }

  /** Before a block that declares `expected` numbers. */
  begin(t: Tokens, expected: number): void {
    this.expected = this.found + Math.max(0, expected);
    this.wrong = wrongVertices(this.vertices);
    if (this.found > 0) {
      // As many as declared would copy all of them for each of thousands of small blocks.
      this.expected = Math.max(this.expected, 1.5 * this.found);
      return;
    }
    this.indices = new Uint32Array(Math.min(t.numbersAtHand(), Math.max(64, expected)));
  }

  /** Moves the numbers read so far into the list of indices; reports those that are no vertex. */
  flush(t: Tokens): void {
    const { values, count, stairs } = this;
    this.indices = roomFor(this.indices, this.found + count, this.expected);
    const { indices, found } = this;
    const bound = this.vertices ?? LIMIT;
    for (let i = 0; i < count; i++) {
      const value = values[i];
      const index = value >>> 0;
      indices[found + i] = index;
      if (index !== value || index >= bound) this.wrong.addSlot(value, t, i);
      else if (stairs && index > stairs.max) {
        stairs.add(index, t, i);
      }
    }
    this.found += count;
    this.count = 0;
  }

  /** After the block. */
  tell(t: Tokens): void {
    this.wrong.tell(t);
  }

  /** Once the number of vertices is known. @param positions where they are, which may have replaced earlier ones */
  tellOutOfRange(t: Tokens, vertices: number, positions: Mark | undefined): void {
    const first = this.stairs?.first(vertices);
    if (first) {
      const late = wrongVertices(vertices);
      late.add(first.value, first.place);
      late.tell(t, countAtLeast(this.indices, this.found, vertices) - 1);
    } else if (positions && this.vertices !== undefined && vertices < this.vertices) {
      const named = this.namedBelow(this.vertices);
      if (named <= vertices) return;
      const message = `Triangles use ${named} vertices, but these positions, which replace earlier ones, are only ${vertices}.`;
      t.report.error('index-out-of-range', message, t.placeOf(positions, 'error'));
    }
  }

  /** One more than the largest index below `bound`. */
  private namedBelow(bound: number): number {
    let named = 0;
    for (let i = 0; i < this.found; i++) {
      const index = this.indices[i];
      if (index >= named && index < bound) named = index + 1;
    }
    return named;
  }

  /** All vertex indices, three per triangle, trimmed. */
  all(): Uint32Array {
    return this.found === this.indices.length ? this.indices : this.indices.slice(0, this.found);
  }
}

/** `skinweights N { k j0 w0 … }`: rows of any length, into the attachments of each vertex. */
export class AttachmentSink implements NumberSink {
  readonly values = NUMBERS;
  count = 0;
  readonly usesUp = true;
  /** Rows whose length was read. */
  rows = 0;
  /** Numbers still missing in the last row; Infinity if it states more attachments than can be stored. */
  missing = 0;
  private start: Uint32Array = NO_INDICES;
  private joints: Uint32Array = NO_INDICES;
  private weights: Float64Array = NO_WEIGHTS;
  private attachments = 0;
  private sum = 0;
  /** Whether a joint was read without its weight yet. (A huge `missing` can't tell odd from even.) */
  private isHalf = false;
  private readonly wrongCounts = new WrongIndices('a number of attachments', () => ' (0 or more)');
  private readonly wrongJoints = new WrongIndices('the index of a joint', () => ' (0 or more)');
  private readonly stairs = new Stairs();
  private offSums = 0;
  private firstOff: { vertex: number; sum: number; place: Place } | undefined;
  private bare = 0;
  private firstBare: { vertex: number; place: Place } | undefined;

  constructor(private readonly expectedRows: number) {}

  /** Reserves what a flush may add. */
  private grow(t: Tokens): void {
    const { attachments, rows, expectedRows } = this;
    // Every number may be a row.
    this.start = roomFor(this.start, rows + this.count + 1, expectedRows + BATCH + 1);
    const needed = attachments + (this.count >> 1) + 1;
    if (needed <= this.weights.length) return;
    // Extrapolated from the rows so far, at once if the available bytes could hold them.
    const expected = rows > 0 ? Math.ceil((1.01 * attachments * expectedRows) / rows) : 0;
    const atOnce = expected <= attachments + t.numbersAtHand() / 2 ? expected : needed;
    this.joints = roomFor(this.joints, Math.max(needed, atOnce), expected);
    const weights = new Float64Array(this.joints.length);
    weights.set(this.weights.subarray(0, attachments));
    this.weights = weights;
  }

  /**
   * Moves the numbers read so far into rows of joints and weights; reports counts that are no whole numbers from 0, and
   * joints that are no indices.
   */
  flush(t: Tokens): void {
    const { values, count, stairs } = this;
    this.grow(t);
    const { start, joints, weights } = this;
    let { rows, attachments, missing, sum } = this;
    let isJoint = !this.isHalf;
    let { max } = stairs;
    let i = 0;
    while (i < count) {
      if (missing === 0) {
        const k = values[i];
        start[rows++] = attachments;
        sum = 0;
        isJoint = true;
        // Compared as a double: a huge count is a row truncated by the block's end.
        // Beyond 2^53 it could not be counted down: how many are missing would depend on the pieces.
        if (k >= 1 && k % 1 === 0) missing = k < LIMIT ? 2 * k : Number.POSITIVE_INFINITY;
        else if (k !== 0) this.wrongCounts.addSlot(k, t, i);
        else if (this.bare++ === 0) this.firstBare = { vertex: rows - 1, place: t.placeOfSlot(i) };
        i++;
        continue;
      }
      // The available part of the row: possibly a weight whose joint was cut off, pairs, possibly a joint alone.
      const stop = Math.min(count, i + missing);
      missing -= stop - i;
      if (!isJoint) {
        sum += values[i];
        weights[attachments++] = values[i++];
        isJoint = true;
      }
      while (i < stop) {
        const value = values[i];
        const joint = value >>> 0;
        joints[attachments] = joint;
        if (joint > max || joint !== value) {
          if (joint !== value || joint >= LIMIT) this.wrongJoints.addSlot(value, t, i);
          else {
            stairs.add(joint, t, i);
            max = joint;
          }
        }
        if (++i === stop) {
          isJoint = false;
          break;
        }
        const weight = values[i++];
        sum += weight;
        weights[attachments++] = weight;
      }
      if (missing === 0 && !(Math.abs(sum - 1) <= SUM_TOLERANCE) && this.offSums++ === 0) {
        this.firstOff = { vertex: rows - 1, sum, place: t.placeOfSlot(i - 1) };
      }
    }
    this.rows = rows;
    this.attachments = attachments;
    this.missing = missing;
    this.sum = sum;
    this.isHalf = !isJoint;
    this.count = 0;
  }

  /** After the block. */
  tell(t: Tokens): void {
    this.wrongCounts.tell(t);
    this.wrongJoints.tell(t);
    if (this.firstOff) {
      const { vertex, sum, place } = this.firstOff;
      const others = this.offSums > 1 ? `; ${otherVertices(this.offSums - 1)} off too` : '';
      const message = `Expected weights that sum to 1, found ${Number(sum.toPrecision(6))} for vertex ${vertex}${others}.`;
      t.report.warn('weights-sum', message, place, 'used as given');
    }
    if (this.firstBare) {
      const { vertex, place } = this.firstBare;
      const others = this.bare > 1 ? `; ${otherVertices(this.bare - 1)} without any too` : '';
      t.report.warn(
        'attachments-missing',
        `Vertex ${vertex} has no attachments${others}.`,
        place,
        'it stays where it is',
      );
    }
  }

  /** Once the number of bindings is known. */
  tellOutOfRange(t: Tokens, bindings: number): void {
    const first = this.stairs.first(bindings);
    if (!first) return;
    const late = new WrongIndices('the index of a joint', () => range(bindings, 'bindings'));
    late.add(first.value, first.place);
    late.tell(t, countAtLeast(this.joints, this.attachments, bindings) - 1);
  }

  /** For this many vertices: those beyond the rows have none, rows beyond the vertices are dropped. */
  all(vertices: number): Attachments {
    const start = new Uint32Array(vertices + 1);
    const rows = Math.min(vertices, this.rows);
    start.set(this.start.subarray(0, rows));
    const last = rows < this.rows ? this.start[rows] : this.attachments;
    start.fill(last, rows);
    return { start, joints: trimmed(this.joints, last), weights: trimmed(this.weights, last) };
  }
}

/** The first `length` numbers: a view if little is left over, else a copy. */
function trimmed<A extends Uint32Array | Float64Array>(array: A, length: number): A {
  const isSnug = array.length - length <= array.length / 16;
  // Both methods return the type of array they are called on.
  return (isSnug ? array.subarray(0, length) : array.slice(0, length)) as A;
}

function wrongVertices(count: number | undefined): WrongIndices {
  return new WrongIndices('the index of a vertex', () => range(count));
}

function range(count: number | undefined, what = 'vertices'): string {
  if (count === undefined) return ' (0 or more)';
  return count === 0 ? `, but there are no ${what}` : ` from 0 to ${count - 1} (there are ${count} ${what})`;
}

function otherVertices(count: number): string {
  return count === 1 ? '1 other vertex is' : `${count} other vertices are`;
}

function countAtLeast(indices: Uint32Array, length: number, bound: number): number {
  let n = 0;
  for (let i = 0; i < length; i++) if (indices[i] >= bound) n++;
  return n;
}

function roomFor(array: Uint32Array, needed: number, expected: number): Uint32Array {
  if (needed <= array.length) return array;
  const grown = new Uint32Array(nextLength(array.length, needed, expected));
  grown.set(array);
  return grown;
}
