/** A small reader of `.npz`, independent of the writer: the zip by its central directory, checked by fflate. */
import { unzipSync } from 'fflate';

export interface NpyArray {
  readonly descr: string;
  readonly shape: readonly number[];
  readonly values: readonly number[] | readonly string[];
}

export type Npz = Readonly<Record<string, NpyArray>>;

/** @throws Error if a checksum is wrong, which fflate does not look at */
export function readNpz(bytes: Uint8Array): Npz {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const entries = Object.entries(unzipSync(bytes));
  let at = 0;
  for (const [name, content] of entries) {
    if (view.getUint32(at + 14, true) !== crcOf(content)) throw new Error(`${name} has a wrong checksum.`);
    at += 30 + view.getUint16(at + 26, true) + view.getUint16(at + 28, true) + content.length;
  }
  return Object.fromEntries(entries.map(([name, content]) => [name.replace(/\.npy$/, ''), readNpy(content)]));
}

/** CRC-32, bit by bit. */
function crcOf(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return ~crc >>> 0;
}

function readNpy(bytes: Uint8Array): NpyArray {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (String.fromCharCode(...bytes.subarray(1, 6)) !== 'NUMPY') throw new Error('This is no .npy file.');
  const start = 10 + view.getUint16(8, true);
  if (start % 64 !== 0 || bytes[start - 1] !== 10) throw new Error('The header does not end at a multiple of 64.');
  const header = new TextDecoder().decode(bytes.subarray(10, start));
  const descr = /'descr': '([^']+)'/.exec(header)?.[1] ?? '';
  const shape = (/'shape': \(([^)]*)\)/.exec(header)?.[1] ?? '')
    .split(',')
    .flatMap((n) => (n.trim() ? [Number(n)] : []));
  const count = shape.reduce((a, b) => a * b, 1);
  const width = descr.startsWith('<U') ? 4 * Number(descr.slice(2)) : Number(descr.slice(2));
  if (bytes.length !== start + count * width) throw new Error(`${descr} ${shape} has ${bytes.length - start} bytes.`);
  const numbers = (read: (at: number) => number) => Array.from({ length: count }, (_, i) => read(start + i * width));
  if (descr === '<f4') return { descr, shape, values: numbers((at) => view.getFloat32(at, true)) };
  if (descr === '<f8') return { descr, shape, values: numbers((at) => view.getFloat64(at, true)) };
  if (descr === '<i4') return { descr, shape, values: numbers((at) => view.getInt32(at, true)) };
  if (descr === '|b1') return { descr, shape, values: numbers((at) => view.getUint8(at)) };
  const text = (at: number) => {
    let out = '';
    for (let o = at; o < at + width; o += 4) {
      const code = view.getUint32(o, true);
      if (code) out += String.fromCodePoint(code);
    }
    return out;
  };
  return { descr, shape, values: Array.from({ length: count }, (_, i) => text(start + i * width)) };
}
