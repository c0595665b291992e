/**
 * Finds keys for a stretch of a take: few, and such that no point is off by more than the tolerance at any row. Errors
 * of joints add up along the skeleton, and mostly don't: so each track gets keys by a share of the tolerance, the result
 * is measured at all points and rows, keys are added where it is exceeded, and those that turn out not to be needed are
 * removed.
 */
import { cubicHolds, expandCubic, fitCubic } from './fit-cubic.ts';
import {
  expandLinear,
  type FittedKeys,
  fitLinear,
  greedyKeys,
  lastNotAbove,
  linearHolds,
  refitLinear,
  withoutKey,
} from './fit-linear.ts';
import { type JointNode, nodeWorlds } from './joint-nodes.ts';
import type { Rows } from './rows.ts';
import type { Track } from './tracks.ts';
import { farthestApart, nodesMoving, type Watch } from './watch.ts';

export type KeyStyle = 'linear' | 'cubic';

export interface StretchOptions {
  readonly style: KeyStyle;
  /** How far points may be off. */
  readonly tolerance: number;
  /** The share of the tolerance that each track gets at first, from 0 to 1. */
  readonly share: number;
  /** Whether keys of straight lines that turn out not to be needed are removed: fewer keys for several times the time. */
  readonly thins: boolean;
  /** Tracks that need no keys here: they are exact anyway. */
  readonly isExact: (track: Track) => boolean;
}

/** The tolerance of morph weights, of the whole: they add to what joints do. */
const OF_WEIGHTS = 0.1;
const MAX_ROUNDS = 400;
/** Of the tolerance: between two rows points are off by a little more than at them. */
const MARGIN = 0.95;
/** Straight lines through moved keys are off by half as much, nearly. */
const HALVED = 1.8;

/** Keys of each track. */
export function fitStretch(
  rows: Rows,
  tracks: readonly Track[],
  nodes: readonly JointNode[],
  watch: Watch,
  { style, tolerance, share, thins, isExact }: StretchOptions,
): readonly FittedKeys[] {
  const isCubic = style === 'cubic';
  const keysFor = isCubic ? fitCubic : fitLinear;
  const limit = MARGIN * tolerance;
  const keys = tracks.map((track) => {
    if (isExact(track)) return [];
    const own = track.path === 'weights' ? OF_WEIGHTS * tolerance : share * limit;
    // A track that moves nothing still has its values.
    const budget = (own * (isCubic ? 1 : HALVED)) / Math.max(track.reach, 1e-9 * tolerance);
    return greedyKeys(rows, (isCubic ? cubicHolds : linearHolds)(rows, track, budget));
  });
  const fits: FittedKeys[] = tracks.map((track, t) => keysFor(rows, track, keys[t]));
  const measured = new Measured(rows, tracks, nodes, watch, isCubic, fits);
  for (let round = 0; round < MAX_ROUNDS; round++) {
    const changed = addKeys(measured, keys, limit);
    if (changed.size === 0) break;
    for (const [t, added] of changed) {
      fits[t] = isCubic ? fitCubic(rows, tracks[t], keys[t]) : refitLinear(rows, tracks[t], keys[t], fits[t], added);
      for (const row of added) measured.update(t, ...around(keys[t], row));
    }
    measured.measure();
  }
  if (thins && !isCubic) removeKeys(measured, rows, tracks, fits, limit);
  return fits;
}

/** The rows that a key at a row, or its absence, has an effect on: two segments on either side. */
function around(keys: readonly number[], row: number): readonly [number, number] {
  const k = lastNotAbove(keys, row);
  return [keys[Math.max(0, k - 2)], keys[Math.min(keys.length - 1, k + 3)]];
}

/**
 * Adds a key at the worst row of each run of rows that are off by too much, to the track that is off most there. Returns
 * the rows added to each track.
 */
function addKeys(measured: Measured, keys: number[][], limit: number): Map<number, number[]> {
  const changed = new Map<number, number[]>();
  const { errors } = measured;
  const limit2 = limit * limit;
  for (let m = 0; m < errors.length; m++) {
    if (!(errors[m] > limit2)) continue;
    let worst = m;
    for (; m < errors.length && errors[m] > limit2; m++) if (errors[m] > errors[worst]) worst = m;
    for (const t of measured.worstTracks(worst)) {
      const row = addKey(keys[t], worst);
      if (row === undefined) continue;
      changed.set(t, [...(changed.get(t) ?? []), row]);
      break;
    }
  }
  return changed;
}

