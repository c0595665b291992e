/**
 * Reads numpy's `.npy`, versions 1 to 3:
 *
 *     \x93NUMPY  major minor  length (2 or 4 bytes)  {'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }
 *     then the numbers, row-major (C) or column-major (Fortran)
 */

import { ImportError } from '../imported.ts';
import { dictionaryOf, type Literal } from './literal.ts';

/** An array of numbers, row-major whatever its order in the file; of texts only `texts`. */
export interface NumpyArray {
  readonly name: string;
  readonly shape: readonly number[];
  /** Single precision where that holds them exactly. Empty of texts. */
  readonly values: Numbers;
  /** Empty of numbers. */
  readonly texts: readonly string[];
}

/** Numbers as they are in an array. */
export type Numbers = Float32Array | Float64Array;

/** The header of an array. */
export interface NumpyHeader {
  readonly shape: readonly number[];
  readonly isFortran: boolean;
  readonly isLittle: boolean;
  /** f, i, u, b, U, S, O of Python objects, V of others that aren't read. */
  readonly type: string;
  /** Bytes of an item. */
  readonly size: number;
  /** Bytes before the numbers. */
  readonly start: number;
  /** As in the file, for messages. */
  readonly description: string;
}

/** Most bytes of an array, in the file and in memory. */
export const MAX_BYTES = 512 * 2 ** 20;
/** Texts name joints, and few else. */
const MAX_TEXTS = 1 << 16;
/** Bytes of a header: numpy itself asks before it reads more than 10,000. */
const LONGEST_HEADER = 1 << 20;
const MAX_DIMENSIONS = 64;
/** Larger than any unit makes a person, and small enough to be multiplied a few times. */
const LARGEST = 1e30;
const MAGIC = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59];

/** Whether bytes begin like an array. */
export function isNpy(bytes: Uint8Array): boolean {
  return MAGIC.every((byte, i) => bytes[i] === byte);
}

/**
 * The header of an array.
 * @param bytes from its start, at least as many as the header has
 * @param name for messages
 * @throws ImportError if it has none
 */
export function npyHeader(bytes: Uint8Array, name: string): NumpyHeader {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (!isNpy(bytes)) fail('npy-header', `Expected ${name} to begin as an array of numpy (.npy), found something else.`);
  // A file that ends before its version is too short for any.
  const [major = 1] = bytes.subarray(6);
  if (!(major >= 1 && major <= 3)) fail('npy-version', `Expected version 1 to 3 of ${name}, found ${major}.`);
  const preamble = major === 1 ? 10 : 12;
  if (bytes.length < preamble) fail('file-cut', `${name} ends within its header: copy or export it again.`);
  const length = major === 1 ? view.getUint16(8, true) : view.getUint32(8, true);
  if (length > LONGEST_HEADER)
    fail('npy-header', `Expected a header of less than 1 MB in ${name}, found ${length} bytes.`);
  const start = preamble + length;
  if (start > bytes.length) fail('file-cut', `${name} ends within its header: copy or export it again.`);
  const text = new TextDecoder(major === 3 ? 'utf-8' : 'latin1').decode(bytes.subarray(preamble, start));
  const members = dictionaryOf(text);
  const shape = shapeOf(members?.get('shape'));
  const description = members?.get('descr');
  const isFortran = members?.get('fortran_order');
  if (description === undefined || typeof isFortran !== 'boolean' || !shape) {
    const found = JSON.stringify(text.trim().slice(0, 60));
    return fail('npy-header', `Expected descr, fortran_order and shape in the header of ${name}, found ${found}.`);
  }
  const simple = typeof description === 'string' ? description : '';
  const [, order, letter = 'V', width = ''] = /^([<>|=])?([a-zA-Z?])(\d*)$/.exec(simple) ?? [];
  const type = letter === '?' ? 'b' : letter;
  return {
    shape,
    isFortran,
    isLittle: order !== '>',
    type,
    size: Number(width || '1') * (type === 'U' ? 4 : 1),
    start,
    description: typeof description === 'string' ? description : 'a structure',
  };
}

