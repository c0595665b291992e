/** Reading `.npy` and `.npz`: every type and layout that is read, and what is refused. */
import fc from 'fast-check';
import { zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { Budget } from '../../../src/import/budget.ts';
import { ONLY, readNpy } from '../../../src/import/numpy/npy.ts';
import { Arrays } from '../../../src/import/numpy/npz.ts';
import { npyOf, npyWith, npzOf } from '../../helpers/numpy.ts';

const read = (bytes: Uint8Array) => readNpy(bytes, 'x');
const header = (descr: string, shape: string, isFortran = 'False') =>
  `{'descr': ${descr}, 'fortran_order': ${isFortran}, 'shape': ${shape}, }\n`;
const of = (...bytes: readonly number[]) => Uint8Array.from(bytes);
const arraysIn = (bytes: Uint8Array) => {
  const budget = new Budget(bytes.length, (message) => {
    throw new Error(message);
  });
  return new Arrays(bytes, 'x.npz', budget);
};

/** A type, its bytes, and the numbers that they are. */
const TYPES: readonly (readonly [descr: string, bytes: readonly number[], values: readonly number[]])[] = [
  ['<f2', [0x00, 0x3c, 0x01, 0x00], [1, 2 ** -24]],
  ['>f2', [0xc0, 0x00], [-2]],
  ['<f4', [0, 0, 0x80, 0x3f], [1]],
  ['>f4', [0x3f, 0x80, 0, 0], [1]],
  ['<f8', [0, 0, 0, 0, 0, 0, 0xf0, 0x3f], [1]],
  ['>f8', [0x3f, 0xf0, 0, 0, 0, 0, 0, 0], [1]],
  ['|i1', [0xff, 2], [-1, 2]],
  ['<i2', [0xfe, 0xff], [-2]],
  ['>i2', [0xff, 0xfe], [-2]],
  ['<i4', [0xfe, 0xff, 0xff, 0xff], [-2]],
  ['>i4', [0, 0, 1, 0], [256]],
  ['<i8', [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff], [-1]],
  ['>i8', [0, 0, 0, 0, 0, 0, 0, 7], [7]],
  ['|u1', [255], [255]],
  ['<u2', [0xff, 0xff], [65535]],
  ['>u4', [0, 0, 0, 9], [9]],
  ['<u8', [1, 0, 0, 0, 0, 0, 0, 0], [1]],
  ['|b1', [1, 0], [1, 0]],
  ['?', [1], [1]],
];

describe('a .npy', () => {
  it.each(TYPES)('numbers of the type %s are read', (descr, bytes, values) => {
    const made = npyWith(header(`'${descr}'`, `(${values.length},)`), of(...bytes));
    expect([...read(made).values]).toEqual(values);
  });

  it.each([
    [1, 0],
    [2, 0],
    [3, 0],
  ])('version %d.%d is read, with keys in any order, other quotes and long integers', (...version) => {
    const text = `{"shape": (2L, 1L), 'fortran_order': False, "descr": '|u1'}`;
    const { shape, values } = read(npyWith(text, of(3, 4), [version[0], version[1]]));
    expect([shape, [...values]]).toEqual([
      [2, 1],
      [3, 4],
    ]);
  });

  it('an array without dimensions is one number', () => {
    const { shape, values } = read(npyWith(header(`'<f4'`, '()'), of(0, 0, 0x80, 0x3f)));
    expect([shape, [...values]]).toEqual([[], [1]]);
  });

  it('numbers in Fortran order come row by row', () => {
    const made = npyWith(header(`'|u1'`, '(2, 3, 2)', 'True'), of(0, 6, 2, 8, 4, 10, 1, 7, 3, 9, 5, 11));
    expect([...read(made).values]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
  });

  it('texts of either kind and byte order are read', () => {
    expect(read(npyWith(header(`'|S3'`, '(2,)'), Buffer.from('ab\0xyz'))).texts).toEqual(['ab', 'xyz']);
    expect(read(npyWith(header(`'>U2'`, '(1,)'), of(0, 0, 0, 104, 0, 1, 0xd1, 0x1e))).texts).toEqual(['h𝄞']);
  });

  it.each([
    [header(`'|O'`, '(1,)'), /^x holds Python objects \(pickled\)/],
    [header(`[('a', '<f4')]`, '(1,)'), /found a structure/],
    [header(`'<c8'`, '(1,)'), /found <c8/],
    [header(`'<f16'`, '(1,)'), /found <f16/],
    [header(`'<f8'`, '(2, 2)'), /Expected 32 bytes for the shape \(2, 2\)/],
    [header(`'<f8'`, '(4294967296, 4294967296, 3)'), /more than 512 MB/],
    [header(`'<f8'`, '(-1,)'), /Expected descr/],
    [header(`'<f8'`, '(1e9,)'), /Expected descr/],
    [header(`'|S1'`, '(100000,)'), /texts/],
    [`__import__('os').system('true')`, /Expected descr/],
    [`{'descr': open('x'), 'fortran_order': False, 'shape': (1,)}`, /Expected descr/],
    [`{'descr': ${'['.repeat(5000)}, 'fortran_order': False, 'shape': (1,)}`, /Expected descr/],
    [`${header(`'|u1'`, '(1,)')}and more`, /Expected descr/],
  ])('the header %s is refused in words', (text, message) => {
    expect(() => read(npyWith(text, new Uint8Array(8)))).toThrow(message);
  });

  it('numbers that are not finite are named with their frame, wherever they are', () => {
    for (const wrong of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]) {
      for (let i = 0; i < 14; i++) {
        const made = npyOf([[7, 2], Float64Array.from({ length: 14 }, (_, k) => (k === i ? wrong : 9e29))]);
        expect(() => read(made)).toThrow(`Expected finite numbers in x, found ${wrong} in frame ${i >> 1}`);
      }
    }
    expect(read(npyOf([[7, 2], new Float64Array(14).fill(9e29)])).values).toHaveLength(14);
  });

  it('numbers that overflow when they are multiplied are refused', () => {
    const made = npyOf([[2, 2], Float64Array.of(1, 2, -1e200, 4)]);
    expect(() => read(made)).toThrow('Expected numbers of less than 1e+30 in x, found -1e+200 in frame 1');
  });

  it('any bytes are read or refused in a sentence', () => {
    const whole = npyOf([[2, 3], Float32Array.of(1, 2, 3, 4, 5, 6)]);
    fc.assert(
      fc.property(fc.nat(whole.length - 1), fc.nat(255), fc.nat(whole.length), (at, byte, length) => {
        const bytes = whole.slice(0, length);
        if (at < length) bytes[at] = byte;
        try {
          expect(read(bytes).values.every(Number.isFinite)).toBe(true);
        } catch (error) {
          expect(error).toHaveProperty('code');
        }
      }),
    );
  });
});

describe('a .npz', () => {
  const numbers = Float64Array.from({ length: 3000 }, (_, i) => Math.sin(i));

  it.each([0, 6] as const)('its arrays come back, at level %d', (level) => {
    const arrays = arraysIn(npzOf({ a: [[1000, 3], numbers], b: [[2], ['x', 'yz']] }, level));
    expect(arrays.names).toEqual(['a', 'b']);
    expect(arrays.header('a')?.shape).toEqual([1000, 3]);
    expect(arrays.array('a')?.values).toEqual(numbers);
    expect(arrays.array('b')?.texts).toEqual(['x', 'yz']);
    expect(arrays.array('c')).toBeUndefined();
  });

  it('sizes in 64 bits are read, as numpy writes them of large arrays', () => {
    const made = npzOf({ a: [[1000, 3], numbers] });
    const view = new DataView(made.buffer);
    const end = made.length - 22;
    const at = view.getUint32(end + 16, true);
    const name = view.getUint16(at + 28, true);
    const extra = new DataView(new ArrayBuffer(20));
    extra.setUint16(0, 1, true);
    extra.setUint16(2, 16, true);
    extra.setBigUint64(4, BigInt(view.getUint32(at + 24, true)), true);
    extra.setBigUint64(12, BigInt(view.getUint32(at + 20, true)), true);
    view.setUint32(at + 20, 0xffffffff, true);
    view.setUint32(at + 24, 0xffffffff, true);
    view.setUint16(at + 30, 20, true);
    const wide = Buffer.concat([made.subarray(0, at + 46 + name), new Uint8Array(extra.buffer), made.subarray(end)]);
    expect(arraysIn(new Uint8Array(wide)).array('a')?.values).toEqual(numbers);
  });

  it('what is said of the only array of a .npy is a sentence', () => {
    const objects = npyWith(header(`'|O'`, '(1,)'), of(1, 2, 3));
    expect(() => readNpy(objects, ONLY)).toThrow(/^The array holds Python objects/);
  });

  it('objects are refused only where they are needed', () => {
    const objects = npyWith(header(`'|O'`, '(1,)'), of(1, 2, 3));
    const arrays = arraysIn(npzOf({ objects, a: [[1000, 3], numbers] }));
    expect(arrays.array('a')?.values).toEqual(numbers);
    expect(() => arrays.array('objects')).toThrow('Python objects');
  });

  /** Sets a number of the entry in the directory, at an offset. */
  const altered = (bytes: Uint8Array, offset: number, value: number, size: 2 | 4 = 4) => {
    const out = bytes.slice();
    const view = new DataView(out.buffer);
    const at = view.getUint32(out.length - 6, true);
    if (size === 2) view.setUint16(at + offset, value, true);
    else view.setUint32(at + offset, value, true);
    return out;
  };

  it.each([0, 6] as const)('an entry of another size than the directory says is refused, at level %d', (level) => {
    const whole = npzOf({ a: [[1000, 3], numbers] }, level);
    for (const size of [24_000, 24_130, 30_000]) {
      expect(() => arraysIn(altered(whole, 24, size)).array('a'), `${size}`).toThrow(/Expected|claims/);
    }
  });

  it('what its bytes can not hold is refused before anything is unpacked', () => {
    const whole = npzOf({ a: [[1000, 3], numbers] });
    expect(() => arraysIn(altered(whole, 24, 400_000_000)).array('a')).toThrow('claims 400000000 bytes');
    expect(() => arraysIn(altered(whole, 24, 4_000_000_000)).array('a')).toThrow('more than 512 MB');
  });

  it('no more is unpacked than is claimed', () => {
    // Eight megabytes of zeros in eight kilobytes.
    const bomb = npzOf({ a: npyWith(header(`'|u1'`, '(8,)'), new Uint8Array(8 * 2 ** 20)) });
    expect(() => arraysIn(altered(bomb, 24, 88)).array('a')).toThrow('found more');
  });

  it('encrypted entries, other methods and overlapping entries are refused', () => {
    const whole = npzOf({ a: [[1000, 3], numbers] });
    expect(() => arraysIn(altered(whole, 8, 1, 2)).array('a')).toThrow('encrypted');
    expect(() => arraysIn(altered(whole, 10, 12, 2)).array('a')).toThrow('method 12');
    expect(() => arraysIn(altered(whole, 20, 1_000_000))).toThrow('overlap');
  });

  it('a file that is cut off, or is none, is said to be', () => {
    const whole = npzOf({ a: [[1000, 3], numbers] });
    expect(() => arraysIn(whole.slice(0, -30))).toThrow('The end of x.npz is missing');
    expect(() => arraysIn(of(1, 2, 3))).toThrow('found something else');
    expect(arraysIn(zipSync({})).names).toEqual([]);
  });
});
