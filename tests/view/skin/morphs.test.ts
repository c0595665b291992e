import { type BufferAttribute, Mesh, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { morphing } from '../../../src/view/skin/morphs.ts';
import { packSkin } from '../../../src/view/skin/skin-geometry.ts';
import { skin } from '../../helpers/builders.ts';

const rows = (indices: number[], values: number[]) => ({
  indices: Uint32Array.from(indices),
  values: Float64Array.from(values),
});
const none = rows([], []);

/** `filler` more morphs than the two being tested. */
function morphed(filler: number) {
  const base = skin();
  const normals = Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1);
  const { geometry } = runToEnd(packSkin(base, normals, 1, true));
  const morphs: Morph[] = [
    { name: 'up', positions: rows([0, 1], [0, 2, 0, 1, 2, 0]), normals: rows([1], [0, 1, 0]) },
    { name: 'out', positions: rows([1], [1, 0, 10]), normals: none },
    ...Array.from({ length: filler }, (_, i) => ({ name: `${i}`, positions: none, normals: none })),
  ];
  const made = runToEnd(morphing(geometry, base.positions, normals, morphs));
  const mesh = new Mesh(geometry);
  if (made.influences.length > 0) mesh.morphTargetInfluences = made.influences;
  return {
    geometry,
    made,
    apply: (...weights: number[]) => made.apply(Float64Array.of(9, ...weights, ...new Array(filler).fill(0)), 1),
    vertex: (v: number) => mesh.getVertexPosition(v, new Vector3()).toArray(),
  };
}

describe.each([
  ['few morphs, on the GPU', 0],
  ['3,000 morphs, on the CPU', 3000],
])('%s', (_, filler) => {
  it('blends positions by any weights', () => {
    const { apply, vertex } = morphed(filler);
    apply(0, 0);
    expect(vertex(1)).toEqual([1, 0, 0]);
    apply(0.5, 0);
    expect(vertex(0)).toEqual([0, 1, 0]);
    apply(-1, 0.5);
    expect(vertex(0)).toEqual([0, -2, 0]);
    expect(vertex(1)).toEqual([1, -2, 5]);
    expect(vertex(2)).toEqual([0, 1, 0]);
    apply(0, 2);
    expect(vertex(0)).toEqual([0, 0, 0]);
    expect(vertex(1)).toEqual([1, 0, 20]);
    apply(0, 0);
    expect(vertex(1)).toEqual([1, 0, 0]);
  });
});

describe('morphs', () => {
  it('morphs are three.js’s own targets while there are few', () => {
    const { geometry, made } = morphed(0);
    expect(geometry.morphTargetsRelative).toBe(true);
    expect(geometry.morphAttributes.position).toHaveLength(2);
    expect([...(geometry.morphAttributes.normal?.[0].array ?? [])]).toEqual([0, 0, 0, 0, 1, -1, 0, 0, 0]);
    expect(made.influences).toHaveLength(2);
  });

  it('leave the GPU alone when there are more than its texture takes, but for what changed', () => {
    const { geometry, made, apply } = morphed(3000);
    // Packed as such: it isn't interleaved.
    const position = geometry.getAttribute('position') as BufferAttribute;
    expect(geometry.morphAttributes.position).toBeUndefined();
    expect(made.influences).toEqual([]);
    apply(0, 0);
    expect(position.version).toBe(0);
    apply(0, 1);
    expect(position).toMatchObject({ version: 1, updateRanges: [{ start: 0, count: 6 }] });
    expect([...geometry.getAttribute('normal').array.subarray(3, 6)]).toEqual([0, 0, 1]);
    apply(0, 1);
    expect(position.version).toBe(1);
    apply(1, 1);
    expect(position).toMatchObject({ version: 2, updateRanges: [{ start: 0, count: 6 }] });
    expect([...geometry.getAttribute('normal').array.subarray(3, 6)]).toEqual([0, 1, 0]);
  });
});
