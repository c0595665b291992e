/**
 * The arrays of a `.npy` or a `.npz`, a zip of them. Only those that are asked for are unpacked, each up to the size
 * that the directory claims.
 */
import { inflate } from '../../formats/inflate.ts';
import { type DirectoryEntry, packedBytes, zipDirectory } from '../../formats/zip-directory.ts';
import type { Budget } from '../budget.ts';
import { ImportError } from '../imported.ts';
import {
  checkHeader,
  fail,
  isNpy,
  itemsOf,
  MAX_BYTES,
  type NumpyArray,
  type NumpyHeader,
  npyHeader,
  ONLY,
  readNpy,
} from './npy.ts';

/** Most bytes of all arrays that are read of one file. */
const MAX_TOGETHER = 2 ** 30;
/** Headers of all are looked at. */
const MAX_ENTRIES = 10_000;
/** Most bytes that one byte of deflated data can hold. */
const MAX_RATIO = 1032;
/** Bytes that are unpacked to see a header: those of a shape are fewer. */
const HEAD = 4096;
/** The arrays of a file by their names. */
export class Arrays {
  private readonly entries = new Map<string, Uint8Array | DirectoryEntry>();
  private readonly headers = new Map<string, NumpyHeader>();
  private read = 0;

  /**
   * @param bytes of the whole file, recognised by its content
   * @param budget is charged with all numbers that are read
   * @throws ImportError if it is neither
   */
  constructor(
    private readonly bytes: Uint8Array,
    fileName: string,
    private readonly budget: Budget,
  ) {
    if (isNpy(bytes)) {
      this.entries.set(ONLY, bytes);
      return;
    }
    const directory = zipDirectory(bytes);
    if (!directory) {
      const isZip = bytes[0] === 0x50 && bytes[1] === 0x4b;
      if (isZip) fail('file-cut', `The end of ${fileName} is missing: copy or export it again.`);
      fail('npy-header', `Expected an array (.npy) or a zip of arrays (.npz), found something else.`);
    }
    if (directory.length > MAX_ENTRIES)
      fail('numpy-large', `Expected at most ${MAX_ENTRIES} arrays, found ${directory.length}.`);
    for (const entry of directory) if (entry.name.endsWith('.npy')) this.entries.set(entry.name.slice(0, -4), entry);
    const packed = directory.reduce((sum, entry) => sum + entry.packed, 0);
    // One piece of data for many entries makes an archive of kilobytes unpack to gigabytes.
    if (packed > bytes.length) fail('zip-damaged', 'Entries of the archive overlap: export it again.');
  }

  /** In the order of the file. */
  get names(): readonly string[] {
    return [...this.entries.keys()];
  }

  /** Whether there is an array of that name. */
  has(name: string): boolean {
    return this.entries.has(name);
  }

  /** The header of an array that is there; of one that is damaged undefined: it may not be needed. */
  header(name: string): NumpyHeader | undefined {
    const known = this.headers.get(name);
    if (known) return known;
    try {
      const entry = this.entries.get(name);
      if (!entry) return undefined;
      const head = entry instanceof Uint8Array ? entry : unpacked(this.bytes, entry, name, HEAD);
      const header = npyHeader(head, name);
      this.headers.set(name, header);
      return header;
    } catch (error) {
      if (error instanceof ImportError) return undefined;
      throw error;
    }
  }

  /**
   * An array with all its numbers; undefined if there is none.
   * @param mayMiss whether NaN is a number that is missing
   * @throws ImportError if it can't be read
   */
  array(name: string, mayMiss = false): NumpyArray | undefined {
    const entry = this.entries.get(name);
    if (!entry) return undefined;
    const size = entry instanceof Uint8Array ? entry.length : entry.size;
    if (size > MAX_BYTES + HEAD)
      fail('numpy-large', `${name} has ${size} bytes: arrays of more than 512 MB aren't read.`);
    this.read += size;
    if (this.read > MAX_TOGETHER) {
      fail('numpy-large', `The arrays that are needed have more than 1 GB together, with ${name}: export less of it.`);
    }
    const header = this.header(name);
    if (header) {
      checkHeader(header, size, name);
      this.budget.spend(itemsOf(header), name);
    }
    return readNpy(entry instanceof Uint8Array ? entry : unpacked(this.bytes, entry, name), name, mayMiss);
  }
}

/**
 * The bytes of an entry, or the first of them.
 * @param most as many as are wanted; default: all
 * @throws ImportError if it is encrypted, cut off, or has another size than the directory says
 */
function unpacked(bytes: Uint8Array, entry: DirectoryEntry, name: string, most = entry.size): Uint8Array {
  const { size, method, isEncrypted } = entry;
  if (isEncrypted) fail('zip-encrypted', `${name} is encrypted: save it without a password.`);
  const packed = packedBytes(bytes, entry);
  if (!packed) return fail('file-cut', `${name} ends early: copy or export the file again.`);
  if (method === 0) {
    if (packed.length !== size) fail('zip-damaged', wrongSize(name, size, packed.length));
    return most < size ? packed.subarray(0, most) : aligned(packed);
  }
  if (method !== 8)
    fail('zip-method', `${name} is compressed by method ${method}; save it with numpy's savez or savez_compressed.`);
  if (size > MAX_RATIO * (packed.length + 1)) {
    fail('zip-damaged', `${name} claims ${size} bytes, more than its ${packed.length} packed bytes can hold.`);
  }
  return inflated(packed, size, Math.min(most, size), name);
}

function inflated(packed: Uint8Array, size: number, most: number, name: string): Uint8Array {
  const out = new Uint8Array(most);
  const { ending, length } = inflate(packed, out);
  if (ending === 'more' && most < size) return out;
  if (ending === 'damaged' || ending === 'cut')
    fail('zip-damaged', `${name} can't be unpacked: copy or export the file again.`);
  if (ending === 'more' || length !== size)
    fail('zip-damaged', wrongSize(name, size, ending === 'more' ? 'more' : length));
  return out;
}

function wrongSize(name: string, size: number, found: number | string): string {
  return `Expected ${size} bytes in ${name}, as the archive says, found ${found}: copy or export the file again.`;
}

/** Numbers can only be viewed at multiples of their size; the header of an array is made so that they are. */
function aligned(bytes: Uint8Array): Uint8Array {
  return bytes.byteOffset % 8 === 0 ? bytes : bytes.slice();
}
