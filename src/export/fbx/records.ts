/**
 * Binary FBX 7.4: a header, records, and a footer.
 *
 *     record = end, number of values, bytes of values (u32), name length u8, name, values,
 *              { record }, an empty record if there may be any
 *     value  = type: C I D L of 1 to 8 bytes; S R with u32 length; f d l i: arrays of n, packed by zlib where that is less
 */
import { zlibSync } from 'fflate';

/** A value as it is in the file. */
export type FbxBytes = Uint8Array<ArrayBuffer>;

/** A record to be written. */
export interface FbxOut {
  readonly name: string;
  readonly values: readonly FbxBytes[];
  readonly children: readonly FbxOut[];
}

/** A record with values and records inside. */
export function record(name: string, values: readonly FbxBytes[] = [], children: readonly FbxOut[] = []): FbxOut {
  return { name, values, children };
}

const UTF8 = new TextEncoder();

function single(letter: string, size: number, write: (view: DataView) => void): FbxBytes {
  const bytes = new Uint8Array(1 + size);
  bytes[0] = letter.charCodeAt(0);
  write(new DataView(bytes.buffer));
  return bytes;
}

/** A truth, or the code of a letter. */
export function small(value: number): FbxBytes {
  return single('C', 1, (view) => view.setUint8(1, value));
}

/** An integer of 32 bits. */
export function int(value: number): FbxBytes {
  return single('I', 4, (view) => view.setInt32(1, value, true));
}

/** An integer of 64 bits. */
export function long(value: number | bigint): FbxBytes {
  return single('L', 8, (view) => view.setBigInt64(1, BigInt(value), true));
}

/** A double. */
export function double(value: number): FbxBytes {
  return single('D', 8, (view) => view.setFloat64(1, value, true));
}

/** A text. */
export function text(value: string): FbxBytes {
  return lengthy('S', UTF8.encode(value));
}

/** The name of an object, with its class. */
export function named(name: string, kind: string): FbxBytes {
  return text(`${name}\0\u0001${kind}`);
}

/** Bytes as they are: an image. */
export function raw(bytes: Uint8Array): FbxBytes {
  return lengthy('R', bytes);
}

function lengthy(letter: string, content: Uint8Array): FbxBytes {
  const bytes = single(letter, 4 + content.length, (view) => view.setUint32(1, content.length, true));
  bytes.set(content, 5);
  return bytes;
}

/** Doubles, floats, or integers of 32 or 64 bits. */
export type FbxArray =
  | Float64Array<ArrayBuffer>
  | Float32Array<ArrayBuffer>
  | Int32Array<ArrayBuffer>
  | BigInt64Array<ArrayBuffer>;

/** Shorter arrays are not packed. */
const PACKED = 128;
/** zlib's: more takes several times as long, for a tenth of the bytes. */
const EFFORT = 3;

/** An array, packed if that is shorter. */
export function array(values: FbxArray): FbxBytes {
  const plain = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
  const packed = plain.length > PACKED ? zlibSync(plain, { level: EFFORT }) : plain;
  const isPacked = packed.length < plain.length;
  const content = isPacked ? packed : plain;
  const bytes = single(letterOf(values), 12 + content.length, (view) => {
    view.setUint32(1, values.length, true);
    view.setUint32(5, isPacked ? 1 : 0, true);
    view.setUint32(9, content.length, true);
  });
  bytes.set(content, 13);
  return bytes;
}

function letterOf(values: FbxArray): string {
  if (values instanceof Float64Array) return 'd';
  if (values instanceof Float32Array) return 'f';
  return values instanceof Int32Array ? 'i' : 'l';
}

/** The version that is written. */
export const VERSION = 7400;

const MAGIC = 'Kaydara FBX Binary  \0\u001a\0';
/** What the header of each record takes beside its name, and what an empty record is. */
const HEADER = 13;
/** Ends the records; the same for all files that state the creation time of `CREATION_TIME`. */
const FOOTER = [0xfa, 0xbc, 0xab, 0x09, 0xd0, 0xc8, 0xd4, 0x66, 0xb1, 0x76, 0xfb, 0x83, 0x1c, 0xf7, 0x26, 0x7e];
const END = [0xf8, 0x5a, 0x8c, 0x6a, 0xde, 0xf5, 0xd9, 0x7e, 0xec, 0xe9, 0x0c, 0xe3, 0x75, 0x8f, 0x29, 0x0b];
/** The creation time that a file states, so that the same content gives the same bytes. */
export const CREATION_TIME = '1970-01-01 10:00:00:000';
/** The id that belongs to that time. */
export const FILE_ID: Uint8Array = Uint8Array.of(
  ...[0x28, 0xb3, 0x2a, 0xeb, 0xb6, 0x24, 0xcc, 0xc2, 0xbf, 0xc8, 0xb0, 0x2a, 0xa9, 0x2b, 0xfc, 0xf1],
);

/** The file, in pieces that follow each other. */
export function fileOf(records: readonly FbxOut[]): readonly FbxBytes[] {
  const head = new Uint8Array(MAGIC.length + 4);
  head.set([...MAGIC].map((char) => char.charCodeAt(0)));
  new DataView(head.buffer).setUint32(MAGIC.length, VERSION, true);
  const pieces = [head];
  let at = head.length;
  for (const one of records) at = write(one, at, pieces);
  at += HEADER + FOOTER.length + 4;
  // The version is at a multiple of 16 bytes, with at least one byte before it.
  const padding = 16 - (at % 16);
  const tail = new Uint8Array(HEADER + FOOTER.length + 4 + padding + 4 + 120 + END.length);
  tail.set(FOOTER, HEADER);
  new DataView(tail.buffer).setUint32(HEADER + FOOTER.length + 4 + padding, VERSION, true);
  tail.set(END, tail.length - END.length);
  pieces.push(tail);
  return pieces;
}

/** Records that end with an empty one although they have nothing inside. */
const BLOCKS = new Set(['AnimationStack', 'AnimationLayer']);

function hasEnd({ name, values, children }: FbxOut): boolean {
  return children.length > 0 || values.length === 0 || BLOCKS.has(name);
}

function sizeOf(one: FbxOut): number {
  const values = one.values.reduce((sum, { length }) => sum + length, 0);
  const inside = one.children.reduce((sum, child) => sum + sizeOf(child), hasEnd(one) ? HEADER : 0);
  return HEADER + one.name.length + values + inside;
}

/** @returns where the record ends */
function write(one: FbxOut, at: number, pieces: FbxBytes[]): number {
  const { name, values, children } = one;
  const head = new Uint8Array(HEADER + name.length);
  const view = new DataView(head.buffer);
  const end = at + sizeOf(one);
  view.setUint32(0, end, true);
  view.setUint32(4, values.length, true);
  view.setUint32(
    8,
    values.reduce((sum, { length }) => sum + length, 0),
    true,
  );
  view.setUint8(12, name.length);
  head.set(
    [...name].map((char) => char.charCodeAt(0)),
    HEADER,
  );
  pieces.push(head, ...values);
  let inside = at + head.length + values.reduce((sum, { length }) => sum + length, 0);
  for (const child of children) inside = write(child, inside, pieces);
  if (hasEnd(one)) pieces.push(new Uint8Array(HEADER));
  return end;
}
