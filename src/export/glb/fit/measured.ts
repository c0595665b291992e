/**
 * Poses that programs make of the keys of a stretch, compared with its rows at all points and axes that are watched.
 */

import { type JointNode, type NodeRange, nodeWorlds, subtrees } from '../../shared/joint-nodes.ts';
import type { Rows } from '../rows.ts';
import type { Track } from '../tracks.ts';
import { expandCubic } from './fit-cubic.ts';
import { expandLinear, type FittedKeys, hasArcs } from './fit-linear.ts';
import { bounded, type PointBounds } from './point-bounds.ts';
import { movedPair, movedPoint, nodesAbove, nodesMoving, pointsBelow, pointsMorphed, type Watch } from './watch.ts';

/** Nodes, pairs and points that change together. */
interface Moved {
  readonly points: Int32Array;
  /** The nodes that the points follow, and those whose axes turn. */
  readonly nodes: Int32Array;
  /** 1 for each of the nodes whose axes turn, and are watched. */
  readonly turns: Uint8Array;
}

/** Compares keys with the rows of a stretch, and keeps the errors as keys change. */
export class Measured {
  readonly rows: Rows;
  readonly tracks: readonly Track[];
  private readonly watch: Watch;
  /** The keys of each track; `replace` is called after they change. */
  readonly fits: FittedKeys[];
  /** The largest squared distance of a point, or of the end of an axis, at each row. */
  readonly errors: Float64Array;
  /** As the rows' values: rotations by components, and along arcs at rows where that differs. */
  readonly made: readonly Float64Array[];
  /** World matrices of the nodes at each row, 16 numbers each, of what is made. */
  private readonly worlds: readonly Float64Array[];
  /** Where points should be at each row: x y z each. */
  private readonly truth: Float64Array;
  /** Whether neither a node nor one above it scales: its axes have length 1. */
  private readonly isRigid: Uint8Array;
  /** World matrices of the nodes at each row, as they should be. */
  private readonly trueWorlds: Float64Array;
  /** The point or axis that is off most at each row: a point, or −1 − the node of an axis. */
  private readonly worst: Int32Array;
  private readonly nodes: readonly JointNode[];
  private readonly isCubic: boolean;
  private readonly isDirty: Uint8Array;
  /** The nodes of each row, from the first up to (excluding) the end, that are placed again when the row is looked at. */
  private readonly staleFrom: Int32Array;
  private readonly staleEnd: Int32Array;
  /** Whether arcs and components differ at a row. */
  private readonly hasArcs: Uint8Array;
  private readonly ranges: readonly NodeRange[];
  private readonly all: NodeRange;
  /** Nodes and points that each track moves, and all of them. */
  private readonly moved: readonly Moved[];
  private readonly every: Moved;
  private readonly bounds: PointBounds;
  /** Error of each node, at the row that is looked at: how far its middle is off, and its axes. */
  private readonly shift: Float64Array;
  private readonly turn: Float64Array;
  /** Numbers of the matrices of a row. */
  private readonly stride: number;
  private readonly pointCount: number;
  private found = 0;
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
    this.staleFrom = new Int32Array(count);
    this.staleEnd = new Int32Array(count).fill(nodes.length);
    this.ranges = subtrees(nodes);
    this.all = { first: 0, end: nodes.length };
    this.isRigid = new Uint8Array(nodes.length);
    nodes.forEach(({ parent, hasScale }, n) => {
      this.isRigid[n] = !hasScale && (parent < 0 || this.isRigid[parent]) ? 1 : 0;
    });
    const below = pointsBelow(nodes, watch);
    const morphed = pointsMorphed(watch);
    this.moved = tracks.map(({ node, path }) => {
      const turning = node < 0 || path === 'translation' ? NO_NODES : this.ranges[node];
      return movedBy(watch, node < 0 ? morphed : below[node], turning);
    });
    this.bounds = bounded(watch, nodes.length);
    this.shift = new Float64Array(nodes.length);
    this.turn = new Float64Array(nodes.length);
    const ways = isCubic ? 1 : 2;
    this.made = Array.from({ length: ways }, () => rows.values.slice(0, count * width));
    this.worlds = Array.from({ length: ways }, () => new Float64Array(count * this.stride));
    this.pointCount = watch.start.length - 1;
    const points = Int32Array.from({ length: this.pointCount }, (_, p) => p);
    this.every = movedBy(watch, points, this.all);
    this.truth = new Float64Array(3 * count * this.pointCount);
    this.trueWorlds = new Float64Array(count * this.stride);
    for (let m = 0; m < count; m++) {
      const o = m * this.stride;
      nodeWorlds(nodes, rows.values, m * width, this.trueWorlds, o);
      for (let p = 0; p < this.pointCount; p++) {
        movedPoint(watch, p, this.trueWorlds, o, rows.values, m * width, this.truth, 3 * (m * this.pointCount + p));
      }
    }
    fits.forEach((own, t) => {
      if (own.rows.length > 0) this.expand(t, 0, count - 1);
    });
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
      if (node < 0 ? isAxis || !this.moved[t].points.includes(worst) : !chain.has(node)) return 0;
      if (isAxis && path === 'translation') return 0;
      const reach = isAxis ? this.watch.axisLength : farthest;
      let most = 0;
      for (const values of this.made.slice(0, this.waysAt(m))) {
        let sum = 0;
        for (let k = o + at; k < o + at + width; k++) sum += (values[k] - this.rows.values[k]) ** 2;
        most = Math.max(most, sum * reach * reach * (path === 'rotation' ? 4 : 1));
      }
      return most;
    });
    return [...off.keys()].filter((t) => off[t] > 0).sort((a, b) => off[b] - off[a]);
  }

  /** After new keys of a track: writes what is made of them from one key to another. */
  replace(t: number, from: number, to: number): void {
    this.expand(t, from, to);
    const { node } = this.tracks[t];
    for (let m = from; m <= to; m++) {
      this.isDirty[m] = 1;
      if (node >= 0) this.unplace(m, this.ranges[node]);
    }
  }

  /**
   * The largest squared distance of a point or an axis that a track moves, from one row to another; `least` if all are
   * less; or one that is more than `enough`.
   * @param worst the row at which it is likely to be large
   */
  farthest(t: number, from: number, worst: number, to: number, least: number, enough: number): number {
    const moved = this.moved[t];
    let most = least;
    for (let m = worst; m <= to && most <= enough; m++) most = this.farthestAt(moved, m, most, enough);
    for (let m = worst - 1; m >= from && most <= enough; m--) most = this.farthestAt(moved, m, most, enough);
    return most;
  }

  /** The points that a track moves. */
  pointsOf(t: number): Int32Array {
    return this.moved[t].points;
  }

  /**
   * Writes the columns of the matrix of the node above at a row, 9 numbers.
   * @param isUnit whether columns have length 1
   */
  writeFrame(node: number, m: number, out: Float64Array, isUnit: boolean): void {
    this.place(m);
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
   * Writes what is missing of a point at a row, and where it is from a node, by the weight by which it follows the
   * node, which is returned.
   */
  writeMiss(point: number, node: number, m: number, miss: Float64Array, lever: Float64Array): number {
    this.place(m);
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
    const fit = this.fits[t];
    expandLinear(this.rows, track, fit, made, false, from, to);
    const isArc = hasArcs(track, fit, from, to);
    if (!isArc && !this.hasArcs.subarray(from, to + 1).includes(1)) return;
    const { width } = this.rows;
    for (let m = from; isArc && m <= to; m++) {
      if (this.hasArcs[m]) continue;
      this.hasArcs[m] = 1;
      onArcs.set(made.subarray(m * width, (m + 1) * width), m * width);
      this.unplace(m, this.all);
    }
    expandLinear(this.rows, track, fit, onArcs, true, from, to);
  }

  /** How many of `made` differ at a row. */
  waysAt(m: number): number {
    return this.hasArcs[m] ? this.made.length : 1;
  }

  private unplace(m: number, { first, end }: NodeRange): void {
    const { staleFrom, staleEnd } = this;
    staleFrom[m] = Math.min(staleFrom[m], first);
    staleEnd[m] = Math.max(staleEnd[m], end);
  }

  /** Places the nodes of a row that have changed since: many changes are taken back before any is looked at there. */
  private place(m: number): void {
    const { nodes, staleFrom, staleEnd, stride } = this;
    if (staleFrom[m] >= staleEnd[m]) return;
    for (let way = 0; way < this.waysAt(m); way++) {
      const row = m * this.rows.width;
      nodeWorlds(nodes, this.made[way], row, this.worlds[way], m * stride, staleFrom[m], staleEnd[m]);
    }
    staleFrom[m] = nodes.length;
    staleEnd[m] = 0;
  }

  private measureRow(m: number): void {
    this.isDirty[m] = 0;
    // What was off most before is likely to be still: most points need no look then.
    this.place(m);
    const before = Math.max(0, this.worst[m]);
    this.found = before;
    let most = 0;
    for (let way = 0; way < this.waysAt(m); way++) most = Math.max(most, this.offOf(before, m, way));
    this.errors[m] = this.farthestAt(this.every, m, most, Infinity);
    this.worst[m] = this.found;
  }

  /**
   * The largest of a number and the squared distances of points, and of axes, at a row; or the first that is more than
   * `enough`.
   */
  private farthestAt(moved: Moved, m: number, before: number, enough: number): number {
    this.place(m);
    let most = before;
    for (let way = 0; way < this.waysAt(m) && most <= enough; way++) {
      most = this.farthestAxis(moved, m, way, most, enough);
      if (most <= enough) most = this.farthestPoint(moved.points, m, way, most, enough);
    }
    return most;
  }

  /** As `farthestAt`, of axes; `found` is −1 − the node. Writes how far nodes are off, unless it is enough before. */
  private farthestAxis({ nodes, turns }: Moved, m: number, way: number, before: number, enough: number): number {
    const { isRigid, trueWorlds, shift, turn } = this;
    const { middles } = this.bounds;
    const worlds = this.worlds[way];
    const length2 = this.watch.axisLength ** 2;
    const o = m * this.stride;
    let most = before;
    for (let i = 0; i < nodes.length; i++) {
      const n = nodes[i];
      const a = o + 16 * n;
      const x0 = worlds[a] - trueWorlds[a];
      const x1 = worlds[a + 1] - trueWorlds[a + 1];
      const x2 = worlds[a + 2] - trueWorlds[a + 2];
      const y0 = worlds[a + 4] - trueWorlds[a + 4];
      const y1 = worlds[a + 5] - trueWorlds[a + 5];
      const y2 = worlds[a + 6] - trueWorlds[a + 6];
      const z0 = worlds[a + 8] - trueWorlds[a + 8];
      const z1 = worlds[a + 9] - trueWorlds[a + 9];
      const z2 = worlds[a + 10] - trueWorlds[a + 10];
      const squares = x0 * x0 + x1 * x1 + x2 * x2 + y0 * y0 + y1 * y1 + y2 * y2 + z0 * z0 + z1 * z1 + z2 * z2;
      // What a difference of rotations makes of a length of 1 has at most this square.
      const turned = isRigid[n] ? squares / 2 : squares;
      if (turns[i]) {
        const off = length2 * (isRigid[n] ? turned : unitsOff(worlds, trueWorlds, a));
        if (off > most) {
          most = off;
          this.found = -1 - n;
          if (off > enough) return off;
        }
      }
      const cx = middles[3 * n];
      const cy = middles[3 * n + 1];
      const cz = middles[3 * n + 2];
      const dx = x0 * cx + y0 * cy + z0 * cz + worlds[a + 12] - trueWorlds[a + 12];
      const dy = x1 * cx + y1 * cy + z1 * cz + worlds[a + 13] - trueWorlds[a + 13];
      const dz = x2 * cx + y2 * cy + z2 * cz + worlds[a + 14] - trueWorlds[a + 14];
      shift[n] = Math.sqrt(dx * dx + dy * dy + dz * dz);
      turn[n] = Math.sqrt(turned);
    }
    return most;
  }

  /** Writes what is missing at the end of an axis of a node at a row, and the axis, by components. */
  writeAxisMiss(node: number, axis: number, m: number, miss: Float64Array, lever: Float64Array): void {
    this.place(m);
    const { axisLength } = this.watch;
    const o = m * this.stride + 16 * node + 4 * axis;
    const isRigid = this.isRigid[node] === 1;
    writeAxis(this.trueWorlds, o, isRigid, miss);
    writeAxis(this.worlds[0], o, isRigid, lever);
    for (let k = 0; k < 3; k++) {
      miss[k] = (miss[k] - lever[k]) * axisLength;
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
    this.place(m);
    return this.offOf(point, m, 0);
  }

  /** As `farthestAt`, of points; `found` is the point. Those that can't be off by more than what was found are left out. */
  private farthestPoint(points: Int32Array, m: number, way: number, before: number, enough: number): number {
    const { shift, turn } = this;
    const { start, nodeOf, local } = this.watch;
    const { levers } = this.bounds;
    let most = before;
    for (let p = 0; p < points.length; p++) {
      const point = points[p];
      let bound = 0;
      for (let i = start[point], end = start[point + 1]; i < end; i++) {
        const n = nodeOf[i];
        bound += local[4 * i + 3] * shift[n] + levers[i] * turn[n];
      }
      if (bound * bound <= most) continue;
      const off = this.offOf(point, m, way);
      if (!(off > most)) continue;
      most = off;
      this.found = point;
      if (off > enough) return off;
    }
    return most;
  }

  /** The squared distance of a point from where it should be, by components (way 0) or along arcs (1). */
  private offOf(point: number, m: number, way: number): number {
    const { truth } = this;
    const { start, nodeOf, local, morphStart, weightAt, by } = this.watch;
    const worlds = this.worlds[way];
    const made = this.made[way];
    const row = m * this.rows.width;
    const o = m * this.stride;
    const t = 3 * (m * this.pointCount + point);
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
    return dx * dx + dy * dy + dz * dz;
  }
}

const NO_NODES: NodeRange = { first: 0, end: 0 };

function movedBy({ start, nodeOf, hasAxes }: Watch, points: Int32Array, turning: NodeRange): Moved {
  const followed = new Set<number>();
  for (const p of points) for (let i = start[p]; i < start[p + 1]; i++) followed.add(nodeOf[i]);
  for (let n = turning.first; n < turning.end; n++) if (hasAxes[n]) followed.add(n);
  const nodes = Int32Array.from(followed).sort();
  const turns = Uint8Array.from(nodes, (n) => (n >= turning.first && n < turning.end ? hasAxes[n] : 0));
  return { points, nodes, turns };
}

/** The largest squared distance of the ends of two matrices' axes, made as long as 1. */
function unitsOff(a: Float64Array, b: Float64Array, o: number): number {
  let most = 0;
  for (let c = o; c < o + 12; c += 4) {
    const s = 1 / (Math.sqrt(a[c] * a[c] + a[c + 1] * a[c + 1] + a[c + 2] * a[c + 2]) || 1);
    const t = 1 / (Math.sqrt(b[c] * b[c] + b[c + 1] * b[c + 1] + b[c + 2] * b[c + 2]) || 1);
    const x = s * a[c] - t * b[c];
    const y = s * a[c + 1] - t * b[c + 1];
    const z = s * a[c + 2] - t * b[c + 2];
    most = Math.max(most, x * x + y * y + z * z);
  }
  return most;
}

/** Writes x y z at `o`, with length 1 unless it has none. @param isUnit whether it has that already */
function writeAxis(from: Float64Array, o: number, isUnit: boolean, out: Float64Array): void {
  const x = from[o];
  const y = from[o + 1];
  const z = from[o + 2];
  const length = isUnit ? 1 : Math.sqrt(x * x + y * y + z * z) || 1;
  out[0] = x / length;
  out[1] = y / length;
  out[2] = z / length;
}
