/** Files made for what is odd in real ones. */
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../src/edit/change.ts';
import { resetPose } from '../../src/edit/commands/pose.ts';
import { importFile } from '../../src/files/imports.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import type { Beside } from '../../src/import/imported.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { parse } from '../../src/worker/parse.ts';
import { type GltfJson, gltfReference } from '../helpers/gltf-reference.ts';
import { farthest, posedNodes } from '../helpers/posed.ts';
import { GltfMaker, glbOf, type Made } from './make-gltf.ts';

const TRIANGLE = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);

async function read(bytes: Uint8Array<ArrayBuffer>, fileName = 'x.glb', files: readonly Beside[] = []) {
  const beside = async (path: string) => files.find(({ source }) => source.path === path);
  const { value, diagnostics } = await importFile('gltf', { fileName, bytes, beside });
  return { whole: value?.characters[0], diagnostics };
}

async function opened(made: Made) {
  const { whole, diagnostics } = await read(glbOf(made));
  if (!whole) throw new Error(JSON.stringify(diagnostics));
  return { whole, diagnostics };
}

async function expectAsThree(made: Made): Promise<void> {
  const { whole } = await opened(made);
  // A valid file has this shape.
  const reference = await gltfReference(made.json as unknown as GltfJson, made.buffers);
  expect(farthest(posedNodes(whole), reference.pose())).toBeLessThan(1 / 2000);
  whole.takes.forEach(({ range: [start, end] }, take) => {
    for (let n = 0; n <= 16; n++) {
      const time = start + ((end - start) * n * 0.9999) / 16;
      expect(farthest(posedNodes(whole, take, time), reference.pose(take, time))).toBeLessThan(1 / 2000);
    }
  });
}

/** Nodes that turn by these quaternions, one a second, with a mesh on the last. */
function turning(quaternions: readonly number[], interpolation = 'LINEAR', scale?: readonly number[]): Made {
  const maker = new GltfMaker();
  const input = maker.add(
    'SCALAR',
    Float32Array.from({ length: quaternions.length / (interpolation === 'CUBICSPLINE' ? 12 : 4) }, (_, i) => i + 1),
  );
  const output = maker.add('VEC4', Float32Array.from(quaternions));
  const POSITION = maker.add('VEC3', TRIANGLE);
  return maker.made({
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      { name: 'a b', children: [1], translation: [1, 2, 3], ...(scale && { scale }) },
      { name: '{tip}', translation: [0, 2, 0], mesh: 0 },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION } }] }],
    animations: [
      {
        samplers: [{ input, output, interpolation }],
        channels: [{ sampler: 0, target: { node: 0, path: 'rotation' } }],
      },
    ],
  });
}

const half = Math.SQRT1_2;

describe('rotations', () => {
  it('a scene that reaches farther than numbers go is refused by the name of the node, or of the mesh', async () => {
    const still = [0, 0, 0, 1];
    const { whole, diagnostics } = await read(glbOf(turning(still, 'LINEAR', [1, 1e308, 1])));
    expect(whole).toBeUndefined();
    expect(diagnostics.map(({ code, message }) => `${code}: ${message}`)).toEqual([
      'scene-too-large: Node "{tip}" is too far away or too large for a number (1.8e308 at most).',
    ]);
    const vertex = await read(glbOf(turning(still, 'LINEAR', [1.7e308, 1, 1])));
    expect(vertex.diagnostics).toEqual([]);
    expect(vertex.whole?.skins[0].positions.every(Number.isFinite)).toBe(true);
  });

  it.each([
    ['nearly half a turn between two keys', [0, 0, 0, 1, 0, 0.9999, 0, 0.0141]],
    [
      'through gimbal lock of all orders',
      [0, 0, 0, 1, half, 0, 0, half, 0, half, 0, half, 0, 0, half, half, 0.5, 0.5, 0.5, 0.5, 0, 1, 0, 0, 1, 0, 0, 0],
    ],
    ['by a quaternion and its negative', [0, 0, 0, 1, 0, 0, -half, -half, 0, 0, 0, 1]],
    [
      'over and over',
      [0.1, 0.1, 0.1, Math.sqrt(0.97), -0.5, 0.5, 0.5, 0.5, 0.7, -0.7, 0.1, 0.1, -0.5, -0.7, 0.5, -0.1],
    ],
  ])('a node that turns %s is where three.js has it', async (_, quaternions) => {
    await expectAsThree(turning(quaternions));
    await expectAsThree(turning(quaternions, 'STEP'));
    // With scale it can't be a quaternionjoint.
    await expectAsThree(turning(quaternions, 'LINEAR', [1, 2, -1]));
    const cubic = Array.from({ length: quaternions.length / 4 }, (_, k) => [
      0.3,
      -0.4,
      0.2,
      0.1,
      ...quaternions.slice(4 * k, 4 * k + 4),
      -0.2,
      0.5,
      0.1,
      0.3,
    ]);
    await expectAsThree(turning(cubic.flat(), 'CUBICSPLINE'));
  });
});

