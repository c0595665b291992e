/** What FBX files say, read from ones written here. */
import { zlibSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { fbxReader } from '../../../src/exchange/fbx/read.ts';
import { multiplyQuaternions, writeQuaternion } from '../../../src/exchange/rotations.ts';
import type { Scene } from '../../../src/exchange/scene.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import { writeRotation } from '../../../src/math/quaternion.ts';
import { FIXED_TANGENT, FLAT, LINEAR } from '../../../src/model/clip.ts';
import { verticesAt, worldsAt } from '../scene-at.ts';
import { walkingBones } from './walking-bones.ts';
import {
  type Connection,
  curve,
  type Fbx,
  fbxBytes,
  fbxText,
  type Obj,
  prop,
  rec,
  recordBytes,
  ticks,
} from './write-fbx.ts';

function read(bytes: Uint8Array | string) {
  return readWhole(fbxReader('file.fbx'), bytes);
}

function sceneOf(fbx: Fbx): Scene {
  const { value, diagnostics } = read(fbxBytes(fbx));
  if (!value) throw new Error(diagnostics.map(({ message }) => message).join('\n'));
  return value;
}

function errorOf(bytes: Uint8Array | string): string {
  const { value, diagnostics } = read(bytes);
  expect(value).toBeUndefined();
  return diagnostics
    .filter(({ severity }) => severity === 'error')
    .map(({ message }) => message)
    .join('\n');
}

/** Degrees as radians. */
const inRadians = (degrees: readonly number[]) => degrees.map((angle) => (angle * Math.PI) / 180);

const bone = (id: number, name: string, ...props: Obj['props'] & object): Obj => ({
  id,
  kind: 'Model',
  name,
  type: 'LimbNode',
  props,
});

/** A model with one mesh: a square in the plane of x and y, unless it says otherwise. */
function meshFile(
  layers: readonly ReturnType<typeof rec>[],
  options: {
    points?: number[];
    corners?: number[];
    props?: Obj['props'];
    objects?: Obj[];
    connections?: Connection[];
    version?: number;
  } = {},
): Fbx {
  const {
    points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0],
    corners = [0, 1, 2, -4],
    props = [],
    objects = [],
    connections = [],
    version = 7400,
  } = options;
  return {
    version,
    objects: [
      { id: 10, kind: 'Model', name: 'square', type: 'Mesh', props },
      {
        id: 11,
        kind: 'Geometry',
        name: 'square',
        type: 'Mesh',
        children: [
          rec('Vertices', [Float64Array.from(points)]),
          rec('PolygonVertexIndex', [Int32Array.from(corners)]),
          ...layers,
        ],
      },
      ...objects,
    ],
    connections: [[10, 0], [11, 10], ...connections],
  };
}

const layer = (name: string, mapping: string, reference: string, ...arrays: ReturnType<typeof rec>[]) =>
  rec(
    name,
    [{ int: 0 }],
    [rec('MappingInformationType', [mapping]), rec('ReferenceInformationType', [reference]), ...arrays],
  );

const CUBIC_USER = 8 | 0x400;

/** One bone whose rotation has a curve about z. */
function turning(keys: Parameters<typeof curve>[1], ...props: Obj['props'] & object): Fbx {
  return {
    objects: [
      bone(10, 'hip', ...props),
      {
        id: 1,
        kind: 'AnimationStack',
        name: 'Walk',
        props: [prop('LocalStart', ticks(0)), prop('LocalStop', ticks(2))],
      },
      { id: 2, kind: 'AnimationLayer', name: 'Base' },
      { id: 3, kind: 'AnimationCurveNode', name: 'R', props: [prop('d|X', 0), prop('d|Y', 0), prop('d|Z', 0)] },
      curve(4, keys),
    ],
    connections: [
      [10, 0],
      [2, 1],
      [3, 2],
      [3, 10, 'Lcl Rotation'],
      [4, 3, 'd|Z'],
    ],
  };
}

function zCurve({ takes }: Scene) {
  const rotation = takes[0].moves[0].rotation;
  const channel = rotation?.kind === 'euler' ? rotation.angles[2] : undefined;
  if (channel?.kind !== 'keys') throw new Error('no keys');
  return channel;
}

