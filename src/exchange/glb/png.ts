/** PNG files from pixels (PNG specification, third edition): 8 bits a channel, with alpha only where it is used. */
import { zlibSync } from 'fflate';
import type { Pixels } from './bmp.ts';

export function writePng({ width, height, rgba, hasAlpha }: Pixels): Uint8Array<ArrayBuffer> {
  const channels = hasAlpha ? 4 : 3;
  const stride = 1 + channels * width;
  const rows = new Uint8Array(stride * height);
  for (let y = 0; y < height; y++) {
    // Each byte as the difference to the row above (filter 2), which compresses pictures well.
    rows[y * stride] = y > 0 ? 2 : 0;
    for (let x = 0; x < width; x++) {
      for (let k = 0; k < channels; k++) {
        const above = y > 0 ? rgba[4 * ((y - 1) * width + x) + k] : 0;
        rows[y * stride + 1 + channels * x + k] = rgba[4 * (y * width + x) + k] - above;
      }
    }
  }
  const head = new Uint8Array(13);
  const view = new DataView(head.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  head.set([8, hasAlpha ? 6 : 2, 0, 0, 0], 8);
  const chunks = [chunk('IHDR', head), chunk('IDAT', zlibSync(rows)), chunk('IEND', new Uint8Array(0))];
  const file = new Uint8Array(SIGNATURE.length + chunks.reduce((sum, { length }) => sum + length, 0));
  file.set(SIGNATURE);
  let at = SIGNATURE.length;
  for (const part of chunks) {
    file.set(part, at);
    at += part.length;
  }
  return file;
}

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

function chunk(type: string, data: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(12 + data.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; i++) bytes[4 + i] = type.charCodeAt(i);
  bytes.set(data, 8);
  view.setUint32(8 + data.length, checksum(bytes.subarray(4, 8 + data.length)));
  return bytes;
}

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

function checksum(bytes: Uint8Array): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = CRC_TABLE[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}
