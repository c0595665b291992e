/** Extracts files from a zip, by fflate. Unwanted entries are never unpacked. */
import { unzipSync } from 'fflate';

export interface ZipEntry {
  /** The file's path in the archive. */
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Larger archives are refused, since one can claim terabytes. */
const MAX_UNPACKED_BYTES = 2 ** 31;
/** Compressed data is never larger than what it holds, but for its headers. */
const HEADERS = 1024;

/**
 * Throws an `Error` with a sentence if it is no zip, is damaged, or would be too large unpacked.
 * @param maxBytes of all that is wanted, unpacked
 */
export function unzip(
  bytes: Uint8Array,
  wanted: (path: string) => boolean,
  maxBytes = MAX_UNPACKED_BYTES,
): { entries: ZipEntry[]; passedOver: string[] } {
  const passedOver: string[] = [];
  let total = 0;
  const files = unzipSync(bytes, {
    filter({ name, size, originalSize }) {
      // Folders, and the extra files of macOS.
      if (name.endsWith('/') || name.startsWith('__MACOSX/') || name.endsWith('.DS_Store')) return false;
      if (!wanted(name)) {
        passedOver.push(name);
        return false;
      }
      total += originalSize;
      if (total > maxBytes) throw new Error(`it would unpack to more than ${maxBytes} bytes`);
      // What is unpacked is cut at its stated size, but only after all of it was read.
      if (size > originalSize + HEADERS) throw new Error(`${name} is larger packed than unpacked`);
      return true;
    },
  });
  const entries = Object.entries(files).map(([path, content]) => ({ path, bytes: new Uint8Array(content) }));
  return { entries, passedOver };
}
