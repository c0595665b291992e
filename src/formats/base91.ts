/**
 * Bytes as printable ASCII that HTML reads as it is: of all 94 signs that can be seen, those without `"`, `&` and `<`.
 * As basE91 by Joachim Henke, with signs of our own: two of 91 hold 13 bits, or 14 where these are below 89. So 16 bits
 * take less than 20, where base 64 takes 21.3.
 */

const SIGNS = Array.from({ length: 94 }, (_, i) => 33 + i).filter((code) => !'"&<'.includes(String.fromCharCode(code)));
const BASE = SIGNS.length;
/** Pairs of signs beyond those of 13 bits. */
const SPARE = BASE * BASE - 8192;

/** The bytes as text. */
export function toBase91(bytes: Uint8Array): string {
  const out = new Uint8Array(Math.ceil((bytes.length * 16) / 13) + 4);
  let length = 0;
  let queue = 0;
  let bits = 0;
  const put = (value: number) => {
    out[length++] = SIGNS[value % BASE];
    out[length++] = SIGNS[Math.floor(value / BASE)];
  };
  for (const byte of bytes) {
    queue |= byte << bits;
    bits += 8;
    if (bits <= 13) continue;
    const low = queue & 8191;
    const taken = low < SPARE ? 14 : 13;
    put(queue & ((1 << taken) - 1));
    queue >>= taken;
    bits -= taken;
  }
  if (bits > 0) put(queue);
  // One sign is enough for what is left, and says that no second byte follows.
  if (bits > 0 && bits < 8 && queue < BASE) length--;
  return new TextDecoder().decode(out.subarray(0, length));
}

/** The bytes of a text that `toBase91` made; blanks and line ends in it are passed over. */
export function fromBase91(text: string): Uint8Array<ArrayBuffer> {
  const values = new Int8Array(128).fill(-1);
  SIGNS.forEach((code, value) => {
    values[code] = value;
  });
  const out = new Uint8Array(Math.floor((text.length * 14) / 16) + 2);
  let length = 0;
  let queue = 0;
  let bits = 0;
  let first = -1;
  for (let i = 0; i < text.length; i++) {
    const value = values[text.charCodeAt(i)] ?? -1;
    if (value < 0) continue;
    if (first < 0) {
      first = value;
      continue;
    }
    const pair = first + value * BASE;
    first = -1;
    queue |= pair << bits;
    bits += (pair & 8191) < SPARE ? 14 : 13;
    for (; bits >= 8; bits -= 8) {
      out[length++] = queue & 255;
      queue >>= 8;
    }
  }
  if (first >= 0) out[length++] = queue | (first << bits);
  return out.slice(0, length);
}
