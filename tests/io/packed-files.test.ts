import fc from 'fast-check';
import { expect, it } from 'vitest';
import { packFiles, unpackFiles } from '../../src/io/packed-files.ts';
import type { ParsedFile } from '../../src/model/files.ts';

const number = fc.oneof(
  fc.integer({ min: -1e6, max: 1e6 }).map((n) => n / 1000),
  fc.double({ noNaN: true, noDefaultInfinity: true }).filter((n) => !Object.is(n, -0)),
);

it('packed files are unpacked to the last bit, whatever numbers their columns have', () => {
  fc.assert(
    fc.property(
      fc.array(number, { maxLength: 40 }),
      fc.array(fc.nat({ max: 2 ** 32 - 1 }), { maxLength: 40 }),
      fc.uint8Array({ maxLength: 40 }),
      (doubles, whole, bytes) => {
        // Of no kind of file: every object is packed the same way.
        const files = [
          { doubles: Float64Array.from(doubles), inside: { whole: Uint32Array.from(whole), list: [bytes, 'a', null] } },
        ] as unknown as readonly ParsedFile[];
        const text = packFiles(files, (one) => one.length);
        expect(unpackFiles(JSON.parse(text))).toEqual(files);
      },
    ),
  );
});

it('packed files have pictures as base64, and numbers that resemble each other as differences', () => {
  const picture = Uint8Array.from({ length: 3000 }, (_, i) => (i * i) % 251);
  const triangles = Uint32Array.from({ length: 300 }, (_, i) => 100_000 + i);
  const files = [{ picture, triangles }] as unknown as readonly ParsedFile[];
  const text = packFiles(files, (one) => one.length);
  expect(text.length).toBeLessThan(5000);
  expect(unpackFiles(JSON.parse(text))).toEqual(files);
});

it('columns of another type are refused', () => {
  const files = [{ floats: new Float32Array(3) }] as unknown as readonly ParsedFile[];
  expect(() => packFiles(files, (one) => one.length)).toThrow('Float32Array');
});
