/**
 * Moves values of keys of straight lines so that points are off least in the two segments beside a key, whatever else
 * displaces them: a joint makes up for what those above it are off by. Weighted least squares, in which points that are
 * off most count most, for a small turn or shift of the key:
 *
 *     Σ w |e − u · J δ|² → min        J δ = (R δ) × r  for turns,  s · L δ  for shifts
 *
 * with e what is missing at a point, or at the end of an axis of the node, u the part of the key in a row (1 at it, 0
 * at its neighbours), r from the node to the point, R and L the rotation and the matrix of the node above, s the weight
 * by which the point follows.
 */
import { normalise } from './fit-linear.ts';
import type { Measured } from './measured.ts';

/** Weight of points that are not off, as a fraction of that of a point at the limit. */
const LEAST = 0.02;
/** Rows between two keys, and points, that are looked at, about. */
const MAX_ROWS = 5;
const MAX_POINTS = 32;
/** A key is never moved by more than this many times the limit. */
const FARTHEST = 3;
/** Parts of the solution that are tried. */
const PARTS = [1, 0.5, 0.25];

/** The symmetric matrix xx yy zz xy xz yz and the right side of a row, in world space. */
const matrix = new Float64Array(6);
const side = new Float64Array(3);
/** The same of all rows, in the space of the node above; 9 and 3 numbers. */
const normal = new Float64Array(9);
const right = new Float64Array(3);
const delta = new Float64Array(3);
const miss = new Float64Array(3);
const lever = new Float64Array(3);
const frame = new Float64Array(9);
const before = new Float64Array(4);

/** Moves every key of every track once. @param isKept whether no row that is within the limit may leave it */
export function moveKeys(measured: Measured, limit: number, isKept: boolean): void {
  measured.fits.forEach(({ rows: keys }, t) => {
    for (let k = 1; k + 1 < keys.length; k++) moveKey(measured, t, k, limit, isKept);
  });
}

/**
 * Says whether the key was moved.
 * @param k neither the first nor the last key
 * @param isKept whether no row that is within the limit may leave it
 */
export function moveKey(measured: Measured, t: number, k: number, limit: number, isKept: boolean): boolean {
  const { rows, tracks, fits } = measured;
  const { path, width, reach } = tracks[t];
  if (path !== 'rotation' && path !== 'translation') return false;
  const { rows: keys, values } = fits[t];
  const [a, key, b] = [keys[k - 1], keys[k], keys[k + 1]];
  if (rows.jumps[key] || rows.jumps[b]) return false;
  const step = Math.max(1, Math.floor((b - a) / (2 * MAX_ROWS)));
  const cost = gather(measured, t, [a, key, b], step, limit);
  if (!solve(normal, right, delta)) return false;
  const size = Math.hypot(delta[0], delta[1], delta[2]) * reach;
  if (!(size > 0)) return false;
  const most = Math.min(1, (FARTHEST * limit) / size);
  const o = k * width;
  for (let c = 0; c < width; c++) before[c] = values[o + c];
  for (const part of PARTS) {
    if (path === 'rotation') turn(values, o, most * part);
    else for (let c = 0; c < 3; c++) values[o + c] = before[c] + most * part * delta[c];
    measured.replace(t, a, b);
    if (!(costOf(measured, t, a, b, step, limit, cost) < cost)) continue;
    if (!isKept || measured.farthest(t, a, key, b, limit * limit, limit * limit) <= limit * limit) return true;
  }
  for (let c = 0; c < width; c++) values[o + c] = before[c];
  measured.replace(t, a, b);
  return false;
}

/** The cube of how far a point is off, squared, in limits. */
function costOfPoint(off: number): number {
  return off * off * off;
}

/** The squared length of what is missing, in limits. */
function offOf([x, y, z]: Float64Array, limit: number): number {
  return (x * x + y * y + z * z) / (limit * limit);
}

function strideOf(points: Int32Array): number {
  return Math.max(1, Math.floor(points.length / MAX_POINTS));
}

/** Sums of all points that are looked at; `enough` if they are more. */
function costOf(
  measured: Measured,
  t: number,
  a: number,
  b: number,
  step: number,
  limit: number,
  enough: number,
): number {
  const points = measured.pointsOf(t);
  const stride = strideOf(points);
  const { node } = measured.tracks[t];
  const isUnseen = measured.turnsUnseen(t);
  let cost = 0;
  for (let m = a + 1; m < b && cost < enough; m += step) {
    for (let i = 0; i < points.length; i += stride) {
      cost += costOfPoint(measured.off(points[i], m) / (limit * limit));
    }
    if (!isUnseen) continue;
    for (let axis = 0; axis < 3; axis++) {
      measured.writeAxisMiss(node, axis, m, miss, lever);
      cost += costOfPoint(offOf(miss, limit));
    }
  }
  return cost;
}

