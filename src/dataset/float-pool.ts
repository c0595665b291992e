/**
 * Memory for the arrays of one take after the other: fresh pages for each, and collecting them, cost as much as filling
 * them. It holds as much as the largest take needed.
 */
import type { Floats } from './data-array.ts';

/** Precisions that arrays can be written in. */
export const PRECISIONS = ['float32', 'float64'] as const;
/** The precision of an array; see `PRECISIONS`. */
export type Precision = (typeof PRECISIONS)[number];

/** Gives out arrays of one precision, and takes all of them back at once. */
export class FloatPool {
  private readonly buffers: Floats[] = [];
  private next = 0;

  constructor(readonly precision: Precision) {}

  /** The arrays given since then are used again. */
  reset(): void {
    this.next = 0;
  }

  /** An array with any content. */
  take(size: number): Floats {
    const i = this.next++;
    const own = this.buffers[i];
    if (own && own.length >= size) return own.subarray(0, size);
    const made = this.precision === 'float64' ? new Float64Array(size) : new Float32Array(size);
    this.buffers[i] = made;
    return made;
  }
}
