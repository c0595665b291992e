/**
 * Finds the triangles that a segment passes through: a bounding volume hierarchy, split at the median of the longest
 * side. Built in steps; queries allocate nothing.
 *
 * A regular grid is simpler, but slow if a mesh is dense in one place (a face on a body).
 */

import { type Hits, hitTriangle } from '../skin/triangle-hits.ts';
import type { Steps } from '../steps.ts';
import { longestAxis, selectMiddle } from './select.ts';
import type { WeldedMesh } from './weld.ts';

/** Triangles per leaf. */
const LEAF = 4;
/** Nodes created between two yields. */
const NODES_A_STEP = 2000;
/** Triangles sorted between two yields. */
const SORTED_A_STEP = 20000;

/** A bounding volume hierarchy of triangles, as columns with an entry per node. */
export interface TriangleTree {
  readonly mesh: WeldedMesh;
  /** Triangle indices, those of a node together. */
  readonly order: Uint32Array;
  /** min x y z, max x y z per node. */
  readonly boxes: Float64Array;
  /** First and one past the last of `order` per node. */
  readonly spans: Uint32Array;
  /** The second child; the first directly follows its parent. 0 for a leaf. */
  readonly second: Uint32Array;
}

/** Yields its progress. */
export function* triangleTree(mesh: WeldedMesh): Steps<TriangleTree> {
  const { positions, triangles } = mesh;
  const count = triangles.length / 3;
  const order = Uint32Array.from({ length: count }, (_, t) => t);
  const middles = new Float64Array(3 * count);
  for (let t = 0; t < count; t++) {
    const a = 3 * triangles[3 * t];
    const b = 3 * triangles[3 * t + 1];
    const c = 3 * triangles[3 * t + 2];
    for (let k = 0; k < 3; k++) middles[3 * t + k] = positions[a + k] + positions[b + k] + positions[c + k];
  }
  yield 0;
  const room = Math.max(1, 2 * count);
  const boxes = new Float64Array(6 * room);
  const spans = new Uint32Array(2 * room);
  const second = new Uint32Array(room);
  let nodes = 0;
  let done = 0;
  let work = 0;
  /** Ranges still to become nodes, each with the node that it is the second child of, or -1. */
  const open = [0, count, -1];
  while (open.length > 0) {
    const parent = open.pop() ?? -1;
    const to = open.pop() ?? 0;
    const from = open.pop() ?? 0;
    const node = nodes++;
    if (parent >= 0) second[parent] = node;
    spans[2 * node] = from;
    spans[2 * node + 1] = to;
    boxAround(mesh, order, from, to, boxes, 6 * node);
    work += to - from;
    if (to - from <= LEAF) done += to - from;
    else {
      const half = (from + to) >> 1;
      selectMiddle(order, middles, longestAxis(order, middles, from, to - 1), from, to - 1, half);
      open.push(half, to, node, from, half, -1);
    }
    if (work > SORTED_A_STEP || node % NODES_A_STEP === 0) {
      work = 0;
      yield count ? done / count : 1;
    }
  }
  return { mesh, order, boxes, spans, second };
}

const stack = new Uint32Array(128);

/**
 * Finds all triangles between two points, except those at a vertex.
 * @param from x y z, like `to`
 */
export function hitsBetween(
  tree: TriangleTree,
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  vertex: number,
  hits: Hits,
): void {
  hits.count = 0;
  const { boxes, spans, second, order } = tree;
  const ox = from[0];
  const oy = from[1];
  const oz = from[2];
  const dx = to[0] - ox;
  const dy = to[1] - oy;
  const dz = to[2] - oz;
  let depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const node = stack[--depth];
    const o = 6 * node;
    let near = 0;
    let far = 1;
    for (let k = 0; k < 3; k++) {
      const start = from[k];
      const d = to[k] - start;
      if (d === 0) {
        if (start < boxes[o + k] || start > boxes[o + 3 + k]) far = -1;
        continue;
      }
      const a = (boxes[o + k] - start) / d;
      const b = (boxes[o + 3 + k] - start) / d;
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    if (near > far + 1e-12) continue;
    if (second[node] > 0) {
      stack[depth++] = second[node];
      stack[depth++] = node + 1;
      continue;
    }
    for (let i = spans[2 * node]; i < spans[2 * node + 1]; i++) {
      hitTriangle(tree.mesh, order[i], vertex, ox, oy, oz, dx, dy, dz, hits);
    }
  }
}

function boxAround(
  { positions, triangles }: WeldedMesh,
  order: Uint32Array,
  from: number,
  to: number,
  boxes: Float64Array,
  o: number,
): void {
  boxes.fill(Infinity, o, o + 3);
  boxes.fill(-Infinity, o + 3, o + 6);
  for (let i = from; i < to; i++) {
    for (let corner = 0; corner < 3; corner++) {
      const at = 3 * triangles[3 * order[i] + corner];
      for (let k = 0; k < 3; k++) {
        if (positions[at + k] < boxes[o + k]) boxes[o + k] = positions[at + k];
        if (positions[at + k] > boxes[o + 3 + k]) boxes[o + 3 + k] = positions[at + k];
      }
    }
  }
}
