/**
 * KHR_draco_mesh_compression: primitives packed by Draco. Its decoder, 190 kB of WebAssembly, is fetched only for files
 * that have some.
 */
import type { Budget } from '../budget.ts';
import { ImportError } from '../imported.ts';
import type { Numbers } from './accessors.ts';
import type { Buffers } from './buffers.ts';
import { fromBase64 } from './data-uri.ts';
import { type Document, extensionOf, type Json, listOf, objectOf } from './json.ts';
import type { Unpacked } from './meshes.ts';

/** The name of the extension. */
export const DRACO = 'KHR_draco_mesh_compression';

type Module = Awaited<ReturnType<typeof loadModule>>;

/** Primitives that are packed, unpacked. @throws ImportError if one is damaged */
export async function unpackDraco(document: Document, buffers: Buffers): Promise<ReadonlyMap<Json, Unpacked>> {
  const out = new Map<Json, Unpacked>();
  let module: Module | undefined;
  for (const [m, mesh] of document.all('meshes').entries()) {
    for (const [p, item] of listOf(mesh.primitives).entries()) {
      const primitive = objectOf(item);
      const packed = extensionOf(primitive, DRACO);
      if (!primitive || !packed) continue;
      const where = `Mesh ${m}, primitive ${p}`;
      const { bytes } = buffers.view(packed.bufferView, where);
      module ??= await loadModule();
      try {
        out.set(primitive, unpacked(module, document, bytes, { packed, primitive }, where, buffers.budget));
      } catch (error) {
        if (error instanceof ImportError) throw error;
        const reason = error instanceof Error ? error.message : String(error);
        throw new ImportError('compressed-damaged', `${where} can't be unpacked by Draco: ${reason}.`);
      }
    }
  }
  return out;
}

async function loadModule() {
  const { make, wasm } = await import('virtual:draco');
  return await make({ wasmBinary: fromBase64(wasm) });
}

function unpacked(
  module: Module,
  document: Document,
  bytes: Uint8Array,
  { packed, primitive }: { readonly packed: Json; readonly primitive: Json },
  where: string,
  budget: Budget,
): Unpacked {
  const attributes = objectOf(primitive.attributes) ?? {};
  const decoder = new module.Decoder();
  const buffer = new module.DecoderBuffer();
  const mesh = new module.Mesh();
  try {
    buffer.Init(new Int8Array(bytes), bytes.length);
    if (decoder.GetEncodedGeometryType(buffer) !== module.TRIANGULAR_MESH) throw new Error('it is not a mesh');
    const status = decoder.DecodeBufferToMesh(buffer, mesh);
    if (!status.ok()) throw new Error(status.error_msg());
    const points = mesh.num_points();
    const corners = 3 * mesh.num_faces();
    budget.spend(points + corners, where);
    const indices = new Uint32Array(
      read(module, 4 * corners, (pointer) => decoder.GetTrianglesUInt32Array(mesh, 4 * corners, pointer)),
    );
    const found = new Map<string, Numbers>();
    for (const [name, id] of Object.entries(objectOf(packed.attributes) ?? {})) {
      const attribute = decoder.GetAttributeByUniqueId(mesh, Number(id));
      const accessor = attributes[name] === undefined ? {} : document.at('accessors', attributes[name], where);
      const width = attribute.num_components();
      const count = width * points;
      budget.spend(count, where);
      const isFloat = accessor.componentType === undefined || accessor.componentType === 5126;
      // Integers as they are: how they are scaled is said by the accessor.
      const type = isFloat ? module.DT_FLOAT32 : module.DT_INT32;
      const raw = read(module, 4 * count, (pointer) =>
        decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, type, 4 * count, pointer),
      );
      const largest = accessor.normalized === true ? (LARGEST[Number(accessor.componentType)] ?? 1) : 1;
      const values = Float64Array.from(isFloat ? new Float32Array(raw) : new Int32Array(raw), (v) =>
        largest === 1 ? v : Math.max(v / largest, -1),
      );
      found.set(name, { count: points, width, values });
    }
    return { attributes: found, indices };
  } finally {
    module.destroy(mesh);
    module.destroy(buffer);
    module.destroy(decoder);
  }
}

/** Largest values of normalised integers. */
const LARGEST: Readonly<Record<number, number>> = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 };

/** The bytes that the decoder writes to its memory. */
function read(module: Module, bytes: number, write: (pointer: number) => unknown): ArrayBuffer {
  const pointer = module._malloc(bytes);
  try {
    write(pointer);
    return module.HEAPU8.slice(pointer, pointer + bytes).buffer;
  } finally {
    module._free(pointer);
  }
}
