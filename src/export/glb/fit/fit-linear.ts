/**
 * Keys of straight lines. Rotations must hold their tolerance both for slerp, as glTF asks, and for components that are
 * interpolated one by one and normalised, as Blender does.
 */
import type { Rows } from '../rows.ts';
import type { Track } from '../tracks.ts';

/** Keys of a track: rows, ascending, with a value each, and in a spline the slopes on both sides, per second. */
export interface FittedKeys {
  readonly rows: readonly number[];
  /** `track.width` numbers per key. */
  readonly values: Float64Array;
  readonly slopesIn?: Float64Array;
  readonly slopesOut?: Float64Array;
}

/** Whether one segment from row i to row j is near enough to all rows in between. */
export type SegmentHolds = (i: number, j: number) => boolean;

/**
 * As few keys as reach from the first to the last row, by extending each segment as far as it holds. Rows on both sides
 * of a jump are keys.
 */
export function greedyKeys(rows: Rows, holds: SegmentHolds): number[] {
  const keys = [0];
  let from = 0;
  const last = rows.count - 1;
  while (from < last) {
    if (rows.jumps[from + 1]) {
      keys.push(++from);
      continue;
    }
    // The segment to `good` holds, that to `bad` does not or goes beyond a jump.
    let good = from + 1;
    let bad = last + 1;
    for (let step = 1; good < last; step *= 2) {
      const next = Math.min(last, good + step);
      const limit = firstJump(rows, good, next);
      if (limit <= next) bad = limit;
      const to = Math.min(next, limit - 1);
      if (to > good && holds(from, to)) good = to;
      else if (to > good) bad = to;
      if (bad <= last) break;
    }
    while (bad - good > 1) {
      const middle = (good + bad) >> 1;
      if (holds(from, middle)) good = middle;
      else bad = middle;
    }
    keys.push(good);
    from = good;
  }
  return keys;
}

/** The first row after `from`, up to `to`, that jumps; `to + 1` if there is none. */
function firstJump({ jumps }: Rows, from: number, to: number): number {
  for (let r = from + 1; r <= to; r++) if (jumps[r]) return r;
  return to + 1;
}

/**
 * A test whether a straight line from one row to another is within the tolerance at the rows between.
 * @param tolerance of the track's numbers: radians for rotations
 */
export function linearHolds(rows: Rows, track: Track, tolerance: number): SegmentHolds {
  return track.path === 'rotation' ? rotationHolds(rows, track.at, tolerance) : vectorHolds(rows, track, tolerance);
}

function vectorHolds({ values, seconds, width }: Rows, { at, width: dims }: Track, tolerance: number): SegmentHolds {
  const limit = tolerance * tolerance;
  return (i, j) => {
    const a = i * width + at;
    const b = j * width + at;
    const span = seconds[j] - seconds[i];
    for (let m = i + 1; m < j; m++) {
      const u = (seconds[m] - seconds[i]) / span;
      const o = m * width + at;
      let sum = 0;
      for (let k = 0; k < dims; k++) {
        const d = values[a + k] + (values[b + k] - values[a + k]) * u - values[o + k];
        sum += d * d;
      }
      if (sum > limit) return false;
    }
    return true;
  };
}

/** Below this cosine of half the angle, slerp and its approximation by components are told apart: 12°. */
const APART = Math.cos(0.1);

function rotationHolds({ values, seconds, width }: Rows, at: number, tolerance: number): SegmentHolds {
  const cos = Math.cos(Math.min(tolerance, Math.PI) / 2);
  const limit = cos * cos;
  return (i, j) => {
    const a = i * width + at;
    const b = j * width + at;
    const span = seconds[j] - seconds[i];
    let dot = 0;
    for (let k = 0; k < 4; k++) dot += values[a + k] * values[b + k];
    // Programs take the shorter way: keys never turn by half a turn.
    if (dot < 0.1) return false;
    const angle = dot < APART ? Math.acos(Math.min(1, dot)) : 0;
    const sine = Math.sin(angle);
    for (let m = i + 1; m < j; m++) {
      const u = (seconds[m] - seconds[i]) / span;
      const o = m * width + at;
      if (!near(values, a, b, o, 1 - u, u, limit)) return false;
      if (angle > 0 && !near(values, a, b, o, Math.sin((1 - u) * angle) / sine, Math.sin(u * angle) / sine, limit))
        return false;
    }
    return true;
  };
}