/** Writes the normal equations of a key between two others; returns the cost of the rows between those. */
function gather(
  measured: Measured,
  t: number,
  [a, key, b]: readonly [number, number, number],
  step: number,
  limit: number,
): number {
  const { rows, tracks } = measured;
  const { node, path } = tracks[t];
  const isTurned = path === 'rotation';
  const isUnseen = measured.turnsUnseen(t);
  const points = measured.pointsOf(t);
  const stride = strideOf(points);
  let cost = 0;
  normal.fill(0);
  right.fill(0);
  for (let m = a + 1; m < b; m += step) {
    const from = rows.seconds[m < key ? a : b];
    const u = (rows.seconds[m] - from) / (rows.seconds[key] - from);
    matrix.fill(0);
    side.fill(0);
    for (let i = 0; i < points.length; i += stride) {
      const share = measured.writeMiss(points[i], node, m, miss, lever);
      const off = offOf(miss, limit);
      cost += costOfPoint(off);
      if (isTurned) addTurn(off * off + LEAST);
      else addShift((off * off + LEAST) * share, share);
    }
    if (isUnseen) {
      for (let axis = 0; axis < 3; axis++) {
        measured.writeAxisMiss(node, axis, m, miss, lever);
        const off = offOf(miss, limit);
        cost += costOfPoint(off);
        addTurn(off * off + LEAST);
      }
    }
    measured.writeFrame(node, m, frame, isTurned);
    addRow(u);
  }
  return cost;
}

function addTurn(w: number): void {
  const [x, y, z] = lever;
  matrix[0] += w * (y * y + z * z);
  matrix[1] += w * (x * x + z * z);
  matrix[2] += w * (x * x + y * y);
  matrix[3] -= w * x * y;
  matrix[4] -= w * x * z;
  matrix[5] -= w * y * z;
  side[0] += w * (y * miss[2] - z * miss[1]);
  side[1] += w * (z * miss[0] - x * miss[2]);
  side[2] += w * (x * miss[1] - y * miss[0]);
}

function addShift(w: number, share: number): void {
  for (let k = 0; k < 3; k++) {
    matrix[k] += w * share;
    side[k] += w * miss[k];
  }
}

/** Adds a row's equations in the space of the node above. */
function addRow(u: number): void {
  const [xx, yy, zz, xy, xz, yz] = matrix;
  for (let c = 0; c < 9; c += 3) {
    const x = frame[c];
    const y = frame[c + 1];
    const z = frame[c + 2];
    const px = xx * x + xy * y + xz * z;
    const py = xy * x + yy * y + yz * z;
    const pz = xz * x + yz * y + zz * z;
    for (let r = 0; r < 3; r++) {
      normal[c + r] += u * u * (px * frame[3 * r] + py * frame[3 * r + 1] + pz * frame[3 * r + 2]);
    }
    right[c / 3] += u * (side[0] * x + side[1] * y + side[2] * z);
  }
}

/** Writes the quaternion `before`, turned by a part of `delta`. */
function turn(values: Float64Array, o: number, part: number): void {
  const [x, y, z, w] = before;
  const dx = (delta[0] * part) / 2;
  const dy = (delta[1] * part) / 2;
  const dz = (delta[2] * part) / 2;
  values[o] = x + dx * w + dy * z - dz * y;
  values[o + 1] = y + dy * w + dz * x - dx * z;
  values[o + 2] = z + dz * w + dx * y - dy * x;
  values[o + 3] = w - dx * x - dy * y - dz * z;
  normalise(values, o);
}

/** Solves a symmetric system of three; false if it says nothing. */
function solve(m: Float64Array, b: Float64Array, x: Float64Array): boolean {
  const ridge = 1e-6 * (m[0] + m[4] + m[8]);
  const xx = m[0] + ridge;
  const yy = m[4] + ridge;
  const zz = m[8] + ridge;
  const [xy, xz, yz] = [m[1], m[2], m[5]];
  const cxx = yy * zz - yz * yz;
  const cxy = xz * yz - xy * zz;
  const cxz = xy * yz - xz * yy;
  const cyy = xx * zz - xz * xz;
  const cyz = xy * xz - xx * yz;
  const czz = xx * yy - xy * xy;
  const determinant = xx * cxx + xy * cxy + xz * cxz;
  if (!(determinant > 0)) return false;
  x[0] = (cxx * b[0] + cxy * b[1] + cxz * b[2]) / determinant;
  x[1] = (cxy * b[0] + cyy * b[1] + cyz * b[2]) / determinant;
  x[2] = (cxz * b[0] + cyz * b[1] + czz * b[2]) / determinant;
  return Number.isFinite(x[0] + x[1] + x[2]);
}
