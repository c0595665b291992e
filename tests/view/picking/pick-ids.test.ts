import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { decodeId, IdRuns, nearestId } from '../../../src/view/picking/pick-ids.ts';

/** The four colour bytes that the shader writes for an id. */
function encodeId(id: number): number[] {
  return [id & 255, (id >>> 8) & 255, (id >>> 16) & 255, id >>> 24];
}

/** An image of `size` × `size` ids, rows from the bottom. */
function picture(size: number, ids: Readonly<Record<number, number>>): Uint8Array {
  const pixels = new Uint8Array(4 * size * size);
  for (const [index, id] of Object.entries(ids)) pixels.set(encodeId(id), 4 * Number(index));
  return pixels;
}

const any = () => true;

describe('ids in a picture', () => {
  it('ids in a picture come back as they were written, all 32 bits of them', () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 0xffffffff }), (id) => {
        expect(decodeId(encodeId(id), 0)).toBe(id);
      }),
    );
  });

  it('ids in a picture are taken from the pixel nearest the centre', () => {
    expect(nearestId(picture(5, { 0: 7, 13: 8 }), 5, 5, any)).toBe(8);
    expect(nearestId(picture(5, { 12: 3, 13: 8 }), 5, 5, any)).toBe(3);
  });

  it('ids in a picture are nothing where nothing was drawn, or too far away', () => {
    expect(nearestId(picture(5, {}), 5, 5, any)).toBe(0);
    expect(nearestId(picture(5, { 0: 7 }), 5, 2, any)).toBe(0);
  });

  it('pass over what was not asked for', () => {
    expect(nearestId(picture(5, { 12: 3, 0: 7 }), 5, 5, (id) => id > 5)).toBe(7);
  });

  it('ids in a picture tell what they stand for', () => {
    const runs = new IdRuns<string>();
    expect(runs.add(10, 'joints')).toBe(1);
    expect(runs.add(0, 'none')).toBe(11);
    expect(runs.add(5, 'skin')).toBe(11);
    expect([0, 1, 10, 11, 15, 16].map((id) => runs.find(id)?.what)).toEqual([
      undefined,
      'joints',
      'joints',
      'skin',
      'skin',
      undefined,
    ]);
    runs.clear();
    expect(runs.find(1)).toBeUndefined();
  });
});
