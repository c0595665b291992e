/** A skin as an FBX mesh: points in the skin's order, materials with their images, clusters, and morphs as shapes. */
import { type CompiledSkin, compileSkin } from '../../evaluate/skin/deform.ts';
import { normalsOf } from '../../evaluate/skin/normals.ts';
import { invertAffine, isSingular, setIdentity } from '../../math/mat4.ts';
import type { Texture } from '../../model/files.ts';
import type { Morph } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';
import type { AttachmentSets } from '../shared/attachments.ts';
import { GivenTextures, heldColor, type NamedImage, PLAIN_COLOR } from '../shared/given-textures.ts';
import {
  facingNormals,
  type MorphDifferences,
  normalDifferences,
  positionDifferences,
  unitNormals,
} from '../shared/mesh-data.ts';
import { type FbxDocument, numberProperty, properties, property } from './document.ts';
import { array, double, int, long, named, raw, record, text } from './records.ts';

/** Adds the geometry of a skin under a model. @returns its id */
export function addGeometry(document: FbxDocument, skin: Skin, model: number): number {
  const normals = normalsOf(skin);
  const triangles = facingNormals(skin, normals);
  // The last point of each polygon is told by its complement.
  const indices = Int32Array.from(triangles, (v, i) => (i % 3 === 2 ? ~v : v));
  const materials = new Int32Array(indices.length / 3);
  skin.surfaces.forEach(({ triangleStart, triangleCount }, s) => {
    materials.fill(s, triangleStart, triangleStart + triangleCount);
  });
  const layer = (name: string, mapping: string, reference: string, content: readonly ReturnType<typeof record>[]) =>
    record(
      name,
      [int(0)],
      [
        record('Version', [int(101)]),
        record('Name', [text('')]),
        record('MappingInformationType', [text(mapping)]),
        record('ReferenceInformationType', [text(reference)]),
        ...content,
      ],
    );
  const unit = Float64Array.from(unitNormals(normals));
  const uv = skin.texcoords && Float64Array.from(skin.texcoords);
  const layers = ['LayerElementNormal', ...(uv ? ['LayerElementUV'] : []), 'LayerElementMaterial'];
  const geometry = document.add('Geometry', named(skin.name, 'Geometry'), 'Mesh', [
    record('Vertices', [array(Float64Array.from(skin.positions))]),
    record('PolygonVertexIndex', [array(indices)]),
    record('GeometryVersion', [int(124)]),
    layer('LayerElementNormal', 'ByVertice', 'Direct', [record('Normals', [array(unit)])]),
    ...(uv
      ? [
          layer('LayerElementUV', 'ByPolygonVertex', 'IndexToDirect', [
            record('UV', [array(uv)]),
            record('UVIndex', [array(Int32Array.from(triangles))]),
          ]),
        ]
      : []),
    layer('LayerElementMaterial', 'ByPolygon', 'IndexToDirect', [record('Materials', [array(materials)])]),
    record(
      'Layer',
      [int(0)],
      [
        record('Version', [int(100)]),
        ...layers.map((type) =>
          record('LayerElement', [], [record('Type', [text(type)]), record('TypedIndex', [int(0)])]),
        ),
      ],
    ),
  ]);
  document.connect(geometry, model);
  return geometry;
}

