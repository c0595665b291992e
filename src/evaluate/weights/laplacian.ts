/**
 * The Laplace operator of a surface, as a symmetric matrix with a row per vertex:
 *
 *     (L·w)ᵢ = Σⱼ cᵢⱼ (wᵢ − wⱼ)          cᵢⱼ = (cot α + cot β) / 2 over the triangles at the edge, clamped above 0
 *
 * and the area around each vertex, a third of that of its triangles. Cotangents may be negative for obtuse triangles;
 * clamping them keeps all weights in 0 … 1, whatever the mesh (Wardetzky et al. 2007 show that no discretisation has
 * all desirable properties). Rows are stored compressed, without the diagonal.
 */
import type { Steps } from '../steps.ts';
import type { WeldedMesh } from './weld.ts';

/** The Laplace operator of a mesh as a sparse symmetric matrix, with the areas around its vertices. */
export interface Laplacian {
  /** Neighbours of vertex i: `columns[start[i]]` up to (excluding) `start[i + 1]`; ascending. */
  readonly start: Uint32Array;
  readonly columns: Uint32Array;
  /** cᵢⱼ for each neighbour; greater than 0. */
  readonly values: Float64Array;
  /** Σⱼ cᵢⱼ. */
  readonly diagonal: Float64Array;
  readonly areas: Float64Array;
}

const LEAST = 1e-2;
/** Maximum cotangent, for triangles without area. */
const MOST = 1e3;
/** Corners or vertices between two yields; a multiple of 3. */
const A_STEP = 6000;

/** Yields its progress every few milliseconds. */
export function* laplacian({ vertexCount, positions, triangles }: WeldedMesh): Steps<Laplacian> {
  const areas = new Float64Array(vertexCount);
  /** Row sizes while edges are listed once per triangle and direction. */
  const room = new Uint32Array(vertexCount + 1);
  for (let k = 0; k < triangles.length; k++) room[triangles[k] + 1] += 2;
  for (let v = 0; v < vertexCount; v++) room[v + 1] += room[v];
  const filled = room.slice(0, vertexCount);
  const neighbours = new Uint32Array(room[vertexCount]);
  const halves = new Float64Array(room[vertexCount]);
  const put = (i: number, j: number, half: number) => {
    neighbours[filled[i]] = j;
    halves[filled[i]++] = half;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    if (t % A_STEP === 0) yield (0.5 * t) / triangles.length;
    for (let k = 0; k < 3; k++) {
      const at = triangles[t + k];
      const i = triangles[t + ((k + 1) % 3)];
      const j = triangles[t + ((k + 2) % 3)];
      const half = cotangent(positions, at, i, j) / 2;
      put(i, j, half);
      put(j, i, half);
      areas[at] += doubleArea / 6;
    }
  }
  const start = new Uint32Array(vertexCount + 1);
  const columns = new Uint32Array(room[vertexCount]);
  const values = new Float64Array(room[vertexCount]);
  const diagonal = new Float64Array(vertexCount);
  /** Index of a neighbour in the current row, if present. */
  const place = new Int32Array(vertexCount).fill(-1);
  let end = 0;
  for (let i = 0; i < vertexCount; i++) {
    if (i % A_STEP === 0) yield 0.5 + (0.5 * i) / vertexCount;
    const from = end;
    // Short rows: insertion sort.
    for (let e = room[i]; e < room[i + 1]; e++) {
      const j = neighbours[e];
      if (place[j] >= from) continue;
      let at = end++;
      for (; at > from && columns[at - 1] > j; at--) columns[at] = columns[at - 1];
      columns[at] = j;
      place[j] = from;
    }
    for (let e = from; e < end; e++) place[columns[e]] = e;
    for (let e = room[i]; e < room[i + 1]; e++) values[place[neighbours[e]]] += halves[e];
    for (let e = from; e < end; e++) {
      values[e] = Math.max(LEAST, values[e]);
      diagonal[i] += values[e];
      place[columns[e]] = -1;
    }
    start[i + 1] = end;
  }
  return { start, columns: columns.slice(0, end), values: values.slice(0, end), diagonal, areas };
}

/** Twice the area of the triangle last passed to `cotangent`. */
let doubleArea = 0;

/** Cotangent of the angle at a vertex, between the sides to two others. */
function cotangent(p: Float64Array, at: number, i: number, j: number): number {
  const ax = p[3 * i] - p[3 * at];
  const ay = p[3 * i + 1] - p[3 * at + 1];
  const az = p[3 * i + 2] - p[3 * at + 2];
  const bx = p[3 * j] - p[3 * at];
  const by = p[3 * j + 1] - p[3 * at + 1];
  const bz = p[3 * j + 2] - p[3 * at + 2];
  const x = ay * bz - az * by;
  const y = az * bx - ax * bz;
  const z = ax * by - ay * bx;
  doubleArea = Math.sqrt(x * x + y * y + z * z);
  const dot = ax * bx + ay * by + az * bz;
  // No area: a degenerate triangle has infinite cotangents.
  if (Math.abs(dot) >= MOST * doubleArea) return dot > 0 ? MOST : -MOST;
  return dot / doubleArea;
}
