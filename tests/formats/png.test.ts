import { crc32 as zlibCrc32 } from 'node:zlib';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { pngFile } from '../../src/formats/png/chunks.ts';
import { crc32 } from '../../src/formats/png/crc32.ts';

describe('PNG', () => {
  it('the CRC-32 of any bytes is zlib’s', () => {
    expect(crc32(new TextEncoder().encode('123456789'))).toBe(0xcbf43926);
    fc.assert(fc.property(fc.uint8Array(), (bytes) => crc32(bytes) === zlibCrc32(bytes)));
  });

  it('a PNG has its signature, size and chunks in order, each with its length and checksum', () => {
    const file = pngFile([3, 258], 'palette', [{ type: 'PLTE', data: Uint8Array.of(1, 2, 3) }]);
    const view = new DataView(file.buffer);
    expect([...file.subarray(0, 8)]).toEqual([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
    const chunks: (readonly [string, readonly number[]])[] = [];
    for (let at = 8; at < file.length; ) {
      const end = at + 8 + view.getUint32(at);
      chunks.push([String.fromCharCode(...file.subarray(at + 4, at + 8)), [...file.subarray(at + 8, end)]]);
      expect(view.getUint32(end)).toBe(zlibCrc32(file.subarray(at + 4, end)));
      at = end + 4;
    }
    expect(chunks).toEqual([
      ['IHDR', [0, 0, 0, 3, 0, 0, 1, 2, 8, 3, 0, 0, 0]],
      ['PLTE', [1, 2, 3]],
      ['IEND', []],
    ]);
  });
});