function shapeOf(literal: Literal | undefined): readonly number[] | undefined {
  if (!Array.isArray(literal) || literal.length > MAX_DIMENSIONS) return undefined;
  const shape = literal.map((item) =>
    typeof item === 'object' && item !== null && 'digits' in item ? Number(item.digits) : Number.NaN,
  );
  return shape.every((n) => n >= 0) ? shape : undefined;
}

/** `poses (30, 156)`, for messages. */
export function shapeText({ shape }: { readonly shape: readonly number[] }): string {
  return `(${shape.join(', ')}${shape.length === 1 ? ',' : ''})`;
}

/** How many items an array has; NaN or infinite if nothing could hold them. */
export function itemsOf({ shape }: NumpyHeader): number {
  return shape.includes(0) ? 0 : shape.reduce((product, n) => product * n, 1);
}

/** Checks an array by its header, before anything of it is read. @throws ImportError if it is not read */
export function checkHeader(header: NumpyHeader, byteLength: number, name: string): void {
  const { type, size, start, description } = header;
  if (type === 'O') fail('numpy-objects', `${name} holds Python objects (pickled); save it as plain arrays.`);
  const isKnown =
    (type === 'f' && [2, 4, 8].includes(size)) ||
    ('iu'.includes(type) && [1, 2, 4, 8].includes(size)) ||
    (type === 'b' && size === 1) ||
    type === 'U' ||
    type === 'S';
  if (!isKnown)
    fail('numpy-type', `Expected numbers or texts in ${name}, found ${description}; save it as plain arrays.`);
  const count = itemsOf(header);
  const isText = type === 'U' || type === 'S';
  if (isText && count > MAX_TEXTS)
    fail('numpy-large', `${name} has ${count} texts: more than ${MAX_TEXTS} aren't read.`);
  const most = isText ? MAX_BYTES : MAX_BYTES / inMemory(header);
  if (!(count * size <= MAX_BYTES && count <= most)) {
    fail('numpy-large', `${name} has the shape ${shapeText(header)}: arrays of more than 512 MB aren't read.`);
  }
  if (count * size > byteLength - start) {
    const found = `found ${byteLength - start}`;
    fail(
      'file-cut',
      `Expected ${count * size} bytes for the shape ${shapeText(header)} of ${name}, ${found}: export it again.`,
    );
  }
}

/** Bytes of a number once it is read. */
function inMemory({ type, size }: NumpyHeader): 4 | 8 {
  return size <= 2 || (type === 'f' && size === 4) ? 4 : 8;
}

/**
 * The array in all bytes of a `.npy`. Numbers are a view of the bytes if they are as they are in memory.
 * @param mayMiss whether NaN is a number that is missing
 * @throws ImportError, also if a number isn't finite
 */
export function readNpy(bytes: Uint8Array, name: string, mayMiss = false): NumpyArray {
  const header = npyHeader(bytes, name);
  checkHeader(header, bytes.length, name);
  const { shape, type } = header;
  if (type === 'U' || type === 'S') return { name, shape, values: new Float64Array(0), texts: textsOf(bytes, header) };
  const values = inRows(numbersOf(bytes, header), header);
  const wrong = firstWrong(values, mayMiss);
  if (wrong >= 0) {
    const [rows = 1] = shape;
    const place = shape.length > 1 ? ` in frame ${Math.floor(wrong / (values.length / rows))}` : '';
    const wanted = Number.isFinite(values[wrong]) ? `numbers of less than ${LARGEST}` : 'finite numbers';
    fail('numpy-finite', `Expected ${wanted} in ${name}, found ${values[wrong]}${place} (frames count from 0).`);
  }
  return { name, shape, values, texts: [] };
}

