/** The central directory of a zip (APPNOTE 4.3.12 to 4.3.16), in 64 bits too. */
import { strFromU8 } from 'fflate';

/** An entry as the directory has it; nothing of it is checked against the entry itself. */
export interface DirectoryEntry {
  readonly name: string;
  readonly isEncrypted: boolean;
  /** 0: stored, 8: deflated. */
  readonly method: number;
  /** Bytes in the archive. */
  readonly packed: number;
  /** Bytes that it claims to unpack to. */
  readonly size: number;
  /** Where its local header is. */
  readonly at: number;
}

/** Signatures of records. */
const [ENTRY, END, END64, LOCATOR64, LOCAL] = [0x02014b50, 0x06054b50, 0x06064b50, 0x07064b50, 0x04034b50];
/** In a field of 32 bits: the number is in 64 bits, in the extra field with this tag. */
const ELSEWHERE = 0xffffffff;
const TAG64 = 1;

/** All entries in the directory's order, up to the first that is none; undefined if there is no directory. */
export function zipDirectory(bytes: Uint8Array): readonly DirectoryEntry[] | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = directoryAt(view);
  if (start === undefined) return undefined;
  const entries: DirectoryEntry[] = [];
  let next = start;
  while (next + 46 <= bytes.length && view.getUint32(next, true) === ENTRY) {
    const at = next;
    const flags = view.getUint16(at + 8, true);
    const [nameLength, extraLength, noteLength] = [28, 30, 32].map((field) => view.getUint16(at + field, true));
    const extra = at + 46 + nameLength;
    const wide = wideFields(view, extra, extraLength);
    const field = (offset: number) => {
      const own = view.getUint32(at + offset, true);
      return own === ELSEWHERE ? (wide.shift() ?? own) : own;
    };
    // In this order: those in 64 bits are only there for fields that need them.
    const [size, packed, local] = [24, 20, 42].map(field);
    entries.push({
      name: strFromU8(bytes.subarray(at + 46, extra), !(flags & 0x800)),
      isEncrypted: (flags & 1) !== 0,
      method: view.getUint16(at + 10, true),
      packed,
      size,
      at: local,
    });
    next = extra + extraLength + noteLength;
  }
  return entries;
}

/** The packed bytes of an entry, a view; undefined if they aren't all there. */
export function packedBytes(bytes: Uint8Array, { at, packed }: DirectoryEntry): Uint8Array | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (at + 30 > bytes.length || view.getUint32(at, true) !== LOCAL) return undefined;
  // The extra field has another length here than in the directory.
  const start = at + 30 + view.getUint16(at + 26, true) + view.getUint16(at + 28, true);
  return start + packed <= bytes.length ? bytes.subarray(start, start + packed) : undefined;
}

/** Where the directory begins; undefined if there is no end of it. */
function directoryAt(view: DataView): number | undefined {
  let end = view.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== END) end--;
  if (end < 0) return undefined;
  const at = view.getUint32(end + 16, true);
  const locator = end - 20;
  if (locator < 0 || view.getUint32(locator, true) !== LOCATOR64) return at;
  const record = Number(view.getBigUint64(locator + 8, true));
  if (record + 56 > view.byteLength || view.getUint32(record, true) !== END64) return at;
  return Number(view.getBigUint64(record + 48, true));
}

/** Numbers in 64 bits of an entry, from its extra fields. */
function wideFields(view: DataView, from: number, length: number): number[] {
  const to = Math.min(from + length, view.byteLength);
  for (let at = from; at + 4 <= to; ) {
    const size = view.getUint16(at + 2, true);
    if (view.getUint16(at, true) === TAG64) {
      const last = Math.min(at + 4 + size, to) - 8;
      const found: number[] = [];
      for (let i = at + 4; i <= last; i += 8) found.push(Number(view.getBigUint64(i, true)));
      return found;
    }
    at += 4 + size;
  }
  return [];
}
