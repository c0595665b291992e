import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { FloatBlocks } from '../../../src/view/skin/float-blocks.ts';

const floatsOf = (blocks: FloatBlocks, texel: number, texels: number) => [
  ...(blocks.texture.image.data ?? []).slice(4 * texel, 4 * (texel + texels)),
];

describe('blocks of floats in one texture', () => {
  it('blocks of floats keep their place and what is written to them, whatever else comes, grows and goes', () => {
    const step = fc.oneof(fc.record({ take: fc.integer({ min: 1, max: 700 }) }), fc.record({ give: fc.nat() }));
    fc.assert(
      fc.property(fc.array(step, { maxLength: 60 }), (steps) => {
        const blocks = new FloatBlocks();
        const owned: { first: number; texels: number; mark: number }[] = [];
        steps.forEach((each, mark) => {
          if ('take' in each) {
            const first = blocks.allocate(each.take);
            blocks.write(first, new Array(4 * each.take).fill(mark));
            owned.push({ first, texels: each.take, mark });
          } else if (owned.length > 0) {
            const [gone] = owned.splice(each.give % owned.length, 1);
            blocks.release(gone.first, gone.texels);
          }
          for (const { first, texels, mark: own } of owned) {
            expect(new Set(floatsOf(blocks, first, texels))).toEqual(new Set([own]));
          }
        });
      }),
      { numRuns: 40 },
    );
  });

  it('blocks of floats that are given back make room for others: nothing grows by coming and going', () => {
    const blocks = new FloatBlocks();
    const sizes = [5, 100, 1, 64, 30];
    for (let round = 0; round < 200; round++) {
      const firsts = sizes.map((size) => blocks.allocate(size));
      // In another order than they came.
      for (const i of [3, 0, 4, 1, 2]) blocks.release(firsts[i], sizes[i]);
    }
    expect(blocks.texture.image).toMatchObject({ width: 256, height: 1 });
    expect(blocks.allocate(256)).toBe(0);
  });
});
