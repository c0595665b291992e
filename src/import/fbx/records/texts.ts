const UTF8 = new TextDecoder();

/** A power of two. */
const KNOWN_TEXTS = 4096;
/** Bytes of a text that is looked up, and words that hold them with what is left of the last one. */
const MAX_SHORT = 63;
const WORDS = 16;

/** Texts of ASCII by their hash: a few hundred names make up nearly all of a file, and most of them are in every file. */
const known: string[] = new Array<string>(KNOWN_TEXTS).fill('');
/** Their bytes, four in a word; the last word is filled up with zeros. */
const knownWords = new Uint32Array(WORDS * KNOWN_TEXTS);

/** The texts in the bytes of a file, in UTF-8. */
export class Texts {
  private readonly view: DataView;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  /** The text of the bytes from `start` to `end` (excluding). */
  of(start: number, end: number): string {
    const { view } = this;
    const length = end - start;
    // Of the last word, too, four bytes are read.
    if (length > MAX_SHORT || end + 4 > view.byteLength) return UTF8.decode(this.bytes.subarray(start, end));
    const last = end - 3;
    let hash = length;
    let at = start;
    for (; at < last; at += 4) hash = mixed(hash, view.getUint32(at, true));
    const rest = view.getUint32(at, true) & ((1 << (8 * (end - at))) - 1);
    const slot = (mixed(hash, rest) >>> 16) & (KNOWN_TEXTS - 1);
    // Those of a hash take each other's place if they are more than two.
    if (this.isKnown(slot, start, end, rest)) return known[slot];
    if (this.isKnown(slot ^ 1, start, end, rest)) return known[slot ^ 1];
    return this.decoded(start, end, known[slot] === '' ? slot : slot ^ 1);
  }

  /** Whether a slot holds the text, the last word of which is given. */
  private isKnown(slot: number, start: number, end: number, rest: number): boolean {
    if (known[slot].length !== end - start) return false;
    const { view } = this;
    let at = start;
    let word = WORDS * slot;
    for (; at < end - 3; at += 4) if (knownWords[word++] !== view.getUint32(at, true)) return false;
    return knownWords[word] === rest;
  }

  private decoded(start: number, end: number, slot: number): string {
    const { bytes } = this;
    for (let at = start; at < end; at++) if (bytes[at] > 127) return UTF8.decode(bytes.subarray(start, end));
    // A decoder takes as long to begin as for hundreds of letters.
    const text = String.fromCharCode(...bytes.subarray(start, end));
    known[slot] = text;
    knownWords.fill(0, WORDS * slot, WORDS * (slot + 1));
    for (let i = 0; i < text.length; i++) knownWords[WORDS * slot + (i >> 2)] |= bytes[start + i] << (8 * (i & 3));
    return text;
  }
}

function mixed(hash: number, word: number): number {
  const product = Math.imul(hash ^ word, 0x9e3779b1);
  return product ^ (product >>> 15);
}
