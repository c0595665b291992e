/**
 * What three.js makes of a glTF file: world matrices of the nodes that a character needs, and vertices of all
 * triangles, at rest and at times of its animations. Pictures and materials are taken out, since they need a browser.
 */
import { AnimationMixer, LoopOnce, Mesh, type Object3D, SkinnedMesh, Vector3 } from 'three';
import { type GLTF, GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

// Three's loader tells its progress by events, which Node doesn't have.
globalThis.ProgressEvent ??= class extends Event {} as unknown as typeof ProgressEvent;

// It would round weights that are bytes.
SkinnedMesh.prototype.normalizeSkinWeights = () => undefined;

interface GltfNode {
  children?: number[];
  mesh?: number;
  skin?: number;
}

/** As much of a file as is asked for here. */
export interface GltfJson {
  scene?: number;
  scenes?: { nodes: number[] }[];
  nodes?: GltfNode[];
  skins?: { joints: number[] }[];
  animations?: { name?: string; channels: { target: { node?: number } }[] }[];
  meshes?: { primitives: { material?: number }[] }[];
  buffers?: { uri?: string; byteLength: number }[];
  [other: string]: unknown;
}

export interface ReferencePose {
  /** 16 numbers per node, in depth-first order. */
  readonly worlds: Float64Array;
  readonly positions: Float64Array;
}

export interface Reference {
  readonly takes: readonly { readonly range: readonly [number, number] }[];
  /** At rest without a take, with the file's morph weights. */
  pose(take?: number, time?: number): ReferencePose;
}

export async function gltfReference(json: GltfJson, buffers: readonly Uint8Array[]): Promise<Reference> {
  const plain: GltfJson = { ...json };
  for (const key of [
    'materials',
    'textures',
    'images',
    'samplers',
    'extensionsUsed',
    'extensionsRequired',
    'extensions',
  ])
    delete plain[key];
  plain.extensionsUsed = json.extensionsUsed;
  plain.meshes = (json.meshes ?? []).map((mesh) => ({
    ...mesh,
    primitives: mesh.primitives.map(({ material: _, ...primitive }) => primitive),
  }));
  // Of several scenes it knows the nodes of the last only.
  if (json.scenes) Object.assign(plain, { scenes: [json.scenes[json.scene ?? 0]], scene: 0 });
  plain.buffers = (json.buffers ?? []).map((buffer, i) => ({
    ...buffer,
    uri: `data:application/octet-stream;base64,${Buffer.from(buffers[i]).toString('base64')}`,
  }));
  const gltf = await new Promise<GLTF>((resolve, reject) => {
    new GLTFLoader().parse(JSON.stringify(plain), '', resolve, reject);
  });
  const { scene, animations, parser } = gltf;
  const needed = neededNodes(json);
  const objects: Object3D[] = [];
  const meshes: Mesh[] = [];
  const nodes: readonly Object3D[] = await parser.getDependencies('node');
  const indexOf = new Map(nodes.map((object, n) => [object, n]));
  scene.traverse((object) => {
    const node = indexOf.get(object);
    if (node !== undefined && needed.has(node)) objects.push(object);
  });
  // Primitives of one node that share their vertices are one list of vertices.
  for (const object of objects) {
    const own: Mesh[] = [];
    const pending = [object];
    // Several primitives of a joint are in a group of their own.
    for (let next = pending.pop(); next; next = pending.pop()) {
      if (next instanceof Mesh) own.push(next);
      pending.push(...next.children.filter((child) => !indexOf.has(child)).reverse());
    }
    const known = new Set<unknown>();
    for (const mesh of own) {
      if (known.has(mesh.geometry.attributes.position)) continue;
      known.add(mesh.geometry.attributes.position);
      meshes.push(mesh);
    }
  }
  // Once per file: a mixer restores what it found when it is told to stop.
  const mixer = new AnimationMixer(scene);
  const restWeights = meshes.map((mesh) => [...(mesh.morphTargetInfluences ?? [])]);
  return {
    takes: animations.map((take) => ({
      range: [Math.min(...take.tracks.map((t) => t.times[0])), take.duration],
    })),
    pose(take, time = 0) {
      mixer.stopAllAction();
      meshes.forEach((mesh, m) => {
        mesh.morphTargetInfluences?.forEach((_, t, own) => {
          own[t] = restWeights[m][t];
        });
      });
      if (take !== undefined) {
        const action = mixer.clipAction(animations[take]);
        action.setLoop(LoopOnce, 1);
        action.clampWhenFinished = true;
        action.reset().play();
        mixer.setTime(time);
      }
      scene.updateMatrixWorld(true);
      const worlds = Float64Array.from(objects.flatMap((object) => object.matrixWorld.toArray()));
      const positions = meshes.flatMap((mesh) => {
        const points: number[] = [];
        const point = new Vector3();
        for (let v = 0; v < mesh.geometry.attributes.position.count; v++) {
          Mesh.prototype.getVertexPosition.call(mesh, v, point);
          const { x, y, z } =
            mesh instanceof SkinnedMesh ? skinned(mesh, v, point) : point.applyMatrix4(mesh.matrixWorld);
          points.push(x, y, z);
        }
        return points;
      });
      return { worlds, positions: Float64Array.from(positions) };
    },
  };
}

/**
 * By all attachments: three.js takes four, and rounds weights that are bytes.
 */
function skinned(mesh: SkinnedMesh, vertex: number, point: Vector3): Vector3 {
  const { attributes } = mesh.geometry;
  const sum = new Vector3();
  let total = 0;
  for (const [joints, weights] of [
    [attributes.skinIndex, attributes.skinWeight],
    [attributes.joints_1, attributes.weights_1],
    [attributes.joints_2, attributes.weights_2],
  ]) {
    for (let k = 0; joints && k < 4; k++) {
      const weight = weights.getComponent(vertex, k);
      const joint = joints.getComponent(vertex, k);
      if (weight === 0) continue;
      total += weight;
      const { bones, boneInverses } = mesh.skeleton;
      const moved = point.clone().applyMatrix4(boneInverses[joint]).applyMatrix4(bones[joint].matrixWorld);
      sum.addScaledVector(moved, weight);
    }
  }
  return sum.divideScalar(total);
}

/** Joints of skins, nodes with a mesh, animated ones, and all above them. */
function neededNodes({ nodes = [], skins = [], animations = [] }: GltfJson): ReadonlySet<number> {
  const parents = new Map(nodes.flatMap(({ children = [] }, n) => children.map((child) => [child, n] as const)));
  const needed = new Set<number>();
  const add = (node: number | undefined) => {
    for (let n = node; n !== undefined; n = parents.get(n)) needed.add(n);
  };
  nodes.forEach(({ mesh }, n) => {
    if (mesh !== undefined) add(n);
  });
  for (const { joints } of skins) for (const joint of joints) add(joint);
  for (const { channels } of animations) for (const { target } of channels) add(target.node);
  return needed;
}
