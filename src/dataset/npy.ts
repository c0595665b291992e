/**
 * Writes numpy's `.npy`, version 1.0, which needs no pickle to be read:
 *
 *     \x93NUMPY 1 0    length of the header, two bytes    {'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }
 *     then the numbers, little-endian, row-major; the header is padded so that they start at a multiple of 64 bytes
 *
 * Texts have a fixed length in code points (`<U7`, UTF-32), the shorter ones padded with zeros.
 */
import type { DataArray } from './data-array.ts';

const ALIGNED = 64;
/** Magic, version and length of the header. */
const PREAMBLE = 10;

/** Header and content; the content of numbers is a view of their array, not a copy. */
export function npyPieces(array: DataArray): readonly [header: Uint8Array, content: Uint8Array] {
  const { type, shape, data } = array;
  if (type === 'text') {
    const texts = data.map((text) => Array.from(text, (character) => character.codePointAt(0) ?? 0));
    const length = texts.reduce((most, text) => Math.max(most, text.length), 1);
    const codes = new Uint32Array(length * texts.length);
    texts.forEach((text, i) => void codes.set(text, i * length));
    return [header(`<U${length}`, shape), bytesOf(codes)];
  }
  const width = type === 'float' && data instanceof Float64Array ? 8 : 4;
  const description = type === 'bool' ? '|b1' : type === 'int' ? '<i4' : `<f${width}`;
  return [header(description, shape), bytesOf(data)];
}

function header(description: string, shape: readonly number[]): Uint8Array {
  const tuple = `(${shape.join(', ')}${shape.length === 1 ? ',' : ''})`;
  const text = `{'descr': '${description}', 'fortran_order': False, 'shape': ${tuple}, }`;
  const length = Math.ceil((PREAMBLE + text.length + 1) / ALIGNED) * ALIGNED;
  const out = new Uint8Array(length).fill(0x20);
  out.set([0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0, (length - PREAMBLE) & 0xff, (length - PREAMBLE) >> 8]);
  // All of it is ASCII.
  for (let i = 0; i < text.length; i++) out[PREAMBLE + i] = text.charCodeAt(i);
  out[length - 1] = 0x0a;
  return out;
}

/** Typed arrays have the byte order of the machine; all that run this are little-endian. */
function bytesOf({ buffer, byteOffset, byteLength }: ArrayBufferView): Uint8Array {
  return new Uint8Array(buffer, byteOffset, byteLength);
}
