/** Unpacks the compressed arrays of FBX files: zlib data whose unpacked size is known. */
import { inflate } from '../../../formats/inflate.ts';

/** Whether so many bytes can unpack to that size: deflate packs at most 1032 into one. */
export function canUnpackTo(packedBytes: number, size: number): boolean {
  return size <= 1040 * packedBytes + 64;
}

/** Bytes before the deflated data. */
const HEADER = 2;

/** The unpacked bytes; undefined if the data is damaged or unpacks to another size. */
export function inflateExactly(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> | undefined {
  if (!canUnpackTo(packed.length, size) || !isZlib(packed)) return undefined;
  const out = new Uint8Array(size);
  const { ending, length } = inflate(packed.subarray(HEADER), out);
  return ending === 'whole' && length === size ? out : undefined;
}

/** Whether data begins as deflated, without a dictionary of its own (RFC 1950). */
function isZlib([method, flags]: Uint8Array): boolean {
  return (method & 15) === 8 && method >> 4 <= 7 && (flags & 32) === 0 && (256 * method + flags) % 31 === 0;
}
