/**
 * The points at which the motion that is written is compared with the true one: joints, End Sites, tips of bones, and of
 * the vertices that follow each joint those that are farthest out in many directions. The displacement of a rigid part by
 * a wrong matrix is largest at a corner of its hull.
 */
import type { CompiledSkin } from '../../evaluate/deform.ts';
import type { Morph } from '../../model/morph.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { JointNode, JointNodes } from './joint-nodes.ts';

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
}

/** Morphs, and how far they go. */
export interface WatchedMorphs {
  readonly morphs: readonly Morph[];
  /** Where their weights begin in a row. */
  readonly weightsAt: number;
  /** The least and greatest weight of each in the takes. */
  readonly least: readonly number[];
  readonly greatest: readonly number[];
}

/** 26 directions: towards faces, edges and corners of a cube. */
const DIRECTIONS = [-1, 0, 1].flatMap((x) =>
  [-1, 0, 1].flatMap((y) => [-1, 0, 1].flatMap((z) => (x || y || z ? [[x, y, z] as const] : []))),
);

/** A point that a joint moves rigidly. */
export interface RigidPoint {
  readonly joint: number;
  /** In the joint's space. */
  readonly point: readonly number[];
}

export function watchPoints(
  skeleton: Skeleton,
  { lastOf }: JointNodes,
  skin: CompiledSkin | undefined,
  watched: WatchedMorphs,
  rigid: readonly RigidPoint[] = [],
): Watch {
  const start = [0];
  const nodeOf: number[] = [];
  const local: number[] = [];
  const morphStart = [0];
  const weightAt: number[] = [];
  const by: number[] = [];
  const pair = (joint: number, point: readonly number[], weight: number) => {
    nodeOf.push(lastOf[joint]);
    local.push(...point, weight);
    morphStart.push(weightAt.length);
  };
  skeleton.joints.forEach(({ endSites = [], length }, joint) => {
    const ends = length ? [...endSites, [0, length, 0] as const] : endSites;
    for (const point of [[0, 0, 0] as const, ...ends]) {
      pair(joint, point, 1);
      start.push(nodeOf.length);
    }
  });
  for (const { joint, point } of rigid) {
    pair(joint, point, 1);
    start.push(nodeOf.length);
  }
  if (skin) {
    const { morphs, weightsAt } = watched;
    const displacements = morphs.map((morph) => displacementOf(skin, morph));
    for (const v of extremes(skin, lastOf.length, watched, displacements)) {
      for (const { joint, weight } of attachmentsOf(skin, v)) {
        if (joint >= lastOf.length) continue;
        displacements.forEach((displacement, m) => {
          const own = displacement.subarray(3 * v, 3 * v + 3);
          if (own.every((d) => d === 0)) return;
          weightAt.push(weightsAt + m);
          by.push(...inJoint(skin, joint, own, 0));
        });
        pair(joint, inJoint(skin, joint, skin.skin.positions.subarray(3 * v, 3 * v + 3), 1), weight);
      }
      start.push(nodeOf.length);
    }
  }
  return {
    start: Int32Array.from(start),
    nodeOf: Int32Array.from(nodeOf),
    local: Float64Array.from(local),
    morphStart: Int32Array.from(morphStart),
    weightAt: Int32Array.from(weightAt),
    by: Float64Array.from(by),
  };
}

/** How far a morph of weight 1 moves each vertex. */
function displacementOf({ vertexCount, skin }: CompiledSkin, { positions: { indices, values } }: Morph): Float64Array {
  const out = new Float64Array(3 * vertexCount);
  indices.forEach((v, row) => {
    for (let k = 0; k < 3; k++) out[3 * v + k] = values[3 * row + k] - skin.positions[3 * v + k];
  });
  return out;
}

