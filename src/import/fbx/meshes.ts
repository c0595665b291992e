/** The meshes of an FBX scene: placed, skinned and with their blend shapes, as meshes of the scene. */
import { quaternionOfEuler } from '../../math/euler.ts';
import { inverseTranspose3, invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { writeRotation } from '../../math/quaternion.ts';
import { ZERO } from '../../math/vec3.ts';
import type { MorphRows } from '../../model/morph.ts';
import type { Attachments } from '../../model/skin.ts';
import type { SceneMesh, SceneSkin, SceneSkinned, SceneTarget } from '../scene.ts';
import type { FbxDocument, FbxObject } from './document.ts';
import type { FbxReport } from './failure.ts';
import { type FbxMesh, meshOf } from './geometry.ts';
import type { FbxJoint } from './joints.ts';
import type { Materials } from './materials.ts';
import { inRadians } from './nodes.ts';
import { Effort } from './polygons.ts';
import { channelsOf, type FbxChannel, shapeWeight } from './shapes.ts';
import { boundOf, type FbxSkin, isNear, skinsOf } from './skins.ts';

/** A mesh, and the channels whose shapes are its targets: `shape` of `channel` for each. */
export interface BuiltMesh {
  readonly mesh: SceneMesh;
  readonly sources: readonly { readonly channel: FbxChannel; readonly shape: number }[];
}

/** The data that meshes are made from. */
export interface MeshSource {
  readonly document: FbxDocument;
  readonly joints: readonly FbxJoint[];
  /** 16 numbers per node at rest, in the file's axes. */
  readonly worlds: Float64Array;
  /** From the file's axes to those of the scene. */
  readonly axes: Float64Array;
  readonly materials: Materials;
  readonly lost: Set<string>;
}

/** All meshes, in the order of their nodes. */
export function meshesOf(source: MeshSource, report: FbxReport): BuiltMesh[] {
  const { document, joints, lost } = source;
  const indices = new Map(joints.map(({ node }, i) => [node.object.id, i]));
  const skins = new Skins();
  const effort = new Effort();
  const read = new Map<number, FbxMesh>();
  return joints.flatMap(({ node: { object } }, i) =>
    document.partsOf(object.id).flatMap(({ object: geometry }) => {
      if (geometry.kind !== 'Geometry') return [];
      if (geometry.type !== 'Mesh') {
        lost.add(`shapes of type ${geometry.type || 'unnamed'}`);
        return [];
      }
      const mesh = read.get(geometry.id) ?? meshOf(geometry.record, report, effort);
      read.set(geometry.id, mesh);
      if (mesh.vertexPoints.length === 0) return [];
      if (mesh.hasColors) lost.add('vertex colours');
      if (mesh.texcoordSets > 1) lost.add('texture coordinate sets after the first');
      // A mesh may be on many models.
      report.budget.spend(PER_MESH + PER_VERTEX * mesh.vertexPoints.length, 'A mesh');
      return [built(source, skins, i, geometry, mesh, (id) => indices.get(id) ?? -1)];
    }),
  );
}

function built(
  { document, joints, worlds, axes, materials, lost }: MeshSource,
  skins: Skins,
  index: number,
  geometry: FbxObject,
  mesh: FbxMesh,
  nodeOf: (id: number) => number,
): BuiltMesh {
  const { object } = joints[index].node;
  const all = skinsOf(document, geometry, nodeOf).filter(({ clusters }) => clusters.length > 0);
  if (all.length > 1) lost.add('skins of a mesh after the first');
  if (all.some(({ method }) => method === 'DualQuaternion' || method === 'Blend')) {
    lost.add('dual quaternion skinning (linear skinning is used)');
  }
  const place = geometricMatrix(object);
  const skin = all.at(0);
  let skinned: SceneSkinned | undefined;
  if (skin) {
    const made = bind(skin, { mesh, index }, joints, worlds, axes, skins);
    skinned = made.skinned;
    const own = place.slice();
    multiplyAffine(made.place, 0, own, 0, place, 0);
  }
  const positions = moved(mesh.points, mesh.vertexPoints, place);
  const normals = mesh.normals && turned(mesh.normals, place);
  const slots = materials.of(object);
  const channels = channelsOf(document, geometry);
  const sources = channels.flatMap((channel) => channel.shapes.map((_, shape) => ({ channel, shape })));
  return {
    mesh: {
      name: object.name,
      node: joints[index].at,
      positions,
      ...(normals && { normals }),
      ...(mesh.texcoords && { texcoords: mesh.texcoords }),
      surfaces: [...mesh.slots].map(([slot, triangles]) => ({
        material: slots.length === 0 ? -1 : slots[Math.min(slot, slots.length - 1)],
        triangles,
      })),
      ...(skinned && { skinned }),
      targets: targetsOf(channels, mesh, place, normals),
    },
    sources,
  };
}

/** Numbers of a mesh on a node beside its vertices, and of each of these. */
const PER_MESH = 500;
const PER_VERTEX = 16;

const ONE = [1, 1, 1] as const;

/** The matrix that is applied to the points of a node only: geometric translation, rotation and scaling. */
function geometricMatrix({ properties }: FbxObject): Float64Array {
  const q = new Float64Array(4);
  const [x, y, z] = inRadians(properties.vector('GeometricRotation', ZERO));
  quaternionOfEuler(x / 2, y / 2, z / 2, q, 0);
  const matrix = new Float64Array(16);
  writeRotation(q[0], q[1], q[2], q[3], matrix, 0, 4);
  const scale = properties.vector('GeometricScaling', ONE);
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) matrix[4 * c + r] *= scale[c];
  matrix.set(properties.vector('GeometricTranslation', ZERO), 12);
  matrix[15] = 1;
  return matrix;
}

