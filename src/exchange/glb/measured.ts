/** What programs make of the keys of a stretch, compared with its rows at all points and axes that are watched. */
import { expandCubic } from './fit-cubic.ts';
import { expandLinear, type FittedKeys } from './fit-linear.ts';
import { type JointNode, type NodeRange, nodeWorlds, subtrees } from './joint-nodes.ts';
import type { Rows } from './rows.ts';
import type { Track } from './tracks.ts';
import { movedPair, movedPoint, nodesAbove, nodesMoving, pointsBelow, pointsMorphed, type Watch } from './watch.ts';

const NO_NODES: NodeRange = { first: 0, end: 0 };

export class Measured {
  readonly rows: Rows;
  readonly tracks: readonly Track[];
  private readonly watch: Watch;
  /** The keys of each track; `replace` is called after they change. */
  readonly fits: FittedKeys[];
  /** The largest squared distance of a point, or of the end of an axis, at each row. */
  readonly errors: Float64Array;
  /** As the rows' values: rotations by components, and along arcs where that differs. */
  readonly made: readonly Float64Array[];
  /** World matrices of the nodes at each row, 16 numbers each, of what is made. */
  private readonly worlds: readonly Float64Array[];
  /** Where points should be at each row: x y z each. */
  private readonly truth: Float64Array;
  /** Whether neither a node nor one above it scales: its axes have length 1. */
  private readonly isRigid: Uint8Array;
  /** Axes of the nodes in the world at each row, of length 1: 9 numbers each. */
  private readonly trueAxes: Float64Array;
  /** What is off most at each row: a point, or −1 − the node of an axis. */
  private readonly worst: Int32Array;
  private readonly nodes: readonly JointNode[];
  private readonly isCubic: boolean;
  private readonly isDirty: Uint8Array;
  /** Whether arcs and components differ at a row. */
  private readonly hasArcs: Uint8Array;
  private readonly ranges: readonly NodeRange[];
  private readonly all: NodeRange;
  /** The points that each track moves. */
  private readonly moved: readonly Int32Array[];
  /** Numbers of the matrices of a row. */
  private readonly stride: number;
  private readonly pointCount: number;
  private found = 0;
  private readonly every: Int32Array;
  private readonly one = new Int32Array(1);
  private readonly at = new Float64Array(3);

  constructor(
    rows: Rows,
    tracks: readonly Track[],
    nodes: readonly JointNode[],
    watch: Watch,
    isCubic: boolean,
    fits: FittedKeys[],
  ) {
    this.rows = rows;
    this.tracks = tracks;
    this.nodes = nodes;
    this.watch = watch;
    this.isCubic = isCubic;
    this.fits = fits;
    const { count, width } = rows;
    this.stride = 16 * nodes.length;
    this.errors = new Float64Array(count);
    this.worst = new Int32Array(count);
    this.isDirty = new Uint8Array(count).fill(1);
    this.hasArcs = new Uint8Array(count);
    this.ranges = subtrees(nodes);
    this.all = { first: 0, end: nodes.length };
    this.isRigid = new Uint8Array(nodes.length);
    nodes.forEach(({ parent, hasScale }, n) => {
      this.isRigid[n] = !hasScale && (parent < 0 || this.isRigid[parent]) ? 1 : 0;
    });
    const below = pointsBelow(nodes, watch);
    const morphed = pointsMorphed(watch);
    this.moved = tracks.map(({ node }) => (node < 0 ? morphed : below[node]));
    const ways = isCubic ? 1 : 2;
    this.made = Array.from({ length: ways }, () => rows.values.slice(0, count * width));
    this.worlds = Array.from({ length: ways }, () => new Float64Array(count * this.stride));
    this.pointCount = watch.start.length - 1;
    this.every = Int32Array.from({ length: this.pointCount }, (_, p) => p);
    this.truth = new Float64Array(3 * count * this.pointCount);
    this.trueAxes = new Float64Array(9 * count * nodes.length);
    for (let m = 0; m < count; m++) {
      nodeWorlds(nodes, rows.values, m * width, this.worlds[0], 0);
      for (let p = 0; p < this.pointCount; p++) {
        movedPoint(watch, p, this.worlds[0], 0, rows.values, m * width, this.truth, 3 * (m * this.pointCount + p));
      }
      for (let n = 0; n < nodes.length; n++) {
        for (let c = 0; c < 3; c++) {
          writeUnit(this.worlds[0], 16 * n + 4 * c, this.trueAxes, 9 * (m * nodes.length + n) + 3 * c);
        }
      }
    }
    fits.forEach((own, t) => {
      if (own.rows.length > 0) this.expand(t, 0, count - 1);
    });
    for (let m = 0; m < count; m++) {
      for (let way = 0; way < this.waysAt(m); way++) this.placeNodes(way, m, this.all);
    }
  }

