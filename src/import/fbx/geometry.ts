/**
 * A mesh of an FBX file: points, polygons, and layers of normals, texture coordinates and materials, each by corner, by
 * point, by polygon or the same everywhere, and with or without indices.
 *
 * A vertex is a point with one normal and one pair of texture coordinates; a point on a seam becomes several.
 */
import type { FbxReport } from './failure.ts';
import { cutPolygon, type Effort } from './polygons.ts';
import { childOf, childrenOf, type FbxNumbers, type FbxRecord, numbersOf, textAt } from './records/record.ts';

/** A mesh as vertices and triangles, in the space of its model. */
export interface FbxMesh {
  /** x y z per point, as in the file. */
  readonly points: Float64Array;
  /** The point of each vertex. */
  readonly vertexPoints: Uint32Array;
  /** x y z per vertex. */
  readonly normals?: Float64Array;
  /** u v per vertex; v points up. */
  readonly texcoords?: Float64Array;
  /** Three vertices per triangle, for each slot of the materials of the model. */
  readonly slots: ReadonlyMap<number, Uint32Array>;
  readonly hasColors: boolean;
  readonly texcoordSets: number;
}

const NOTHING = new Float64Array(0);

/** Numbers that a point and a corner of a polygon become: a vertex each, with its normal, its place in the texture, triangles. */
const PER_POINT = 12;
const PER_CORNER = 12;

/**
 * Reads a mesh from its record.
 * @param effort that cutting polygons may take
 */
export function meshOf(record: FbxRecord, report: FbxReport, effort: Effort): FbxMesh {
  const points = finitePoints(numbersOf(childOf(record, 'Vertices')));
  const corners = numbersOf(childOf(record, 'PolygonVertexIndex'));
  report.budget.spend(PER_POINT * (points.length / 3) + PER_CORNER * corners.length, 'A mesh');
  const normals = layerOf(record, 'LayerElementNormal', 'Normals', 'NormalsIndex', 3);
  const texcoords = layerOf(record, 'LayerElementUV', 'UV', 'UVIndex', 2);
  const materials = materialLayer(record);
  const vertices = new Vertices(points.length / 3, normals !== undefined, texcoords !== undefined);
  const slots = new Map<number, number[]>();
  // Of one polygon: its points, its vertices, and three of its corners per triangle.
  const own: number[] = [];
  const made: number[] = [];
  const cut: number[] = [];
  let skipped = 0;
  let polygon = 0;
  for (let start = 0; start < corners.length; polygon++) {
    let end = start;
    while (end < corners.length && corners[end] >= 0) end++;
    end = Math.min(end + 1, corners.length);
    own.length = made.length = end - start;
    let isMissing = false;
    for (let i = 0; i < own.length; i++) {
      const corner = corners[start + i];
      own[i] = corner < 0 ? ~corner : corner;
      if (3 * own[i] >= points.length) isMissing = true;
    }
    if (isMissing) skipped++;
    else if (own.length > 2) {
      for (let i = 0; i < own.length; i++) {
        made[i] = vertices.at(own[i], normals, texcoords, start + i, polygon);
      }
      const slot = materials(polygon);
      const triangles = slots.get(slot) ?? [];
      slots.set(slot, triangles);
      cut.length = 0;
      cutPolygon(points, own, cut, effort);
      for (const corner of cut) triangles.push(made[corner]);
    }
    start = end;
  }
  if (skipped > 0) {
    const what = skipped === 1 ? 'A polygon has' : `${skipped} polygons have`;
    report.warn(
      'bad-index',
      `${what} corners that refer to missing points; there are ${points.length / 3}.`,
      record.offset,
      'left out',
    );
  }
  vertices.addUnused();
  return {
    points,
    vertexPoints: Uint32Array.from(vertices.points),
    ...(normals && { normals: Float64Array.from(vertices.normals) }),
    ...(texcoords && { texcoords: Float64Array.from(vertices.texcoords) }),
    slots: new Map([...slots].map(([slot, triangles]) => [slot, Uint32Array.from(triangles)])),
    hasColors: childOf(record, 'LayerElementColor') !== undefined,
    texcoordSets: childrenOf(record, 'LayerElementUV').length,
  };
}

/** Whole points only, and 0 for what is not a number. */
function finitePoints(numbers: FbxNumbers): Float64Array {
  const count = 3 * Math.floor(numbers.length / 3);
  const out = new Float64Array(count);
  for (let i = 0; i < count; i++) out[i] = Number.isFinite(numbers[i]) ? numbers[i] : 0;
  return out;
}

/** Values of corners: at what index a corner's are, given the corner, its point and its polygon; -1 for none. */
interface Layer {
  readonly values: FbxNumbers;
  readonly width: number;
  indexOf(corner: number, point: number, polygon: number): number;
}