function moved(points: Float64Array, vertices: Uint32Array, m: Float64Array): Float64Array {
  const out = new Float64Array(3 * vertices.length);
  for (let v = 0; v < vertices.length; v++) writeMoved(points, 3 * vertices[v], m, out, 3 * v);
  return out;
}

function writeMoved(from: ArrayLike<number>, at: number, m: Float64Array, out: Float64Array, o: number): void {
  const x = from[at];
  const y = from[at + 1];
  const z = from[at + 2];
  for (let k = 0; k < 3; k++) out[o + k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k];
}

/** Normals, of length 1 where they have a direction. */
function turned(normals: Float64Array, m: Float64Array): Float64Array {
  const turn = new Float64Array(9);
  inverseTranspose3(m, 0, turn, 0);
  const out = new Float64Array(normals.length);
  for (let o = 0; o < normals.length; o += 3) {
    const x = normals[o];
    const y = normals[o + 1];
    const z = normals[o + 2];
    for (let k = 0; k < 3; k++) out[o + k] = turn[k] * x + turn[3 + k] * y + turn[6 + k] * z;
    const length = Math.hypot(out[o], out[o + 1], out[o + 2]);
    if (length > 0) for (let k = 0; k < 3; k++) out[o + k] /= length;
  }
  return out;
}

interface Binding {
  readonly skinned: SceneSkinned;
  readonly place: Float64Array;
}

