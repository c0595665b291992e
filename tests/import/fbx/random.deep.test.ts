/** Random FBX files: whatever lies between curves and nodes, the scene's channels move nodes to where they are. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { Report } from '../../../src/formats/report.ts';
import { takesOf } from '../../../src/import/fbx/animation.ts';
import { axesOf } from '../../../src/import/fbx/axes.ts';
import { documentOf } from '../../../src/import/fbx/document.ts';
import { SceneMotion } from '../../../src/import/fbx/motion.ts';
import { nodesOf } from '../../../src/import/fbx/nodes.ts';
import { readFbxFile } from '../../../src/import/fbx/records/read-file.ts';
import { expectEqual } from '../../helpers/equal.ts';
import { posed } from '../../helpers/posed.ts';
import { multiply, worldsAt } from '../scene-at.ts';
import { randomFbx } from './random-fbx.ts';
import { characterOf } from './read-character.ts';
import { read } from './small-files.ts';
import { fbxBytes, fbxText } from './write-fbx.ts';

/** None of a key: there a value that jumps may be either. Some are right after one. */
const TIMES = [-0.41, 0.013, 0.37, 0.50003, 0.513, 1.00004, 1.213, 1.513, 1.93, 2.2, 2.45];

it('random FBX files move as pivots, orders, inherited scales and layers say', () => {
  fc.assert(
    fc.property(randomFbx, (fbx) => {
      const bytes = fbxBytes(fbx);
      const { value: scene } = read(bytes);
      const { file, report } = readFbxFile(bytes, new Report('a.fbx'));
      const document = documentOf(file);
      const nodes = nodesOf(document);
      const axes = axesOf(document.settings)?.matrix;
      if (!scene || !axes) throw new Error('not read');
      const motion = new SceneMotion(nodes, takesOf(document, report)[0]);
      for (const time of TIMES) {
        motion.at(time);
        const worlds = worldsAt(scene, scene.takes[0], time);
        for (const [i, { object }] of nodes.entries()) {
          const expected = multiply([...axes], [...motion.worlds.subarray(16 * i, 16 * i + 16)]);
          const own = worlds[scene.nodes.findIndex(({ name }) => name === object.name)];
          const size = Math.max(1, ...expected.map(Math.abs));
          const off = Math.max(...own.map((value, k) => Math.abs(value - expected[k]) / size));
          expect(off, `${object.name} at ${time} s`).toBeLessThan(2e-4);
        }
      }
    }),
    { numRuns: 20 },
  );
});

it('characters of random FBX files have their joints where the nodes are', () => {
  fc.assert(
    fc.property(randomFbx, (fbx) => {
      const bytes = fbxBytes(fbx);
      const { value: scene } = read(bytes);
      if (!scene) throw new Error('not read');
      const character = characterOf(bytes);
      for (const time of TIMES) {
        const expected = worldsAt(scene, scene.takes[0], time);
        const { worlds } = posed(character, 0, time);
        for (const [i, { name }] of scene.nodes.entries()) {
          const joint = character.skeleton.joints.findIndex((own) => own.name === name);
          expect(joint).toBeGreaterThanOrEqual(0);
          const size = Math.max(1, ...expected[i].map(Math.abs));
          const own = worlds.subarray(16 * joint, 16 * joint + 16);
          const off = Math.max(...own.map((value, k) => Math.abs(value - expected[i][k]) / size));
          expect(off, `${name} at ${time} s`).toBeLessThan(1e-5);
        }
      }
    }),
    { numRuns: 20 },
  );
});

it('random FBX files are the same as texts and as bytes in either order', () => {
  fc.assert(
    fc.property(randomFbx, fc.constantFrom(7400, 7500), (fbx, version) => {
      const own = { ...fbx, version };
      const [a, b, c] = [fbxText(own), fbxBytes(own), fbxBytes(own, false)].map(read);
      expect(a.value).toBeDefined();
      expectEqual(b.value, a.value);
      expectEqual(c.value, a.value);
    }),
    { numRuns: 20 },
  );
});