/** Index of the first number that is not finite, or so large that products of it would not be; -1 if there is none. */
function firstWrong(values: Numbers, mayMiss: boolean): number {
  let i = 0;
  // No number is larger than its sum with others of no sign. Written so that NaN counts.
  for (; i + 4 <= values.length; i += 4) {
    const sum = Math.abs(values[i]) + Math.abs(values[i + 1]) + Math.abs(values[i + 2]) + Math.abs(values[i + 3]);
    if (!(sum <= LARGEST)) break;
  }
  for (; i < values.length; i++) {
    if (!(Math.abs(values[i]) <= LARGEST) && !(mayMiss && Number.isNaN(values[i]))) return i;
  }
  return -1;
}

function numbersOf(bytes: Uint8Array, header: NumpyHeader): Numbers {
  const { type, size, start, isLittle } = header;
  const count = itemsOf(header);
  const at = bytes.byteOffset + start;
  // Typed arrays have the byte order of the machine; all that run this are little-endian.
  if (type === 'f' && size > 2 && isLittle && at % size === 0) {
    return size === 4 ? new Float32Array(bytes.buffer, at, count) : new Float64Array(bytes.buffer, at, count);
  }
  const read = readerOf(header, new DataView(bytes.buffer, at, count * size));
  const values = inMemory(header) === 4 ? new Float32Array(count) : new Float64Array(count);
  for (let i = 0; i < count; i++) values[i] = read(i * size);
  return values;
}

function readerOf({ type, size, isLittle }: NumpyHeader, view: DataView): (at: number) => number {
  if (type === 'f') {
    if (size === 8) return (at) => view.getFloat64(at, isLittle);
    if (size === 4) return (at) => view.getFloat32(at, isLittle);
    return (at) => halfOf(view.getUint16(at, isLittle));
  }
  if (size === 1) return type === 'i' ? (at) => view.getInt8(at) : (at) => view.getUint8(at);
  if (size === 2) return type === 'i' ? (at) => view.getInt16(at, isLittle) : (at) => view.getUint16(at, isLittle);
  if (size === 4) return type === 'i' ? (at) => view.getInt32(at, isLittle) : (at) => view.getUint32(at, isLittle);
  return type === 'i'
    ? (at) => Number(view.getBigInt64(at, isLittle))
    : (at) => Number(view.getBigUint64(at, isLittle));
}

/** A float of 16 bits. */
function halfOf(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? Number.NaN : sign * Number.POSITIVE_INFINITY;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

/** Row-major, the last index running first. */
function inRows(values: Numbers, { shape, isFortran }: NumpyHeader): Numbers {
  if (!isFortran || shape.length < 2) return values;
  const out = values instanceof Float32Array ? new Float32Array(values.length) : new Float64Array(values.length);
  const steps = shape.map((_, k) => shape.slice(0, k).reduce((step, n) => step * n, 1));
  const index = new Float64Array(shape.length);
  let from = 0;
  for (let i = 0; i < out.length; i++) {
    out[i] = values[from];
    for (let k = shape.length - 1; k >= 0; k--) {
      from += steps[k];
      if (++index[k] < shape[k]) break;
      from -= steps[k] * shape[k];
      index[k] = 0;
    }
  }
  return out;
}

function textsOf(bytes: Uint8Array, header: NumpyHeader): readonly string[] {
  const { type, size, start, isLittle } = header;
  const view = new DataView(bytes.buffer, bytes.byteOffset + start);
  const texts: string[] = [];
  for (let i = 0; i < itemsOf(header); i++) {
    const codes: number[] = [];
    for (let at = i * size; at < (i + 1) * size; at += type === 'U' ? 4 : 1) {
      const code = type === 'U' ? view.getUint32(at, isLittle) : view.getUint8(at);
      if (code === 0) break;
      codes.push(code <= 0x10ffff ? code : 0xfffd);
    }
    texts.push(codes.map((code) => String.fromCodePoint(code)).join(''));
  }
  return texts;
}

/** The name of the only array of a `.npy`. */
export const ONLY = 'the array';

/** Throws an `ImportError`, whose sentence may begin with an array's name. */
export function fail(code: string, message: string): never {
  throw new ImportError(code, message.startsWith(ONLY) ? `T${message.slice(1)}` : message);
}
