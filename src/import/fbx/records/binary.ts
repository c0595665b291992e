/**
 * Binary FBX: a header, records, and a footer that is not read.
 *
 *     file   = "Kaydara FBX Binary  \0" 1A, 0 or 1 where numbers are big-endian, version u32, { record }, an empty record
 *     record = end, number of values, bytes of values (u32; from 7.5 on u64), name length u8, name, values,
 *              { record }, an empty record if there were any
 *     value  = type: C Z B Y I F D L of 1 to 8 bytes; S R with u32 length; f d l i b c: arrays of n, packed by zlib or not
 *
 * Lengths are checked before anything is allocated: arrays take no more memory than the file says, deflate can hold,
 * and the budget of the file allows.
 */
import type { FbxReport } from '../failure.ts';
import { canUnpackTo, inflateExactly } from './inflate.ts';
import { NumberPool } from './number-pool.ts';
import { type FbxFile, type FbxNumbers, type FbxRecord, type FbxValue, NO_RECORDS } from './record.ts';
import { Texts } from './texts.ts';

const MAGIC = 'Kaydara FBX Binary  \0';
const HEADER = 27;
/** Where the header says whether numbers are big-endian, and the version. */
const ENDIANNESS_AT = 22;
const VERSION_AT = 23;
/** Real files have less than ten levels. */
const MAX_DEPTH = 64;

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
  const pool = new NumberPool();
  return { version, isText: false, pool, records: new BinaryReader(bytes, version >= 7500, pool, report).file() };
}

/** Values of a record that a list is made for at once. */
const MAX_USUAL = 64;

/** Types of values that are one number, and of arrays; each is the code of its letter. */
const BOOLS = [67, 90, 66];
const INT16 = 89;
const INT32 = 73;
const FLOAT32 = 70;
const FLOAT64 = 68;
const INT64 = 76;
const TEXT = 83;
const RAW = 82;
const FLOATS = 102;
const DOUBLES = 100;
const LONGS = 108;
const INTS = 105;
const BYTES = 98;
const CHARS = 99;

/** By type: bytes of one number, or of the beginning of others; 0 for what is no type. */
const VALUE_BYTES = new Uint8Array(256);
for (const type of BOOLS) VALUE_BYTES[type] = 1;
VALUE_BYTES[INT16] = 2;
for (const type of [INT32, FLOAT32, TEXT, RAW]) VALUE_BYTES[type] = 4;
for (const type of [FLOAT64, INT64]) VALUE_BYTES[type] = 8;
for (const type of [FLOATS, DOUBLES, LONGS, INTS, BYTES, CHARS]) VALUE_BYTES[type] = 12;

class BinaryReader {
  private readonly view: DataView<ArrayBuffer>;
  private readonly texts: Texts;
  private readonly headerBytes: number;
  private readonly isLittle: boolean;
  private at = HEADER;

  constructor(
    private readonly bytes: Uint8Array<ArrayBuffer>,
    private readonly isWide: boolean,
    private readonly pool: NumberPool,
    private readonly report: FbxReport,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.texts = new Texts(bytes);
    this.headerBytes = isWide ? 25 : 13;
    this.isLittle = isLittleEndian(bytes);
  }

  file(): FbxRecord[] {
    const records: FbxRecord[] = [];
    // Some exporters leave out the empty record at the end, with the footer.
    while (this.at + this.headerBytes <= this.bytes.length) {
      const record = this.record(this.bytes.length, 0);
      if (!record) return records;
      records.push(record);
    }
    if (this.at < this.bytes.length || records.length === 0) {
      this.report.fail('file-cut', 'Expected another record, found the end of the file: it was cut off.', this.at);
    }
    return records;
  }

  /** The record that begins here, behind which it moves; undefined if it is the empty one. */
  private record(limit: number, depth: number): FbxRecord | undefined {
    const { view, report, isWide } = this;
    const offset = this.at;
    if (offset + this.headerBytes > limit) {
      report.fail('file-cut', 'Expected another record, found the end of the one around it.', offset);
    }
    const end = this.size(offset);
    const count = this.size(offset + (isWide ? 8 : 4));
    const valueBytes = this.size(offset + (isWide ? 16 : 8));
    const nameLength = view.getUint8(offset + this.headerBytes - 1);
    this.at = offset + this.headerBytes;
    if (end === 0) return undefined;
    const values = this.at + nameLength;
    const rest = values + valueBytes;
    if (end > limit) {
      const what = end > this.bytes.length ? 'the file: it was cut off' : 'the record around it';
      report.fail('file-cut', `A record ends at byte ${end}, past the end of ${what}.`, offset);
    }
    if (rest > end) report.fail('bad-record', 'A record is shorter than its name and values.', offset);
    if (depth > MAX_DEPTH) report.fail('too-deep', `Records are nested more than ${MAX_DEPTH} deep.`, offset);
    const name = this.texts.of(this.at, values);
    this.at = values;
    // Each value has a byte for its type.
    if (count > valueBytes) report.fail('bad-record', `${name} claims ${count} values in ${valueBytes} bytes.`, offset);
    // A list that grows has room for sixteen more, which is several times what most records have.
    const read = count <= MAX_USUAL ? new Array<FbxValue>(count) : [];
    for (let i = 0; i < count; i++) read[i] = this.value(rest);
    this.at = rest;
    let children = NO_RECORDS;
    if (rest < end) {
      const inside: FbxRecord[] = [];
      while (this.at < end) {
        const child = this.record(end, depth + 1);
        if (!child) break;
        inside.push(child);
      }
      children = inside;
    }
    this.at = end;
    return { name, values: read, children, offset };
  }

