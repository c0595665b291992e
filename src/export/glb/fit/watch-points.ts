/**
 * The points that are watched: joints, End Sites, tips of bones, and of the vertices that follow each joint those that
 * are farthest out in many directions. The displacement of a rigid part by a wrong matrix is largest at a corner of its
 * hull.
 */
import type { CompiledSkin } from '../../../evaluate/skin/deform.ts';
import type { Morph } from '../../../model/morph.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { AttachmentSets } from '../../shared/attachments.ts';
import type { JointNodes } from '../../shared/joint-nodes.ts';
import type { Watch } from './watch.ts';

/** Morphs, and how far they go. */
export interface WatchedMorphs {
  readonly morphs: readonly Morph[];
  /** Where their weights begin in a row. */
  readonly weightsAt: number;
  /** The least and greatest weight of each in the takes. */
  readonly least: readonly number[];
  readonly greatest: readonly number[];
}

/** A skin as it is written. */
export interface WatchedSkin {
  readonly compiled: CompiledSkin;
  readonly sets: AttachmentSets;
  readonly morphs: WatchedMorphs;
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

/** Collects the points that are watched. */
export class WatchPoints {
  private readonly start = [0];
  private readonly nodeOf: number[] = [];
  private readonly local: number[] = [];
  private readonly morphStart = [0];
  private readonly weightAt: number[] = [];
  private readonly by: number[] = [];
  private readonly vertices = new Set<number>();
  /** Displacements of each morph by a weight of 1: x y z per vertex. */
  readonly displacements: readonly Float64Array[];
  private made: Watch | undefined;

  /**
   * Watches joints, their axes, End Sites and tips.
   * @param axisLength by which turns of a joint are seen that nothing else shows
   */
  constructor(
    skeleton: Skeleton,
    readonly nodes: JointNodes,
    private readonly axisLength: number,
    readonly skin: WatchedSkin | undefined,
  ) {
    this.displacements = skin ? skin.morphs.morphs.map((morph) => displacementOf(skin.compiled, morph)) : [];
    skeleton.joints.forEach(({ endSites = [], length }, joint) => {
      const ends = length ? [...endSites, [0, length, 0] as const] : endSites;
      for (const point of [[0, 0, 0] as const, ...ends]) this.addPoint({ joint, point });
    });
  }

  /** The points that are watched; another object after more was added. */
  get watch(): Watch {
    const { start, nodeOf, local, morphStart, weightAt, by, axisLength, nodes } = this;
    if (this.made) return this.made;
    const hasAxes = new Uint8Array(nodes.nodes.length);
    for (const node of nodes.lastOf) hasAxes[node] = 1;
    this.made = {
      start: Int32Array.from(start),
      nodeOf: Int32Array.from(nodeOf),
      local: Float64Array.from(local),
      morphStart: Int32Array.from(morphStart),
      weightAt: Int32Array.from(weightAt),
      by: Float64Array.from(by),
      hasAxes,
      axisLength,
    };
    return this.made;
  }

  /** Watches a point that moves with one joint. */
  addPoint({ joint, point }: RigidPoint): void {
    this.addPair(joint, point, 1);
    this.endPoint();
  }

  /** Watches the vertices that are outermost. */
  addOutermost(): void {
    if (this.skin) this.addVertices(extremes(this.skin, this.nodes.lastOf.length, this.displacements));
  }

  /** Watches vertices: by all attachments, and by the first four where a program may read only these. */
  addVertices(vertices: Iterable<number>): void {
    if (!this.skin) return;
    const { sets } = this.skin;
    for (const v of vertices) {
      if (this.vertices.has(v)) continue;
      this.vertices.add(v);
      this.addVertex(this.skin, v, sets.joints.length);
      if (sets.joints.length > 1 && sets.weights[1][4 * v] > 0) this.addVertex(this.skin, v, 1);
    }
  }

  private addVertex({ compiled, sets, morphs }: WatchedSkin, v: number, setCount: number): void {
    const position = compiled.skin.positions.subarray(3 * v, 3 * v + 3);
    for (const { joint, weight } of attachmentsOf(sets, v, setCount)) {
      if (joint >= this.nodes.lastOf.length) continue;
      this.displacements.forEach((displacement, m) => {
        const own = displacement.subarray(3 * v, 3 * v + 3);
        if (own.every((d) => d === 0)) return;
        this.weightAt.push(morphs.weightsAt + m);
        this.by.push(...inJoint(compiled, joint, own, 0));
      });
      this.addPair(joint, inJoint(compiled, joint, position, 1), weight);
    }
    this.endPoint();
  }

  private addPair(joint: number, point: readonly number[], weight: number): void {
    this.nodeOf.push(this.nodes.lastOf[joint]);
    this.local.push(...point, weight);
    this.morphStart.push(this.weightAt.length);
  }

  private endPoint(): void {
    this.start.push(this.nodeOf.length);
    this.made = undefined;
  }
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
function extremes(skin: WatchedSkin, jointCount: number, displacements: readonly Float64Array[]): ReadonlySet<number> {
  const {
    vertexCount,
    skin: { positions },
  } = skin.compiled;
  const { least, greatest } = skin.morphs;
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
      for (let v = 0; v < vertexCount; v++) {
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
  /** They sum to 1. */
  readonly weight: number;
}

/** The attachments of a vertex in the first sets, as programs read them. */
function attachmentsOf({ joints, weights }: AttachmentSets, v: number, setCount: number): readonly Attachment[] {
  const own: Attachment[] = [];
  let sum = 0;
  for (let set = 0; set < setCount; set++) {
    for (let k = 4 * v; k < 4 * v + 4 && weights[set][k] > 0; k++) {
      own.push({ joint: joints[set][k], weight: weights[set][k] });
      sum += weights[set][k];
    }
  }
  return own.map(({ joint, weight }) => ({ joint, weight: weight / sum }));
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
function outermost({ compiled, sets }: WatchedSkin, jointCount: number, positions: Float64Array): Set<number> {
  const most = new Extremes(jointCount);
  const less = new Extremes(jointCount);
  for (let v = 0; v < compiled.vertexCount; v++) {
    const point = positions.subarray(3 * v, 3 * v + 3);
    attachmentsOf(sets, v, sets.joints.length).forEach(({ joint, weight }, a) => {
      if (joint >= jointCount || joint >= compiled.matrixCount) return;
      if (a === 0) most.add(v, joint, inJoint(compiled, joint, point, 1), 1);
      else less.add(v, joint, inJoint(compiled, joint, point, 1), weight);
    });
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
