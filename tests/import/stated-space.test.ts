/** Units that files of other programs state, and what becomes of them. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { metresPerUnit, statedSpace } from '../../src/evaluate/space/metres.ts';
import { importFile } from '../../src/files/imports.ts';
import { toCharacter } from '../../src/import/to-character.ts';
import type { Space } from '../../src/model/space.ts';
import { bone, read } from './fbx/small-files.ts';
import { fbxBytes, prop } from './fbx/write-fbx.ts';
import { GltfMaker, glbOf } from './make-gltf.ts';

/** A bone 95 units above the origin, in a file with these settings. */
function boneIn(...settings: ReturnType<typeof prop>[]) {
  const objects = [bone(10, 'hips', prop('Lcl Translation', 0, 95, 0))];
  const { value, diagnostics } = read(fbxBytes({ settings, objects, connections: [[10, 0]] }));
  const character = value && toCharacter(value);
  return { skeleton: character?.skeleton, space: character?.space?.space, diagnostics };
}

describe('the unit of an FBX file', () => {
  it.each([
    [1, 'centimetres', '1 cm'],
    [100, 'metres', '1 m'],
    [10, 'decimetres', '10 cm'],
    [0.1, 'millimetres', '0.1 cm'],
    [2.54, 'inches', '2.54 cm'],
    [30.48, 'own', '30.48 cm'],
  ] as const)('of %d cm is %s', (centimetres, unit, text) => {
    const { skeleton, space, diagnostics } = boneIn(prop('UnitScaleFactor', centimetres));
    expect(space).toMatchObject({ up: 'y', unit, lift: 0, known: 'stated' });
    expect(space && metresPerUnit(space)).toBeCloseTo(centimetres / 100, 9);
    expect(skeleton?.joints[0].offset).toEqual([0, 95, 0]);
    expect(diagnostics.map(({ message }) => message).join()).toContain(`The length unit is ${text}, as in the file`);
  });

  it('is the format’s centimetre where the file states none, whatever it was made in', () => {
    expect(boneIn().space?.unit).toBe('centimetres');
    expect(boneIn(prop('OriginalUnitScaleFactor', 100)).space?.unit).toBe('centimetres');
  });

  it.each([0, -1, 1e300, 1e-300])('is a centimetre, with a warning, where %d is stated', (centimetres) => {
    const { space, diagnostics } = boneIn(prop('UnitScaleFactor', centimetres));
    expect(space?.unit).toBe('centimetres');
    expect(diagnostics.map(({ code }) => code)).toContain('bad-unit');
  });
});

it.each(['x.glb', 'x.vrm', 'x.vrma'])('%s is in metres, by the specification', async (fileName) => {
  const maker = new GltfMaker();
  const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 100, 0, 0, 0, 170, 0));
  const meshes = [{ primitives: [{ attributes: { POSITION } }] }];
  const bytes = glbOf(maker.made({ scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes }));
  const { value } = await importFile('gltf', { fileName, bytes, beside: async () => undefined });
  const expected: Space = { up: 'y', unit: 'metres', lift: 0, known: 'stated' };
  expect(value?.characters[0].space?.space).toEqual(expected);
});

it('a stated unit is as long as stated, whatever it is called', () => {
  fc.assert(
    fc.property(fc.double({ min: 1e-9, max: 1e8, noNaN: true }), (metres) => {
      const { space } = statedSpace(metres);
      expect(Math.abs(metresPerUnit(space) / metres - 1)).toBeLessThan(1e-6);
    }),
  );
});