/** The first layer of a kind; undefined if there is none, or none that can be used. */
function layerOf(
  mesh: FbxRecord,
  kind: string,
  valuesName: string,
  indicesName: string,
  width: number,
): Layer | undefined {
  const record = childOf(mesh, kind);
  const values = numbersOf(childOf(record, valuesName));
  const by = mappingOf(record);
  if (!by || values.length < width) return undefined;
  const hasIndices = (textAt(childOf(record, 'ReferenceInformationType')) ?? 'Direct') !== 'Direct';
  const indices = hasIndices ? numbersOf(childOf(record, indicesName)) : undefined;
  // Files exist that say they have indices and have none.
  const own = indices && indices.length > 0 ? indices : undefined;
  return {
    values,
    width,
    indexOf(corner, point, polygon) {
      const at = by(corner, point, polygon);
      const index = own ? (at < own.length ? own[at] : -1) : at;
      return index >= 0 && (index + 1) * width <= values.length ? index : -1;
    },
  };
}

function mappingOf(
  record: FbxRecord | undefined,
): ((corner: number, point: number, polygon: number) => number) | undefined {
  switch (textAt(childOf(record, 'MappingInformationType'))) {
    case 'ByPolygonVertex':
      return (corner) => corner;
    case 'ByVertex':
    case 'ByVertice':
      return (_, point) => point;
    case 'ByPolygon':
      return (_, __, polygon) => polygon;
    case 'AllSame':
      return () => 0;
    default:
      return undefined;
  }
}

/** The slot of a polygon's material: its place in the list of the model; 0 if the file says nothing. */
function materialLayer(mesh: FbxRecord): (polygon: number) => number {
  const record = childOf(mesh, 'LayerElementMaterial');
  const slots = record ? numbersOf(childOf(record, 'Materials')) : NOTHING;
  const isByPolygon = textAt(childOf(record, 'MappingInformationType')) === 'ByPolygon';
  return (polygon) => Math.max(0, slots[isByPolygon ? polygon : 0] ?? 0);
}

/** Normals that differ by less are the same: exporters round those of one point differently. */
const SAME_NORMAL = 1e-6;

/** Vertices of one point that a corner is compared with: some points have thousands. */
const MAX_COMPARED = 256;

/** Vertices by point: a chain of those that each point has become. */
class Vertices {
  readonly points: number[] = [];
  readonly normals: number[] = [];
  readonly texcoords: number[] = [];
  private readonly first: Int32Array;
  private readonly next: number[] = [];

  constructor(
    pointCount: number,
    private readonly hasNormals: boolean,
    private readonly hasTexcoords: boolean,
  ) {
    this.first = new Int32Array(pointCount).fill(-1);
  }

  /** The vertex of a corner, an earlier one if it is equal. */
  at(point: number, normals: Layer | undefined, texcoords: Layer | undefined, corner: number, polygon: number): number {
    const n = normals?.indexOf(corner, point, polygon) ?? -1;
    const t = texcoords?.indexOf(corner, point, polygon) ?? -1;
    const x = read(normals, n, 0);
    const y = read(normals, n, 1);
    const z = read(normals, n, 2);
    const u = read(texcoords, t, 0);
    const v = read(texcoords, t, 1);
    let compared = 0;
    for (let vertex = this.first[point]; vertex >= 0 && compared < MAX_COMPARED; vertex = this.next[vertex]) {
      compared++;
      const isSame =
        (!this.hasNormals ||
          (Math.abs(this.normals[3 * vertex] - x) <= SAME_NORMAL &&
            Math.abs(this.normals[3 * vertex + 1] - y) <= SAME_NORMAL &&
            Math.abs(this.normals[3 * vertex + 2] - z) <= SAME_NORMAL)) &&
        (!this.hasTexcoords || (this.texcoords[2 * vertex] === u && this.texcoords[2 * vertex + 1] === v));
      if (isSame) return vertex;
    }
    return this.add(point, x, y, z, u, v);
  }

  /** Points without a polygon stay, too: a deformer may count them. */
  addUnused(): void {
    for (let point = 0; point < this.first.length; point++) {
      if (this.first[point] < 0) this.add(point, 0, 0, 0, 0, 0);
    }
  }

  private add(point: number, x: number, y: number, z: number, u: number, v: number): number {
    const vertex = this.points.length;
    this.points.push(point);
    if (this.hasNormals) this.normals.push(x, y, z);
    if (this.hasTexcoords) this.texcoords.push(u, v);
    this.next.push(this.first[point]);
    this.first[point] = vertex;
    return vertex;
  }
}

function read(layer: Layer | undefined, index: number, k: number): number {
  if (!layer || index < 0 || k >= layer.width) return 0;
  const value = layer.values[index * layer.width + k];
  return Number.isFinite(value) ? value : 0;
}