  /** Measures rows that are out of date. */
  measure(): void {
    for (let m = 0; m < this.errors.length; m++) if (this.isDirty[m]) this.measureRow(m);
  }

  /** The tracks that displace what is off most at a row, the one that displaces it most first. */
  worstTracks(m: number): readonly number[] {
    const worst = this.worst[m];
    const isAxis = worst < 0;
    const chain = isAxis ? nodesAbove(this.nodes, -1 - worst) : nodesMoving(this.nodes, this.watch, worst);
    const o = m * this.rows.width;
    const off = this.tracks.map(({ node, at, width, path, reach: farthest }, t) => {
      if (node < 0 ? isAxis || !this.moved[t].includes(worst) : !chain.has(node)) return 0;
      if (isAxis && path === 'translation') return 0;
      const reach = isAxis ? this.watch.axisLength : farthest;
      let most = 0;
      for (const values of this.made) {
        let sum = 0;
        for (let k = o + at; k < o + at + width; k++) sum += (values[k] - this.rows.values[k]) ** 2;
        most = Math.max(most, sum * reach * reach * (path === 'rotation' ? 4 : 1));
      }
      return most;
    });
    return [...off.keys()].filter((t) => off[t] > 0).sort((a, b) => off[b] - off[a]);
  }

  /** After new keys of a track: writes what is made of them from one key to another, and places the nodes there. */
  replace(t: number, from: number, to: number): void {
    this.expand(t, from, to);
    const { node } = this.tracks[t];
    for (let m = from; m <= to; m++) {
      this.isDirty[m] = 1;
      if (node >= 0) for (let way = 0; way < this.waysAt(m); way++) this.placeNodes(way, m, this.ranges[node]);
    }
  }

  /**
   * The largest squared distance of a point or an axis that a track moves, from one row to another; or one that is more than
   * `enough`.
   * @param worst the row at which it is likely to be large
   */
  farthest(t: number, from: number, worst: number, to: number, enough: number): number {
    let most = 0;
    const points = this.moved[t];
    const { node, path } = this.tracks[t];
    const range = node < 0 || path === 'translation' ? NO_NODES : this.ranges[node];
    for (let m = worst; m <= to && most <= enough; m++) most = this.farthestAt(points, range, m, most, enough);
    for (let m = worst - 1; m >= from && most <= enough; m--) most = this.farthestAt(points, range, m, most, enough);
    return most;
  }

  /** The points that a track moves. */
  pointsOf(t: number): Int32Array {
    return this.moved[t];
  }

  /**
   * Writes the columns of the matrix of the node above at a row, 9 numbers.
   * @param isUnit whether columns have length 1
   */
  writeFrame(node: number, m: number, out: Float64Array, isUnit: boolean): void {
    const { parent } = this.nodes[node];
    const [made] = this.worlds;
    const o = m * this.stride + 16 * parent;
    for (let c = 0; c < 3; c++) {
      for (let r = 0; r < 3; r++) out[3 * c + r] = parent < 0 ? (c === r ? 1 : 0) : made[o + 4 * c + r];
      if (!isUnit) continue;
      const length = Math.hypot(out[3 * c], out[3 * c + 1], out[3 * c + 2]) || 1;
      for (let r = 0; r < 3; r++) out[3 * c + r] /= length;
    }
  }