/** Adds a key at a row, or, if there is one, halfway in the longer segment beside it; undefined if all rows are keys. */
function addKey(keys: number[], row: number): number | undefined {
  const k = lastNotAbove(keys, row);
  if (keys[k] !== row) {
    keys.splice(k + 1, 0, row);
    return row;
  }
  const before = k > 0 ? row - keys[k - 1] : 0;
  const after = k + 1 < keys.length ? keys[k + 1] - row : 0;
  if (Math.max(before, after) < 2) return undefined;
  const isBefore = before > after;
  const middle = isBefore ? row - (before >> 1) : row + (after >> 1);
  keys.splice(isBefore ? k : k + 1, 0, middle);
  return middle;
}

/** A key that may not be needed. */
interface Candidate {
  readonly t: number;
  readonly row: number;
  /** How far points would be off there, about, without it. */
  readonly off: number;
}

/** Keys whose absence would be off by more than this many times the limit are needed: moved neighbours halve it. */
const HOPELESS = 3;

/** Removes keys without which no row is off by too much, those that matter least first. */
function removeKeys(measured: Measured, rows: Rows, tracks: readonly Track[], fits: FittedKeys[], limit: number): void {
  const candidates: Candidate[] = [];
  tracks.forEach((track, t) => {
    if (track.path === 'weights') return;
    const own = fits[t].rows;
    for (let k = 1; k + 1 < own.length; k++) {
      if (rows.jumps[own[k]] || rows.jumps[own[k + 1]]) continue;
      const off = offWithout(rows, track, own[k - 1], own[k], own[k + 1]);
      if (off < HOPELESS * limit) candidates.push({ t, row: own[k], off });
    }
  });
  candidates.sort((a, b) => a.off - b.off);
  for (const { t, row } of candidates) {
    const before = fits[t];
    const k = lastNotAbove(before.rows, row);
    const first = before.rows[Math.max(0, k - 2)];
    const last = before.rows[Math.min(before.rows.length - 1, k + 2)];
    fits[t] = withoutKey(rows, tracks[t], before, k);
    if (measured.holds(t, first, row, last, limit)) continue;
    fits[t] = before;
    measured.restore(t, first, last);
  }
}

/** How far points are off at a key, about, where a straight line is taken from a row before it to one after. */
function offWithout({ values, seconds, width }: Rows, track: Track, a: number, key: number, b: number): number {
  const u = (seconds[key] - seconds[a]) / (seconds[b] - seconds[a]);
  let sum = 0;
  for (let c = track.at; c < track.at + track.width; c++) {
    const d = values[a * width + c] * (1 - u) + values[b * width + c] * u - values[key * width + c];
    sum += d * d;
  }
  return Math.sqrt(sum) * track.reach * (track.path === 'rotation' ? 2 : 1);
}

/** How far points are off at each row by morph weights alone, at most. */
function offByWeights({ values, count, width }: Rows, tracks: readonly Track[], made: Float64Array): Float64Array {
  const off = new Float64Array(count);
  const weights = tracks.find(({ path }) => path === 'weights');
  if (!weights) return off;
  for (let m = 0; m < count; m++) {
    const o = m * width + weights.at;
    for (let k = o; k < o + weights.width; k++) off[m] += Math.abs(made[k] - values[k]) * weights.reach;
  }
  return off;
}

/** What programs make of the keys, compared with the rows. */
class Measured {
  readonly rows: Rows;
  readonly tracks: readonly Track[];
  /** The largest squared distance of a point at each row. */
  readonly errors: Float64Array;
  private readonly points: Int32Array;
  /** Errors that `restore` brings back. */
  private readonly before: Float64Array;
  /** How far points are off at each row by morph weights alone, at most. */
  private readonly byWeights: Float64Array;
  private readonly nodes: readonly JointNode[];
  private readonly watch: Watch;
  private readonly isCubic: boolean;
  private readonly fits: readonly FittedKeys[];
  /** As the rows' values: rotations by components, and along arcs where that differs. */
  private readonly made: readonly Float64Array[];
  private readonly truth: Float64Array;
  private readonly worlds: Float64Array;
  private readonly isDirty: Uint8Array;
  /** Whether arcs and components differ at a row. */
  private readonly hasArcs: Uint8Array;
  private readonly found = new Float64Array(2);

