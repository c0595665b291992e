/**
 * The points at which the motion that is written is compared with the true one: joints, End Sites, tips of bones, and of
 * the vertices that follow each joint most those that are farthest out in many directions. The displacement of a rigid
 * part by a wrong matrix is largest at a corner of its hull.
 */
import type { CompiledSkin } from '../../evaluate/deform.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { JointNode, JointNodes } from './joint-nodes.ts';

/** Point p is moved by the pairs `start[p]` up to (excluding) `start[p + 1]`. */
export interface Watch {
  readonly start: Int32Array;
  /** The node of each pair. */
  readonly nodeOf: Int32Array;
  /** x y z of the point in the space of the node, and its weight: 4 numbers per pair. */
  readonly local: Float64Array;
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
  rigid: readonly RigidPoint[] = [],
): Watch {
  const start = [0];
  const nodeOf: number[] = [];
  const local: number[] = [];
  const pair = (joint: number, point: readonly number[], weight: number) => {
    nodeOf.push(lastOf[joint]);
    local.push(...point, weight);
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
    for (const v of outermost(skin, lastOf.length)) {
      for (const { joint, weight } of attachmentsOf(skin, v)) {
        if (joint < lastOf.length) pair(joint, inJoint(skin, joint, v), weight);
      }
      start.push(nodeOf.length);
    }
  }
  return { start: Int32Array.from(start), nodeOf: Int32Array.from(nodeOf), local: Float64Array.from(local) };
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

/** The vertex in the space of a joint. */
function inJoint({ skin: { positions }, inverseBindings: m }: CompiledSkin, joint: number, v: number): number[] {
  const o = 16 * joint;
  const [x, y, z] = positions.subarray(3 * v, 3 * v + 3);
  return [0, 1, 2].map((r) => m[o + r] * x + m[o + 4 + r] * y + m[o + 8 + r] * z + m[o + 12 + r]);
}

/** The vertices that are outermost in some direction among those that follow one joint most. */
function outermost(skin: CompiledSkin, jointCount: number): ReadonlySet<number> {
  const farthest = new Float64Array(DIRECTIONS.length * jointCount).fill(-Infinity);
  const vertexOf = new Int32Array(farthest.length).fill(-1);
  const { start, joints, weights } = skin.skin.attachments ?? {
    start: undefined,
    joints: undefined,
    weights: undefined,
  };
  for (let v = 0; v < skin.vertexCount; v++) {
    let joint = start ? -1 : 0;
    if (start) {
      let most = 0;
      for (let a = start[v]; a < start[v + 1]; a++) if (weights[a] > most) [most, joint] = [weights[a], joints[a]];
    }
    if (joint < 0 || joint >= jointCount || joint >= skin.matrixCount) continue;
    const [x, y, z] = inJoint(skin, joint, v);
    DIRECTIONS.forEach(([dx, dy, dz], d) => {
      const far = dx * x + dy * y + dz * z;
      const at = DIRECTIONS.length * joint + d;
      if (!(far > farthest[at])) return;
      farthest[at] = far;
      vertexOf[at] = v;
    });
  }
  return new Set(vertexOf.filter((v) => v >= 0));
}

/**
 * The largest distance between the points of two poses, and the point.
 * @param worlds, others of the nodes, 16 numbers each, from `o` and `p` on
 * @param out receives the squared distance and the index of the point
 */
export function farthestApart(
  { start, nodeOf, local }: Watch,
  worlds: Float64Array,
  o: number,
  others: Float64Array,
  p: number,
  out: Float64Array,
): void {
  let most = -1;
  let where = 0;
  let i = 0;
  for (let point = 0; point + 1 < start.length; point++) {
    let dx = 0;
    let dy = 0;
    let dz = 0;
    for (const end = start[point + 1]; i < end; i++) {
      const a = o + 16 * nodeOf[i];
      const b = p + 16 * nodeOf[i];
      const x = local[4 * i];
      const y = local[4 * i + 1];
      const z = local[4 * i + 2];
      const w = local[4 * i + 3];
      dx +=
        w *
        ((worlds[a] - others[b]) * x +
          (worlds[a + 4] - others[b + 4]) * y +
          (worlds[a + 8] - others[b + 8]) * z +
          worlds[a + 12] -
          others[b + 12]);
      dy +=
        w *
        ((worlds[a + 1] - others[b + 1]) * x +
          (worlds[a + 5] - others[b + 5]) * y +
          (worlds[a + 9] - others[b + 9]) * z +
          worlds[a + 13] -
          others[b + 13]);
      dz +=
        w *
        ((worlds[a + 2] - others[b + 2]) * x +
          (worlds[a + 6] - others[b + 6]) * y +
          (worlds[a + 10] - others[b + 10]) * z +
          worlds[a + 14] -
          others[b + 14]);
    }
    const sum = dx * dx + dy * dy + dz * dz;
    if (sum > most) {
      most = sum;
      where = point;
    }
  }
  out[0] = most;
  out[1] = where;
}

/** The nodes that move a point, from its own up to the root. */
export function nodesMoving(nodes: readonly JointNode[], { start, nodeOf }: Watch, point: number): ReadonlySet<number> {
  const found = new Set<number>();
  for (let i = start[point]; i < start[point + 1]; i++) {
    for (let n = nodeOf[i]; n >= 0 && !found.has(n); n = nodes[n].parent) found.add(n);
  }
  return found;
}
