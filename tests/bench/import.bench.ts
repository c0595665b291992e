/**
 * Files of other programs against three.js's loaders of the same: from the bytes to characters, and to a scene. Read
 * the ratios, not the times. Goals: at most 3 times GLTFLoader, and half of FBXLoader. Ours are bundled, as they ship.
 *
 * three.js keeps floats as they are in a file, ours become doubles, but for rotations: their angles are fitted once
 * something asks for the channels of their take. The third figure of a GLB is with the channels of all its takes.
 */
import { Texture } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { bench, describe } from 'vitest';
import { bundled } from '../helpers/bundled.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';
import { chainGlb } from '../import/chain-glb.ts';

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

async function ours(kind: 'gltf' | 'fbx', fileName: string, bytes: Uint8Array<ArrayBuffer>) {
  const { value } = await importFile(kind, { fileName, bytes, beside: async () => undefined });
  if (!value) throw new Error(`${fileName} was not read.`);
  return value.characters;
}

/** Returns how many channels there are. */
async function withChannels(bytes: Uint8Array<ArrayBuffer>): Promise<number> {
  const takes = (await ours('gltf', 'a.glb', bytes)).flatMap((character) => character.takes);
  return takes.reduce((sum, { channels }) => sum + channels.length, 0);
}

async function gltfLoader(bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const loader = new GLTFLoader();
  loader.register(() => ({ name: 'no pictures', loadTexture: async () => new Texture() }));
  await loader.parseAsync(bytes.buffer, '');
}

function compareGltf(name: string, bytes: Uint8Array<ArrayBuffer>, options: typeof FEW): void {
  describe(name, () => {
    bench('GLTFLoader', () => gltfLoader(bytes), options);
    bench('ours', async () => void (await ours('gltf', 'a.glb', bytes)), options);
    bench('ours, with all channels', async () => void (await withChannels(bytes)), options);
  });
}

compareGltf('a GLB of 40 takes of 45 joints', chainGlb({ joints: 45, takes: 40, keys: 35, vertices: 3000 }), FEW);
compareGltf('a GLB of 150,000 vertices', chainGlb({ joints: 30, takes: 1, keys: 20, vertices: 150_000 }), FEW);

for (const file of hasShared ? ['Fox', 'bird-animations', 'greenman'] : []) {
  compareGltf(`${file}.glb`, new Uint8Array(sharedBytes(`data/gltf/${file}.glb`)), MANY);
}

const FBX_FILES = ['91_48', 'maya_game_sausage_7500_binary_combined', 'blender_279_sausage_7400_binary'];
for (const file of hasShared ? [...FBX_FILES, 'maya_pivot_offset_7700_ascii'] : []) {
  const bytes = new Uint8Array(sharedBytes(`data/fbx/${file}.fbx`));
  describe(`${file}.fbx`, () => {
    bench('FBXLoader', () => void new FBXLoader().parse(bytes.buffer, ''), MANY);
    bench('ours', async () => void (await ours('fbx', 'a.fbx', bytes)), MANY);
  });
}
