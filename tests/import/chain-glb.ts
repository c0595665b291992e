/** GLB files of any size: chains of joints that turn. */
import { GltfMaker, glbOf } from './make-gltf.ts';

/** How much there is of each; vertices are of one skin. */
export interface Content {
  readonly joints: number;
  readonly takes: number;
  readonly keys: number;
  readonly vertices: number;
}

/** A chain of joints with a skin, all of which turn in all takes at an even rate. */
export function chainGlb({ joints, takes, keys, vertices }: Content): Uint8Array<ArrayBuffer> {
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
