/**
 * Binary FBX: a header, records, and a footer that is not read.
 *
 *     file   = "Kaydara FBX Binary  \0" 1A, 0 or 1 where numbers are big-endian, version u32, { record }, an empty record
 *     record = end, number of values, bytes of values (u32; from 7.5 on u64), name length u8, name, values,
 *              { record }, an empty record if there were any
 *     value  = type: C Z B Y I F D L of 1 to 8 bytes; S R with u32 length; f d l i b c: arrays of n, packed by zlib or not
 *
 * Lengths are checked before anything is allocated: arrays take no more memory than the file says, deflate can hold, and
 * the budget of the file allows.
 */
import type { FbxReport } from './failure.ts';
import { canUnpackTo, inflateExactly } from './inflate.ts';
import type { FbxFile, FbxNumbers, FbxRecord, FbxValue } from './record.ts';

const MAGIC = 'Kaydara FBX Binary  \0';
const HEADER = 27;
/** Where the header says whether numbers are big-endian, and the version. */
const ENDIANNESS_AT = 22;
const VERSION_AT = 23;
/** Real files have less than ten levels. */
const MAX_DEPTH = 64;
const UTF8 = new TextDecoder();

/** Whether bytes begin like a binary FBX file; all others are read as text. */
export function isBinaryFbx(bytes: Uint8Array): boolean {
  return bytes.length >= MAGIC.length && [...MAGIC].every((char, i) => bytes[i] === char.charCodeAt(0));
}

/** The version in the header of a binary file; 0 if it ends before. */
export function binaryVersion(bytes: Uint8Array): number {
  if (bytes.length < HEADER) return 0;
  return new DataView(bytes.buffer, bytes.byteOffset).getUint32(VERSION_AT, isLittleEndian(bytes));
}

function isLittleEndian(bytes: Uint8Array): boolean {
  return bytes[ENDIANNESS_AT] === 0;
}

/** The records of a binary file of version 7.0 or later. Fails if it is damaged. */
export function readBinary(bytes: Uint8Array<ArrayBuffer>, report: FbxReport): FbxFile {
  const version = binaryVersion(bytes);
  return { version, isText: false, records: new BinaryReader(bytes, version >= 7500, report).file() };
}

interface Cursor {
  at: number;
}

class BinaryReader {
  private readonly view: DataView;
  private readonly headerBytes: number;
  private readonly isLittle: boolean;

  constructor(
    private readonly bytes: Uint8Array<ArrayBuffer>,
    private readonly isWide: boolean,
    private readonly report: FbxReport,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.headerBytes = isWide ? 25 : 13;
    this.isLittle = isLittleEndian(bytes);
  }

  file(): FbxRecord[] {
    const records: FbxRecord[] = [];
    const cursor = { at: HEADER };
    // Some exporters leave out the empty record at the end, with the footer.
    while (cursor.at + this.headerBytes <= this.bytes.length) {
      const record = this.record(cursor, this.bytes.length, 0);
      if (!record) return records;
      records.push(record);
    }
    if (cursor.at < this.bytes.length || records.length === 0) {
      this.report.fail('file-cut', 'Expected another record, found the end of the file: it was cut off.', cursor.at);
    }
    return records;
  }

  /** The record at the cursor, which moves behind it; undefined if it is the empty one. */
  private record(cursor: Cursor, limit: number, depth: number): FbxRecord | undefined {
    const { view, report, isWide } = this;
    const offset = cursor.at;
    if (offset + this.headerBytes > limit) {
      report.fail('file-cut', 'Expected another record, found the end of the one around it.', offset);
    }
    const end = this.size(offset);
    const count = this.size(offset + (isWide ? 8 : 4));
    const valueBytes = this.size(offset + (isWide ? 16 : 8));
    const nameLength = view.getUint8(offset + this.headerBytes - 1);
    cursor.at = offset + this.headerBytes;
    if (end === 0) return undefined;
    const values = cursor.at + nameLength;
    const rest = values + valueBytes;
    if (end > limit) {
      const what = end > this.bytes.length ? 'the file: it was cut off' : 'the record around it';
      report.fail('file-cut', `A record ends at byte ${end}, past the end of ${what}.`, offset);
    }
    if (rest > end) report.fail('bad-record', 'A record is shorter than its name and values.', offset);
    if (depth > MAX_DEPTH) report.fail('too-deep', `Records are nested more than ${MAX_DEPTH} deep.`, offset);
    const name = textOf(this.bytes.subarray(cursor.at, values));
    cursor.at = values;
    // Each value has a byte for its type.
    if (count > valueBytes) report.fail('bad-record', `${name} claims ${count} values in ${valueBytes} bytes.`, offset);
    const read: FbxValue[] = [];
    for (let i = 0; i < count; i++) read.push(this.value(cursor, rest));
    cursor.at = rest;
    const children: FbxRecord[] = [];
    while (cursor.at < end) {
      const child = this.record(cursor, end, depth + 1);
      if (!child) break;
      children.push(child);
    }
    cursor.at = end;
    return { name, values: read, children, offset };
  }