/** The outermost vertices without morphs, with those of the takes, and those that a morph moves farthest. */
function extremes(
  skin: CompiledSkin,
  jointCount: number,
  { least, greatest }: WatchedMorphs,
  displacements: readonly Float64Array[],
): ReadonlySet<number> {
  const { positions } = skin.skin;
  const found = outermost(skin, jointCount, positions);
  const moved = displacements.filter((_, m) => least[m] !== 0 || greatest[m] !== 0);
  if (moved.length === 0) return found;
  for (const weights of [least, greatest]) {
    const morphed = positions.slice();
    displacements.forEach((displacement, m) => {
      for (let i = 0; i < morphed.length; i++) morphed[i] += weights[m] * displacement[i];
    });
    for (const v of outermost(skin, jointCount, morphed)) found.add(v);
  }
  for (const displacement of moved) {
    for (const [dx, dy, dz] of DIRECTIONS) {
      let most = 0;
      let vertex = 0;
      for (let v = 0; v < skin.vertexCount; v++) {
        const far = dx * displacement[3 * v] + dy * displacement[3 * v + 1] + dz * displacement[3 * v + 2];
        if (far > most) [most, vertex] = [far, v];
      }
      found.add(vertex);
    }
  }
  return found;
}

interface Attachment {
  readonly joint: number;
  /** Normalised. */
  readonly weight: number;
}

function attachmentsOf({ skin: { attachments } }: CompiledSkin, v: number): readonly Attachment[] {
  if (!attachments) return [{ joint: 0, weight: 1 }];
  const { start, joints, weights } = attachments;
  const own = weights.subarray(start[v], start[v + 1]);
  const sum = own.reduce((total, w) => total + w, 0);
  if (!(sum > 0)) return [];
  return Array.from(own, (w, a) => ({ joint: joints[start[v] + a], weight: w / sum })).filter(({ weight }) => weight);
}

/** A point (w = 1) or a displacement (w = 0) of a vertex in the space of a joint. */
function inJoint(
  { inverseBindings: m, matrixCount }: CompiledSkin,
  joint: number,
  [x, y, z]: ArrayLike<number> & Iterable<number>,
  w: 0 | 1,
): number[] {
  if (joint >= matrixCount) return [x, y, z];
  const o = 16 * joint;
  return [0, 1, 2].map((r) => m[o + r] * x + m[o + 4 + r] * y + m[o + 8 + r] * z + w * m[o + 12 + r]);
}

/**
 * The vertices that are outermost in some direction among those that follow one joint most; and among those that follow
 * it less, the ones that it moves farthest.
 */
function outermost(skin: CompiledSkin, jointCount: number, positions: Float64Array): Set<number> {
  const most = new Extremes(jointCount);
  const less = new Extremes(jointCount);
  const { start, joints, weights } = skin.skin.attachments ?? {
    start: undefined,
    joints: undefined,
    weights: undefined,
  };
  for (let v = 0; v < skin.vertexCount; v++) {
    const point = positions.subarray(3 * v, 3 * v + 3);
    const place = (joint: number) => inJoint(skin, joint, point, 1);
    if (!start) {
      most.add(v, 0, place(0), 1);
      continue;
    }
    let first = start[v];
    for (let a = start[v]; a < start[v + 1]; a++) if (weights[a] > weights[first]) first = a;
    for (let a = start[v]; a < start[v + 1]; a++) {
      if (joints[a] >= jointCount || joints[a] >= skin.matrixCount || !(weights[a] > 0)) continue;
      if (a === first) most.add(v, joints[a], place(joints[a]), 1);
      else less.add(v, joints[a], place(joints[a]), weights[a]);
    }
  }
  return new Set([...most.vertices(), ...less.vertices()]);
}

/** The vertex that is farthest in each direction in the space of each joint. */
class Extremes {
  private readonly farthest: Float64Array;
  private readonly vertexOf: Int32Array;

  constructor(jointCount: number) {
    this.farthest = new Float64Array(DIRECTIONS.length * jointCount).fill(-Infinity);
    this.vertexOf = new Int32Array(this.farthest.length).fill(-1);
  }

  add(vertex: number, joint: number, [x, y, z]: readonly number[], weight: number): void {
    for (let d = 0; d < DIRECTIONS.length; d++) {
      const [dx, dy, dz] = DIRECTIONS[d];
      const far = weight * (dx * x + dy * y + dz * z);
      const at = DIRECTIONS.length * joint + d;
      if (!(far > this.farthest[at])) continue;
      this.farthest[at] = far;
      this.vertexOf[at] = vertex;
    }
  }

  vertices(): Int32Array {
    return this.vertexOf.filter((v) => v >= 0);
  }
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
