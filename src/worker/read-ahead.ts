/**
 * The bytes of many files, in their order. Every read is a message to the browser and back: the small files that come
 * next are read while one is parsed, so that a thousand takes don't wait a thousand times.
 */

/** Larger files come in pieces, and are never in memory as a whole. */
const SMALL_BYTES = 1 << 20;
const AT_ONCE = 8;

export class ReadAhead {
  private readonly small: Iterator<Blob>;
  private readonly begun = new Map<Blob, Promise<ArrayBuffer>>();

  /** @param blobs in the order in which they will be asked for */
  constructor(blobs: readonly Blob[]) {
    this.small = blobs.filter(({ size }) => size <= SMALL_BYTES).values();
  }

  /**
   * Hands a file's bytes over, in pieces.
   * @throws DOMException if it can't be read
   */
  async read(blob: Blob, take: (chunk: Uint8Array) => void): Promise<void> {
    this.begin();
    const whole = this.begun.get(blob);
    if (whole) {
      const bytes = new Uint8Array(await whole);
      this.begun.delete(blob);
      this.begin();
      take(bytes);
      return;
    }
    const reader = blob.stream().getReader();
    for (let next = await reader.read(); !next.done; next = await reader.read()) take(next.value);
  }

  private begin(): void {
    while (this.begun.size < AT_ONCE) {
      const next = this.small.next();
      if (next.done) return;
      const bytes = next.value.arrayBuffer();
      // Who asks for it is told.
      bytes.catch(() => undefined);
      this.begun.set(next.value, bytes);
    }
  }
}