/** Whether the direction of s·a + t·b is within an angle of c; `limit` is the squared cosine of half the angle. */
function near(v: Float64Array, a: number, b: number, c: number, s: number, t: number, limit: number): boolean {
  const x = s * v[a] + t * v[b];
  const y = s * v[a + 1] + t * v[b + 1];
  const z = s * v[a + 2] + t * v[b + 2];
  const w = s * v[a + 3] + t * v[b + 3];
  const dot = x * v[c] + y * v[c + 1] + z * v[c + 2] + w * v[c + 3];
  return dot * dot >= limit * (x * x + y * y + z * z + w * w);
}

/** Keys at the given rows with the values there. */
export function keysAt(rows: Rows, { at, width }: Track, keys: readonly number[]): FittedKeys {
  const values = new Float64Array(keys.length * width);
  keys.forEach((row, k) => {
    values.set(rows.values.subarray(row * rows.width + at, row * rows.width + at + width), k * width);
  });
  return { rows: keys.slice(), values };
}

/**
 * Keys at the given rows, with values that halve the largest errors. Between two keys on a curve it sags from the
 * straight line by up to s; with both ends moved by s/2 it is off by s/2 everywhere. A key between segments that sag by
 * s and t is moved by (s + t)/4. The first and last key and those beside jumps stay on the curve.
 */
export function fitLinear(rows: Rows, track: Track, keys: readonly number[]): FittedKeys {
  const fitted = keysAt(rows, track, keys);
  for (let k = 1; k + 1 < keys.length; k++) moveKey(rows, track, fitted, k);
  return fitted;
}

/** The keys of a track, fitted again after some were added: only those, and their neighbours, are computed. */
export function refitLinear(
  rows: Rows,
  track: Track,
  keys: readonly number[],
  before: FittedKeys,
  added: readonly number[],
): FittedKeys {
  const { width } = track;
  const values = new Float64Array(keys.length * width);
  let from = 0;
  keys.forEach((row, k) => {
    const isOld = before.rows[from] === row;
    if (!isOld) return;
    for (let c = 0; c < width; c++) values[k * width + c] = before.values[from * width + c];
    from++;
  });
  const fitted = { rows: keys.slice(), values };
  for (const row of added) {
    const at = lastNotAbove(keys, row);
    for (let k = Math.max(1, at - 1); k <= Math.min(keys.length - 2, at + 1); k++) moveKey(rows, track, fitted, k);
  }
  return fitted;
}

/** The keys of a track without the key of index k, which is neither the first nor the last. */
export function withoutKey(rows: Rows, track: Track, { rows: keys, values }: FittedKeys, k: number): FittedKeys {
  const { width } = track;
  const fewer = keys.toSpliced(k, 1);
  const fitted = { rows: fewer, values: new Float64Array(fewer.length * width) };
  fitted.values.set(values.subarray(0, k * width));
  fitted.values.set(values.subarray((k + 1) * width), k * width);
  for (let n = Math.max(1, k - 1); n <= Math.min(fewer.length - 2, k); n++) moveKey(rows, track, fitted, n);
  return fitted;
}

/** Seconds: Blender takes keys that are nearer for one, a hundredth of a frame apart at 24 frames per second. */
const NEAR = 5e-4;

/**
 * The keys of a track, with a key on the line before each two that are so near that programs take them for one: what
 * leads there isn't bent towards the later one.
 */
export function guarded(rows: Rows, { at, width }: Track, fitted: FittedKeys, made: Float64Array): FittedKeys {
  const { rows: keys, values } = fitted;
  const { seconds } = rows;
  const all: number[] = [];
  const own: number[] = [];
  keys.forEach((row, k) => {
    const isFirst = k + 1 < keys.length && seconds[keys[k + 1]] - seconds[row] < NEAR;
    if (isFirst && k > 0 && seconds[row] - seconds[keys[k - 1]] >= NEAR) {
      let guard = row - 1;
      while (guard > keys[k - 1] && seconds[row] - seconds[guard] < NEAR) guard--;
      if (guard > keys[k - 1]) {
        const o = guard * rows.width + at;
        all.push(guard);
        own.push(...made.subarray(o, o + width));
      }
    }
    all.push(row);
    own.push(...values.subarray(k * width, (k + 1) * width));
  });
  return all.length === keys.length ? fitted : { rows: all, values: Float64Array.from(own) };
}

