/** Extracts files from a zip, by fflate. Unwanted entries are never unpacked. */

import { unzipSync } from 'fflate';
import { UserError } from '../model/user-error.ts';
import { zipDirectory } from './zip-directory.ts';

/** A file taken out of an archive. */
export interface ZipEntry {
  /** The file's path in the archive. */
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Larger archives are refused, since one can claim terabytes. */
const MAX_UNPACKED_BYTES = 2 ** 31;
/** Compressed data is never larger than what it holds, but for its headers. */
const HEADERS = 1024;
/** Most bytes that one byte of deflated data can hold. */
const MAX_RATIO = 1032;

/** A zip that is in order, but isn't unpacked; its message says why, to go on after a colon. */
export class ZipRefusal extends UserError {}

/**
 * Throws an `Error` with a sentence if it is no zip or is damaged, a `ZipRefusal` if it is encrypted or would be too
 * large unpacked.
 *
 * @param maxBytes of all that is wanted, unpacked
 */
export function unzip(
  bytes: Uint8Array,
  wanted: (path: string) => boolean,
  maxBytes = MAX_UNPACKED_BYTES,
): { entries: ZipEntry[]; passedOver: string[] } {
  const passedOver: string[] = [];
  let [total, packed] = [0, 0];
  // fflate would unpack them to noise.
  const encrypted = new Set(zipDirectory(bytes)?.flatMap(({ name, isEncrypted }) => (isEncrypted ? [name] : [])));
  const files = unzipSync(bytes, {
    filter({ name, size, originalSize }) {
      // Folders, and the extra files of macOS.
      if (name.endsWith('/') || name.startsWith('__MACOSX/') || name.endsWith('.DS_Store')) return false;
      if (!wanted(name)) {
        passedOver.push(name);
        return false;
      }
      if (encrypted.has(name)) throw new ZipRefusal(`${name} is encrypted; unpack the zip with its password first`);
      total += originalSize;
      packed += size;
      if (total > maxBytes) throw new ZipRefusal(`it would unpack to more than ${maxBytes} bytes`);
      // What is unpacked is cut at its stated size, but only after all of it was read.
      if (size > originalSize + HEADERS) throw new Error(`${name} is larger packed than unpacked`);
      if (originalSize > MAX_RATIO * (size + HEADERS)) {
        throw new Error(`${name} states ${originalSize} bytes, more than its ${size} packed bytes can hold`);
      }
      // One piece of data for many entries makes an archive of kilobytes unpack to gigabytes.
      if (packed > bytes.length) throw new Error('its entries overlap');
      return true;
    },
  });
  const entries = Object.entries(files).map(([path, content]) => ({ path, bytes: withOwnBuffer(content) }));
  return { entries, passedOver };
}

/** As handed over between threads: with all of its buffer. Copied only if need be, since it may have hundreds of MB. */
function withOwnBuffer(content: Uint8Array): Uint8Array<ArrayBuffer> {
  const { buffer } = content;
  const isWhole = buffer instanceof ArrayBuffer && buffer.byteLength === content.byteLength;
  return isWhole ? new Uint8Array(buffer) : new Uint8Array(content);
}