it('a node that turns in a moment, where a cubic of quaternions passes near 0, is where three.js has it', async () => {
  const first = [0.89, 0.26, 0.08, -0.36];
  const second = [-0.91, -0.28, -0.09, 0.38];
  const out = [0.09, 0.03, 0.01, -0.04];
  const still = [0, 0, 0, 0];
  await expectAsThree(turning([...still, ...first, ...out, ...still, ...second, ...still], 'CUBICSPLINE'));
});

/** Two triangles in one mesh, with whatever is asked for. */
function triangles(
  attributes: (maker: GltfMaker) => Record<string, unknown>,
  more: Record<string, unknown> = {},
): Made {
  const maker = new GltfMaker();
  const primitive = attributes(maker);
  return maker.made({
    nodes: [{ name: 'n', mesh: 0, scale: [0.5, 0.5, 0.5] }],
    meshes: [{ primitives: [primitive] }],
    ...more,
  });
}

describe('meshes', () => {
  it('reads strips, fans, quantised positions and no scene', async () => {
    const strip = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0);
    for (const mode of [5, 6]) {
      const made = triangles((m) => ({ mode, attributes: { POSITION: m.add('VEC3', strip) } }));
      expect((await opened(made)).whole.skins[0].triangles).toEqual(
        mode === 5 ? Uint32Array.of(0, 1, 2, 2, 1, 3) : Uint32Array.of(0, 1, 2, 0, 2, 3),
      );
    }
    const bytes = Int16Array.of(0, 0, 0, 32767, 0, 0, 0, -32768, 100);
    const { whole } = await opened(
      triangles((m) => ({ attributes: { POSITION: m.add('VEC3', bytes, { normalized: true }) } })),
    );
    expect([...whole.skins[0].positions.slice(3, 9)]).toEqual([0.5, 0, 0, 0, -0.5, 100 / 32767 / 2]);
  });

  it('moves texture coordinates by KHR_texture_transform, v upwards, and names the texture', async () => {
    const png = Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10);
    const made = triangles(
      (m) => {
        const image = m.view(png);
        Object.assign(images, { image });
        return {
          material: 0,
          attributes: {
            POSITION: m.add('VEC3', TRIANGLE),
            TEXCOORD_1: m.add('VEC2', Float32Array.of(0, 0, 1, 0, 0, 1)),
          },
        };
      },
      {
        images: [
          {
            get bufferView() {
              return images.image;
            },
            mimeType: 'image/png',
            name: 'my skin',
          },
        ],
        textures: [{ source: 0 }],
        materials: [
          {
            name: 'm',
            pbrMetallicRoughness: {
              baseColorFactor: [1, 0.5, 0, 1],
              baseColorTexture: {
                index: 0,
                texCoord: 1,
                extensions: { KHR_texture_transform: { offset: [0.25, 0.5], scale: [2, 0.5], rotation: Math.PI / 2 } },
              },
            },
          },
        ],
      },
    );
    const { whole } = await opened(made);
    const [skin] = whole.skins;
    expect(skin.surfaces[0].material).toEqual({ name: 'm', color: [1, 0.5, 0], texture: 'my_skin.png' });
    expect(whole.textures.map(({ name }) => name)).toEqual(['my_skin.png']);
    const expected = [0.25, 0.5, 0.25, 2.5, 0.75, 0.5];
    skin.texcoords?.forEach((v, i) => {
      expect(v).toBeCloseTo(expected[i], 12);
    });
  });
  const images: { image?: number } = {};

  it('a pointer to what moves of a node is read as its path; what others point to is named, once', async () => {
    const moving = (asPointer: boolean, ...others: readonly string[]): Made => {
      const maker = new GltfMaker();
      const POSITION = maker.add('VEC3', TRIANGLE);
      const input = maker.add('SCALAR', Float32Array.of(0, 1));
      const output = (type: 'SCALAR' | 'VEC3' | 'VEC4', ...values: number[]) =>
        maker.add(type, Float32Array.from(values));
      const outputs = {
        translation: output('VEC3', 0, 0, 0, 1, 2, 3),
        rotation: output('VEC4', 0, 0, 0, 1, 1, 0, 0, 0),
        scale: output('VEC3', 1, 1, 1, 2, 1, 1),
        weights: output('SCALAR', 0, 1),
      };
      const pointing = (pointer: string) => ({ path: 'pointer', extensions: { KHR_animation_pointer: { pointer } } });
      const paths = Object.keys(outputs);
      return maker.made({
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ children: [1] }, { mesh: 0 }],
        meshes: [{ primitives: [{ attributes: { POSITION }, targets: [{ POSITION }] }] }],
        animations: [
          {
            samplers: Object.values(outputs).map((own) => ({ input, output: own })),
            channels: [
              ...paths.map((path, sampler) => ({
                sampler,
                target: asPointer ? pointing(`/nodes/1/${path}`) : { node: 1, path },
              })),
              ...others.map((pointer) => ({ sampler: 0, target: pointing(pointer) })),
            ],
          },
        ],
        extensionsRequired: ['KHR_animation_pointer'],
      });
    };
    const plain = await opened(moving(false));
    const pointed = await opened(moving(true));
    expect(pointed).toEqual(plain);
    expect(pointed.diagnostics).toEqual([]);
    const elsewhere = ['/materials/0/emissiveFactor', '/materials/1/alphaCutoff', '/cameras/0/perspective/yfov'];
    const { whole, diagnostics } = await opened(moving(true, ...elsewhere));
    expect(whole).toEqual(plain.whole);
    expect(diagnostics.map(({ message }) => message)).toEqual([
      'Not read: the animation of materials (KHR_animation_pointer), the animation of cameras (KHR_animation_pointer).',
    ]);
  });

  it('a material that only emits light has that colour and image; what another emits is named', async () => {
    const base = (baseColorFactor: readonly number[]) => ({ pbrMetallicRoughness: { baseColorFactor } });
    const strong = { extensions: { KHR_materials_emissive_strength: { emissiveStrength: 4 } } };
    const image = { emissiveTexture: { index: 0 } };
    const told = async (material: object) => {
      const made = triangles((m) => ({ attributes: { POSITION: m.add('VEC3', TRIANGLE) }, material: 0 }), {
        nodes: [{ mesh: 0 }],
        materials: [{ name: 'm', ...material }],
        textures: [{ source: 0 }],
        images: [{ uri: 'glow.png' }],
        extensionsRequired: ['KHR_materials_emissive_strength'],
      });
      const { whole, diagnostics } = await opened(made);
      const { color, texture } = whole.skins[0].surfaces[0].material ?? {};
      return [color, texture, /emissive/.test(diagnostics.map(({ message }) => message).join())];
    };
    const black = base([0, 0, 0, 1]);
    expect(await told({ ...black, emissiveFactor: [0, 1, 0] })).toEqual([[0, 1, 0], undefined, false]);
    expect(await told({ ...black, emissiveFactor: [0, 0.2, 0.5], ...strong })).toEqual([[0, 0.8, 1], undefined, false]);
    expect(await told({ ...black, emissiveFactor: [1, 1, 1], ...image })).toEqual([undefined, 'glow.png', false]);
    // Times a factor of 0, which is the default, nothing is emitted.
    expect(await told({ ...black, ...image })).toEqual([[0, 0, 0], undefined, false]);
    expect(await told({ ...base([1, 0, 0, 1]), emissiveFactor: [0, 1, 0] })).toEqual([[1, 0, 0], undefined, true]);
    expect(await told({ emissiveFactor: [0, 1, 0], ...image })).toEqual([undefined, undefined, true]);
  });

  it('passes over normals and weights that are no finite numbers, and reads targets of normals alone', async () => {
    const made = triangles(
      (m) => ({
        attributes: {
          POSITION: m.add('VEC3', TRIANGLE),
          NORMAL: m.add('VEC3', Float32Array.of(0, 1, 0, Infinity, 0, 0, 0, 0, NaN)),
          JOINTS_0: m.add('VEC4', new Uint8Array(12)),
          WEIGHTS_0: m.add('VEC4', Float32Array.of(Infinity, 1, 0, 0, 1, 0, 0, 0, NaN, 0, 0, 0)),
        },
        targets: [{ NORMAL: m.add('VEC3', Float32Array.of(0, 0, 1, 0, 1, 0, 0, 1, 0)) }],
      }),
      { skins: [{ joints: [0] }], nodes: [{ mesh: 0, skin: 0 }] },
    );
    const { skins, morphs } = (await opened(made)).whole;
    // Computed where the file has none.
    expect([...(skins[0].normals ?? [])]).toEqual([0, 1, 0, 0, 0, 1, 0, 0, 1]);
    expect([...(skins[0].attachments?.weights ?? [])]).toEqual([1, 1, 1]);
    expect(morphs[0].positions.indices.length).toBe(0);
    expect([...morphs[0].normals.indices]).toEqual([0]);
    expect([...morphs[0].normals.values]).toEqual([0, 1, 1]);
  });

  it('starts with the weights of the mesh, or of its node, and returns to them', async () => {
    for (const [own, ofNode, expected] of [
      [[0.5, 0.25], undefined, [0.5, 0.25]],
      [
        [0.5, 0.25],
        [0, 0.75],
        [0, 0.75],
      ],
      [undefined, undefined, [0, 0]],
    ]) {
      const made = triangles(
        (m) => ({
          attributes: { POSITION: m.add('VEC3', TRIANGLE) },
          targets: [1, 2].map((k) => ({ POSITION: m.add('VEC3', new Float32Array(9).fill(k)) })),
        }),
        { scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, ...(ofNode && { weights: ofNode }) }] },
      );
      const [mesh] = made.json.meshes as Record<string, unknown>[];
      if (own) mesh.weights = own;
      await expectAsThree(made);
      const files = [{ path: 'x.glb', blob: new Blob([glbOf(made)]) }];
      const parsed = await parse({ files }, () => undefined);
      const { document } = openFiles(EMPTY_DOCUMENT, parsed.files, parsed.broken);
      const [{ id, pose }] = document.characters;
      expect(pose.slice(-2)).toEqual(expected);
      const zero = documentIn(resetPose.run(document, { characterId: id, to: 'zero', timeSeconds: 0 }));
      expect(zero.characters[0].pose.slice(-2)).toEqual([0, 0]);
      const again = documentIn(resetPose.run(zero, { characterId: id, to: 'file', timeSeconds: 0 }));
      expect(again.characters[0].pose).toEqual(pose);
    }
  });

  it('unpacks views of meshoptimizer', async () => {
    await MeshoptEncoder.ready;
    const maker = new GltfMaker();
    const packed = MeshoptEncoder.encodeVertexBuffer(new Uint8Array(TRIANGLE.buffer), 3, 12);
    const at = maker.view(packed);
    const own = maker.views[at];
    maker.views[at] = {
      buffer: 1,
      byteLength: 36,
      extensions: { EXT_meshopt_compression: { ...own, byteStride: 12, count: 3, mode: 'ATTRIBUTES' } },
    };
    maker.accessors.push({ bufferView: at, componentType: 5126, type: 'VEC3', count: 3 });
    const made = maker.made({
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      extensionsRequired: ['EXT_meshopt_compression'],
    });
    const { whole, diagnostics } = await opened(made);
    expect(diagnostics).toEqual([]);
    expect([...whole.skins[0].positions]).toEqual([...TRIANGLE]);
  });
});

