/** What FBX files say of meshes, axes and units, read from ones written here. */
import { describe, expect, it } from 'vitest';
import { verticesAt, worldsAt } from '../scene-at.ts';
import { bone, layer, meshFile, read, sceneOf } from './small-files.ts';
import { type Fbx, fbxBytes, fbxText, type Obj, prop, type Rec, rec } from './write-fbx.ts';

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

  it('a material that only emits light has that colour; what another emits is named', () => {
    const told = (...props: Rec[]) => {
      const fbx = meshFile([], {
        objects: [{ id: 20, kind: 'Material', name: 'm', props }],
        connections: [[20, 10]],
      });
      const { value, diagnostics } = read(fbxBytes(fbx));
      return [value?.materials[0].color, /emissive/.test(diagnostics.map(({ message }) => message).join())];
    };
    const [black, red, glow] = [
      prop('DiffuseColor', 0, 0, 0),
      prop('DiffuseColor', 1, 0, 0),
      prop('EmissiveColor', 0, 1, 0),
    ];
    expect(told(black, glow)).toEqual([[0, 1, 0], false]);
    expect(told(black, glow, prop('EmissiveFactor', 0.5))).toEqual([[0, 0.5, 0], false]);
    expect(told(black, glow, prop('EmissiveFactor', 0))).toEqual([[0, 0, 0], false]);
    expect(told(red, glow)).toEqual([[1, 0, 0], true]);
    expect(told(red)).toEqual([[1, 0, 0], false]);
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

  it('the points of a shape follow it by their own percentages, of which Blender may write a single one', () => {
    const heights = (creator: string, points: readonly number[], full: readonly number[]) => {
      const offsets = points.flatMap(() => [0, 0, 8]);
      const fbx = meshFile([], {
        before: [rec('FBXHeaderExtension', [], [rec('Creator', [creator])])],
        objects: [
          { id: 20, kind: 'Deformer', name: 'b', type: 'BlendShape' },
          {
            id: 21,
            kind: 'Deformer',
            name: 'smile',
            type: 'BlendShapeChannel',
            children: [rec('DeformPercent', [50]), rec('FullWeights', [Float64Array.from(full)])],
          },
          {
            id: 22,
            kind: 'Geometry',
            name: 's',
            type: 'Shape',
            children: [
              rec('Indexes', [Int32Array.from(points)]),
              rec('Vertices', [Float64Array.from(offsets)]),
              rec('Normals', [Float64Array.from(offsets)]),
            ],
          },
        ],
        connections: [
          [20, 11],
          [21, 20],
          [22, 21],
        ],
      });
      const all = verticesAt(sceneOf(fbx), undefined, 0)[0];
      return [2, 5, 8, 11].map((z) => all[z]);
    };
    expect(heights('FBX SDK', [0, 2, 3], [100, 25, 0])).toEqual([4, 0, 1, 0]);
    expect(heights('Blender (stable FBX IO) - 4.4.1', [1], [25])).toEqual([0, 1, 0, 0]);
    // Half of what it is at 25 %, twice over.
    expect(heights('FBX SDK', [1], [25])).toEqual([0, 16, 0, 0]);
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
