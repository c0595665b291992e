import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { blendMorphs, compileSkin, deform } from '../../../../src/evaluate/skin/deform.ts';
import { vertexDeformer } from '../../../../src/evaluate/skin/one-vertex.ts';
import { setIdentity } from '../../../../src/math/mat4.ts';
import type { Morph } from '../../../../src/model/morph.ts';
import { movedVertices } from '../../../../src/model/moved-vertices.ts';
import { oneSurface, type Skin } from '../../../../src/model/skin.ts';
import { placeText } from '../../../../src/ui/editors/inspector/joint-facts.ts';
import { materialsAt, materialText } from '../../../../src/ui/editors/inspector/vertex-facts.ts';
import { character, skeleton } from '../../builders.ts';

const bindings = new Float64Array(32);
setIdentity(bindings, 0);
setIdentity(bindings, 16);

/** Four vertices: on the root, on both joints, on nothing, twice on one joint. */
const patch: Skin = {
  name: 'patch',
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5),
  normals: Float64Array.of(0, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0),
  triangles: Uint32Array.of(0, 1, 2),
  surfaces: oneSurface(Uint32Array.of(0, 1, 2)),
  bindings,
  attachments: {
    start: Uint32Array.of(0, 1, 3, 3, 6),
    joints: Uint32Array.of(0, 0, 1, 1, 1, 0),
    weights: Float64Array.of(1, 0.4, 0.6, 0.5, 0.5, 0),
  },
};

const morphs: readonly Morph[] = [
  {
    name: 'up',
    positions: { indices: Uint32Array.of(1, 3, 3), values: Float64Array.of(1, 2, 0, 1, 3, 0, 1, 4, 0) },
    normals: { indices: Uint32Array.of(1), values: Float64Array.of(0, 1, 0) },
  },
];

describe('movedVertices', () => {
  it('counts a vertex once, and none of weight 0', () => {
    expect([0, 1, 2].map((joint) => movedVertices(patch, joint))).toEqual([2, 2, 0]);
  });

  it('attributes all vertices to the root without weights', () => {
    const { attachments: _none, ...bare } = patch;
    expect(movedVertices(bare, 0)).toBe(4);
    expect(movedVertices(bare, 1)).toBe(0);
  });
});

describe('vertexDeformer', () => {
  it('equals deforming the whole skin, to the last bit', () => {
    const legs = skeleton(['hips', -1], ['leg', 0]);
    const dofs = Float64Array.of(0.1, 0.2, 0.3, 0.4, -0.5, 0.6, 1, 0.2, -0.7, 0.35);
    const world = new Float64Array(32);
    worldMatrices(compileSkeleton(legs), dofs, world);
    const compiled = compileSkin(patch);
    const blended = [new Float64Array(12), new Float64Array(12)];
    const all = [new Float64Array(12), new Float64Array(12)];
    blendMorphs(compiled, morphs, dofs, 9, blended[0], blended[1]);
    deform(compiled, world, blended[0], blended[1], all[0], all[1]);
    for (let v = 0; v < 4; v++) {
      const { position, normal } = vertexDeformer(patch, morphs, v)(dofs, world);
      expect(position).toEqual(all[0].slice(3 * v, 3 * v + 3));
      expect(normal).toEqual(all[1].slice(3 * v, 3 * v + 3));
    }
  });

  it('vertexDeformer keeps a skin without a skeleton in place, and has no normal if the file has none', () => {
    const { normals: _none, ...bare } = patch;
    const { position, normal } = vertexDeformer(bare, [], 1)(new Float64Array(3), undefined);
    expect([...position]).toEqual([1, 0, 0]);
    expect(normal).toBeUndefined();
  });
});

describe('the materials of a vertex', () => {
  it('the materials of a vertex are those of the triangles around it, each once, with texture and colour', () => {
    const cloth = { name: 'cloth', texture: 'cloth.png', color: [1, 0.5, 0] } as const;
    const glass = { name: 'glass', color: [0, 0, 0.25] } as const;
    const triangles = Uint32Array.of(0, 1, 2, 1, 2, 3, 0, 1, 2);
    const surfaces = [cloth, glass, cloth].map((material, i) => ({ material, triangleStart: i, triangleCount: 1 }));
    const at = (vertex: number) => materialsAt({ ...patch, triangles, surfaces }, vertex).map(materialText);
    expect(at(0)).toEqual(['cloth: cloth.png × 1 0.5 0']);
    expect(at(1)).toEqual(['cloth: cloth.png × 1 0.5 0', 'glass: 0 0 0.25']);
    expect(at(3)).toEqual(['glass: 0 0 0.25']);
    expect(materialsAt(patch, 0)).toEqual([]);
    expect([{ name: '' }, { name: 'fur' }, { name: '', texture: 'a.png' }].map(materialText)).toEqual([
      'without a name',
      'fur',
      'a.png',
    ]);
  });
});

it('world matrices say that they are without the place of the character in the scene, where it has one', () => {
  const { placements } = character();
  expect(placeText(character())).toBe('');
  const moved = [...placements, { ...placements[0], position: [1, 0, 0] as const }];
  expect(placeText(character({ placements: moved }))).toBe('without its place in the scene');
});