/** Adds the materials of a skin's surfaces, with images inside the file. @returns names of textures that are missing */
export function addMaterials(
  document: FbxDocument,
  { surfaces, texcoords }: Skin,
  textures: readonly Texture[],
  model: number,
): readonly string[] {
  const given = new GivenTextures(textures);
  const videos = new Map<NamedImage, number>();
  for (const { material } of surfaces) {
    const one = material?.texture && texcoords ? given.of(material.texture) : undefined;
    const [r, g, b] = material?.color ? heldColor(material.color) : one ? [1, 1, 1] : PLAIN_COLOR;
    const color = (name: string, ...values: readonly number[]) =>
      property(name, ['Color', '', 'A'], ...values.map(double));
    const id = document.add('Material', named(material?.name ?? 'material', 'Material'), '', [
      record('Version', [int(102)]),
      record('ShadingModel', [text('lambert')]),
      record('MultiLayer', [int(0)]),
      properties(
        color('AmbientColor', 0, 0, 0),
        color('DiffuseColor', r, g, b),
        property('DiffuseFactor', ['Number', '', 'A'], double(1)),
        property('Opacity', ['double', 'Number', ''], double(1)),
      ),
    ]);
    document.connect(id, model);
    if (one) addTexture(document, one, id, videos);
  }
  return given.missing;
}

function addTexture(document: FbxDocument, one: NamedImage, material: number, videos: Map<NamedImage, number>): void {
  // Named by what is in it: a bitmap is a PNG now.
  const file = `${one.name.replace(/\.[^.]*$/, '')}.${one.image.mime === 'image/jpeg' ? 'jpg' : one.image.mime.slice(6)}`;
  const names = [record('FileName', [text(file)]), record('RelativeFilename', [text(file)])];
  let video = videos.get(one);
  if (video === undefined) {
    video = document.add('Video', named(one.name, 'Video'), 'Clip', [
      record('Type', [text('Clip')]),
      properties(property('Path', ['KString', 'XRefUrl', ''], text(file))),
      record('UseMipMap', [int(0)]),
      ...names,
      record('Content', [raw(one.image.bytes)]),
    ]);
    videos.set(one, video);
  }
  const texture = document.add('Texture', named(one.name, 'Texture'), '', [
    record('Type', [text('TextureVideoClip')]),
    record('Version', [int(202)]),
    record('TextureName', [named(one.name, 'Texture')]),
    record('Media', [named(one.name, 'Video')]),
    ...names,
    properties(property('UVSet', ['KString', '', ''], text('default'))),
  ]);
  document.connect(video, texture);
  document.connect(texture, material, 'DiffuseColor');
}

/** Where joints are when a skin is bound, and which node shows each. */
export interface Bones {
  /** Node of each joint, and last of one that never moves; -1 if there is none. */
  readonly ids: readonly number[];
  readonly names: readonly string[];
  /** World matrices at rest of each of them, 16 numbers each. */
  readonly worlds: Float64Array;
}

/** Adds a cluster for each joint that moves a vertex, and the pose of that moment. */
export function addSkin(
  document: FbxDocument,
  skin: Skin,
  { sets, geometry, model }: { readonly sets: AttachmentSets; readonly geometry: number; readonly model: number },
  bones: Bones,
): void {
  const deformer = document.add('Deformer', named(skin.name, 'Deformer'), 'Skin', [
    record('Version', [int(101)]),
    record('Link_DeformAcuracy', [double(50)]),
    record('SkinningType', [text('Linear')]),
  ]);
  document.connect(deformer, geometry);
  const compiled = compileSkin(skin);
  const poses = new Map<number, Float64Array<ArrayBuffer>>([[model, identity()]]);
  clustersOf(sets, bones.ids.length).forEach(({ vertices, weights }, joint) => {
    if (bones.ids[joint] < 0) return;
    const link = bones.worlds.slice(16 * joint, 16 * joint + 16);
    const toJoint = new Float64Array(16);
    if (isBound(compiled, joint, bones.ids.length)) {
      toJoint.set(compiled.inverseBindings.subarray(16 * joint, 16 * joint + 16));
      const own = skin.bindings.subarray(16 * joint, 16 * joint + 16);
      // As the skin is deformed here: without a usable binding, none is undone.
      link.set(own.length && !isSingular(own) ? own : identity());
    } else invertAffine(link, 0, toJoint, 0);
    poses.set(bones.ids[joint], link);
    if (vertices.length === 0) return;
    const cluster = document.add('Deformer', named(bones.names[joint], 'SubDeformer'), 'Cluster', [
      record('Version', [int(100)]),
      record('UserData', [text(''), text('')]),
      record('Indexes', [array(Int32Array.from(vertices))]),
      record('Weights', [array(Float64Array.from(weights))]),
      record('Transform', [array(toJoint)]),
      record('TransformLink', [array(link)]),
    ]);
    document.connect(cluster, deformer);
    document.connect(bones.ids[joint], cluster);
  });
  document.add('Pose', named('BIND_POSES', 'Pose'), 'BindPose', [
    record('Type', [text('BindPose')]),
    record('Version', [int(100)]),
    record('NbPoseNodes', [int(poses.size)]),
    ...[...poses].map(([id, matrix]) =>
      record('PoseNode', [], [record('Node', [long(id)]), record('Matrix', [array(matrix)])]),
    ),
  ]);
}

