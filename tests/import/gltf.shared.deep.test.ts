import { expect, it } from 'vitest';
import { readContainer } from '../../src/import/gltf/container.ts';
import { readGltf } from '../../src/import/gltf/read.ts';
import { toCharacter } from '../../src/import/to-character.ts';
import { type GltfJson, gltfReference } from '../helpers/gltf-reference.ts';
import { farthest, posedNodes } from '../helpers/posed.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

const FILES = [
  'cs-rotate/01_cs_rotate.gltf',
  'cs-morph/01_cs_morph.gltf',
  'skinned-cylinder/03_skinned_cylinder.gltf',
  'parent-inverse/06_parent-inverse-anim.gltf',
  'sparse-two-primitives/23_multi_prim_vertex_attribute.gltf',
  'bird-animations.glb',
  'greenman.glb',
  'Fox.glb',
  'made-odd.glb',
  'made-shared-joints.glb',
];

/** Of a take, each time. */
const MOMENTS = 25;

async function readShared(file: string) {
  const path = `data/gltf/${file}`;
  const folder = path.slice(0, path.lastIndexOf('/') + 1);
  const bytes = new Uint8Array(sharedBytes(path));
  const beside = async (name: string) => ({
    bytes: new Uint8Array(sharedBytes(folder + name)),
    source: { name, path: folder + name, bytes: 0 },
  });
  const { scene, diagnostics } = await readGltf({ fileName: path.slice(folder.length), bytes, beside });
  const whole = scene && toCharacter(scene);
  const { document, binary = bytes } = readContainer(bytes);
  // A valid file has this shape.
  const json = document.root as unknown as GltfJson;
  const buffers = (json.buffers ?? []).map(({ uri }) => (uri === undefined ? binary : sharedBytes(folder + uri)));
  if (!whole) throw new Error(JSON.stringify(diagnostics));
  return { whole, reference: await gltfReference(json, buffers) };
}

describeShared('glTF files of many programs', () => {
  it.each(FILES)('%s is where three.js has it, at rest and at any time of its takes', async (file) => {
    const { whole, reference } = await readShared(file);
    expect(whole.takes.map(({ range }) => range)).toEqual(reference.takes.map(({ range }) => range));
    expect(farthest(posedNodes(whole), reference.pose())).toBeLessThan(1 / 2000);
    whole.takes.forEach(({ range: [start, end] }, take) => {
      for (let n = 0; n < MOMENTS; n++) {
        // Not at the very end, where three.js begins again; between keys.
        const time = start + ((end - start) * (n * 0.9999)) / (MOMENTS - 1);
        expect(farthest(posedNodes(whole, take, time), reference.pose(take, time))).toBeLessThan(1 / 2000);
      }
    });
  });
});
