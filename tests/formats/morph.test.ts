import { describe, expect, it } from 'vitest';
import { readMorph } from '../../src/formats/morph/read.ts';
import { writeMorph } from '../../src/formats/morph/write.ts';
import { told } from './read-in-pieces.ts';

const morph = (text: string) => readMorph(text, 'smile.morph');

describe('reading .morph', () => {
  it('reads rows of an index and a vector', () => {
    const { value, diagnostics } = morph('normals 1 { 4 0 0 1 } positions 2 {\n18 0.5 1 -2\n3 0 0 1e-3\n}');
    expect(diagnostics).toEqual([]);
    expect(value).toEqual({
      name: 'smile',
      positions: { indices: Uint32Array.of(18, 3), values: Float64Array.of(0.5, 1, -2, 0, 0, 1e-3) },
      normals: { indices: Uint32Array.of(4), values: Float64Array.of(0, 0, 1) },
    });
  });

  it('reading .morph reads many rows', () => {
    const rows = Array.from({ length: 9000 }, (_, i) => `${2 * i} ${i} 0 -${i}`).join('\n');
    const { value } = morph(`positions 9000 {\n${rows}\n}`);
    expect(value?.positions.indices[8999]).toBe(17998);
    expect(value?.positions.values.slice(-3)).toEqual(Float64Array.of(8999, 0, -8999));
  });

  it('stores no weight, and says so', () => {
    const { value } = morph('positions 1 { 0 1 2 3 }');
    if (!value) throw new Error('not read');
    const { text, diagnostics } = writeMorph({ ...value, weight: 0.5 }, 'smile.morph');
    expect(text).toBe(writeMorph(value).text);
    expect(told({ diagnostics })).toEqual(['info weight-left-out 0:0']);
  });

  it('uses the last of rows for one vertex, and says so', () => {
    const { value, diagnostics } = morph('positions 3 {\n5 1 1 1\n4 2 2 2\n5 3 3 3\n}');
    expect(value?.positions).toEqual({ indices: Uint32Array.of(5, 4), values: Float64Array.of(3, 3, 3, 2, 2, 2) });
    expect(told({ diagnostics })).toEqual(['warning index-repeated 4:1']);
  });

  it('uses what is there where a count says otherwise', () => {
    expect(told(morph('positions 3 {\n5 1 1 1\n}'))).toEqual(['warning count-mismatch 1:11']);
    expect(told(morph('positions -1 {\n5 1 1 1\n}'))).toEqual(['warning count-mismatch 1:11']);
  });

  it.each([
    ['', 'error vertex-missing 1:1'],
    ['positions 0 { }', 'error vertex-missing 1:1'],
    ['positions 1 {\n5 1 1\n}', 'error vertex-missing 1:1'],
    ['positions 2 {\n5 1 1 1\n6 1 1\n}', 'error row-incomplete 4:1'],
    ['positions 1 {\n1.5 1 1 1\n}', 'error index-fractional 2:1'],
    ['positions 1 {\n-1 1 1 1\n}', 'error index-out-of-range 2:1'],
    ['positions 1 {\n1e10 1 1 1\n}', 'error index-out-of-range 2:1'],
    ['positions 1 {\n5 1 x 1\n}', 'error not-a-number 2:5'],
    ['positions {\n5 1 1 1\n}', 'error number-expected 1:11'],
    ['positions 1 {\n5 1 1 1\nnormals 1 {\n5 1 1 1\n}', 'error brace-missing 3:1'],
    ['positions 1 {\n5 1 1 1', 'error brace-missing 2:8'],
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = morph(text);
    expect(result.value).toBeUndefined();
    expect(told(result)[0]).toBe(expected);
  });
});

describe('writing .morph', () => {
  it('leaves out a block without rows', () => {
    const { value } = morph('positions 1 { 4 0 0.5 -0 }');
    expect(value && writeMorph(value).text).toBe('positions 1 {\n\t4 0 0.5 -0\n}\n');
  });
});
