import fc from 'fast-check';
import { expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import { type GltfJson, gltfReference } from '../helpers/gltf-reference.ts';
import { farthest, posedNodes } from '../helpers/posed.ts';
import { glbOf } from './make-gltf.ts';
import { randomGltf } from './random-gltf.ts';

it('random glTF files are where three.js has them, at rest and between the keys of their takes', async () => {
  await fc.assert(
    fc.asyncProperty(randomGltf, async (made) => {
      const beside = async () => undefined;
      const { value, diagnostics } = await importFile('gltf', { fileName: 'a.glb', bytes: glbOf(made), beside });
      const whole = value?.characters[0];
      if (!whole) {
        expect(diagnostics.map(({ code }) => code)).toContain('file-empty');
        return;
      }
      // A valid file has this shape.
      const reference = await gltfReference(made.json as unknown as GltfJson, made.buffers);
      expect(whole.takes.map(({ range }) => range)).toEqual(reference.takes.map(({ range }) => range));
      expect(farthest(posedNodes(whole), reference.pose())).toBeLessThan(1 / 2000);
      whole.takes.forEach(({ range: [start, end] }, take) => {
        for (let n = 0; n < 6; n++) {
          const time = start + (end - start) * (0.0137 + 0.1931 * n);
          expect(farthest(posedNodes(whole, take, time), reference.pose(take, time))).toBeLessThan(1 / 2000);
        }
      });
    }),
    { numRuns: 20 },
  );
});
