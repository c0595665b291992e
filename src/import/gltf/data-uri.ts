/** `data:application/octet-stream;base64,AAAA…`: bytes inside the JSON. */

const ALPHABET = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
const SKIPPED = 255;
const VALUES = new Uint8Array(256).fill(SKIPPED);
for (let i = 0; i < 64; i++) VALUES[ALPHABET.charCodeAt(i)] = i;
// The alphabet of URLs, which some programs use.
VALUES['-'.charCodeAt(0)] = 62;
VALUES['_'.charCodeAt(0)] = 63;

/** The content of a data URI. */
export interface DataUri {
  readonly mime: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Undefined if it is another URI. Characters that don't belong into it are passed over. */
export function readDataUri(uri: string): DataUri | undefined {
  const comma = uri.indexOf(',');
  if (!uri.startsWith('data:') || comma < 0) return undefined;
  const [mime, ...parameters] = uri.slice(5, comma).split(';');
  const isBase64 = parameters.some((p) => p.toLowerCase() === 'base64');
  const bytes = isBase64 ? fromBase64(uri, comma + 1) : new TextEncoder().encode(unescaped(uri.slice(comma + 1)));
  return { mime, bytes };
}

/** A URI or a path with its %20 and the like resolved; as it is if they are broken. */
export function unescaped(uri: string): string {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

/** The bytes of a text, from one of its characters on. */
export function fromBase64(text: string, from = 0): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(Math.floor(((text.length - from) * 3) / 4));
  let written = 0;
  let bits = 0;
  let held = 0;
  for (let i = from; i < text.length; i++) {
    const value = VALUES[text.charCodeAt(i) & 255];
    if (value === SKIPPED) continue;
    held = ((held << 6) | value) & 0xffffff;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out[written++] = (held >> bits) & 255;
  }
  return out.slice(0, written);
}
