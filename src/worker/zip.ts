/** Files out of a zip, by fflate. Entries that no reader wants are never unpacked. */
import { unzipSync } from 'fflate';

export interface ZipEntry {
  /** The archive's own path of the file. */
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** More than this unpacked is refused: an archive can claim terabytes. */
export const MAX_UNPACKED_BYTES = 2 ** 31;

/** Throws an `Error` with a sentence when it is no zip, is damaged, or would unpack to too much. */
export function unzip(
  bytes: Uint8Array,
  wanted: (path: string) => boolean,
): { entries: ZipEntry[]; passedOver: string[] } {
  const passedOver: string[] = [];
  let total = 0;
  const files = unzipSync(bytes, {
    filter({ name, originalSize }) {
      // Folders, and what macOS puts beside each file.
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
