/**
 * Writes numpy's `.npz`: a zip of `.npy` files, stored, as `np.savez` does. All times are the first of 1980, so that
 * the same arrays give the same bytes.
 *
 *     each entry     local header, name, content
 *     at the end     central directory: a header and the name of each entry; end record
 */
import type { DataArray } from './data-array.ts';
import { npyPieces } from './npy.ts';

/** CRC-32 as in zip. @param value of the bytes before; default 0 */
export type Crc32 = (bytes: Uint8Array, value?: number) => number;

const VERSION = 20;
/** The first of January 1980. */
const DATE = 0x21;
/** Names are UTF-8. */
const UTF8 = 0x800;

/** One after the other, the file. Contents are views of the arrays, which must not change until they are written. */
export function npzPieces(arrays: readonly DataArray[], crc32: Crc32): readonly Uint8Array[] {
  const pieces: Uint8Array[] = [];
  const directory: Uint8Array[] = [];
  let at = 0;
  for (const array of arrays) {
    const [header, content] = npyPieces(array);
    const name = asciiOf(`${array.name}.npy`);
    const size = header.length + content.length;
    // Of no bytes at all zlib's own result is 0, whatever came before.
    const crc = content.length > 0 ? crc32(content, crc32(header)) : crc32(header);
    const common = fields([2, VERSION, 2, UTF8, 2, 0, 2, 0, 2, DATE, 4, crc, 4, size, 4, size]);
    const named = [...common, ...fields([2, name.length, 2, 0])];
    const start = at;
    const local = Uint8Array.from([...fields([4, 0x04034b50]), ...named, ...name]);
    pieces.push(local, header, content);
    at += local.length + size;
    // No comment, disk 0, no attributes.
    const rest = fields([2, 0, 2, 0, 2, 0, 4, 0, 4, start]);
    directory.push(Uint8Array.from([...fields([4, 0x02014b50, 2, VERSION]), ...named, ...rest, ...name]));
  }
  const length = directory.reduce((sum, entry) => sum + entry.length, 0);
  const count = directory.length;
  return [
    ...pieces,
    ...directory,
    Uint8Array.from(fields([4, 0x06054b50, 2, 0, 2, 0, 2, count, 2, count, 4, length, 4, at, 2, 0])),
  ];
}

/** Little-endian numbers: pairs of a width in bytes and a value. */
function fields(pairs: readonly number[]): number[] {
  const out: number[] = [];
  for (let i = 0; i < pairs.length; i += 2) {
    for (let b = 0; b < pairs[i]; b++) out.push((pairs[i + 1] >>> (8 * b)) & 0xff);
  }
  return out;
}

function asciiOf(text: string): readonly number[] {
  return Array.from(text, (character) => character.charCodeAt(0));
}