describe('FBX curves', () => {
  it('keys of one layer keep their times, values and slopes', () => {
    const { times, values, tangentsIn, tangentsOut } = zCurve(
      sceneOf(
        turning([
          { time: 0, value: 90, flags: CUBIC_USER, data: [45, 30, 0, 0] },
          { time: 1.5, value: -90, flags: 0x4 },
          { time: 2, value: 0, flags: 0x4 },
        ]),
      ),
    );
    expect([...times]).toEqual([0, 1.5, 2]);
    expect([...values].map((value) => value / Math.PI)).toEqual([0.5, -0.5, 0]);
    expect(tangentsOut.kinds[0]).toBe(FIXED_TANGENT);
    expect(tangentsOut.slopes[0]).toBeCloseTo(Math.PI / 4, 12);
    expect(tangentsIn.slopes[1]).toBeCloseTo(Math.PI / 6, 12);
    expect([tangentsOut.kinds[1], tangentsIn.kinds[2]]).toEqual([LINEAR, LINEAR]);
  });

  it('a held key becomes a step: two keys at one time', () => {
    const { times, values, tangentsOut } = zCurve(
      sceneOf(
        turning([
          { time: 0, value: 10, flags: 2 },
          { time: 1, value: 20, flags: 2 },
        ]),
      ),
    );
    expect([...times]).toEqual([0, 1, 1]);
    expect([...values].map((value) => Math.round((value * 180) / Math.PI))).toEqual([10, 10, 20]);
    expect(tangentsOut.kinds[0]).toBe(FLAT);
  });

  it('a pre-rotation about the axis turned last keeps the keys, and is added to them', () => {
    const keys = [
      { time: 0, value: 10, flags: 4 },
      { time: 1, value: 20, flags: 4 },
    ];
    const { times, values } = zCurve(sceneOf(turning(keys, prop('PreRotation', 0, 0, 30))));
    expect([...times]).toEqual([0, 1]);
    expect([...values].map((value) => (value * 180) / Math.PI)).toEqual([40, 50].map((v) => expect.closeTo(v, 9)));
  });

  it.each([
    [
      [20, 30, 40],
      [0, 0, 0],
    ],
    [
      [-80, 15, 170],
      [0, 0, 25],
    ],
    [
      [20, 90, 0],
      [0, 0, 0],
    ],
  ])('a node that turns about one axis keeps its keys below any pre-rotation: %j, and %j after', (before, after) => {
    const fbx = turning(
      [
        { time: 0, value: 10, flags: CUBIC_USER, data: [45, 30, 0, 0] },
        { time: 1.5, value: -90, flags: 0x4 },
        { time: 2, value: 0, flags: 0x4 },
      ],
      prop('PreRotation', ...before),
      prop('PostRotation', ...after),
    );
    const { value: scene, diagnostics } = read(fbxBytes(fbx));
    if (!scene) throw new Error('not read');
    expect(diagnostics.map(({ code }) => code)).toEqual(['fbx-space']);
    const { times, tangentsOut, tangentsIn } = zCurve(scene);
    expect([...times]).toEqual([0, 1.5, 2]);
    expect([tangentsOut.kinds[0], tangentsOut.kinds[1], tangentsIn.kinds[2]]).toEqual([FIXED_TANGENT, LINEAR, LINEAR]);
    const expected = new Float64Array(4);
    const part = new Float64Array(4);
    for (const [time, angle] of [
      [0, 10],
      [1.5, -90],
      [1.75, -45],
    ]) {
      writeQuaternion('xyz', inRadians(before), expected);
      writeQuaternion('xyz', inRadians([0, 0, angle]), part);
      multiplyQuaternions(expected, part, expected);
      writeQuaternion('xyz', inRadians(after), part);
      multiplyQuaternions(expected, [-part[0], -part[1], -part[2], part[3]], expected);
      const matrix = new Float64Array(16);
      writeRotation(expected[0], expected[1], expected[2], expected[3], matrix, 0, 4);
      const shown = worldsAt(scene, scene.takes[0], time)[0];
      for (const k of [0, 1, 2, 4, 5, 6, 8, 9, 10]) expect(shown[k]).toBeCloseTo(matrix[k], 9);
    }
  });

  it('other pre- and post-rotations are fitted and said', () => {
    const keys = [
      { time: 0, value: 10, flags: 4 },
      { time: 1, value: 20, flags: 4 },
    ];
    const { diagnostics } = read(
      fbxBytes(turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0))),
    );
    expect(diagnostics.map(({ code }) => code)).toContain('curves-fitted');
  });

  it('fitted keys jump at once where a key holds the value of the next', () => {
    const keys = [
      { time: 0, value: 10, flags: 0x102 },
      { time: 1, value: 20, flags: 0x102 },
      { time: 2, value: 80, flags: 0x102 },
    ];
    const scene = sceneOf(turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0)));
    const at = (time: number) => worldsAt(scene, scene.takes[0], time)[0].map((v) => expect.closeTo(v, 4));
    expect(worldsAt(scene, scene.takes[0], 0.00003)[0]).toEqual(at(0.6));
    expect(worldsAt(scene, scene.takes[0], 0.99997)[0]).toEqual(at(0.6));
    expect(worldsAt(scene, scene.takes[0], 1.00003)[0]).toEqual(at(1.6));
  });

  it('times that are no finite numbers count as 0', () => {
    const text = fbxText(
      turning([
        { time: 0.5, value: 10, flags: 4 },
        { time: 1, value: 20, flags: 4 },
      ]),
    );
    const { value } = read(text.replace(/(KeyTime: [\s\S]*?a: \d+,)\d+/, '$11e999'));
    expect(value && [...zCurve(value).times]).toEqual([0, 0.5]);
  });

  it('the units of time that newer files choose are followed', () => {
    const fbx = turning([
      { time: 0, value: 0, flags: 4 },
      { time: 1, value: 1, flags: 4 },
    ]);
    const header = rec(
      'FBXHeaderExtension',
      [],
      [rec('FBXHeaderVersion', [{ int: 1004 }]), rec('OtherFlags', [], [rec('TCDefinition', [{ int: 0 }])])],
    );
    // The first header counts.
    const text = fbxText(fbx)
      .replace(/FBXHeaderExtension:[\s\S]*?\n\}/, '')
      .replace(
        'GlobalSettings',
        `FBXHeaderExtension: {\n${header.children.map(({ name, children }) => (children.length > 0 ? `${name}: {\nTCDefinition: 0\n}` : `${name}: 1004`)).join('\n')}\n}\nGlobalSettings`,
      );
    const { value } = read(text.replaceAll(String(ticks(1)), '141120000'));
    expect(value && [...zCurve(value).times]).toEqual([0, 1]);
  });
});

