/**
 * Reads GLB files as other programs do: three.js's and Babylon's loaders and interpolation, and the Khronos validator.
 */
import '@babylonjs/core/Animations/animatable.js';
import { NullEngine } from '@babylonjs/core/Engines/nullEngine.js';
import { LoadAssetContainerAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { Logger } from '@babylonjs/core/Misc/logger.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/glTF/2.0/glTFLoader.js';
import { validateBytes } from 'gltf-validator';
import { AnimationMixer, LoopOnce, type Object3D, Texture } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { DEFAULT_GLB, type GlbOptions } from '../../src/export/glb/options.ts';
import { writeGlb } from '../../src/export/glb/write.ts';
import type { ExchangeReport } from '../../src/export/shared/report.ts';
import type { Character } from '../../src/model/document.ts';

export interface Glb {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly report: ExchangeReport;
  readonly json: GltfJson;
}

/** The part of the JSON that tests read. */
export interface GltfJson {
  readonly nodes: readonly {
    readonly name?: string;
    readonly children?: readonly number[];
    readonly translation?: readonly number[];
    readonly rotation?: readonly number[];
    readonly scale?: readonly number[];
  }[];
  readonly scenes: readonly { readonly nodes: readonly number[] }[];
  readonly skins?: readonly { readonly joints: readonly number[]; readonly inverseBindMatrices: number }[];
  readonly meshes?: readonly {
    readonly primitives: readonly {
      readonly attributes: Readonly<Record<string, number>>;
      readonly indices?: number;
      readonly material?: number;
      readonly targets?: readonly Readonly<Record<string, number>>[];
    }[];
    readonly extras?: { readonly targetNames: readonly string[] };
  }[];
  readonly animations?: readonly {
    readonly name: string;
    readonly channels: readonly {
      readonly sampler: number;
      readonly target: { readonly node: number; readonly path: string };
    }[];
    readonly samplers: readonly { readonly input: number; readonly output: number; readonly interpolation: string }[];
  }[];
  readonly accessors: readonly {
    readonly bufferView?: number;
    readonly componentType: number;
    readonly count: number;
    readonly type: string;
    readonly sparse?: {
      readonly count: number;
      readonly indices: { readonly bufferView: number; readonly componentType: number };
      readonly values: { readonly bufferView: number };
    };
  }[];
  readonly bufferViews: readonly { readonly byteOffset: number; readonly byteLength: number }[];
  readonly images?: readonly { readonly mimeType: string; readonly bufferView: number }[];
  readonly materials?: readonly unknown[];
}

/** A character written as GLB, in its own space. */
export function glbOf(character: Character, options: Partial<GlbOptions> = {}): Glb {
  const { pieces, report } = writeGlb(character, { ...DEFAULT_GLB, ...options }, false);
  const bytes = new Uint8Array(report.bytes);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return { bytes, report, json: jsonOf(bytes) };
}

function jsonOf(bytes: Uint8Array): GltfJson {
  const length = new DataView(bytes.buffer).getUint32(12, true);
  return JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))) as GltfJson;
}

/** The same file with further members of its JSON. */
export function withJson({ bytes, json }: Glb, more: Readonly<Record<string, unknown>>): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify({ ...json, ...more }));
  const length = 4 * Math.ceil(text.length / 4);
  const rest = bytes.subarray(20 + new DataView(bytes.buffer).getUint32(12, true));
  const out = new Uint8Array(20 + length + rest.length);
  out.set(bytes.subarray(0, 20));
  out.fill(32, 20, 20 + length);
  out.set(text, 20);
  out.set(rest, 20 + length);
  const view = new DataView(out.buffer);
  view.setUint32(8, out.length, true);
  view.setUint32(12, length, true);
  return out;
}

/** Errors and warnings of the Khronos validator. */
export async function complaintsOf(bytes: Uint8Array): Promise<readonly string[]> {
  const { issues } = await validateBytes(bytes, { maxIssues: 0 });
  return issues.messages
    .filter(({ severity }) => severity < 2)
    .map(({ code, message, pointer }) => `${code} ${pointer ?? ''} ${message}`);
}

const WIDTHS: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const TYPES: Readonly<
  Record<number, typeof Float32Array | typeof Uint8Array | typeof Uint16Array | typeof Uint32Array>
> = { 5126: Float32Array, 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };

/** The numbers of an accessor. */
export function numbersOf({ bytes, json }: Pick<Glb, 'bytes' | 'json'>, accessor: number): Float64Array {
  const { bufferView, componentType, count, type, sparse } = json.accessors[accessor];
  const width = WIDTHS[type];
  const start = 20 + new DataView(bytes.buffer).getUint32(12, true) + 8;
  const values = (view: number, component: number, length: number) =>
    new TYPES[component](bytes.slice(start + json.bufferViews[view].byteOffset).buffer, 0, length);
  const out = new Float64Array(count * width);
  if (bufferView !== undefined) out.set(values(bufferView, componentType, count * width));
  if (sparse) {
    const indices = values(sparse.indices.bufferView, sparse.indices.componentType, sparse.count);
    const rows = values(sparse.values.bufferView, componentType, sparse.count * width);
    indices.forEach((index, row) => {
      for (let k = 0; k < width; k++) out[width * index + k] = rows[width * row + k];
    });
  }
  return out;
}