/** Whether the skin says where a joint was when it was bound; the last bone is none of its joints. */
function isBound({ matrixCount }: CompiledSkin, joint: number, count: number): boolean {
  return joint < matrixCount && joint < count - 1;
}

function identity(): Float64Array<ArrayBuffer> {
  const matrix = new Float64Array(16);
  setIdentity(matrix, 0);
  return matrix;
}

interface Cluster {
  readonly vertices: number[];
  readonly weights: number[];
}

function clustersOf({ joints, weights }: AttachmentSets, count: number): readonly Cluster[] {
  const clusters = Array.from({ length: count }, (): Cluster => ({ vertices: [], weights: [] }));
  const vertices = joints[0].length / 4;
  for (let v = 0; v < vertices; v++) {
    for (let set = 0; set < joints.length; set++) {
      for (let k = 4 * v; k < 4 * v + 4; k++) {
        if (!(weights[set][k] > 0)) continue;
        clusters[joints[set][k]].vertices.push(v);
        clusters[joints[set][k]].weights.push(weights[set][k]);
      }
    }
  }
  return clusters;
}

/** Adds morphs as shapes. @returns the id of each one's channel */
export function addShapes(
  document: FbxDocument,
  skin: Skin,
  morphs: readonly Morph[],
  geometry: number,
  weights: readonly number[],
): readonly number[] {
  if (morphs.length === 0) return [];
  const blend = document.add('Deformer', named(skin.name, 'Deformer'), 'BlendShape', [record('Version', [int(100)])]);
  document.connect(blend, geometry);
  const normals = normalsOf(skin);
  return morphs.map((morph, m) => {
    const positions = positionDifferences(morph, skin);
    const turned = normalDifferences(morph, normals);
    // One list of points for both.
    const points = [...new Set([...positions.indices, ...turned.indices])].sort((a, b) => a - b);
    const percent = 100 * weights[m];
    const channel = document.add('Deformer', named(morph.name, 'SubDeformer'), 'BlendShapeChannel', [
      record('Version', [int(100)]),
      record('DeformPercent', [double(percent)]),
      record('FullWeights', [array(Float64Array.of(100))]),
      properties(numberProperty('DeformPercent', percent)),
    ]);
    document.connect(channel, blend);
    const shape = document.add('Geometry', named(morph.name, 'Geometry'), 'Shape', [
      record('Version', [int(100)]),
      record('Indexes', [array(Int32Array.from(points))]),
      record('Vertices', [array(spread(positions, points))]),
      record('Normals', [array(spread(turned, points))]),
    ]);
    document.connect(shape, channel);
    return channel;
  });
}

/** Differences for a list of points, 0 for those that have none. */
function spread({ indices, values }: MorphDifferences, points: readonly number[]): Float64Array<ArrayBuffer> {
  const at = new Map(points.map((point, i) => [point, i]));
  const out = new Float64Array(3 * points.length);
  indices.forEach((index, row) => {
    const i = at.get(index) ?? 0;
    for (let k = 0; k < 3; k++) out[3 * i + k] = values[3 * row + k];
  });
  return out;
}
