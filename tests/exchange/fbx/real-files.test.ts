/** The public FBX files, held to the numbers of ufbx at ten times of each take. */
import { expect, it } from 'vitest';
import { fbxReader } from '../../../src/exchange/fbx/read.ts';
import type { Scene } from '../../../src/exchange/scene.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import { conformance, describeShared, sharedBytes } from '../../helpers/shared.ts';
import { verticesAt, worldsAt } from '../scene-at.ts';

interface Expected {
  readonly nodes: readonly (readonly [string, number])[];
  readonly takes: readonly {
    readonly name: string;
    readonly at: readonly {
      readonly t: number;
      readonly nodes: readonly number[];
      readonly vertices?: readonly number[];
    }[];
  }[];
}

const FILES = [
  'maya_game_sausage_7500_binary_combined',
  'maya_pivot_offset_7700_ascii',
  'maya_anim_layers_7500_ascii',
  'blender_279_sausage_7400_binary',
  'maya_blend_shape_cube_7700_binary',
  '91_48',
];

function sceneOf(name: string): Scene {
  const { value, diagnostics } = readWhole(fbxReader(`${name}.fbx`), sharedBytes(`data/fbx/${name}.fbx`));
  expect(diagnostics.filter(({ severity }) => severity !== 'info')).toEqual([]);
  if (!value) throw new Error('not read');
  return value;
}

function sizeOf(numbers: readonly number[]): number {
  const spans = [0, 1, 2].map((k) => {
    const own = numbers.filter((_, i) => i % 3 === k);
    return own.reduce((a, b) => Math.max(a, b)) - own.reduce((a, b) => Math.min(a, b));
  });
  return Math.hypot(...spans);
}

/** Of all that the file says about a take. */
function takeSize({ at }: Expected['takes'][number]): number {
  return Math.max(...at.map(({ nodes, vertices = [] }) => sizeOf([...nodes, ...vertices])));
}

function distance(a: ArrayLike<number>, i: number, b: ArrayLike<number>, j: number): number {
  return Math.hypot(a[3 * i] - b[3 * j], a[3 * i + 1] - b[3 * j + 1], a[3 * i + 2] - b[3 * j + 2]);
}

describeShared('the public FBX files', () => {
  for (const name of FILES) {
    it(`${name}: nodes are where ufbx has them at all times`, () => {
      const scene = sceneOf(name);
      const expected = conformance<Expected>(`fbx/${name}.json`);
      for (const stated of expected.takes) {
        const take = scene.takes.find((own) => own.name === stated.name);
        expect(take).toBeDefined();
        const size = takeSize(stated);
        for (const { t, nodes } of stated.at) {
          const worlds = worldsAt(scene, take, t);
          for (const [i, [node]] of expected.nodes.entries()) {
            const own = worlds[scene.nodes.findIndex((one) => one.name === node)];
            expect(distance(own.slice(12), 0, nodes, i) / size).toBeLessThan(1e-4);
          }
        }
      }
    });

    it(`${name}: vertices are where ufbx has them, and each stays itself`, () => {
      const scene = sceneOf(name);
      const expected = conformance<Expected>(`fbx/${name}.json`);
      for (const stated of expected.takes) {
        const { at } = stated;
        const take = scene.takes.find((own) => own.name === stated.name);
        const size = takeSize(stated);
        const all = at.map(({ t }) => verticesAt(scene, take, t).flatMap((own) => [...own]));
        const count = (at[0].vertices?.length ?? 0) / 3;
        const offs = Array.from({ length: count }, (_, j) => {
          let nearest = Number.POSITIVE_INFINITY;
          for (let i = 0; i < all[0].length / 3; i++) {
            const off = at.reduce((most, { vertices = [] }, f) => Math.max(most, distance(all[f], i, vertices, j)), 0);
            nearest = Math.min(nearest, off);
          }
          return nearest / size;
        });
        expect(Math.max(0, ...offs)).toBeLessThan(1e-4);
      }
    });
  }
});
