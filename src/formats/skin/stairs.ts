/**
 * Finds the first number of a list that reaches a bound which is only known after the list and its bytes are gone: the
 * joint indices of `skinweights` against the `bindings` that follow.
 *
 * The first number ≥ bound is larger than all before it. So it is enough to record each new maximum with its place; for
 * joints these are few.
 *
 * Rejected: the place of every number (8 bytes each), or of every 4096th (gives no line).
 */
import type { Place } from '../places.ts';
import type { Tokens } from '../tokens.ts';

/**
 * Number of places that keep their line to show; beyond it (ascending triangles before positions) only line numbers are
 * kept.
 */
const SHOWN = 256;
const NONE = new Float64Array(0);

/** Records each new maximum of a list with its place, so that a bound that is known later can be checked. */
export class Stairs {
  max = -1;
  private values: Float64Array = NONE;
  private lines: Float64Array = NONE;
  private count = 0;
  private readonly places: Place[] = [];

  /** A new maximum, in a sink's `flush`. */
  add(value: number, t: Tokens, slot: number): void {
    this.max = value;
    if (this.count === this.values.length) {
      this.values = grown(this.values);
      this.lines = grown(this.lines);
    }
    if (this.count < SHOWN) this.places.push(t.placeOfSlot(slot));
    else this.lines[this.count] = t.lineOfSlot(slot);
    this.values[this.count++] = value;
  }

  /** The first number that was at least `bound`. */
  first(bound: number): { value: number; place: Place } | undefined {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.values[middle] < bound) low = middle + 1;
      else high = middle;
    }
    if (low === this.count) return undefined;
    return { value: this.values[low], place: this.places[low] ?? { line: this.lines[low], column: 1 } };
  }
}

function grown(array: Float64Array): Float64Array {
  const twice = new Float64Array(Math.max(16, 2 * array.length));
  twice.set(array);
  return twice;
}
