/** Reads inputs once, for their hash and for what is made of them. */
import { createHash } from 'node:crypto';
import { closeSync, fstatSync, openSync, readSync, statSync } from 'node:fs';
import type { GivenPath } from '../paths.ts';
import { fileBytes, readPieces } from '../read-file.ts';

export interface ReadInput {
  /** SHA-256 of all bytes, hexadecimal. */
  readonly hash: string;
  /** Absent: too many to be held. Overwritten by the next input. */
  readonly bytes?: Uint8Array;
}

/** Larger files are read twice, a megabyte at a time, so that memory is bounded. */
const MAX_HELD = 32 << 20;

export class InputReader {
  /** As large as the largest input so far, since fresh memory for each costs as much as reading it. */
  private held = new Uint8Array(0);

  /** @param most larger files are not held; bytes */
  constructor(private readonly most = MAX_HELD) {}

  read({ absolute: path, bytes: unpacked }: GivenPath): ReadInput {
    if (unpacked) return { hash: hashOfBytes(unpacked), bytes: unpacked };
    const stats = statSync(path);
    if (!stats.isFile() || stats.size === 0) {
      // A pipe can't be read twice; files of /proc don't say how large they are.
      const bytes = fileBytes(path);
      return { hash: hashOfBytes(bytes), bytes };
    }
    const file = openSync(path, 'r');
    try {
      const { size } = fstatSync(file);
      if (size > this.most) return { hash: hashOf(path) };
      // One more byte tells that the file has not grown.
      if (this.held.length <= size) this.held = new Uint8Array(size + 1);
      let length = 0;
      for (let read = -1; read !== 0 && length <= size; length += read) {
        read = readSync(file, this.held, length, size + 1 - length, null);
      }
      if (length !== size) throw new Error('it changed while it was being read; try again');
      const bytes = this.held.subarray(0, length);
      return { hash: hashOfBytes(bytes), bytes };
    } finally {
      closeSync(file);
    }
  }
}

function hashOfBytes(bytes: Uint8Array): string {
  return createHash('sha256').update(bytes).digest('hex');
}

/** SHA-256 of a file on disk or in an archive, hexadecimal. @throws Error as `hashOf` */
export function hashOfGiven({ absolute, bytes }: Pick<GivenPath, 'absolute' | 'bytes'>): string {
  return bytes ? hashOfBytes(bytes) : hashOf(absolute);
}

/** SHA-256 of a file, hexadecimal. @throws Error if it can't be read, or is not a file, and so can't be read again */
export function hashOf(path: string): string {
  if (!statSync(path).isFile()) throw new Error(`${path} is not a file; save it to one first`);
  const hash = createHash('sha256');
  readPieces(path, (piece) => hash.update(piece));
  return hash.digest('hex');
}