describe('FBX meshes', () => {
  it('a polygon with a corner turned inwards is cut without leaving it', () => {
    // An arrow head: its third corner lies inside the triangle of the others.
    const fbx = meshFile([], { points: [0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0] });
    const { surfaces, meshes } = { surfaces: sceneOf(fbx).meshes[0].surfaces, meshes: sceneOf(fbx).meshes };
    const p = meshes[0].positions;
    let area = 0;
    const t = surfaces[0].triangles;
    for (let i = 0; i < t.length; i += 3) {
      const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
      const own = ((p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[c] - p[a]) * (p[b + 1] - p[a + 1])) / 2;
      expect(own).toBeGreaterThan(0);
      area += own;
    }
    expect(area).toBeCloseTo(4, 12);
  });

  it('normals by corner, point and polygon, with and without indices, are the same', () => {
    const normal = [0, 0, 1];
    const all = Float64Array.from([...normal, ...normal, ...normal, ...normal]);
    const variants = [
      layer('LayerElementNormal', 'ByPolygonVertex', 'Direct', rec('Normals', [all])),
      layer('LayerElementNormal', 'ByVertice', 'Direct', rec('Normals', [all])),
      layer('LayerElementNormal', 'ByPolygon', 'Direct', rec('Normals', [Float64Array.from(normal)])),
      layer('LayerElementNormal', 'AllSame', 'Direct', rec('Normals', [Float64Array.from(normal)])),
      layer(
        'LayerElementNormal',
        'ByPolygonVertex',
        'IndexToDirect',
        rec('Normals', [Float64Array.from(normal)]),
        rec('NormalsIndex', [Int32Array.of(0, 0, 0, 0)]),
      ),
    ];
    for (const variant of variants) {
      expect([...(sceneOf(meshFile([variant])).meshes[0].normals ?? [])]).toEqual([...all]);
    }
  });

  it('a point on a seam becomes a vertex for each pair of texture coordinates', () => {
    const uv = layer(
      'LayerElementUV',
      'ByPolygonVertex',
      'IndexToDirect',
      rec('UV', [Float64Array.of(0, 0, 1, 0, 1, 1, 0.5, 0.5)]),
      rec('UVIndex', [Int32Array.of(0, 1, 2, 0, 2, 3)]),
    );
    const { positions, texcoords } = sceneOf(meshFile([uv], { corners: [0, 1, -3, 0, 2, -4] })).meshes[0];
    expect(positions).toHaveLength(12);
    expect(texcoords).toHaveLength(8);
    const seam = layer(
      'LayerElementUV',
      'ByPolygonVertex',
      'Direct',
      rec('UV', [Float64Array.of(0, 0, 1, 0, 1, 1, 0.2, 0, 1, 1, 0, 1)]),
    );
    expect(sceneOf(meshFile([seam], { corners: [0, 1, -3, 0, 2, -4] })).meshes[0].positions).toHaveLength(15);
  });

  it('materials by polygon are surfaces, with colours times their factor', () => {
    const materials = layer(
      'LayerElementMaterial',
      'ByPolygon',
      'IndexToDirect',
      rec('Materials', [Int32Array.of(0, 1)]),
    );
    const scene = sceneOf(
      meshFile([materials], {
        corners: [0, 1, -3, 0, 2, -4],
        objects: [
          { id: 20, kind: 'Material', name: 'red', props: [prop('DiffuseColor', 1, 0, 0), prop('DiffuseFactor', 0.5)] },
          { id: 21, kind: 'Material', name: 'blue', props: [prop('DiffuseColor', 0, 0, 1)] },
        ],
        connections: [
          [20, 10],
          [21, 10],
        ],
      }),
    );
    expect(scene.materials).toEqual([
      { name: 'red', color: [0.5, 0, 0] },
      { name: 'blue', color: [0, 0, 1] },
    ]);
    expect(scene.meshes[0].surfaces.map(({ material, triangles }) => [material, ...triangles])).toEqual([
      [0, 0, 1, 2],
      [1, 0, 2, 3],
    ]);
  });

  it('an embedded image becomes a texture, from bytes and from base64', () => {
    const png = Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 1, 2, 3, 4);
    const fbx = meshFile([], {
      objects: [
        { id: 20, kind: 'Material', name: 'skin' },
        { id: 21, kind: 'Texture', name: 'map', children: [rec('RelativeFilename', ['..\\maps\\face.png'])] },
        { id: 22, kind: 'Video', name: 'map', type: 'Clip', children: [rec('Content', [png])] },
      ],
      connections: [
        [20, 10],
        [21, 20, 'DiffuseColor'],
        [22, 21],
      ],
    });
    for (const bytes of [fbxBytes(fbx), fbxText(fbx)]) {
      const { value } = read(bytes);
      expect(value?.textures).toEqual([{ name: 'face.png', mime: 'image/png', bytes: png }]);
      expect(value?.materials).toEqual([{ name: 'skin', texture: 'face.png' }]);
    }
  });

  it('geometric transforms move the points of a node, and nothing below it', () => {
    const fbx = meshFile([], {
      props: [prop('GeometricTranslation', 0, 0, 5), prop('GeometricScaling', 2, 2, 2)],
      objects: [bone(12, 'below')],
      connections: [[12, 10]],
    });
    const scene = sceneOf(fbx);
    expect([...verticesAt(scene, undefined, 0)[0]].slice(3, 6)).toEqual([2, 0, 5]);
    expect(worldsAt(scene, undefined, 0)[1].slice(12, 15)).toEqual([0, 0, 0]);
  });

  it('vertices without weights hang on their own node, the others on their joints', () => {
    const identity = Float64Array.from({ length: 16 }, (_, i) => (i % 5 === 0 ? 1 : 0));
    const fbx = meshFile([], {
      props: [prop('Lcl Translation', 0, 0, 3)],
      objects: [
        bone(12, 'joint', prop('Lcl Translation', 0, 0, 0)),
        { id: 13, kind: 'Deformer', name: '', type: 'Skin' },
        {
          id: 14,
          kind: 'Deformer',
          name: '',
          type: 'Cluster',
          children: [
            rec('Indexes', [Int32Array.of(0, 1)]),
            rec('Weights', [Float64Array.of(2, 1)]),
            rec('Transform', [identity]),
            rec('TransformLink', [identity]),
          ],
        },
      ],
      connections: [
        [12, 0],
        [13, 11],
        [14, 13],
        [12, 14],
      ],
    });
    const [vertices] = verticesAt(sceneOf(fbx), undefined, 0);
    // Weights are normalised.
    expect([...vertices]).toEqual([0, 0, 0, 1, 0, 0, 1, 1, 3, 0, 1, 3]);
  });

  it('shapes in between take their part by the percentage, and go on beyond the last', () => {
    const shape = (id: number, z: number): Obj => ({
      id,
      kind: 'Geometry',
      name: `s${z}`,
      type: 'Shape',
      children: [rec('Indexes', [Int32Array.of(2)]), rec('Vertices', [Float64Array.of(0, 0, z)])],
    });
    const at = (percent: number) => {
      const fbx = meshFile([], {
        objects: [
          { id: 20, kind: 'Deformer', name: 'b', type: 'BlendShape' },
          {
            id: 21,
            kind: 'Deformer',
            name: 'smile',
            type: 'BlendShapeChannel',
            props: [prop('DeformPercent', percent)],
            children: [rec('FullWeights', [Float64Array.of(50, 100)])],
          },
          shape(22, 1),
          shape(23, 5),
        ],
        connections: [
          [20, 11],
          [21, 20],
          [22, 21],
          [23, 21],
        ],
      });
      return verticesAt(sceneOf(fbx), undefined, 0)[0][8];
    };
    expect([0, 25, 50, 75, 100, 150].map(at)).toEqual([0, 0.5, 1, 3, 5, 9]);
  });
});