  /** A length or an end in the header of a record. */
  private size(at: number): number {
    const { view, isLittle } = this;
    return this.isWide ? Number(view.getBigUint64(at, isLittle)) : view.getUint32(at, isLittle);
  }

  private value(cursor: Cursor, limit: number): FbxValue {
    const { view, bytes, isLittle } = this;
    const start = cursor.at;
    if (start >= limit) this.report.fail('bad-value', 'Expected a value, found the end of its record.', start);
    const type = String.fromCharCode(bytes[start]);
    const at = start + 1;
    const take = (size: number) => {
      if (at + size > limit) this.report.fail('bad-value', 'A value is longer than its record.', start);
      cursor.at = at + size;
    };
    switch (type) {
      case 'C':
      case 'Z':
      case 'B':
        take(1);
        return view.getUint8(at);
      case 'Y':
        take(2);
        return view.getInt16(at, isLittle);
      case 'I':
        take(4);
        return view.getInt32(at, isLittle);
      case 'F':
        take(4);
        return view.getFloat32(at, isLittle);
      case 'D':
        take(8);
        return view.getFloat64(at, isLittle);
      case 'L':
        take(8);
        return integer(view.getBigInt64(at, isLittle));
      case 'S':
      case 'R': {
        take(4);
        const length = view.getUint32(at, isLittle);
        take(4 + length);
        const data = bytes.subarray(at + 4, at + 4 + length);
        return type === 'S' ? textOf(data) : data;
      }
      case 'f':
      case 'd':
      case 'l':
      case 'i':
      case 'b':
      case 'c': {
        take(12);
        const count = view.getUint32(at, isLittle);
        const encoding = view.getUint32(at + 4, isLittle);
        const length = view.getUint32(at + 8, isLittle);
        const width = elementBytes(type);
        const size = count * width;
        take(12 + (encoding === 0 ? size : length));
        const data = this.array(bytes.subarray(at + 12, cursor.at), encoding, size, start);
        if (!isLittle) reverseEach(data, width);
        return numbers(type, data, count);
      }
      default:
        return this.report.fail(
          'bad-value',
          `Expected a type of value, found the byte ${bytes[start]}: the file is damaged.`,
          start,
        );
    }
  }

  private array(
    data: Uint8Array<ArrayBuffer>,
    encoding: number,
    size: number,
    offset: number,
  ): Uint8Array<ArrayBuffer> {
    if (encoding > 1) {
      this.report.fail(
        'bad-array',
        `Expected an uncompressed (0) or compressed (1) array, found encoding ${encoding}.`,
        offset,
      );
    }
    // Copied, since numbers have to be aligned.
    if (encoding === 0) return data.slice();
    if (canUnpackTo(data.length, size)) {
      this.report.budget.spend(size / 8, 'A compressed array');
      const unpacked = inflateExactly(data, size);
      if (unpacked) return unpacked;
    }
    return this.report.fail('bad-array', `A compressed array is damaged: it does not expand to ${size} bytes.`, offset);
  }
}

function elementBytes(type: 'f' | 'd' | 'l' | 'i' | 'b' | 'c'): number {
  if (type === 'd' || type === 'l') return 8;
  return type === 'f' || type === 'i' ? 4 : 1;
}

/** Reverses the bytes of each element. */
function reverseEach(data: Uint8Array, width: number): void {
  if (width === 1) return;
  for (let at = 0; at + width <= data.length; at += width) data.subarray(at, at + width).reverse();
}

/** Numbers of little-endian bytes, as all machines in use have them. */
function numbers(type: 'f' | 'd' | 'l' | 'i' | 'b' | 'c', data: Uint8Array<ArrayBuffer>, count: number): FbxNumbers {
  switch (type) {
    case 'f':
      return new Float32Array(data.buffer, 0, count);
    case 'd':
      return new Float64Array(data.buffer, 0, count);
    case 'i':
      return new Int32Array(data.buffer, 0, count);
    case 'l': {
      const low = new Uint32Array(data.buffer, 0, 2 * count);
      const high = new Int32Array(data.buffer, 0, 2 * count);
      const out = new Float64Array(count);
      // Rounded once, by the sum, as the integer would be.
      for (let i = 0; i < count; i++) out[i] = high[2 * i + 1] * 2 ** 32 + low[2 * i];
      return out;
    }
    default:
      return data;
  }
}

/** As a number where that is exact. */
export function integer(value: bigint): number | bigint {
  const number = Number(value);
  return Number.isSafeInteger(number) ? number : value;
}

/** UTF-8; nearly all names are short and ASCII, for which a decoder takes several times as long. */
function textOf(bytes: Uint8Array): string {
  if (bytes.length > 64) return UTF8.decode(bytes);
  let text = '';
  for (const byte of bytes) {
    if (byte > 127) return UTF8.decode(bytes);
    text += String.fromCharCode(byte);
  }
  return text;
}