/** Gives a key between two others its value. */
function moveKey(rows: Rows, { at, width, path }: Track, { rows: keys, values }: FittedKeys, k: number): void {
  const row = keys[k];
  for (let c = 0; c < width; c++) values[k * width + c] = rows.values[row * rows.width + at + c];
  if (rows.jumps[row] || rows.jumps[keys[k + 1]]) return;
  addSag(rows, at, width, keys[k - 1], row, values, k * width);
  addSag(rows, at, width, row, keys[k + 1], values, k * width);
  if (path === 'rotation') normalise(values, k * width);
}

/** Adds a quarter of the parabola s·4u(1 − u) that fits what is left of the curve beside the straight line. */
function addSag(rows: Rows, at: number, dims: number, i: number, j: number, out: Float64Array, o: number): void {
  const { values, seconds, width } = rows;
  const a = i * width + at;
  const b = j * width + at;
  const span = seconds[j] - seconds[i];
  let squares = 0;
  for (let m = i + 1; m < j; m++) {
    const u = (seconds[m] - seconds[i]) / span;
    squares += 16 * u * u * (1 - u) * (1 - u);
  }
  for (let m = i + 1; m < j; m++) {
    const u = (seconds[m] - seconds[i]) / span;
    const part = (4 * u * (1 - u)) / (4 * squares);
    const p = m * width + at;
    for (let k = 0; k < dims; k++) {
      out[o + k] += part * (values[p + k] - (1 - u) * values[a + k] - u * values[b + k]);
    }
  }
}

/** Whether arcs and components differ anywhere from one key to another: @param first row, to `last` */
export function hasArcs({ path }: Track, { rows: keys, values }: FittedKeys, first: number, last: number): boolean {
  if (path !== 'rotation') return false;
  for (let k = lastNotAbove(keys, first); k + 1 < keys.length && keys[k] < last; k++) {
    const o = 4 * k;
    const dot =
      values[o] * values[o + 4] +
      values[o + 1] * values[o + 5] +
      values[o + 2] * values[o + 6] +
      values[o + 3] * values[o + 7];
    if (dot < APART) return true;
  }
  return false;
}

/**
 * Writes what programs make of the keys at each row.
 * @param out of the layout of the rows' values
 * @param bySlerp whether rotations are interpolated along the arc rather than by components
 * @param first row, a key, to `last`, another
 */
export function expandLinear(
  { seconds, width, jumps }: Rows,
  { at, width: dims, path }: Track,
  { rows: keys, values }: FittedKeys,
  out: Float64Array,
  bySlerp: boolean,
  first: number,
  last: number,
): void {
  for (let k = lastNotAbove(keys, first); k < keys.length && keys[k] <= last; k++) {
    const o = keys[k] * width + at;
    for (let c = 0; c < dims; c++) out[o + c] = values[k * dims + c];
    if (path === 'rotation') normalise(out, o);
    if (k + 1 === keys.length || jumps[keys[k + 1]]) continue;
    const from = keys[k];
    const to = keys[k + 1];
    const span = seconds[to] - seconds[from];
    let dot = 0;
    if (path === 'rotation') for (let c = 0; c < 4; c++) dot += values[k * 4 + c] * values[k * 4 + 4 + c];
    const angle = bySlerp && path === 'rotation' && dot < APART ? Math.acos(Math.min(1, dot)) : 0;
    for (let m = from + 1; m < to; m++) {
      const u = (seconds[m] - seconds[from]) / span;
      const s = angle > 0 ? Math.sin((1 - u) * angle) / Math.sin(angle) : 1 - u;
      const t = angle > 0 ? Math.sin(u * angle) / Math.sin(angle) : u;
      const p = m * width + at;
      for (let c = 0; c < dims; c++) out[p + c] = s * values[k * dims + c] + t * values[(k + 1) * dims + c];
      if (path === 'rotation') normalise(out, p);
    }
  }
}

/** The last of ascending numbers that is not above a value, which is not below the first. */
export function lastNotAbove(ascending: readonly number[], value: number): number {
  let low = 0;
  let high = ascending.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (ascending[middle] <= value) low = middle;
    else high = middle;
  }
  return low;
}

/** Divides four numbers by their length. */
export function normalise(q: Float64Array, o: number): void {
  const length = Math.sqrt(q[o] * q[o] + q[o + 1] * q[o + 1] + q[o + 2] * q[o + 2] + q[o + 3] * q[o + 3]);
  for (let k = 0; k < 4; k++) q[o + k] /= length;
}