describe('FBX axes and units', () => {
  const settings = (...axes: number[]) =>
    ['UpAxis', 'UpAxisSign', 'FrontAxis', 'FrontAxisSign', 'CoordAxis', 'CoordAxisSign'].map((name, i) =>
      prop(name, { int: axes[i] }),
    );

  it('z up is turned so that y is, in the file’s own unit, and said', () => {
    const fbx: Fbx = {
      settings: [...settings(2, 1, 1, -1, 0, 1), prop('UnitScaleFactor', 100)],
      objects: [bone(10, 'hip', prop('Lcl Translation', 1, 2, 3))],
      connections: [[10, 0]],
    };
    const { value, diagnostics } = read(fbxBytes(fbx));
    expect(
      value &&
        worldsAt(value, undefined, 0)[1]
          .slice(12, 15)
          .map((v) => Math.round(v * 1e9) / 1e9),
    ).toEqual([1, 3, -2]);
    expect(diagnostics.map(({ message }) => message).join()).toMatch(/1 m.*z is up/);
  });

  it('left-handed axes are mirrored', () => {
    const scene = sceneOf({
      settings: settings(1, 1, 2, -1, 0, 1),
      objects: [bone(10, 'hip', prop('Lcl Translation', 1, 2, 3))],
      connections: [[10, 0]],
    });
    expect(
      worldsAt(scene, undefined, 0)[1]
        .slice(12, 15)
        .map((v) => Math.round(v * 1e9) / 1e9),
    ).toEqual([1, 2, -3]);
  });
});