  /**
   * Writes what is missing of a point at a row, and where it is from a node, by the weight by which it follows the node,
   * which is returned.
   */
  writeMiss(point: number, node: number, m: number, miss: Float64Array, lever: Float64Array): number {
    const { watch, rows, at, truth } = this;
    const { start, nodeOf, local } = watch;
    const [worlds] = this.worlds;
    const { first, end } = this.ranges[node];
    const o = m * this.stride;
    const row = m * rows.width;
    const pivot = o + 16 * node + 12;
    const t = 3 * (m * this.pointCount + point);
    for (let k = 0; k < 3; k++) {
      miss[k] = truth[t + k];
      lever[k] = 0;
    }
    let share = 0;
    for (let i = start[point]; i < start[point + 1]; i++) {
      movedPair(watch, i, worlds, o, this.made[0], row, at);
      const w = local[4 * i + 3];
      const follows = nodeOf[i] >= first && nodeOf[i] < end;
      if (follows) share += w;
      for (let k = 0; k < 3; k++) {
        miss[k] -= w * at[k];
        if (follows) lever[k] += w * (at[k] - worlds[pivot + k]);
      }
    }
    return share;
  }

  private expand(t: number, from: number, to: number): void {
    const track = this.tracks[t];
    const [made, onArcs] = this.made;
    if (this.isCubic) {
      expandCubic(this.rows, track, this.fits[t], made, from, to);
      return;
    }
    expandLinear(this.rows, track, this.fits[t], made, false, from, to);
    if (!expandLinear(this.rows, track, this.fits[t], onArcs, true, from, to)) return;
    for (let m = from; m <= to; m++) {
      if (this.hasArcs[m]) continue;
      this.hasArcs[m] = 1;
      this.placeNodes(1, m, this.all);
    }
  }

  private waysAt(m: number): number {
    return this.hasArcs[m] ? this.made.length : 1;
  }

  private placeNodes(way: number, m: number, { first, end }: NodeRange): void {
    nodeWorlds(this.nodes, this.made[way], m * this.rows.width, this.worlds[way], m * this.stride, first, end);
  }

  private measureRow(m: number): void {
    this.isDirty[m] = 0;
    this.found = 0;
    this.errors[m] = this.farthestAt(this.every, this.all, m, 0, Infinity);
    this.worst[m] = this.found;
  }

  /**
   * The largest of a number and the squared distances of points, and of axes of some nodes, at a row; or the first that is
   * more than `enough`.
   */
  private farthestAt(points: Int32Array, nodes: NodeRange, m: number, before: number, enough: number): number {
    let most = before;
    for (let way = 0; way < this.waysAt(m) && most <= enough; way++) {
      most = this.farthestOf(points, m, way, most, enough);
      if (most <= enough) most = this.farthestAxis(nodes, m, way, most, enough);
    }
    return most;
  }

  private farthestAxis({ first, end }: NodeRange, m: number, way: number, before: number, enough: number): number {
    const { trueAxes, isRigid } = this;
    const { hasAxes, axisLength } = this.watch;
    const worlds = this.worlds[way];
    const length2 = axisLength * axisLength;
    let most = before;
    for (let n = first; n < end; n++) {
      if (!hasAxes[n]) continue;
      const a = m * this.stride + 16 * n;
      const t = 9 * (m * this.nodes.length + n);
      // Of a small turn by ω the axes' ends are off by 2 ω² in all.
      let turn = 0;
      for (let c = 0; c < 3; c++) {
        const x = worlds[a + 4 * c];
        const y = worlds[a + 4 * c + 1];
        const z = worlds[a + 4 * c + 2];
        const s = isRigid[n] ? 1 : 1 / (Math.sqrt(x * x + y * y + z * z) || 1);
        const dx = x * s - trueAxes[t + 3 * c];
        const dy = y * s - trueAxes[t + 3 * c + 1];
        const dz = z * s - trueAxes[t + 3 * c + 2];
        const off = dx * dx + dy * dy + dz * dz;
        turn = isRigid[n] ? turn + off / 2 : Math.max(turn, off);
      }
      const off = turn * length2;
      if (!(off > most)) continue;
      most = off;
      this.found = -1 - n;
      if (off > enough) return off;
    }
    return most;
  }

