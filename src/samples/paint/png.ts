/**
 * A PNG with a palette, the smallest format for a flat-coloured texture that every browser reads.
 *
 *     signature  IHDR (size, 8 bits, colour type 3)  PLTE  IDAT (zlib of rows, each led by filter 0)  IEND
 *
 * https://www.w3.org/TR/png-3/. Compressed with fflate rather than node:zlib: the bytes are compared with those in the
 * repository, and Node's zlib gives other bytes in other versions.
 */
import { zlibSync } from 'fflate';

/** `pixels`: RGB, rows from the top. More than 256 colours are reduced to the 256 most frequent. */
export function encodePng(pixels: Uint8Array, size: number): Uint8Array {
  const { palette, indices } = indexColours(pixels);
  const rows = new Uint8Array(size * (size + 1));
  for (let y = 0; y < size; y++) rows.set(indices.subarray(y * size, (y + 1) * size), y * (size + 1) + 1);
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, size);
  view.setUint32(4, size);
  header[8] = 8;
  header[9] = 3;
  const chunks = [
    Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
    chunk('IHDR', header),
    chunk('PLTE', Uint8Array.from(palette)),
    chunk('IDAT', zlibSync(rows, { level: 9, mem: 12 })),
    chunk('IEND', new Uint8Array(0)),
  ];
  const out = new Uint8Array(chunks.reduce((sum, c) => sum + c.length, 0));
  let at = 0;
  for (const c of chunks) {
    out.set(c, at);
    at += c.length;
  }
  return out;
}

/** Colours are first rounded to 32 levels per channel, which isn't visible and halves the file. */
function indexColours(pixels: Uint8Array): { palette: number[]; indices: Uint8Array } {
  const keyAt = (i: number) => (pixels[i] >> 3) * 1024 + (pixels[i + 1] >> 3) * 32 + (pixels[i + 2] >> 3);
  const counts = new Map<number, number>();
  for (let i = 0; i < pixels.length; i += 3) counts.set(keyAt(i), (counts.get(keyAt(i)) ?? 0) + 1);
  const ranked = [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]).map(([key]) => key);
  const kept = ranked.slice(0, 256);
  const channels = (key: number) => [key >> 10, (key >> 5) & 31, key & 31];
  const nearest = (key: number) => {
    const [r, g, b] = channels(key);
    const distance = (other: number) => {
      const [x, y, z] = channels(other);
      return (x - r) ** 2 + (y - g) ** 2 + (z - b) ** 2;
    };
    return kept.reduce((best, k, i) => (distance(k) < distance(kept[best]) ? i : best), 0);
  };
  const indexOf = new Map(ranked.map((key, i) => [key, i < 256 ? i : nearest(key)]));
  const indices = new Uint8Array(pixels.length / 3);
  for (let i = 0; i < indices.length; i++) indices[i] = indexOf.get(keyAt(3 * i)) ?? 0;
  return { palette: kept.flatMap((key) => channels(key).map((c) => Math.round((c * 255) / 31))), indices };
}

function chunk(type: string, data: Uint8Array): Uint8Array {
  const out = new Uint8Array(12 + data.length);
  const view = new DataView(out.buffer);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; i++) out[4 + i] = type.charCodeAt(i);
  out.set(data, 8);
  view.setUint32(8 + data.length, crc32(out.subarray(4, 8 + data.length)));
  return out;
}

function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return ~crc >>> 0;
}
