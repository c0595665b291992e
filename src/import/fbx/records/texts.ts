const UTF8 = new TextDecoder();

/** A power of two. */
const KNOWN_TEXTS = 4096;
/** Bytes of a text that is looked up. */
const MAX_SHORT = 64;

/** Texts of ASCII by their hash: a few hundred names make up nearly all of a file, and most of them are in every file. */
const known: string[] = new Array<string>(KNOWN_TEXTS).fill('');

/** The text of bytes, in UTF-8. */
export function textOf(bytes: Uint8Array, start: number, end: number): string {
  const length = end - start;
  if (length > MAX_SHORT) return UTF8.decode(bytes.subarray(start, end));
  let hash = length;
  for (let at = start; at < end; at++) hash = (Math.imul(hash, 31) + bytes[at]) | 0;
  const slot = (hash ^ (hash >>> 16)) & (KNOWN_TEXTS - 1);
  const text = known[slot];
  if (text.length === length) {
    let i = 0;
    while (i < length && text.charCodeAt(i) === bytes[start + i]) i++;
    if (i === length) return text;
  }
  return decoded(bytes, start, end, slot);
}

function decoded(bytes: Uint8Array, start: number, end: number, slot: number): string {
  for (let at = start; at < end; at++) if (bytes[at] > 127) return UTF8.decode(bytes.subarray(start, end));
  // A decoder takes as long to begin as for hundreds of letters.
  const text = String.fromCharCode(...bytes.subarray(start, end));
  known[slot] = text;
  return text;
}
