import { crc32 } from 'node:zlib';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { DataArray } from '../../src/dataset/data-array.ts';
import { npzPieces } from '../../src/dataset/npz.ts';
import { readNpz } from './read-npz.ts';

const file = (arrays: readonly DataArray[]) => Buffer.concat(npzPieces(arrays, crc32));

describe('an .npz', () => {
  it('an .npz has the arrays that were written, with numpy’s types and shapes', () => {
    const bytes = file([
      { name: 'a', type: 'float', shape: [2, 3], data: Float32Array.of(1, 2, 3, 4, 5, 0.1) },
      { name: 'b', type: 'float', shape: [], data: Float64Array.of(0.1) },
      { name: 'c', type: 'int', shape: [2], data: Int32Array.of(-1, 7) },
      { name: 'd', type: 'bool', shape: [3, 1], data: Uint8Array.of(0, 1, 1) },
      { name: 'e', type: 'text', shape: [3], data: ['hips', '', 'Knöchel 𝄞'] },
      { name: 'none', type: 'text', shape: [0], data: [] },
    ]);
    expect(readNpz(bytes)).toEqual({
      a: { descr: '<f4', shape: [2, 3], values: [1, 2, 3, 4, 5, Math.fround(0.1)] },
      b: { descr: '<f8', shape: [], values: [0.1] },
      c: { descr: '<i4', shape: [2], values: [-1, 7] },
      d: { descr: '|b1', shape: [3, 1], values: [0, 1, 1] },
      e: { descr: '<U9', shape: [3], values: ['hips', '', 'Knöchel 𝄞'] },
      none: { descr: '<U1', shape: [0], values: [] },
    });
  });

  it('any arrays come back from an .npz, whose bytes they alone decide', () => {
    const floats = fc.array(fc.double()).map((values) => Float64Array.from(values));
    const texts = fc.array(fc.string({ unit: 'grapheme' }).filter((text) => !text.includes('\0')));
    fc.assert(
      fc.property(floats, texts, (data, names) => {
        const arrays: readonly DataArray[] = [
          { name: 'values', type: 'float', shape: [data.length], data },
          { name: 'names', type: 'text', shape: [names.length], data: names },
        ];
        const read = readNpz(file(arrays));
        expect(read.values.values).toEqual([...data]);
        expect(read.names.values).toEqual(names);
        expect(file(arrays).equals(file(arrays))).toBe(true);
      }),
      { numRuns: 50 },
    );
  });
});
