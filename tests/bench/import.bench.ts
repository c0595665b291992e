/**
 * Files of other programs against three.js's loaders of the same: from the bytes to characters, and to a scene. Read the
 * ratios, not the times. Goals: at most 3 times GLTFLoader, and half of FBXLoader. Ours are bundled, as they ship.
 *
 * three.js keeps floats as they are in a file and fits nothing, ours become doubles and turn to angles. So GLB files are
 * the farther from the goal the more of them is rotations.
 */
import { Texture } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { bench, describe } from 'vitest';
import { bundled } from '../helpers/bundled.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';
import { GltfMaker, glbOf } from '../import/make-gltf.ts';

type Files = typeof import('../../src/files/imports.ts');
const { importFile } = await bundled<Files>('src/files/imports.ts');

/** Few of the large files, which take up to half a second each. */
const FEW = { time: 0, iterations: 12, warmupTime: 0, warmupIterations: 3 };
const MANY = { time: 0, iterations: 60, warmupTime: 0, warmupIterations: 20 };

// What three.js's loaders ask of a page. Pictures are never loaded: no ratio is about them.
const noPicture = { addEventListener: () => undefined, removeEventListener: () => undefined };
Object.assign(globalThis, {
  ProgressEvent: class extends Event {},
  window: globalThis,
  self: globalThis,
  document: { createElementNS: () => noPicture },
});

// FBXLoader tells of each material that it has no model of, in every iteration.
console.warn = () => undefined;

async function ours(kind: 'gltf' | 'fbx', fileName: string, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const { value } = await importFile(kind, { fileName, bytes, beside: async () => undefined });
  if (!value) throw new Error(`${fileName} was not read.`);
}

async function gltfLoader(bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const loader = new GLTFLoader();
  loader.register(() => ({ name: 'no pictures', loadTexture: async () => new Texture() }));
  await loader.parseAsync(bytes.buffer, '');
}

interface Content {
  readonly joints: number;
  readonly takes: number;
  readonly keys: number;
  readonly vertices: number;
}

/** A chain of joints with a skin. */
function made({ joints, takes, keys, vertices }: Content): Uint8Array<ArrayBuffer> {
  const maker = new GltfMaker();
  const floats = (count: number, at: (i: number) => number) => Float32Array.from({ length: count }, (_, i) => at(i));
  const jointOf = (v: number) => Math.floor((v * joints) / vertices);
  const bytes = (k: number, v: number) => (k === 0 ? jointOf(v) : k === 1 ? Math.min(jointOf(v) + 1, joints - 1) : 0);
  const attributes = {
    POSITION: maker.add('VEC3', floats(3 * vertices, Math.sin)),
    NORMAL: maker.add('VEC3', floats(3 * vertices, Math.cos)),
    JOINTS_0: maker.add(
      'VEC4',
      Uint8Array.from({ length: 4 * vertices }, (_, i) => bytes(i & 3, i >> 2)),
    ),
    WEIGHTS_0: maker.add(
      'VEC4',
      floats(4 * vertices, (i) => [0.75, 0.25, 0, 0][i & 3]),
    ),
  };
  const indices = maker.add(
    'SCALAR',
    Uint32Array.from({ length: 6 * vertices }, (_, i) => (7 * i) % vertices),
  );
  const inverses = floats(16 * joints, (i) => (i % 5 === 0 || i % 16 === 15 ? 1 : 0));
  const inverseBindMatrices = maker.add('MAT4', inverses);
  const times = maker.add(
    'SCALAR',
    floats(keys, (k) => k / 30),
  );
  const sampler = (type: 'VEC3' | 'VEC4', values: Float32Array) => ({ input: times, output: maker.add(type, values) });
  const animations = Array.from({ length: takes }, (_, a) => {
    const samplers = Array.from({ length: joints }, (__, j) =>
      sampler(
        'VEC4',
        floats(4 * keys, (i) => (i % 4 === 3 ? 1 : 0.4 * Math.sin(0.15 * (i >> 2) + j + a + (i & 3)))),
      ),
    );
    const channels = samplers.map((__, j) => ({ sampler: j, target: { node: j, path: 'rotation' } }));
    return { samplers, channels };
  });
  const bones = Array.from({ length: joints }, (_, j) => ({
    children: j + 1 < joints ? [j + 1] : [],
    translation: [0, 1, 0],
  }));
  return glbOf(
    maker.made({
      scene: 0,
      scenes: [{ nodes: [0, joints] }],
      nodes: [...bones, { mesh: 0, skin: 0 }],
      meshes: [{ primitives: [{ attributes, indices }] }],
      skins: [{ joints: [...bones.keys()], inverseBindMatrices }],
      animations,
    }),
  );
}

function compareGltf(name: string, bytes: Uint8Array<ArrayBuffer>, options: typeof FEW): void {
  describe(name, () => {
    bench('GLTFLoader', () => gltfLoader(bytes), options);
    bench('ours', () => ours('gltf', 'a.glb', bytes), options);
  });
}

compareGltf('a GLB of 40 takes of 45 joints', made({ joints: 45, takes: 40, keys: 35, vertices: 3000 }), FEW);
compareGltf('a GLB of 150,000 vertices', made({ joints: 30, takes: 1, keys: 20, vertices: 150_000 }), FEW);

for (const file of hasShared ? ['Fox', 'bird-animations', 'greenman'] : []) {
  compareGltf(`${file}.glb`, new Uint8Array(sharedBytes(`data/gltf/${file}.glb`)), MANY);
}

const FBX_FILES = ['91_48', 'maya_game_sausage_7500_binary_combined', 'blender_279_sausage_7400_binary'];
for (const file of hasShared ? [...FBX_FILES, 'maya_pivot_offset_7700_ascii'] : []) {
  const bytes = new Uint8Array(sharedBytes(`data/fbx/${file}.fbx`));
  describe(`${file}.fbx`, () => {
    bench('FBXLoader', () => void new FBXLoader().parse(bytes.buffer, ''), MANY);
    bench('ours', () => ours('fbx', 'a.fbx', bytes), MANY);
  });
}
