import draco from 'draco3dgltf';
import { expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import { GltfMaker, glbOf, type Made } from './make-gltf.ts';

/** Two triangles of four vertices, packed. */
async function packed(isSequential: boolean) {
  const module = await draco.createEncoderModule({});
  const encoder = new module.Encoder();
  const builder = new module.MeshBuilder();
  const mesh = new module.Mesh();
  const positions = Float32Array.of(0, 0, 0, 4, 0, 0, 0, 2, 0, 4, 2, 1);
  builder.AddFacesToMesh(mesh, 2, Uint32Array.of(0, 1, 2, 2, 1, 3));
  const id = builder.AddFloatAttributeToMesh(mesh, module.POSITION, 4, 3, positions);
  if (isSequential) encoder.SetEncodingMethod(module.MESH_SEQUENTIAL_ENCODING);
  encoder.SetAttributeQuantization(module.POSITION, 14);
  const out = new module.DracoInt8Array();
  const length = encoder.EncodeMeshToDracoBuffer(mesh, out);
  const maker = new GltfMaker();
  const bufferView = maker.view(Int8Array.from({ length }, (_, i) => out.GetValue(i)));
  maker.accessors.push({ componentType: 5126, type: 'VEC3', count: 4 });
  maker.accessors.push({ componentType: 5123, type: 'SCALAR', count: 6 });
  const extensions = { KHR_draco_mesh_compression: { bufferView, attributes: { POSITION: id } } };
  const primitive = { attributes: { POSITION: 0 }, indices: 1, extensions };
  return maker.made({ nodes: [{ mesh: 0 }], meshes: [{ primitives: [primitive] }] });
}

function read(made: Made) {
  return importFile('gltf', { fileName: 'x.glb', bytes: glbOf(made), beside: async () => undefined });
}

it('reads primitives that Draco has packed, within its quantisation', async () => {
  const made = await packed(false);
  const { value, diagnostics } = await read(made);
  expect(diagnostics).toEqual([]);
  const [skin] = value?.characters[0].skins ?? [];
  // Draco may list vertices in another order; the corners are the same.
  const corners = [...skin.triangles].map((v) =>
    [...skin.positions.subarray(3 * v, 3 * v + 3)].map((x) => Math.round(1e3 * x)),
  );
  expect(corners.length).toBe(6);
  expect(new Set(corners.map(String))).toEqual(new Set(['0,0,0', '4000,0,0', '0,2000,0', '4000,2000,1000']));

  made.buffers[0].fill(77, 8, 30);
  const damaged = await read(made);
  expect(damaged.value).toBeUndefined();
  expect(damaged.diagnostics).toMatchObject([{ severity: 'error', code: 'compressed-damaged' }]);
});

it('a corner beyond the vertices that Draco has packed is an error', async () => {
  const made = await packed(true);
  const bytes = made.buffers[0];
  // Uncompressed corners, a byte each.
  const at = bytes.findIndex((_, i) => [0, 1, 2, 2, 1, 3].every((corner, k) => bytes[i + k] === corner));
  expect(at).toBeGreaterThan(0);
  bytes[at + 5] = 200;
  const { value, diagnostics } = await read(made);
  expect(value).toBeUndefined();
  expect(diagnostics.map(({ code }) => code)).toContain('index-out-of-range');
});
