/**
 * Makes a surface of a mesh: duplicate vertices, from seams of textures or hard edges, are merged, and connected
 * triangles form parts. Heat flows only within a part.
 */
import type { Steps } from '../steps.ts';

/** A mesh whose duplicate vertices are merged, with its connected parts. */
export interface WeldedMesh {
  /** For each vertex of the mesh, its vertex here. */
  readonly of: Uint32Array;
  readonly vertexCount: number;
  /** x y z per vertex. */
  readonly positions: Float64Array;
  /** Three vertices per triangle, all different. */
  readonly triangles: Uint32Array;
  /** For each vertex here. */
  readonly parts: Uint32Array;
  readonly partCount: number;
  /** Diagonal of the box around all vertices. */
  readonly diagonal: number;
}

/** Distance, as a fraction of the mesh's diagonal, below which positions are the same: covers rounded decimals. */
const SAME_PLACE = 1e-6;

/** Vertices or triangles between two yields. */
const A_STEP = 5000;

/** Yields its progress every few milliseconds. */
export function* weld(positions: Float64Array, triangles: Uint32Array): Steps<WeldedMesh> {
  const diagonal = diagonalOf(positions);
  const { of, firsts } = yield* samePlaces(positions, SAME_PLACE * diagonal);
  const welded = new Float64Array(3 * firsts.length);
  firsts.forEach((vertex, i) => {
    for (let k = 0; k < 3; k++) welded[3 * i + k] = positions[3 * vertex + k];
  });
  const kept = new Uint32Array(triangles.length);
  let count = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = of[triangles[t]];
    const b = of[triangles[t + 1]];
    const c = of[triangles[t + 2]];
    if (a === b || b === c || c === a) continue;
    kept[count] = a;
    kept[count + 1] = b;
    kept[count + 2] = c;
    count += 3;
  }
  const own = kept.slice(0, count);
  yield 0.8;
  return {
    of,
    vertexCount: firsts.length,
    positions: welded,
    triangles: own,
    diagonal,
    ...(yield* partsOf(firsts.length, own)),
  };
}

interface Places {
  readonly of: Uint32Array;
  readonly firsts: readonly number[];
}

/**
 * Uses a grid of cells that are large compared with the tolerance: a vertex is searched in its own cell, and in
 * neighbours within the tolerance.
 */
function* samePlaces(positions: Float64Array, tolerance: number): Steps<Places> {
  const count = positions.length / 3;
  const of = new Uint32Array(count);
  const firsts: number[] = [];
  const cell = 8 * tolerance || 1;
  const size = 2 ** Math.ceil(Math.log2(2 * count + 2));
  /** Linked lists of welded vertices by cell: index plus one; 0 ends. */
  const heads = new Uint32Array(size);
  const next = new Uint32Array(count);
  const slot = (x: number, y: number, z: number) =>
    (Math.imul(x | 0, 73856093) ^ Math.imul(y | 0, 19349663) ^ Math.imul(z | 0, 83492791)) & (size - 1);
  const find = (x: number, y: number, z: number): number => {
    const toX = Math.floor((x + tolerance) / cell);
    const toY = Math.floor((y + tolerance) / cell);
    const toZ = Math.floor((z + tolerance) / cell);
    for (let i = Math.floor((x - tolerance) / cell); i <= toX; i++) {
      for (let j = Math.floor((y - tolerance) / cell); j <= toY; j++) {
        for (let k = Math.floor((z - tolerance) / cell); k <= toZ; k++) {
          for (let entry = heads[slot(i, j, k)]; entry > 0; entry = next[entry - 1]) {
            const o = 3 * firsts[entry - 1];
            const dx = positions[o] - x;
            const dy = positions[o + 1] - y;
            const dz = positions[o + 2] - z;
            if (dx * dx + dy * dy + dz * dz <= tolerance * tolerance) return entry - 1;
          }
        }
      }
    }
    return -1;
  };
  for (let v = 0; v < count; v++) {
    if (v % A_STEP === 0) yield (0.7 * v) / count;
    const x = positions[3 * v];
    const y = positions[3 * v + 1];
    const z = positions[3 * v + 2];
    const found = find(x, y, z);
    if (found >= 0) {
      of[v] = found;
      continue;
    }
    const s = slot(Math.floor(x / cell), Math.floor(y / cell), Math.floor(z / cell));
    firsts.push(v);
    next[firsts.length - 1] = heads[s];
    heads[s] = firsts.length;
    of[v] = firsts.length - 1;
  }
  return { of, firsts };
}

/** Parts connected by triangles, numbered in vertex order. */
function* partsOf(vertexCount: number, triangles: Uint32Array): Steps<Pick<WeldedMesh, 'parts' | 'partCount'>> {
  const root = Uint32Array.from({ length: vertexCount }, (_, v) => v);
  const rootOf = (vertex: number) => {
    let v = vertex;
    while (root[v] !== v) {
      root[v] = root[root[v]];
      v = root[v];
    }
    return v;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const a = rootOf(triangles[t]);
    root[rootOf(triangles[t + 1])] = a;
    root[rootOf(triangles[t + 2])] = a;
  }
  yield 0.9;
  const parts = new Uint32Array(vertexCount);
  const number = new Int32Array(vertexCount).fill(-1);
  let partCount = 0;
  for (let v = 0; v < vertexCount; v++) {
    const r = rootOf(v);
    if (number[r] < 0) number[r] = partCount++;
    parts[v] = number[r];
  }
  return { parts, partCount };
}

function diagonalOf(positions: Float64Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let o = 0; o < positions.length; o += 3) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], positions[o + k]);
      high[k] = Math.max(high[k], positions[o + k]);
    }
  }
  return positions.length ? Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
}
