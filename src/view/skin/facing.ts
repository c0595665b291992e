/**
 * Which way a skin's triangles and normals face, made consistent for lighting: some real files wind all triangles
 * inward, or have stray normals that point inward.
 *
 *     triangles across an edge that only these two share are wound alike       (union-find, with the turn as parity)
 *     each such patch is wound so that Σ Nₜ · (n₁ + n₂ + n₃) ≥ 0             Nₜ: a triangle's area normal
 *     a vertex's normal is flipped where n · Σ Nₜ < 0                    over the triangles around it
 *
 * A triangle seen from behind is then seen from behind all its normals: the side never changes within a triangle. Only
 * signs change: normals stay the file's. Computed in the binding pose, valid in any pose.
 *
 * Rejected: deciding per pixel, which tears a triangle with one bad corner; the file's winding, which may differ from
 * triangle to triangle; recomputed normals, which lose the author's smoothing.
 */
import type { Steps } from '../../evaluate/steps.ts';
import { areaNormal } from '../../math/triangle.ts';

/** Triangles, vertices or edges between two yields: under a millisecond's work. */
const STRIDE = 16384;

export interface Facing {
  /** The same triangles, each with the same last corner; the given array if it is already consistent. */
  readonly triangles: Uint32Array;
  /** One number per vertex: 1 if its normal is to be flipped, else 0. */
  readonly turned: Float32Array<ArrayBuffer>;
}

/**
 * @param triangles three vertices each
 * @param positions x y z per vertex
 * @param normals x y z per vertex, of any length
 */
export function* facingOf(triangles: Uint32Array, positions: Float64Array, normals: Float64Array): Steps<Facing> {
  const vertices = positions.length / 3;
  const count = triangles.length / 3;
  const patches = yield* patchesOf(triangles, vertices);

  // Twice each triangle's area, times its normal.
  const area = new Float32Array(3 * count);
  const agreement = new Float64Array(count);
  const normal = new Float64Array(3);
  for (let t = 0; t < count; t++) {
    const a = 3 * triangles[3 * t];
    const b = 3 * triangles[3 * t + 1];
    const c = 3 * triangles[3 * t + 2];
    areaNormal(positions, a, b, c, normal);
    const x = normal[0];
    const y = normal[1];
    const z = normal[2];
    area[3 * t] = x;
    area[3 * t + 1] = y;
    area[3 * t + 2] = z;
    const root = patches.find(t);
    agreement[root] +=
      (patches.odd(t) ? -1 : 1) *
      (x * (normals[a] + normals[b] + normals[c]) +
        y * (normals[a + 1] + normals[b + 1] + normals[c + 1]) +
        z * (normals[a + 2] + normals[b + 2] + normals[c + 2]));
    if (t % STRIDE === STRIDE - 1) yield 0.7 + (0.1 * t) / count;
  }

  let wound: Uint32Array | undefined;
  const around = new Float32Array(3 * vertices);
  for (let t = 0; t < count; t++) {
    const sign = agreement[patches.find(t)] < 0 !== patches.odd(t) ? -1 : 1;
    if (sign < 0) {
      wound ??= triangles.slice();
      wound[3 * t] = triangles[3 * t + 1];
      wound[3 * t + 1] = triangles[3 * t];
    }
    for (let i = 3 * t; i < 3 * t + 3; i++) {
      const o = 3 * triangles[i];
      around[o] += sign * area[3 * t];
      around[o + 1] += sign * area[3 * t + 1];
      around[o + 2] += sign * area[3 * t + 2];
    }
    if (t % STRIDE === STRIDE - 1) yield 0.8 + (0.1 * t) / count;
  }

  const turned = new Float32Array(vertices);
  for (let v = 0; v < vertices; v++) {
    const o = 3 * v;
    const along = normals[o] * around[o] + normals[o + 1] * around[o + 1] + normals[o + 2] * around[o + 2];
    if (along < 0) turned[v] = 1;
    if (v % STRIDE === STRIDE - 1) yield 0.9 + (0.1 * v) / vertices;
  }
  return { triangles: wound ?? triangles, turned };
}

/** Union-find of triangles; each stores whether it is wound opposite to its patch's representative. */
class Patches {
  private readonly parent: Uint32Array;
  private readonly differs: Uint8Array;
  /** Union by rank, so that no `find` walks far. */
  private readonly height: Uint8Array;