  constructor(
    rows: Rows,
    tracks: readonly Track[],
    nodes: readonly JointNode[],
    watch: Watch,
    isCubic: boolean,
    fits: readonly FittedKeys[],
  ) {
    this.rows = rows;
    this.tracks = tracks;
    this.nodes = nodes;
    this.watch = watch;
    this.isCubic = isCubic;
    this.fits = fits;
    const { count, width } = rows;
    this.errors = new Float64Array(count);
    this.points = new Int32Array(count);
    this.before = new Float64Array(count);
    this.isDirty = new Uint8Array(count).fill(1);
    this.hasArcs = new Uint8Array(count);
    this.made = Array.from({ length: isCubic ? 1 : 2 }, () => rows.values.slice(0, count * width));
    this.worlds = new Float64Array(16 * nodes.length);
    this.truth = new Float64Array(count * 16 * nodes.length);
    for (let m = 0; m < count; m++) nodeWorlds(nodes, rows.values, m * width, this.truth, m * 16 * nodes.length);
    fits.forEach((own, t) => {
      if (own.rows.length > 0) this.update(t, 0, count - 1);
    });
    this.byWeights = offByWeights(rows, tracks, this.made[0]);
    this.measure();
  }

  /** After new keys of a track: rows from one key to another, both included, are out of date. */
  update(t: number, from: number, to: number): void {
    const track = this.tracks[t];
    const [made, onArcs] = this.made;
    if (this.isCubic) expandCubic(this.rows, track, this.fits[t], made, from, to);
    else {
      expandLinear(this.rows, track, this.fits[t], made, false, from, to);
      if (expandLinear(this.rows, track, this.fits[t], onArcs, true, from, to)) this.hasArcs.fill(1, from, to + 1);
    }
    this.isDirty.fill(1, from, to + 1);
  }

  /** Measures rows that are out of date; returns the largest error from one row to another, both included. */
  measure(from = 0, to = this.rows.count - 1): number {
    let most = 0;
    for (let m = from; m <= to; m++) {
      if (this.isDirty[m]) this.measureRow(m);
      if (this.errors[m] > most) most = this.errors[m];
    }
    return most;
  }

  /**
   * Whether no row from one key to another is off by more than the limit with the track's new keys, `worst` being the
   * likeliest. If one is, `restore` is called next.
   */
  holds(t: number, from: number, worst: number, to: number, limit: number): boolean {
    this.before.set(this.errors.subarray(from, to + 1));
    this.update(t, from, to);
    const limit2 = limit * limit;
    this.measureRow(worst);
    if (this.errors[worst] > limit2) return false;
    for (let m = from; m <= to; m++) {
      if (!this.isDirty[m]) continue;
      this.measureRow(m);
      if (this.errors[m] > limit2) return false;
    }
    return true;
  }

  /** With the track's keys, and the errors, as they were before `holds`. */
  restore(t: number, from: number, to: number): void {
    this.update(t, from, to);
    this.isDirty.fill(0, from, to + 1);
    this.errors.set(this.before.subarray(0, to + 1 - from), from);
  }

  private measureRow(m: number): void {
    const { nodes, found } = this;
    const { width } = this.rows;
    this.isDirty[m] = 0;
    this.errors[m] = -1;
    const ways = this.hasArcs[m] ? this.made.length : 1;
    for (let way = 0; way < ways; way++) {
      nodeWorlds(nodes, this.made[way], m * width, this.worlds);
      farthestApart(this.watch, this.worlds, 0, this.truth, m * 16 * nodes.length, found);
      const error = (Math.sqrt(found[0]) + this.byWeights[m]) ** 2;
      if (!(error > this.errors[m])) continue;
      this.errors[m] = error;
      this.points[m] = found[1];
    }
  }

  /** The tracks that displace the worst point of a row, the one that displaces it most first. */
  worstTracks(m: number): readonly number[] {
    const chain = nodesMoving(this.nodes, this.watch, this.points[m]);
    const o = m * this.rows.width;
    const off = this.tracks.map(({ node, at, width, path, reach }) => {
      if (!chain.has(node)) return 0;
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
}
