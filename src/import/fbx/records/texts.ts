const UTF8 = new TextDecoder();

/** Entries of `Texts`; a power of two. */
const TEXT_SLOTS = 1024;
/** Bytes of a text that is looked up. */
const MAX_SHORT = 64;

/**
 * The texts of a file, each decoded once: a few hundred names make up nearly all of it, and a decoder takes as long to
 * begin as for hundreds of letters.
 */
export class Texts {
  private readonly texts: string[] = [];
  private readonly starts = new Int32Array(TEXT_SLOTS);
  private readonly lengths = new Int32Array(TEXT_SLOTS).fill(-1);

  constructor(private readonly bytes: Uint8Array) {}

  /** UTF-8. */
  of(start: number, end: number): string {
    const { bytes, starts, lengths, texts } = this;
    const length = end - start;
    if (length > MAX_SHORT) return UTF8.decode(bytes.subarray(start, end));
    let hash = length;
    for (let at = start; at < end; at++) hash = (Math.imul(hash, 31) + bytes[at]) | 0;
    const slot = (hash ^ (hash >>> 16)) & (TEXT_SLOTS - 1);
    if (lengths[slot] === length) {
      const known = starts[slot];
      let i = 0;
      while (i < length && bytes[known + i] === bytes[start + i]) i++;
      if (i === length) return texts[slot];
    }
    starts[slot] = start;
    lengths[slot] = length;
    texts[slot] = decoded(bytes, start, end);
    return texts[slot];
  }
}

function decoded(bytes: Uint8Array, start: number, end: number): string {
  let text = '';
  for (let at = start; at < end; at++) {
    if (bytes[at] > 127) return UTF8.decode(bytes.subarray(start, end));
    text += String.fromCharCode(bytes[at]);
  }
  return text;
}
