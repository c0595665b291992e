import fc from 'fast-check';
import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { blendMorphs, compileSkin } from '../../../src/evaluate/skin/deform.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { addMorphs, packMorphs } from '../../../src/view/skin/packed-morphs.ts';
import { skin } from '../../helpers/builders.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';

const VERTICES = 6;
const base = skin('hero', 0, {
  positions: Float64Array.from({ length: 3 * VERTICES }, (_, i) => Math.sin(i)),
  normals: Float64Array.from({ length: 3 * VERTICES }, (_, i) => Math.cos(i)),
});
const compiled = compileSkin(base);

const number = fc.double({ min: -10, max: 10, noNaN: true });
/** Rows for some vertices, each once, in any order; some beyond the skin's. */
const rows = fc
  .uniqueArray(fc.nat(VERTICES + 1), { maxLength: VERTICES })
  .chain((indices) =>
    fc
      .array(number, { minLength: 3 * indices.length, maxLength: 3 * indices.length })
      .map((values) => ({ indices: Uint32Array.from(indices), values: Float64Array.from(values) })),
  );
const morph = fc.record({ name: fc.constant('m'), positions: rows, normals: rows });
const morphs = fc.array(morph, { maxLength: 40 }).chain((all) =>
  fc.tuple(
    fc.constant(all),
    fc.array(number, { minLength: all.length, maxLength: all.length }).map((w) => Float64Array.from(w)),
  ),
);

const pack = (all: readonly Morph[]) => runToEnd(packMorphs(all, base.positions, compiled.normals));

describe('the morphs of a skin', () => {
  it('the morphs of a skin move its vertices as the core does, in doubles', () => {
    fc.assert(
      fc.property(morphs, ([all, weights]) => {
        const positions = base.positions.slice();
        blendMorphs(compiled, all, weights, 0, positions, positions.slice());
        const packed = pack(all);
        for (let v = 0; v < VERTICES; v++) {
          const at = new Vector3().fromArray(base.positions, 3 * v);
          if (packed) addMorphs(packed, base.positions, v, weights, at);
          expectClose(at.toArray(), positions.slice(3 * v, 3 * v + 3), WITHIN.rounding * 1000);
        }
      }),
    );
  });

  it('the morphs of a skin are summed on the GPU from a range of texels a vertex', () => {
    fc.assert(
      fc.property(morphs, ([all, weights]) => {
        const positions = base.positions.slice();
        const normals = positions.slice();
        blendMorphs(compiled, all, weights, 0, positions, normals);
        const packed = pack(all);
        const texels = packed?.texture.image.data;
        const moved = all.flatMap((m) => Array.from(m.normals.indices)).filter((v) => v < VERTICES);
        expect(packed?.moveNormals ?? false).toBe(moved.length > 0);
        // As the shader does.
        for (let v = 0; v < VERTICES; v++) {
          const position = [...base.positions.subarray(3 * v, 3 * v + 3)];
          const normal = [...compiled.normals.subarray(3 * v, 3 * v + 3)];
          const [first, end] = packed?.ranges.array.slice(2 * v, 2 * v + 2) ?? [0, 0];
          for (let d = first; d < end && texels; d++) {
            const weight = weights[texels[8 * d]];
            for (let i = 0; i < 3; i++) {
              position[i] += weight * texels[8 * d + 1 + i];
              normal[i] += weight * texels[8 * d + 4 + i];
            }
          }
          expectClose(
            [...position, ...normal],
            [...positions.slice(3 * v, 3 * v + 3), ...normals.slice(3 * v, 3 * v + 3)],
            1e-3,
          );
        }
      }),
    );
  });

  it('the morphs of a skin take a texel pair for what moves a vertex, and nothing where nothing does', () => {
    const none = { indices: new Uint32Array(0), values: new Float64Array(0) };
    expect(pack([])).toBeUndefined();
    expect(pack([{ name: 'still', positions: none, normals: none }])).toBeUndefined();
    const one = { indices: Uint32Array.of(4), values: Float64Array.of(1, 2, 3) };
    const packed = pack([
      { name: 'still', positions: none, normals: none },
      { name: 'one', positions: one, normals: one },
    ]);
    expect([...(packed?.ranges.array ?? [])]).toEqual([0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1]);
    expect(packed?.texture.image.data?.[0]).toBe(1);
  });
});