  /** Writes what is missing at the end of an axis of a node at a row, and the axis, by components. */
  writeAxisMiss(node: number, axis: number, m: number, miss: Float64Array, lever: Float64Array): void {
    const { axisLength } = this.watch;
    const t = 9 * (m * this.nodes.length + node) + 3 * axis;
    writeUnit(this.worlds[0], m * this.stride + 16 * node + 4 * axis, lever, 0);
    for (let k = 0; k < 3; k++) {
      miss[k] = (this.trueAxes[t + k] - lever[k]) * axisLength;
      lever[k] *= axisLength;
    }
  }

  /** Whether turns of a node are seen by its axes more than by any point. */
  turnsUnseen(t: number): boolean {
    const { node, path, reach } = this.tracks[t];
    return path === 'rotation' && this.watch.hasAxes[node] === 1 && reach <= this.watch.axisLength;
  }

  /** The squared distance of a point from where it should be, by components. */
  off(point: number, m: number): number {
    this.one[0] = point;
    return this.farthestOf(this.one, m, 0, 0, Infinity);
  }

  /** As `farthestAt`, by components (way 0) or along arcs (1); `found` is the point. */
  private farthestOf(points: Int32Array, m: number, way: number, before: number, enough: number): number {
    const { truth } = this;
    const { start, nodeOf, local, morphStart, weightAt, by } = this.watch;
    const worlds = this.worlds[way];
    const made = this.made[way];
    const row = m * this.rows.width;
    const o = m * this.stride;
    const from = 3 * m * this.pointCount;
    let most = before;
    for (let n = 0; n < points.length; n++) {
      const point = points[n];
      const t = from + 3 * point;
      let dx = truth[t];
      let dy = truth[t + 1];
      let dz = truth[t + 2];
      for (let i = start[point], end = start[point + 1]; i < end; i++) {
        const a = o + 16 * nodeOf[i];
        let x = local[4 * i];
        let y = local[4 * i + 1];
        let z = local[4 * i + 2];
        const w = local[4 * i + 3];
        for (let k = morphStart[i], last = morphStart[i + 1]; k < last; k++) {
          const weight = made[row + weightAt[k]];
          x += weight * by[3 * k];
          y += weight * by[3 * k + 1];
          z += weight * by[3 * k + 2];
        }
        dx -= w * (worlds[a] * x + worlds[a + 4] * y + worlds[a + 8] * z + worlds[a + 12]);
        dy -= w * (worlds[a + 1] * x + worlds[a + 5] * y + worlds[a + 9] * z + worlds[a + 13]);
        dz -= w * (worlds[a + 2] * x + worlds[a + 6] * y + worlds[a + 10] * z + worlds[a + 14]);
      }
      const off = dx * dx + dy * dy + dz * dz;
      if (!(off > most)) continue;
      most = off;
      this.found = point;
      if (off > enough) return off;
    }
    return most;
  }
}

/** Writes x y z at `o`, with length 1 unless it has none. */
function writeUnit(from: Float64Array, o: number, out: Float64Array, to: number): void {
  const length = Math.sqrt(from[o] * from[o] + from[o + 1] * from[o + 1] + from[o + 2] * from[o + 2]) || 1;
  for (let k = 0; k < 3; k++) out[to + k] = from[o + k] / length;
}
