/** Reads glTF 2.0, GLB, VRM and VRM animations as a scene. */
import { stemOf } from '../../model/files.ts';
import { counted, type Import, ImportError, type Imported, Remarks } from '../imported.ts';
import { Accessors } from './accessors.ts';
import { Buffers, MESHOPT } from './buffers.ts';
import { readContainer } from './container.ts';
import { DRACO, unpackDraco } from './draco.ts';
import { readHumanoid } from './humanoid.ts';
import { type Document, extensionOf, listOf } from './json.ts';
import { readMaterials } from './materials.ts';
import { Meshes } from './meshes.ts';
import { meshoptDecoder } from './meshopt.ts';
import { readNodes } from './nodes.ts';
import { readTakes } from './takes.ts';

/** By the specification, of VRM too. */
const METRES = 1;

/** Never throws for anything that the file holds. */
export async function readGltf(given: Import): Promise<Imported> {
  const remarks = new Remarks(given.fileName);
  try {
    return { ...(await read(given, remarks)), diagnostics: remarks.finish() };
  } catch (error) {
    if (!(error instanceof ImportError)) throw error;
    return { diagnostics: [...remarks.finish(), remarks.error(error)] };
  }
}

async function read(given: Import, remarks: Remarks) {
  const container = readContainer(given.bytes);
  const { document } = container;
  listOthers(document, remarks);
  const isMeshopt = document.all('bufferViews').some((view) => MESHOPT.some((name) => extensionOf(view, name)));
  const buffers = await Buffers.load(container, given, isMeshopt ? await meshoptDecoder() : undefined);
  const accessors = new Accessors(document, buffers);
  const { materials, textures, mappings, sources } = await readMaterials(document, buffers, given, remarks);
  const unpacked = await unpackDraco(document, buffers);
  const nodes = readNodes(document, readHumanoid(document), remarks);
  const meshes = new Meshes(document, accessors, mappings, unpacked, buffers.budget, remarks).read(nodes);
  const takes = readTakes(document, accessors, buffers.budget, nodes.indexOf, meshes, remarks);
  const name = stemOf({ name: given.fileName, path: given.fileName, bytes: 0 });
  return {
    scene: { name, metres: METRES, nodes: nodes.nodes, meshes, materials, textures, takes },
    beside: [...buffers.sources, ...sources],
  };
}

/** Lists the contents of the file that are not read, by name. */
function listOthers(document: Document, remarks: Remarks): void {
  const { root } = document;
  const cameras = document.count('cameras');
  if (cameras) remarks.leaveOut(counted(cameras, 'camera'));
  const lights = listOf(extensionOf(root, 'KHR_lights_punctual')?.lights).length;
  if (lights) remarks.leaveOut(counted(lights, 'light'));
  const vrm = extensionOf(root, 'VRM') ?? extensionOf(root, 'VRMC_vrm');
  if (vrm?.blendShapeMaster ?? vrm?.expressions) remarks.leaveOut('expressions (their morphs are read)');
  if (vrm?.secondaryAnimation || extensionOf(root, 'VRMC_springBone')) remarks.leaveOut('spring bones');
  const required = listOf(root.extensionsRequired).filter((e) => typeof e === 'string' && !READ.has(e));
  const looks = required.filter((e) => LOOKS.test(String(e)));
  if (looks.length) {
    const message = `The file requires ${looks.join(', ')}, which Marrow doesn't read.`;
    remarks.warn('extension-unknown', message, 'materials may look different');
  }
  const shapes = required.filter((e) => !looks.includes(e));
  if (shapes.length) {
    const message = `The file requires ${shapes.join(', ')}, which Marrow doesn't read: without it, joints or vertices could be wrong. Open the file in a program that reads it, such as Blender, and export it without.`;
    throw new ImportError('extension-unsupported', message);
  }
}

/** Extensions that change colours and lights only. */
const LOOKS = /^[A-Z]+_(materials|lights|texture|image|environment)_?/;

const READ: ReadonlySet<string> = new Set([
  ...MESHOPT,
  DRACO,
  'KHR_mesh_quantization',
  'KHR_texture_transform',
  'EXT_texture_webp',
  'KHR_animation_pointer',
  'KHR_materials_unlit',
  'KHR_materials_emissive_strength',
  'KHR_materials_pbrSpecularGlossiness',
  'VRM',
  'VRMC_vrm',
  'VRMC_vrm_animation',
]);
