/** The public FBX files, held to the numbers of ufbx at ten times of each take. */
import { expect, it } from 'vitest';
import { readFbx } from '../../../src/import/fbx/read.ts';
import type { Scene } from '../../../src/import/scene.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { verticesAt, worldsAt } from '../scene-at.ts';
import { distance, expectedOf, FBX_FILES, takeSize } from './expected.ts';

function sceneOf(name: string): Scene {
  const { value, diagnostics } = readFbx(`${name}.fbx`, sharedBytes(`data/fbx/${name}.fbx`));
  expect(diagnostics.filter(({ severity }) => severity !== 'info')).toEqual([]);
  if (!value) throw new Error('not read');
  return value;
}

describeShared('the public FBX files', () => {
  for (const name of FBX_FILES) {
    it(`${name}: nodes are where ufbx has them at all times`, () => {
      const scene = sceneOf(name);
      const expected = expectedOf(name);
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
      const expected = expectedOf(name);
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
