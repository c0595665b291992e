/**
 * A PNG with a palette, the smallest format for a flat-coloured texture that every browser reads. Each row is led by
 * filter 0. Compressed with fflate rather than node:zlib: the bytes are compared with those in the repository, and
 * Node's zlib gives other bytes in other versions.
 */
import { zlibSync } from 'fflate';
import { pngFile } from '../../../src/formats/png/chunks.ts';

/** `pixels`: RGB, rows from the top. More than 256 colours are reduced to the 256 most frequent. */
export function encodePng(pixels: Uint8Array, size: number): Uint8Array {
  const { palette, indices } = indexColours(pixels);
  const rows = new Uint8Array(size * (size + 1));
  for (let y = 0; y < size; y++) rows.set(indices.subarray(y * size, (y + 1) * size), y * (size + 1) + 1);
  return pngFile([size, size], 'palette', [
    { type: 'PLTE', data: Uint8Array.from(palette) },
    { type: 'IDAT', data: zlibSync(rows, { level: 9, mem: 12 }) },
  ]);
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