describe('files that are no FBX 7', () => {
  it('other files are refused by what they are', () => {
    expect(errorOf('')).toMatch(/empty/);
    expect(errorOf('solid cube')).toMatch(/Expected an FBX file/);
    expect(errorOf('; FBX 6.1.0 project file\n')).toMatch(/version 6\.1.*Converter/);
    expect(errorOf(recordBytes(6100, []))).toMatch(/version 6\.1/);
  });

  it('a text that breaks off or has no number says where', () => {
    const text = fbxText(turning([{ time: 0, value: 0, flags: 4 }]));
    const { diagnostics } = read(text.slice(0, text.indexOf('Connections') - 3));
    expect(diagnostics[0].message).toMatch(/Expected \}/);
    const broken = read(text.replace('a: 0', 'a: zero'));
    expect(broken.diagnostics[0].message).toMatch(/Expected a number/);
    expect(broken.diagnostics[0].line).toBeGreaterThan(10);
  });

  it('a binary file that breaks off says at which byte', () => {
    const bytes = fbxBytes(turning([{ time: 0, value: 0, flags: 4 }]));
    expect(errorOf(bytes.slice(0, bytes.length / 2))).toMatch(/cut off.*at byte \d+/);
  });

  it('an array that unpacks to more than it says, or says more than deflate holds, is refused', () => {
    const bomb = zlibSync(new Uint8Array(5_000_000));
    const array = (count: number) => {
      const header = Buffer.alloc(13);
      header.write('d');
      header.writeUInt32LE(count, 1);
      header.writeUInt32LE(1, 5);
      header.writeUInt32LE(bomb.length, 9);
      return Buffer.concat([header, bomb]);
    };
    for (const count of [10, 100_000_000]) {
      const file = recordBytes(7400, [rec('Objects', [Float64Array.of(1)])]);
      const at = Buffer.from(file).indexOf('Objects') + 7;
      const value = array(count);
      const body = Buffer.concat([Buffer.from(file.slice(0, at)), value, Buffer.alloc(13)]);
      body.writeUInt32LE(at + value.length, 27);
      body.writeUInt32LE(value.length, 35);
      expect(errorOf(new Uint8Array(body))).toMatch(/packed array is damaged/);
    }
  });

  it('small files that ask for much are refused by their size', () => {
    const packed = (count: number) => rec('Vertices', [new Float64Array(count)]);
    expect(errorOf(fbxBytes({ ...meshFile([packed(5e6)]) }))).toMatch(/goes beyond 4\d* numbers in memory/);
    const points = Array.from({ length: 3000 }, (_, i) => i % 7);
    const mesh = meshFile([], { points, corners: Array.from({ length: 999 }, (_, i) => (i % 3 === 2 ? ~i : i)) });
    const copies = Array.from(
      { length: 900 },
      (_, i): Obj => ({ id: 1000 + i, kind: 'Model', name: '', type: 'Mesh' }),
    );
    const connections = copies.flatMap(({ id }): Connection[] => [
      [id, 0],
      [11, id],
    ]);
    const many = { objects: [...mesh.objects, ...copies], connections: [...mesh.connections, ...connections] };
    expect(errorOf(fbxBytes(many))).toMatch(/A mesh goes beyond/);
  });

  it('a curve that repeats for hours gets no more keys than its file is worth, which is said', () => {
    const keys = [
      { time: 0, value: 0, flags: CUBIC_USER, data: [9e4, 0, 0, 0] as const },
      { time: 0.001, value: 99, flags: CUBIC_USER, data: [1e5, 1e5, 0, 0] as const },
    ];
    const fbx = turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0));
    const cycle = rec('Post-Extrapolation', [], [rec('Type', [{ int: 82 }]), rec('Repetition', [{ int: -1 }])]);
    const objects = fbx.objects.map((own) => (own.id === 4 ? curve(4, keys, [cycle]) : own));
    const { value, diagnostics } = read(fbxBytes({ ...fbx, objects }));
    expect(diagnostics.map(({ code }) => code)).toContain('curves-too-long');
    expect(value && zCurve(value).times.length).toBeLessThan(50_000);
  });

  it('models that are each other’s parents are left out', () => {
    const fbx: Fbx = {
      objects: [bone(10, 'a'), bone(11, 'b'), bone(12, 'c')],
      connections: [
        [10, 11],
        [11, 10],
        [12, 0],
      ],
    };
    expect(sceneOf(fbx).nodes.map(({ name }) => name)).toEqual(['c']);
    expect(
      errorOf(
        fbxBytes({
          ...fbx,
          connections: [
            [10, 11],
            [11, 10],
          ],
        }),
      ),
    ).toMatch(/Expected models/);
  });

  it('thousands of models inside each other are no harm: those too deep are left out, and said', () => {
    const objects = Array.from({ length: 3000 }, (_, i) => bone(10 + i, `b${i}`, prop('InheritType', { int: 0 })));
    const connections = objects.map(({ id }, i): Connection => [id, i === 0 ? 0 : id - 1]);
    const { value, diagnostics } = read(fbxBytes({ objects, connections }));
    expect(value?.nodes.length).toBe(500);
    expect(diagnostics.map(({ message }) => message).join()).toMatch(/2500 models outside the scene or too deep/);
  });

  it('an encrypted file says so', () => {
    expect(errorOf(recordBytes(7400, [rec('EncryptionType', ['x']), rec('Objects')]))).toMatch(/encrypted/);
  });
});

it('what is told of a binary file as a whole, or of a byte of it, has no line', () => {
  const reader = fbxReader('a.fbx');
  reader.feed(fbxBytes(walkingBones));
  const { diagnostics } = reader.end();
  expect(diagnostics.map(({ code, line }) => [code, line])).toContainEqual(['fbx-space', 0]);
  expect(diagnostics.filter(({ line }) => line > 0)).toEqual([]);
});
