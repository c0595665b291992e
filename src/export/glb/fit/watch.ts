/** Where the motion that is written is compared with the true one: at points that nodes move, and at axes of nodes. */
import type { JointNode } from '../../shared/joint-nodes.ts';

/** Point p is moved by the pairs `start[p]` up to (excluding) `start[p + 1]`. */
export interface Watch {
  readonly start: Int32Array;
  /** The node of each pair. */
  readonly nodeOf: Int32Array;
  /** x y z of the point in the space of the node, and its weight: 4 numbers per pair. */
  readonly local: Float64Array;
  /** Pair i is displaced by the morphs `morphStart[i]` up to (excluding) `morphStart[i + 1]`. */
  readonly morphStart: Int32Array;
  /** Where in a row the weight is that displaces a pair. */
  readonly weightAt: Int32Array;
  /** x y z by a weight of 1, in the space of the node. */
  readonly by: Float64Array;
  /** 1 for each node whose axes in the world are watched. */
  readonly hasAxes: Uint8Array;
  /** How long the axes are: their ends may be off by as much as points. */
  readonly axisLength: number;
}

const at = new Float64Array(3);

/**
 * Where a point is.
 * @param worlds of the nodes, 16 numbers each, from `o` on
 * @param row the nodes' numbers, then the morph weights, from `r` on
 * @param out receives x y z at `to`
 */
export function movedPoint(
  watch: Watch,
  point: number,
  worlds: Float64Array,
  o: number,
  row: Float64Array,
  r: number,
  out: Float64Array,
  to: number,
): void {
  const { start, local } = watch;
  let px = 0;
  let py = 0;
  let pz = 0;
  for (let i = start[point], end = start[point + 1]; i < end; i++) {
    movedPair(watch, i, worlds, o, row, r, at);
    const w = local[4 * i + 3];
    px += w * at[0];
    py += w * at[1];
    pz += w * at[2];
  }
  out[to] = px;
  out[to + 1] = py;
  out[to + 2] = pz;
}

/** Where a point would be by one of its pairs alone. */
export function movedPair(
  watch: Watch,
  i: number,
  worlds: Float64Array,
  o: number,
  row: Float64Array,
  r: number,
  out: Float64Array,
): void {
  const a = o + 16 * watch.nodeOf[i];
  pointOfPair(watch, i, row, r, out);
  const x = out[0];
  const y = out[1];
  const z = out[2];
  out[0] = worlds[a] * x + worlds[a + 4] * y + worlds[a + 8] * z + worlds[a + 12];
  out[1] = worlds[a + 1] * x + worlds[a + 5] * y + worlds[a + 9] * z + worlds[a + 13];
  out[2] = worlds[a + 2] * x + worlds[a + 6] * y + worlds[a + 10] * z + worlds[a + 14];
}

/** Writes where a pair's point is in the space of its node, displaced by the morph weights of a row from `r` on. */
export function pointOfPair(
  { local, morphStart, weightAt, by }: Watch,
  i: number,
  row: Float64Array,
  r: number,
  out: Float64Array,
): void {
  for (let k = 0; k < 3; k++) out[k] = local[4 * i + k];
  for (let m = morphStart[i]; m < morphStart[i + 1]; m++) {
    for (let k = 0; k < 3; k++) out[k] += row[r + weightAt[m]] * by[3 * m + k];
  }
}

/** The points that each node moves: its own and those of all nodes below. */
export function pointsBelow(nodes: readonly JointNode[], watch: Watch): readonly Int32Array[] {
  const lists = nodes.map((): number[] => []);
  for (let p = 0; p + 1 < watch.start.length; p++) for (const n of nodesMoving(nodes, watch, p)) lists[n].push(p);
  return lists.map((list) => Int32Array.from(list));
}

/** The points that morphs move. */
export function pointsMorphed({ start, morphStart }: Watch): Int32Array {
  const found: number[] = [];
  for (let p = 0; p + 1 < start.length; p++) if (morphStart[start[p + 1]] > morphStart[start[p]]) found.push(p);
  return Int32Array.from(found);
}

/** The nodes that move a point, from its own up to the root. */
export function nodesMoving(nodes: readonly JointNode[], { start, nodeOf }: Watch, point: number): ReadonlySet<number> {
  const found = new Set<number>();
  for (let i = start[point]; i < start[point + 1]; i++) {
    for (let n = nodeOf[i]; n >= 0 && !found.has(n); n = nodes[n].parent) found.add(n);
  }
  return found;
}

/** A node and all above it. */
export function nodesAbove(nodes: readonly JointNode[], node: number): ReadonlySet<number> {
  const found = new Set<number>();
  for (let n = node; n >= 0; n = nodes[n].parent) found.add(n);
  return found;
}
