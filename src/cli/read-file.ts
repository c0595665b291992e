/** Files from disk, a megabyte at a time. What is not a file, such as a pipe, is read once, up to a limit. */
import { closeSync, fstatSync, openSync, readSync, statSync } from 'node:fs';

const CHUNK_BYTES = 1 << 20;
/** Scratch; readers keep nothing of it. */
const chunk = new Uint8Array(CHUNK_BYTES);
/** Of what doesn't say how large it is: pipes and devices, which may never end. */
const MAX_PIPED_BYTES = 256 << 20;
/** What one buffer of Node's holds. */
const MAX_WHOLE_BYTES = 2 ** 31 - 1;

/**
 * @param take gets each piece, which is overwritten by the next
 * @returns the number of bytes
 * @throws Error if it can't be read, changes meanwhile or, being no file, doesn't end
 */
export function readPieces(path: string, take: (piece: Uint8Array) => void): number {
  const file = openSync(path, 'r');
  try {
    const before = fstatSync(file);
    // Files of /proc have no size.
    const isSized = before.isFile() && before.size > 0;
    const limit = isSized ? before.size : MAX_PIPED_BYTES;
    let bytes = 0;
    while (bytes <= limit) {
      // Of a sized file a byte more, which there is if it has grown.
      const read = readSync(file, chunk, 0, Math.min(CHUNK_BYTES, limit + 1 - bytes), null);
      if (read === 0) break;
      bytes += read;
      if (bytes <= limit) take(chunk.subarray(0, read));
    }
    if (isSized && bytes !== before.size) throw new Error('it changed while it was being read; try again');
    if (bytes > limit) throw new Error(`it has more than ${limit >> 20} MB or no end; save it to a file first`);
    return bytes;
  } finally {
    closeSync(file);
  }
}

/** @param most bytes; default: as many as a buffer holds. @throws Error as `readPieces`, and if there are more */
export function fileBytes(path: string, most = MAX_WHOLE_BYTES): Uint8Array<ArrayBuffer> {
  const { size } = statSync(path);
  if (size > most) throw new Error(`it has ${size} bytes, more than the ${most} that can be read`);
  // A pipe has no size: grown as it is read.
  let bytes = new Uint8Array(size);
  let length = 0;
  readPieces(path, (piece) => {
    if (length + piece.length > bytes.length) {
      const grown = new Uint8Array(Math.max(2 * bytes.length, length + piece.length));
      grown.set(bytes);
      bytes = grown;
    }
    bytes.set(piece, length);
    length += piece.length;
  });
  return bytes.subarray(0, length);
}

/** Of lists, which have a line for each take. */
const MAX_TEXT_BYTES = 256 << 20;

/** In UTF-8. @throws Error as `fileBytes` */
export function fileText(path: string): string {
  return new TextDecoder().decode(fileBytes(path, MAX_TEXT_BYTES));
}
