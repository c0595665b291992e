/**
 * The chunks of a PNG of 8 bits a channel (https://www.w3.org/TR/png-3/):
 *
 *     signature  IHDR (size, bits, colour type)  given chunks  IEND
 *     chunk      length of its data, type, data, CRC-32 of type and data
 */
import { crc32 } from './crc32.ts';

/** Contents of pixels: indices of a palette are bytes, colours are a byte a channel. */
const COLOUR_TYPES = { rgb: 2, palette: 3, rgba: 6 } as const;

/** A chunk of a PNG, without length and checksum. */
export interface PngChunk {
  /** Four letters. */
  readonly type: string;
  readonly data: Uint8Array;
}

/**
 * The file. Its chunks are written as they are given: `PLTE` before `IDAT`, whose data is compressed already.
 * @param size width and height, pixels
 */
export function pngFile(
  size: readonly [width: number, height: number],
  colours: keyof typeof COLOUR_TYPES,
  chunks: readonly PngChunk[],
): Uint8Array<ArrayBuffer> {
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, size[0]);
  view.setUint32(4, size[1]);
  header.set([8, COLOUR_TYPES[colours]], 8);
  const all = [{ type: 'IHDR', data: header }, ...chunks, { type: 'IEND', data: new Uint8Array(0) }];
  const file = new Uint8Array(all.reduce((sum, { data }) => sum + 12 + data.length, SIGNATURE.length));
  file.set(SIGNATURE);
  let at = SIGNATURE.length;
  for (const chunk of all) at = writeChunk(chunk, file, at);
  return file;
}

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Returns where the next one begins. */
function writeChunk({ type, data }: PngChunk, file: Uint8Array, at: number): number {
  const view = new DataView(file.buffer);
  const end = at + 8 + data.length;
  view.setUint32(at, data.length);
  for (let i = 0; i < 4; i++) file[at + 4 + i] = type.charCodeAt(i);
  file.set(data, at + 8);
  view.setUint32(end, crc32(file.subarray(at + 4, end)));
  return end + 4;
}
