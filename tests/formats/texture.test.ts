import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { imageSize } from '../../src/formats/texture/image-size.ts';
import { textureReader } from '../../src/formats/texture/read.ts';

const size = fc.record({ width: fc.integer({ min: 1, max: 0x3fff }), height: fc.integer({ min: 1, max: 0x3fff }) });
type Size = { readonly width: number; readonly height: number };

/** Headers only: nothing is decoded. */
const HEADERS: Readonly<Record<string, (size: Size) => Uint8Array<ArrayBuffer>>> = {
  png({ width, height }) {
    const bytes = new Uint8Array(33);
    bytes.set([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);
    new DataView(bytes.buffer).setUint32(16, width);
    new DataView(bytes.buffer).setUint32(20, height);
    return bytes;
  },
  bmp({ width, height }) {
    const bytes = new Uint8Array(54);
    bytes.set([0x42, 0x4d]);
    const view = new DataView(bytes.buffer);
    view.setUint32(14, 40, true);
    view.setInt32(18, width, true);
    view.setInt32(22, -height, true);
    return bytes;
  },
  jpg({ width, height }) {
    // A comment, a table and fill bytes come before the frame.
    const bytes = [0xff, 0xd8, 0xff, 0xfe, 0, 4, 0xff, 0xc0, 0xff, 0xc4, 0, 3, 9, 0xff, 0xff, 0xc2, 0, 11, 8];
    return Uint8Array.of(...bytes, height >> 8, height & 255, width >> 8, width & 255, 1, 0, 0);
  },
  webp({ width, height }) {
    const bytes = new Uint8Array(30);
    bytes.set(new TextEncoder().encode('RIFF----WEBPVP8L'));
    bytes[20] = 0x2f;
    new DataView(bytes.buffer).setUint32(21, (width - 1) | ((height - 1) << 14), true);
    return bytes;
  },
};

function read(name: string, bytes: Uint8Array<ArrayBuffer>) {
  const reader = textureReader(name);
  reader.feed(bytes);
  return reader.end();
}

describe('images', () => {
  it('the size of an image is what its header states, in each format', () => {
    for (const header of Object.values(HEADERS)) {
      fc.assert(
        fc.property(size, (stated) => {
          expect(imageSize(header(stated))).toEqual(stated);
        }),
        { numRuns: 30 },
      );
    }
  });

  it('the size of an image is undefined or whole numbers, whatever the bytes are', () => {
    const begun = fc.constantFrom(...Object.values(HEADERS).map((header) => header({ width: 3, height: 5 })));
    fc.assert(
      fc.property(begun, fc.uint8Array({ maxLength: 40 }), fc.nat(30), (header, noise, at) => {
        const found = imageSize(Uint8Array.of(...header.subarray(0, at), ...noise));
        if (found) expect([found.width, found.height].every((n) => Number.isInteger(n) && n >= 0)).toBe(true);
      }),
    );
  });

  it('an image that states more pixels than can be drawn is refused before it is decoded, with its size', () => {
    for (const [extension, header] of Object.entries(HEADERS)) {
      const stated = extension === 'webp' ? { width: 16_383, height: 16_383 } : { width: 50_000, height: 50_000 };
      const { value, diagnostics } = read(`a.${extension}`, header(stated));
      expect(value).toBeUndefined();
      expect(diagnostics.map(({ message }) => message)).toEqual([
        `The image has ${stated.width} × ${stated.height} pixels. A texture may have up to 16384 pixels per side and 100 million in total. Scale it down.`,
      ]);
    }
    expect(read('a.png', HEADERS.png({ width: 8192, height: 8192 })).value?.name).toBe('a.png');
  });
});