  /** A length or an end in the header of a record. */
  private size(at: number): number {
    const { view, isLittle } = this;
    if (!this.isWide) return view.getUint32(at, isLittle);
    const high = view.getUint32(isLittle ? at + 4 : at, isLittle);
    const low = view.getUint32(isLittle ? at : at + 4, isLittle);
    // As an integer, so that all that is computed of it is one, which takes half the time.
    return high === 0 ? low : high * 2 ** 32 + low;
  }

  private value(limit: number): FbxValue {
    const { view, bytes, isLittle } = this;
    const start = this.at;
    if (start >= limit) this.report.fail('bad-value', 'Expected a value, found the end of its record.', start);
    const type = bytes[start];
    const at = start + 1;
    const size = VALUE_BYTES[type];
    if (size === 0) {
      const found = `found the byte ${type}: the file is damaged.`;
      this.report.fail('bad-value', `Expected a type of value, ${found}`, start);
    }
    this.move(at + size, limit, start);
    switch (type) {
      // Most values are texts.
      case TEXT:
      case RAW: {
        const from = at + 4;
        this.move(from + view.getUint32(at, isLittle), limit, start);
        return type === TEXT ? this.texts.of(from, this.at) : bytes.subarray(from, this.at);
      }
      case INT16:
        return view.getInt16(at, isLittle);
      case INT32:
        return view.getInt32(at, isLittle);
      case FLOAT32:
        return view.getFloat32(at, isLittle);
      case FLOAT64:
        return view.getFloat64(at, isLittle);
      case INT64:
        return this.long(at);
      case FLOATS:
      case DOUBLES:
      case LONGS:
      case INTS:
      case BYTES:
      case CHARS: {
        const count = view.getUint32(at, isLittle);
        const encoding = view.getUint32(at + 4, isLittle);
        const length = view.getUint32(at + 8, isLittle);
        const unpacked = count * elementBytes(type);
        const from = at + 12;
        this.move(from + (encoding === 0 ? unpacked : length), limit, start);
        // Numbers in a file are hardly ever aligned.
        if (encoding === 0) return this.numbers(view, from, type, count);
        const data = this.unpacked(bytes.subarray(from, this.at), encoding, unpacked, start);
        return this.numbers(new DataView(data.buffer), 0, type, count);
      }
      default:
        return view.getUint8(at);
    }
  }

  /** Moves to the end of a value or of its beginning. */
  private move(end: number, limit: number, start: number): void {
    if (end > limit) this.report.fail('bad-value', 'A value is longer than its record.', start);
    this.at = end;
  }

  /** A 64-bit integer. */
  private long(at: number): number | bigint {
    const { view, isLittle } = this;
    const high = view.getInt32(isLittle ? at + 4 : at, isLittle);
    const number = high * 2 ** 32 + view.getUint32(isLittle ? at : at + 4, isLittle);
    return Number.isSafeInteger(number) ? number : view.getBigInt64(at, isLittle);
  }

  /** So many numbers at an offset of a view. */
  private numbers(view: DataView<ArrayBuffer>, from: number, type: ArrayType, count: number): FbxNumbers {
    const { isLittle, pool } = this;
    switch (type) {
      case FLOATS: {
        const out = pool.floats(count);
        for (let i = 0; i < count; i++) out[i] = view.getFloat32(from + 4 * i, isLittle);
        return out;
      }
      case DOUBLES: {
        const out = pool.doubles(count);
        for (let i = 0; i < count; i++) out[i] = view.getFloat64(from + 8 * i, isLittle);
        return out;
      }
      case INTS: {
        const out = pool.integers(count);
        for (let i = 0; i < count; i++) out[i] = view.getInt32(from + 4 * i, isLittle);
        return out;
      }
      case LONGS: {
        const out = pool.doubles(count);
        const [low, high] = isLittle ? [from, from + 4] : [from + 4, from];
        // Rounded once, by the sum, as the integer would be.
        for (let i = 0; i < count; i++) {
          out[i] = view.getInt32(high + 8 * i, isLittle) * 2 ** 32 + view.getUint32(low + 8 * i, isLittle);
        }
        return out;
      }
      default:
        return new Uint8Array(view.buffer, view.byteOffset + from, count);
    }
  }

  private unpacked(
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
    if (canUnpackTo(data.length, size)) {
      this.report.budget.spend(size / 8, 'A compressed array');
      const found = inflateExactly(data, size);
      if (found) return found;
    }
    return this.report.fail('bad-array', `A compressed array is damaged: it does not expand to ${size} bytes.`, offset);
  }
}

type ArrayType = typeof FLOATS | typeof DOUBLES | typeof LONGS | typeof INTS | typeof BYTES | typeof CHARS;

function elementBytes(type: ArrayType): number {
  if (type === DOUBLES || type === LONGS) return 8;
  return type === FLOATS || type === INTS ? 4 : 1;
}

/** As a number where that is exact. */
export function integer(value: bigint): number | bigint {
  const number = Number(value);
  return Number.isSafeInteger(number) ? number : value;
}
