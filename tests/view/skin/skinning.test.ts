import fc from 'fast-check';
import { Matrix4, MeshBasicMaterial, MeshStandardMaterial, ShaderChunk, ShaderLib, Vector3, Vector4 } from 'three';
import { describe, expect, it } from 'vitest';
import { compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { DEFAULT_DISPLAY } from '../../../src/model/session.ts';
import { oneSurface, type Skin } from '../../../src/model/skin.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import { PLAIN_SKIN, withExactSkinning } from '../../../src/view/skin/skinning.ts';
import { character, joint, skin } from '../../helpers/builders.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';

/** One vertex per list of (joint, weight) pairs, all at the same position. */
function attached(lists: readonly (readonly (readonly [number, number])[])[], bindings: readonly Matrix4[]): Skin {
  const start = Uint32Array.of(0, ...lists.map((_, v) => lists.slice(0, v + 1).flat().length));
  return skin('hero', 0, {
    positions: Float64Array.from(lists.flatMap(() => [0.5, -1, 2])),
    normals: Float64Array.from(lists.flatMap(() => [0, 0.6, 0.8])),
    attachments: {
      start,
      joints: Uint32Array.from(lists.flat(), ([j]) => j),
      weights: Float64Array.from(lists.flat(), ([, w]) => w),
    },
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings: Float64Array.from(bindings.flatMap((m) => m.elements)),
  });
}

const chain = (joints: number) => ({ name: 'chain', joints: Array.from({ length: joints }, (_, j) => joint(j - 1)) });
const number = (size: number) => fc.double({ min: -size, max: size, noNaN: true });

describe('skinning on the CPU, as three.js asks for it', () => {
  it('skinning on the CPU, as three.js asks for it is what the core computes, for any number of attachments, any weights, bindings with scale and shear', () => {
    const joints = 5;
    const binding = fc
      .array(number(1), { minLength: 9, maxLength: 9 })
      .map((m) =>
        new Matrix4().set(2 + m[0], m[1], m[2], 3, m[3], 2 + m[4], m[5], -1, m[6], m[7], 2 + m[8], 0, 0, 0, 0, 1),
      )
      .filter((m) => Math.abs(m.determinant()) > 0.1);
    const attachments = fc.array(fc.tuple(fc.nat(joints - 1), number(2)), { maxLength: 10 });
    fc.assert(
      fc.property(
        fc.array(attachments, { minLength: 1, maxLength: 6 }),
        fc.array(binding, { minLength: joints, maxLength: joints }),
        fc.array(number(4), { minLength: 3 + 3 * joints, maxLength: 3 + 3 * joints }),
        fc.boolean(),
        (lists, bindings, angles, isFarAway) => {
          const pose = isFarAway ? angles.map((x, d) => (d < 3 ? 1e5 * x : x)) : angles;
          const model = attached(lists, bindings);
          const view = new CharacterView(new DrawnSkins());
          view.show(character({ skeleton: chain(joints), skins: [model], pose }), DEFAULT_DISPLAY, undefined);
          const compiled = compileSkin(model);
          const positions = model.positions.slice();
          deform(compiled, view.worldMatrices, model.positions, compiled.normals, positions, positions.slice());
          expectClose(view.vertices(), positions, WITHIN.rounding * (isFarAway ? 1e4 : 100));
        },
      ),
      { numRuns: 100 },
    );
  });

  it('leaves a vertex without attachments where it is, and scales one whose weights do not sum to 1', () => {
    const identity = new Matrix4();
    const view = new CharacterView(new DrawnSkins());
    const model = attached([[], [[0, 0.5]], [[0, 0]]], [identity]);
    const pose = [1000, 0, 0, 0, 0, 0];
    view.show(character({ skeleton: chain(1), skins: [model], pose }), DEFAULT_DISPLAY, undefined);
    expect([...view.vertices()]).toEqual([0.5, -1, 2, 500.25, 0, 1, 0, 0, 0]);
  });

  it('skinning on the CPU, as three.js asks for it turns directions too, and keeps what kind of vector it was given', () => {
    const view = new CharacterView(new DrawnSkins());
    const model = attached([[[0, 1]]], [new Matrix4()]);
    const pose = [7, 0, 0, 0, 0, Math.PI / 2];
    view.show(character({ skeleton: chain(1), skins: [model], pose }), DEFAULT_DISPLAY, undefined);
    const [mesh] = view.skinnedMeshes;
    const direction = mesh.applyBoneTransform(0, new Vector4(1, 0, 0, 0));
    expectClose(direction.toArray(), [0, 1, 0, 0], WITHIN.rounding);
    const point = mesh.applyBoneTransform(0, new Vector4(1, 0, 0, 1));
    expectClose(point.toArray(), [7, 2, 0, 1], WITHIN.rounding);
    expectClose(mesh.applyBoneTransform(0, new Vector3(1, 0, 0)).toArray(), [7, 2, 0], WITHIN.rounding);
  });

  it('gives the GPU the same matrices, and the identity after them', () => {
    const view = new CharacterView(new DrawnSkins());
    const model = attached([[[1, 1]]], [new Matrix4(), new Matrix4().makeScale(2, 2, 2)]);
    view.show(character({ skeleton: chain(2), skins: [model] }), DEFAULT_DISPLAY, undefined);
    const [mesh] = view.skinnedMeshes;
    const { boneTexture, firstMatrix } = mesh.skeleton;
    const before = boneTexture.version;
    view.seek(1);
    expect(boneTexture.version).toBeGreaterThan(before);
    mesh.skeleton.update();
    const rows = (m: number) => [...(boneTexture.image.data ?? [])].slice(4 * firstMatrix + 12 * m).slice(0, 12);
    expect(rows(1)).toEqual([0.5, 0, 0, 0, 0, 0.5, 0, 2, 0, 0, 0.5, 0]);
    expect(rows(2)).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
    // For exporters: three.js's own inverse bindings.
    expect(mesh.skeleton.boneInverses[1].elements[0]).toBe(0.5);
  });
});

describe('a material with exact skinning', () => {
  const compiled = (material: MeshStandardMaterial, shaders: { vertexShader: string; fragmentShader: string }) => {
    const shader = { ...shaders, uniforms: {} };
    // Only these three are used; the renderer has many more parameters.
    material.onBeforeCompile(shader as Parameters<typeof material.onBeforeCompile>[0], {} as never);
    return shader;
  };

  it('leaves none of the chunks that it replaces, and names itself for the program cache', () => {
    const material = withExactSkinning(new MeshStandardMaterial(), PLAIN_SKIN, { placing: 'many' });
    const { vertexShader, fragmentShader } = compiled(material, ShaderLib.standard);
    expect(vertexShader).not.toMatch(/#include <(skinning_pars_vertex|skinnormal_vertex|skinning_vertex)>/);
    expect(vertexShader).not.toContain('attachmentTexture');
    expect(fragmentShader).not.toContain('\tnormal *= faceDirection;');
    expect(material.customProgramCacheKey()).not.toBe(new MeshStandardMaterial().customProgramCacheKey());
  });

  it('knows every chunk that skins in three.js', () => {
    const skinning = Object.keys(ShaderChunk).filter((name) => /^skin/.test(name));
    expect(skinning.sort()).toEqual([
      'skinbase_vertex',
      'skinning_pars_vertex',
      'skinning_vertex',
      'skinnormal_vertex',
    ]);
  });

  it('a material with exact skinning keeps what the material does to its shader itself', () => {
    const material = new MeshStandardMaterial();
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader += '// mine';
    };
    const shader = compiled(withExactSkinning(material, PLAIN_SKIN, { placing: 'many' }), ShaderLib.standard);
    expect(shader.fragmentShader).toContain('// mine');
    const other = withExactSkinning(new MeshBasicMaterial(), PLAIN_SKIN, { placing: 'many' });
    expect(material.customProgramCacheKey()).not.toBe(other.customProgramCacheKey());
  });
});