  constructor(count: number) {
    // A plain loop: `from` with a function takes 50 ms for two million.
    this.parent = new Uint32Array(count);
    for (let t = 0; t < count; t++) this.parent[t] = t;
    this.differs = new Uint8Array(count);
    this.height = new Uint8Array(count);
  }

  /** The patch's representative; `odd` then says whether `t` is wound opposite to it. */
  find(t: number): number {
    const { parent, differs } = this;
    let root = t;
    let odd = 0;
    while (parent[root] !== root) {
      odd ^= differs[root];
      root = parent[root];
    }
    for (let at = t; at !== root; ) {
      const next = parent[at];
      const was = differs[at];
      parent[at] = root;
      differs[at] = odd;
      odd ^= was;
      at = next;
    }
    return root;
  }

  odd(t: number): boolean {
    return this.differs[t] === 1;
  }

  /** Joins two triangles' patches. If already joined with the other parity (a Möbius strip), nothing changes. */
  join(a: number, b: number, differ: boolean): void {
    const { parent, height } = this;
    let first = this.find(a);
    let second = this.find(b);
    if (first === second) return;
    if (height[first] < height[second]) [first, second] = [second, first];
    parent[second] = first;
    this.differs[second] = this.differs[a] ^ this.differs[b] ^ (differ ? 1 : 0);
    if (height[first] === height[second]) height[first]++;
  }
}

/** Edges are bucketed by their lower vertex, as in `edgesOf`, and matched within a bucket by the upper one. */
function* patchesOf(triangles: Uint32Array, vertices: number): Steps<Patches> {
  const all = triangles.length;
  const patches = new Patches(all / 3);
  const start = new Uint32Array(vertices + 1);
  for (let i = 0; i < all; i++) {
    start[Math.min(triangles[i], triangles[afterInTriangle(i)]) + 1]++;
    if (i % STRIDE === STRIDE - 1) yield (0.15 * i) / all;
  }
  for (let v = 0; v < vertices; v++) start[v + 1] += start[v];
  yield 0.15;
  const corner = new Uint32Array(all);
  const filled = start.slice(0, vertices);
  for (let i = 0; i < all; i++) {
    corner[filled[Math.min(triangles[i], triangles[afterInTriangle(i)])]++] = i;
    if (i % STRIDE === STRIDE - 1) yield 0.15 + (0.15 * i) / all;
  }
  // Per upper vertex, for edges of the current lower vertex: owner mark, count, and the last two edges.
  const mark = new Uint32Array(vertices);
  const times = new Uint32Array(vertices);
  const one = new Uint32Array(vertices);
  const other = new Uint32Array(vertices);
  for (let v = 0; v < vertices; v++) {
    for (let e = start[v]; e < start[v + 1]; e++) {
      const i = corner[e];
      const u = Math.max(triangles[i], triangles[afterInTriangle(i)]);
      if (mark[u] !== v + 1) {
        mark[u] = v + 1;
        times[u] = 0;
      }
      times[u]++;
      other[u] = one[u];
      one[u] = i;
    }
    for (let e = start[v]; e < start[v + 1]; e++) {
      const i = corner[e];
      const u = Math.max(triangles[i], triangles[afterInTriangle(i)]);
      // Edges of three triangles are ambiguous; those of degenerate triangles mean nothing.
      if (times[u] !== 2 || one[u] !== i || u === v) continue;
      const j = other[u];
      // Neighbours run along their edge in opposite directions. The two sides of a sheet share place and normals, so
      // they have to face the same way instead.
      const isSheet = triangles[afterInTriangle(afterInTriangle(i))] === triangles[afterInTriangle(afterInTriangle(j))];
      patches.join(Math.floor(i / 3), Math.floor(j / 3), (triangles[i] === triangles[j]) !== isSheet);
    }
    if (v % STRIDE === STRIDE - 1) yield 0.3 + (0.4 * v) / vertices;
  }
  yield 0.7;
  return patches;
}

/** The next of three consecutive indices that are a triangle. */
export function afterInTriangle(i: number): number {
  return i % 3 === 2 ? i - 2 : i + 1;
}