function bind(
  { clusters }: FbxSkin,
  { mesh, index }: { readonly mesh: FbxMesh; readonly index: number },
  joints: readonly FbxJoint[],
  worlds: Float64Array,
  axes: Float64Array,
  skins: Skins,
): Binding {
  const { place: own, inverses } = boundOf(clusters, index, worlds);
  const place = new Float64Array(16);
  multiplyAffine(axes, 0, own, 0, place, 0);
  const back = new Float64Array(16);
  invertAffine(axes, 0, back, 0);
  const binds = clusters.map(({ node }, c) => {
    const inverse = new Float64Array(16);
    multiplyAffine(inverses, 16 * c, back, 0, inverse, 0);
    return { node: joints[node].at, inverse };
  });
  const points = attachedPoints(clusters, mesh.points.length / 3);
  // Vertices without weights hang on the mesh's own node.
  if (points.hasOwn) {
    const inverse = new Float64Array(16);
    if (isSingular(place)) setIdentity(inverse);
    else invertAffine(place, 0, inverse, 0);
    binds.push({ node: joints[index].at, inverse });
  }
  const { skin, at } = skins.add(binds);
  return { skinned: { skin, attachments: attachmentsOf(mesh.vertexPoints, points, at) }, place };
}

/** Clusters and weights of points: those of point i from `start[i]` to `start[i + 1]`. Weights sum to 1. */
interface AttachedPoints {
  readonly start: Uint32Array;
  readonly clusters: Uint32Array;
  readonly weights: Float64Array;
  /** Whether points without weights have one of a cluster after the last. */
  readonly hasOwn: boolean;
}

function attachedPoints(clusters: FbxSkin['clusters'], count: number): AttachedPoints {
  const start = new Uint32Array(count + 1);
  eachWeight(clusters, count, (point) => start[point + 1]++);
  let hasOwn = false;
  for (let point = 0; point < count; point++) {
    if (start[point + 1] === 0) {
      start[point + 1] = 1;
      hasOwn = true;
    }
    start[point + 1] += start[point];
  }
  const own = new Uint32Array(start[count]).fill(clusters.length);
  const weights = new Float64Array(start[count]);
  const next = start.slice();
  eachWeight(clusters, count, (point, cluster, weight) => {
    own[next[point]] = cluster;
    weights[next[point]++] = weight;
  });
  for (let point = 0; point < count; point++) {
    const [from, to] = [start[point], start[point + 1]];
    if (own[from] === clusters.length) {
      weights[from] = 1;
      continue;
    }
    let sum = 0;
    for (let i = from; i < to; i++) sum += weights[i];
    for (let i = from; i < to; i++) weights[i] /= sum;
  }
  return { start, clusters: own, weights, hasOwn };
}

/** Calls a function with each weight of a point, in the order of the clusters. */
function eachWeight(
  clusters: FbxSkin['clusters'],
  count: number,
  use: (point: number, cluster: number, weight: number) => void,
): void {
  for (let c = 0; c < clusters.length; c++) {
    const { points, weights } = clusters[c];
    const length = Math.min(points.length, weights.length);
    for (let i = 0; i < length; i++) {
      const [point, weight] = [points[i], weights[i]];
      if (point >= 0 && point < count && weight > 0 && Number.isFinite(weight)) use(point, c, weight);
    }
  }
}

/** @param at the joint of the skin for each cluster */
function attachmentsOf(vertices: Uint32Array, points: AttachedPoints, at: readonly number[]): Attachments {
  const start = new Uint32Array(vertices.length + 1);
  for (let v = 0; v < vertices.length; v++) {
    start[v + 1] = start[v] + points.start[vertices[v] + 1] - points.start[vertices[v]];
  }
  const joints = new Uint32Array(start[vertices.length]);
  const weights = new Float64Array(joints.length);
  let o = 0;
  for (const point of vertices) {
    for (let i = points.start[point]; i < points.start[point + 1]; i++) {
      joints[o] = at[points.clusters[i]];
      weights[o++] = points.weights[i];
    }
  }
  return { start, joints, weights };
}

/** A joint of a skin: its node, and 16 numbers from the vertices to it. */
interface Bind {
  readonly node: number;
  readonly inverse: Float64Array;
}

/** The skins of a file: one for all meshes, unless they were bound to different poses of a joint. */
class Skins {
  private readonly all: { readonly binds: Bind[]; readonly skin: { joints: number[]; inverseBinds: Float64Array } }[] =
    [];

