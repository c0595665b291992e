/** Extracts files from a zip, by fflate. Unwanted entries are never unpacked. */
import { unzipSync } from 'fflate';

export interface ZipEntry {
  /** The file's path in the archive. */
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Larger archives are refused, since one can claim terabytes. */
const MAX_UNPACKED_BYTES = 2 ** 31;

/** Throws an `Error` with a sentence if it is no zip, is damaged, or would be too large unpacked. */
export function unzip(
  bytes: Uint8Array,
  wanted: (path: string) => boolean,
): { entries: ZipEntry[]; passedOver: string[] } {
  const passedOver: string[] = [];
  let total = 0;
  const files = unzipSync(bytes, {
    filter({ name, originalSize }) {
      // Folders, and the extra files of macOS.
      if (name.endsWith('/') || name.startsWith('__MACOSX/') || name.endsWith('.DS_Store')) return false;
      if (!wanted(name)) {
        passedOver.push(name);
        return false;
      }
      total += originalSize;
      if (total > MAX_UNPACKED_BYTES) throw new Error(`it would unpack to more than ${MAX_UNPACKED_BYTES} bytes`);
      return true;
    },
  });
  const entries = Object.entries(files).map(([path, content]) => ({ path, bytes: new Uint8Array(content) }));
  return { entries, passedOver };
}
