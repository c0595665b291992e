import { unzlibSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { readBmp } from '../../../src/export/shared/images/bmp.ts';
import { imageOf } from '../../../src/export/shared/images/images.ts';
import { writePng } from '../../../src/export/shared/images/png.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';

/** A bitmap of a header of 40 bytes, a palette and rows. */
function bitmap(width: number, height: number, bits: number, compression: number, palette: number[], rows: number[]) {
  const bytes = new Uint8Array(54 + palette.length + rows.length);
  const view = new DataView(bytes.buffer);
  bytes.set([0x42, 0x4d]);
  view.setUint32(2, bytes.length, true);
  view.setUint32(10, 54 + palette.length, true);
  view.setUint32(14, 40, true);
  view.setInt32(18, width, true);
  view.setInt32(22, height, true);
  view.setUint16(26, 1, true);
  view.setUint16(28, bits, true);
  view.setUint32(30, compression, true);
  bytes.set(palette, 54);
  bytes.set(rows, 54 + palette.length);
  return bytes;
}

const RED = [255, 0, 0, 255];
const GREEN = [0, 255, 0, 255];
const PALETTE = [0, 0, 255, 0, 0, 255, 0, 0];

describe('bitmaps', () => {
  it('a bitmap of 24 bits is read from its last row up, with padded rows', () => {
    const rows = [0, 255, 0, 0, 0, 255, 0, 0, /* above: */ 0, 0, 255, 0, 0, 255, 0, 0];
    expect([...(readBmp(bitmap(2, 2, 24, 0, [], rows))?.rgba ?? [])]).toEqual([...RED, ...RED, ...GREEN, ...RED]);
    expect([...(readBmp(bitmap(2, -2, 24, 0, [], rows))?.rgba ?? [])]).toEqual([...GREEN, ...RED, ...RED, ...RED]);
  });

  it('a bitmap with a palette is read, of 1, 4 and 8 bits and in runs', () => {
    const expected = [...GREEN, ...RED, ...GREEN];
    for (const bytes of [
      bitmap(3, 1, 1, 0, PALETTE, [0b10100000, 0, 0, 0]),
      bitmap(3, 1, 4, 0, PALETTE, [0x10, 0x10, 0, 0]),
      bitmap(3, 1, 8, 0, PALETTE, [1, 0, 1, 0]),
      bitmap(3, 1, 8, 1, PALETTE, [1, 1, 1, 0, 1, 1, 0, 1]),
      bitmap(3, 1, 4, 2, PALETTE, [3, 0x10, 0, 1]),
    ]) {
      expect([...(readBmp(bytes)?.rgba ?? [])]).toEqual(expected);
    }
  });

  it('a bitmap that is cut off or far too large is none', () => {
    const whole = bitmap(2, 2, 24, 0, [], new Array(16).fill(0));
    for (let length = 0; length < whole.length; length++) expect(readBmp(whole.subarray(0, length))).toBeUndefined();
    expect(readBmp(bitmap(1 << 20, 1 << 20, 24, 0, [], []))).toBeUndefined();
  });

  it('the PNG of some pixels has them: its rows are differences to those above', () => {
    const png = writePng({ width: 1, height: 2, rgba: Uint8Array.of(9, 8, 7, 255, 10, 7, 7, 255), hasAlpha: false });
    expect([...png.subarray(1, 4)]).toEqual([0x50, 0x4e, 0x47]);
    const length = new DataView(png.buffer).getUint32(33);
    expect([...unzlibSync(png.subarray(41, 41 + length))]).toEqual([0, 9, 8, 7, 2, 1, 255, 0]);
  });

  it('images are told by their content, whatever they are called', () => {
    const named = (bytes: number[]) =>
      imageOf({ name: 'x.bmp', mime: 'image/bmp', bytes: Uint8Array.from(bytes) })?.mime;
    expect(named([0x89, 0x50, 0x4e, 0x47])).toBe('image/png');
    expect(named([0xff, 0xd8, 0xff])).toBe('image/jpeg');
    expect(named([1, 2, 3])).toBeUndefined();
  });
});

describeShared('the course’s bitmap', () => {
  it('the bitmap of the head becomes a PNG that is smaller', () => {
    const bytes = Uint8Array.from(sharedBytes('data/cse169/head.bmp'));
    const made = imageOf({ name: 'head.bmp', mime: 'image/bmp', bytes });
    expect(made?.mime).toBe('image/png');
    expect(made?.bytes.length).toBeLessThan(bytes.length);
  });
});