  /** The skin that holds these, and where. */
  add(binds: readonly Bind[]): { skin: SceneSkin; at: number[] } {
    const fits = (held: readonly Bind[]) =>
      binds.every(({ node, inverse }) => held.every((own) => own.node !== node || isNear(own.inverse, inverse)));
    let home = this.all.find(({ binds: held }) => fits(held));
    if (!home) {
      home = { binds: [], skin: { joints: [], inverseBinds: new Float64Array(0) } };
      this.all.push(home);
    }
    const { binds: held, skin } = home;
    const at = binds.map((bind) => {
      const known = held.findIndex(({ node }) => node === bind.node);
      return known >= 0 ? known : held.push(bind) - 1;
    });
    skin.joints = held.map(({ node }) => node);
    skin.inverseBinds = Float64Array.from(held.flatMap(({ inverse }) => [...inverse]));
    return { skin, at };
  }
}

/** A target per shape. */
function targetsOf(
  channels: readonly FbxChannel[],
  mesh: FbxMesh,
  place: Float64Array,
  normals: Float64Array | undefined,
): SceneTarget[] {
  if (channels.length === 0) return [];
  const vertices = verticesOf(mesh);
  return channels.flatMap(({ name, shapes, percent }) =>
    shapes.map((shape, s) => ({
      name: shapes.length === 1 ? name : `${name}_${shape.name || s + 1}`,
      positions: rowsOf(vertices, shape.points, shape.offsets, (point, offset, values, o) => {
        const at = [0, 1, 2].map((k) => mesh.points[3 * point + k] + offset[k]);
        writeMoved(at, 0, place, values, o);
      }),
      normals: normals && mesh.normals ? normalRows(vertices, shape, mesh.normals, place) : NO_ROWS,
      weight: shapeWeight(shapes, s, percent),
    })),
  );
}

const NO_ROWS: MorphRows = { indices: new Uint32Array(0), values: new Float64Array(0) };

function verticesOf({ points, vertexPoints }: FbxMesh): number[][] {
  const vertices: number[][] = Array.from({ length: points.length / 3 }, () => []);
  for (const [v, point] of vertexPoints.entries()) vertices[point].push(v);
  return vertices;
}

type WriteRow = (point: number, offset: readonly number[], values: Float64Array, o: number, vertex: number) => void;

/** Rows for all vertices of the points that have an offset. */
function rowsOf(
  vertices: readonly number[][],
  points: ArrayLike<number>,
  offsets: ArrayLike<number>,
  write: WriteRow,
): MorphRows {
  const indices: number[] = [];
  const listed = new Map<number, number>();
  for (let i = 0; i < points.length && 3 * i + 2 < offsets.length; i++) {
    if (vertices[points[i]]) listed.set(points[i], i);
  }
  for (const point of listed.keys()) for (const vertex of vertices[point]) indices.push(vertex);
  const values = new Float64Array(3 * indices.length);
  let o = 0;
  for (const [point, i] of listed) {
    const offset = [0, 1, 2].map((k) => (Number.isFinite(offsets[3 * i + k]) ? offsets[3 * i + k] : 0));
    for (const vertex of vertices[point]) {
      write(point, offset, values, o, vertex);
      o += 3;
    }
  }
  return { indices: Uint32Array.from(indices), values };
}

function normalRows(
  vertices: readonly number[][],
  { points, normals }: { readonly points: ArrayLike<number>; readonly normals: ArrayLike<number> },
  base: Float64Array,
  place: Float64Array,
): MorphRows {
  const isUsed = Array.from(normals).some((value) => value !== 0);
  if (!isUsed) return NO_ROWS;
  const rows = rowsOf(vertices, points, normals, (_, offset, values, o, vertex) => {
    for (let k = 0; k < 3; k++) values[o + k] = base[3 * vertex + k] + offset[k];
  });
  return { indices: rows.indices, values: turned(rows.values, place) };
}