describe('parts of the body', () => {
  const bones = { hips: { node: 0 }, leftUpperLeg: { node: 1 } };
  const nodes = [
    { name: 'J1', children: [1] },
    { name: 'J2', mesh: 0 },
  ];

  it.each([
    ['VRM 1.0', { VRMC_vrm: { humanoid: { humanBones: bones } } }],
    [
      'VRM 0.x',
      {
        VRM: {
          humanoid: {
            humanBones: [
              { bone: 'hips', node: 0 },
              { bone: 'leftUpperLeg', node: 1 },
            ],
          },
        },
      },
    ],
  ])('%s names the joints for retargeting', async (_, extensions) => {
    const made = triangles((m) => ({ attributes: { POSITION: m.add('VEC3', TRIANGLE) } }), { nodes, extensions });
    const { whole } = await opened(made);
    expect(whole.skeleton.joints.map(({ name, role }) => [name, role])).toEqual([
      ['J1', 'hips'],
      ['J2', 'leftUpperLeg'],
    ]);
  });
});

describe('files that are not as they should be', () => {
  const plain = () => triangles((m) => ({ attributes: { POSITION: m.add('VEC3', TRIANGLE) } }));
  /** With another value at a place of the JSON. */
  const withJson = (path: string, value: unknown) => {
    const made = plain();
    const names = path.split('.');
    const last = names.pop() ?? '';
    let at: object = made.json;
    for (const name of names) at = Reflect.get(at, name);
    Reflect.set(at, last, value);
    return glbOf(made);
  };

  it.each([
    ['file-truncated', 'is cut off', () => glbOf(plain()).slice(0, 60)],
    ['json-invalid', 'is something else', () => new TextEncoder().encode('hello')],
    ['version-unknown', 'has version 1', () => withJson('asset.version', '1.0')],
    ['nodes-cyclic', 'has only a node below itself', () => withJson('nodes.0.children', [0])],
    ['nodes-cyclic', 'has a node twice', () => withJson('scenes', [{ nodes: [0, 0] }])],
    ['index-out-of-range', 'names a mesh that it does not have', () => withJson('nodes.0.mesh', 7)],
    ['accessor-too-long', 'has an accessor past its view', () => withJson('accessors.0.count', 4e9)],
    [
      'accessor-too-large',
      'has billions of zeros',
      () => withJson('accessors.0', { componentType: 5126, type: 'VEC3', count: 4e9 }),
    ],
    ['file-too-large', 'has one mesh on very many nodes', () => withJson('nodes', Array(20000).fill({ mesh: 0 }))],
    [
      'file-too-large',
      'has very many animations of very many nodes',
      () => {
        const maker = new GltfMaker();
        const input = maker.add('SCALAR', Float32Array.of(1));
        const output = maker.add('VEC3', Float32Array.of(1, 2, 3));
        const channels = [{ sampler: 0, target: { node: 0, path: 'translation' } }];
        const animations = Array(800).fill({ samplers: [{ input, output }], channels });
        return glbOf(maker.made({ nodes: Array(1000).fill({}), animations }));
      },
    ],
    [
      'file-too-large',
      'uses the same bytes very many times',
      () => {
        const maker = new GltfMaker();
        const POSITION = maker.add('VEC3', new Float32Array(30000));
        const primitives = Array.from({ length: 300 }, (_, i) => ({
          attributes: { POSITION, _OTHER: i },
        }));
        return glbOf(maker.made({ nodes: [{ mesh: 0 }], meshes: [{ primitives }] }));
      },
    ],
    ['buffer-too-short', 'has a view past its buffer', () => withJson('bufferViews.0.byteLength', 1e9)],
    ['part-not-given', 'needs a file that is not there', () => withJson('buffers.0.uri', 'x.bin')],
    ['file-empty', 'has neither mesh nor animation', () => withJson('nodes', [{}])],
    [
      'extension-unsupported',
      'requires something that changes its shapes',
      () => withJson('extensionsRequired', ['KHR_materials_clearcoat', 'EXT_mesh_gpu_instancing']),
    ],
  ])('%s: a file that %s is refused with a reason', async (code, _, bytes) => {
    const { whole, diagnostics } = await read(bytes());
    expect(whole).toBeUndefined();
    expect(diagnostics.map((d) => d.code)).toContain(code);
  });
});

it('what a file requires for its looks only is named, and the file is read', async () => {
  const made = triangles((m) => ({ attributes: { POSITION: m.add('VEC3', TRIANGLE) } }));
  Object.assign(made.json, { extensionsRequired: ['KHR_materials_clearcoat', 'KHR_lights_punctual'] });
  const { whole, diagnostics } = await read(glbOf(made));
  expect(whole?.skins).toHaveLength(1);
  expect(diagnostics).toMatchObject([{ severity: 'warning', message: expect.stringContaining('clearcoat') }]);
});

describe('a mesh that is not in the file', () => {
  it('is said with the number that its node has in the file, whatever the order of the tree', async () => {
    const maker = new GltfMaker();
    const POSITION = maker.add('VEC3', TRIANGLE);
    const made = maker.made({
      scene: 0,
      scenes: [{ nodes: [2] }],
      nodes: [{ mesh: 7 }, { mesh: 0 }, { children: [1, 0] }],
      meshes: [{ primitives: [{ attributes: { POSITION } }] }],
    });
    const { whole, diagnostics } = await read(glbOf(made));
    expect(whole).toBeUndefined();
    expect(diagnostics.map(({ message }) => message).join()).toContain('Node 0 refers to meshes 7');
  });
});
