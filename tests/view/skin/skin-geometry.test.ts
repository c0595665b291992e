import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { edgesOf, normalsGeometry, packSkin } from '../../../src/view/skin/skin-geometry.ts';
import { skin } from '../../helpers/builders.ts';

const many = (counts: readonly number[]) =>
  skin('hero', 0, {
    positions: new Float64Array(3 * counts.length),
    attachments: {
      start: Uint32Array.of(0, ...counts.map((_, v) => counts.slice(0, v + 1).reduce((a, b) => a + b, 0))),
      joints: Uint32Array.from(
        counts.flatMap((n) => Array.from({ length: n }, (_, i) => i)),
        (i) => i,
      ),
      weights: Float64Array.from(
        counts.flatMap((n) => Array.from({ length: n }, (_, i) => (i + 1) / 8)),
        (w) => w,
      ),
    },
  });

describe('a skin packed for the GPU', () => {
  it('a skin packed for the GPU has four attachments a vertex in attributes and the rest in a texture, in ranges', () => {
    const model = many([0, 1, 4, 6, 9, 0]);
    const { geometry, attachmentTexture } = runToEnd(packSkin(model, model.positions, 99, true));
    const index = geometry.getAttribute('skinIndex');
    const weight = geometry.getAttribute('skinWeight');
    expect([...index.array]).toEqual([99, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 99, 0, 0, 0]);
    expect([...weight.array.subarray(0, 8)]).toEqual([1, 0, 0, 0, 0.125, 0, 0, 0]);
    expect([...geometry.getAttribute('attachmentRange').array]).toEqual([0, 0, 0, 0, 0, 0, 0, 2, 2, 7, 7, 7]);
    expect(attachmentTexture?.image.data?.slice(0, 14)).toEqual(
      Float32Array.of(4, 0.625, 5, 0.75, 4, 0.625, 5, 0.75, 6, 0.875, 7, 1, 8, 1.125),
    );
  });

  it('a skin packed for the GPU has no texture where four are enough, and hangs on the root without any', () => {
    const model = many([0, 1, 4]);
    expect(runToEnd(packSkin(model, model.positions, 9, true)).attachmentTexture).toBeUndefined();
    const { attachments: _, ...bare } = skin();
    const { geometry } = runToEnd(packSkin(bare, bare.positions, 9, true));
    expect([...geometry.getAttribute('skinWeight').array]).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
  });

  it('hangs on the identity without a skeleton', () => {
    const model = many([0, 1, 9]);
    const { geometry, attachmentTexture } = runToEnd(packSkin(model, model.positions, 7, false));
    expect([...geometry.getAttribute('skinIndex').array]).toEqual([7, 0, 0, 0, 7, 0, 0, 0, 7, 0, 0, 0]);
    expect(attachmentTexture).toBeUndefined();
  });

  it('takes more joints than 16 bits count', () => {
    const model = many([1]);
    const { geometry } = runToEnd(packSkin(model, model.positions, 70_000, true));
    expect(geometry.getAttribute('skinIndex').array).toBeInstanceOf(Float32Array);
  });

  it('stops often enough on the way that no slice is felt', () => {
    const counts = new Array(50_000).fill(1);
    const model = { ...many([1]), positions: new Float64Array(3 * counts.length) };
    model.attachments = {
      start: Uint32Array.from({ length: counts.length + 1 }, (_, v) => v),
      joints: new Uint32Array(counts.length),
      weights: new Float64Array(counts.length).fill(1),
    };
    const steps = [...packSkin(model, model.positions, 9, true)];
    expect(steps.length).toBeGreaterThanOrEqual(5);
    expect(steps).toEqual([...steps].sort((a, b) => a - b));
  });

  it('shares its arrays with the lines that show its normals', () => {
    const { geometry } = runToEnd(packSkin(skin(), new Float64Array(9), 9, true));
    const lines = normalsGeometry(geometry);
    expect(lines.getAttribute('position').array).toBe(geometry.getAttribute('position').array);
    expect(lines.instanceCount).toBe(3);
  });
});

describe('the wire of a skin', () => {
  it('the wire of a skin has each edge once, whichever way round the triangles go', () => {
    const triangles = fc
      .array(fc.tuple(fc.nat(9), fc.nat(9), fc.nat(9)), { maxLength: 30 })
      .map((all) => Uint32Array.from(all.flat()));
    /** Naively: a set of pairs, the lower vertex first, without degenerate ones. */
    const sidesOf = (all: Uint32Array) => {
      const sides = new Set<string>();
      for (let i = 0; i < all.length; i++) {
        const [a, b] = [all[i], all[i % 3 === 2 ? i - 2 : i + 1]];
        if (a !== b) sides.add(`${Math.min(a, b)}-${Math.max(a, b)}`);
      }
      return sides;
    };
    const sorted = (pairs: Uint32Array) =>
      Array.from({ length: pairs.length / 2 }, (_, e) => `${pairs[2 * e]}-${pairs[2 * e + 1]}`).sort();
    fc.assert(
      fc.property(triangles, (all) => {
        expect(sorted(runToEnd(edgesOf(all, 10)))).toEqual([...sidesOf(all)].sort());
      }),
    );
  });
});
