/** Bytes of the first buffer, and of the others: those of a few hundred curves. */
const FIRST_BYTES = 1 << 13;
const BUFFER_BYTES = 1 << 16;
/** Lists of fewer bytes share one. */
const MAX_SHARED = 1 << 12;

/**
 * Short lists of numbers in shared buffers, since a buffer takes as long to allocate as a hundred numbers to write, and
 * a file has thousands of lists. For numbers that are gone once the file is read: a list keeps its whole buffer.
 */
export class NumberPool {
  private buffer = new ArrayBuffer(0);
  private at = 0;

  /** So many zeros. */
  doubles(count: number): Float64Array<ArrayBuffer> {
    if (!this.fits(8 * count)) return new Float64Array(count);
    return new Float64Array(this.buffer, this.place(8 * count), count);
  }

  /** So many zeros. */
  floats(count: number): Float32Array<ArrayBuffer> {
    if (!this.fits(4 * count)) return new Float32Array(count);
    return new Float32Array(this.buffer, this.place(4 * count), count);
  }

  /** So many zeros. */
  integers(count: number): Int32Array<ArrayBuffer> {
    if (!this.fits(4 * count)) return new Int32Array(count);
    return new Int32Array(this.buffer, this.place(4 * count), count);
  }

  /** Whether a list is short enough; makes room for it. */
  private fits(bytes: number): boolean {
    if (bytes >= MAX_SHARED) return false;
    if (this.at + bytes > this.buffer.byteLength) {
      this.buffer = new ArrayBuffer(this.buffer.byteLength === 0 ? FIRST_BYTES : BUFFER_BYTES);
      this.at = 0;
    }
    return true;
  }

  private place(bytes: number): number {
    const at = this.at;
    // Doubles are at multiples of their size.
    this.at += Math.ceil(bytes / 8) * 8;
    return at;
  }
}