/** Keys of an animation, of all channels together. */
export function keyCount({ json }: Glb, animation = 0): number {
  const samplers = json.animations?.[animation].samplers ?? [];
  return samplers.reduce((sum, { input }) => sum + json.accessors[input].count, 0);
}

/** What another program shows: world matrices of the skin's joints and the morph weights at a time of a take. */
export interface Shown {
  readonly matrices: Float64Array;
  readonly weights: readonly number[];
}
export type Player = (take: number, seconds: number) => Shown;

// What three.js's loader expects of a browser, for a file without images.
Object.assign(globalThis, { self: globalThis, ProgressEvent: class {} });

export async function inThree(glb: Glb): Promise<Player> {
  const loader = new GLTFLoader();
  // Images need a browser.
  loader.register(() => ({ name: 'NO_IMAGES', loadTexture: async () => new Texture() }));
  const { scene, animations, parser } = await loader.parseAsync(glb.bytes.slice().buffer, '');
  const objects = new Map<number, Object3D>();
  let mesh: Object3D | undefined;
  scene.traverse((object) => {
    const of = parser.associations.get(object);
    if (of?.nodes !== undefined) objects.set(of.nodes, object);
    if ('morphTargetInfluences' in object) mesh ??= object;
  });
  const mixer = new AnimationMixer(scene);
  let playing = -1;
  return (take, seconds) => {
    if (take !== playing && animations[take]) {
      mixer.stopAllAction();
      const action = mixer.clipAction(animations[take]).setLoop(LoopOnce, 1);
      action.clampWhenFinished = true;
      action.play();
      playing = take;
    }
    if (animations[take]) {
      const action = mixer.clipAction(animations[take]);
      action.reset().play();
      mixer.setTime(seconds);
    }
    scene.updateMatrixWorld(true);
    const joints = glb.json.skins?.[0].joints ?? [];
    const matrices = Float64Array.from(joints.flatMap((node) => objects.get(node)?.matrixWorld.elements ?? []));
    const influences = mesh && 'morphTargetInfluences' in mesh ? mesh.morphTargetInfluences : undefined;
    return { matrices, weights: Array.isArray(influences) ? influences.map(Number) : [] };
  };
}

/** Where three.js has the nodes of these names, at a time of a file's first animation. */
export async function jointsInThree(
  bytes: Uint8Array,
  names: readonly string[],
): Promise<(seconds: number) => readonly (readonly [number, number, number])[]> {
  const { scene, animations } = await new GLTFLoader().parseAsync(Uint8Array.from(bytes).buffer, '');
  const mixer = new AnimationMixer(scene);
  const action = mixer.clipAction(animations[0]).setLoop(LoopOnce, 1);
  action.clampWhenFinished = true;
  return (seconds) => {
    action.reset().play();
    mixer.setTime(seconds);
    scene.updateMatrixWorld(true);
    return names.map((name) => {
      const object = scene.getObjectByName(name);
      if (!object) throw new Error(`The file has no node ${name}.`);
      const [x, y, z] = object.matrixWorld.elements.slice(12);
      return [x, y, z];
    });
  };
}

let engine: NullEngine | undefined;

export async function inBabylon(glb: Glb): Promise<Player> {
  // It greets on the console.
  Logger.LogLevels = Logger.NoneLogLevel;
  engine ??= new NullEngine();
  const scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  const container = await LoadAssetContainerAsync(glb.bytes.slice(), scene, { pluginExtension: '.glb' });
  container.addAllToScene();
  const nodes = new Map<number, (typeof container.transformNodes)[number]>();
  for (const node of [...container.transformNodes, ...container.meshes]) {
    // Where the loader notes what a node was made of.
    const { gltf } = (node.metadata ?? node._internalMetadata ?? {}) as { gltf?: { pointers?: readonly string[] } };
    const own = node._internalMetadata?.gltf as { pointers?: readonly string[] } | undefined;
    for (const pointer of gltf?.pointers ?? own?.pointers ?? []) {
      const index = /^\/nodes\/(\d+)$/.exec(pointer)?.[1];
      if (index !== undefined) nodes.set(Number(index), node);
    }
  }
  let playing = -1;
  return (take, seconds) => {
    const group = container.animationGroups[take];
    if (group) {
      if (playing !== take) for (const other of container.animationGroups) other.stop();
      if (playing !== take) group.start(false).pause();
      playing = take;
      // The loader counts 60 frames a second.
      group.goToFrame(seconds * 60);
    }
    const joints = glb.json.skins?.[0].joints ?? [];
    const matrices = Float64Array.from(
      joints.flatMap((index) => [...(nodes.get(index)?.computeWorldMatrix(true).asArray() ?? [])]),
    );
    const manager = container.morphTargetManagers[0];
    const weights = manager ? Array.from({ length: manager.numTargets }, (_, m) => manager.getTarget(m).influence) : [];
    return { matrices, weights };
  };
}
