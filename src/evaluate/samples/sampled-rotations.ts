/**
 * Interpolates joints that rotate as a whole between two frames: by three Euler angles or a quaternion's four numbers,
 * all driven by samples. They are interpolated as quaternions and converted back to their DOFs.
 *
 *     linear     slerp(q₀, q₁, t), along the shortest arc at constant speed (Shoemake 1985)
 *     cubic      Catmull and Rom's spline (1974) of q₋₁ q₀ q₁ q₂ as vectors of four numbers, normalised
 *
 * Of q and −q, which are the same rotation, each frame takes the one nearer to its neighbour. So angles that jump in
 * the file (179° to −179°, or all three past gimbal lock) neither spin the joint nor put a corner into the spline,
 * which passes through all frames with continuous velocity. (Shoemake's squad takes logarithms and three slerps for
 * that, and is no smoother.)
 *
 * Of a rotation's equivalent angles the nearest to those of the frames are chosen: a pose is its DOFs, for limits,
 * linked DOFs, sliders and files alike. The quaternions are kept as well, for making matrices.
 */
import { eulerNear, quaternionOfEuler, quaternionsOfEulers, turnEuler } from '../../math/euler.ts';
import { slerp } from '../../math/slerp.ts';
import type { Samples } from '../../model/takes/samples.ts';
import type { PoseRotations } from '../rotations/pose-rotations.ts';
import { nearEuler, readRows } from './near-eulers.ts';
import type { SampledJoints } from './sampled-joints.ts';
import { catmullRom } from './sampling.ts';

/** Quaternions x y z w of the four frames around a time, and of the time itself. Scratch; never escapes. */
const before = new Float64Array(4);
const here = new Float64Array(4);
const next = new Float64Array(4);
const after = new Float64Array(4);
const turned = new Float64Array(4);
const angles = new Float64Array(3);

/**
 * Writes the DOFs of joints with three Euler angles; `part`, the fraction of the way to the next row, must not be 0.
 */
export function betweenEulers(
  samples: Samples,
  joints: SampledJoints,
  row: number,
  part: number,
  out: Float64Array,
  rotations?: PoseRotations,
): void {
  if (rotations) rotations.areGiven = true;
  const isLinear = samples.interpolation === 'linear';
  if (isLinear) readRows(samples, joints, row, part);
  for (let r = 0; r < joints.eulerSigns.length; r++) {
    if (!isLinear || !nearEuler(joints, r, out, rotations))
      betweenAnyEuler(samples, joints, r, row, part, out, rotations);
  }
}

/** One of those rotations, number `r`. */
function betweenAnyEuler(
  { values, scales, frameCount, interpolation }: Samples,
  { eulerJoints, eulerDofs, eulerColumns, eulerHalves, eulerSigns, eulerAxes }: SampledJoints,
  r: number,
  row: number,
  part: number,
  out: Float64Array,
  rotations?: PoseRotations,
): void {
  const width = scales.length;
  const at = row * width;
  const to = at + width;
  const ca = eulerColumns[3 * r];
  const cb = eulerColumns[3 * r + 1];
  const cc = eulerColumns[3 * r + 2];
  const fa = eulerHalves[3 * r];
  const fb = eulerHalves[3 * r + 1];
  const fc = eulerHalves[3 * r + 2];
  const a0 = values[at + ca] * fa;
  const b0 = values[at + cb] * fb;
  const c0 = values[at + cc] * fc;
  const a1 = values[to + ca] * fa;
  const b1 = values[to + cb] * fb;
  const c1 = values[to + cc] * fc;
  if (rotations) rotations.values[8 * eulerJoints[r]] = Number.NaN;
  angles[0] = 2 * a0;
  angles[1] = 2 * b0;
  angles[2] = 2 * c0;
  if (interpolation === 'cubic') {
    quaternionsOfEulers(a0, b0, c0, a1, b1, c1, here, next);
    const hasBefore = row > 0;
    const hasAfter = row + 2 < frameCount;
    const b = at - width;
    const f = to + width;
    if (hasBefore) quaternionOfEuler(values[b + ca] * fa, values[b + cb] * fb, values[b + cc] * fc, before, 0);
    if (hasAfter) quaternionOfEuler(values[f + ca] * fa, values[f + cb] * fb, values[f + cc] * fc, after, 0);
    align(next, here);
    spline(hasBefore, hasAfter, part);
    turnAngles(2 * a1, 2 * b1, 2 * c1, part);
  } else if (a0 !== a1 || b0 !== b1 || c0 !== c1) {
    quaternionsOfEulers(a0, b0, c0, a1, b1, c1, here, next);
    slerp(here, next, part, turned);
    turnAngles(2 * a1, 2 * b1, 2 * c1, part);
    if (rotations) keepTurned(rotations.values, 8 * eulerJoints[r], eulerSigns[r], eulerAxes, 3 * r);
  }
  const sign = eulerSigns[r];
  out[eulerDofs[3 * r]] = sign * angles[0];
  out[eulerDofs[3 * r + 1]] = sign * angles[1];
  out[eulerDofs[3 * r + 2]] = sign * angles[2];
}

/** Writes `angles` and their unit quaternion `turned` as in `PoseRotations`; the axes are at `axes[i]`. */
function keepTurned(out: Float64Array, o: number, sign: number, axes: Int32Array, i: number): void {
  for (let k = 0; k < 3; k++) {
    out[o + k] = sign * angles[k];
    out[o + 3 + axes[i + k]] = sign * turned[k];
  }
  out[o + 6] = turned[3];
}

/** Changes `angles` from those of `here` to those of `turned`; α β γ are those of `next`. */
function turnAngles(alpha: number, beta: number, gamma: number, part: number): void {
  const a = alpha - angles[0];
  const b = beta - angles[1];
  const c = gamma - angles[2];
  const isSmooth = a < 1 && a > -1 && b < 1 && b > -1 && c < 1 && c > -1;
  if (isSmooth && turnEuler(here, 0, turned, 0, angles, 0)) return;
  angles[0] = between(angles[0], alpha, part);
  angles[1] = between(angles[1], beta, part);
  angles[2] = between(angles[2], gamma, part);
  eulerNear(turned, angles, 0);
}

/**
 * The starting value for the search of an angle: interpolated between frames, but near the closer frame if the file
 * jumps.
 */
function between(from: number, to: number, part: number): number {
  const step = to - from;
  if (step <= Math.PI && step >= -Math.PI) return from + step * part;
  return part < 0.5 ? from : to;
}

/**
 * Writes the DOFs of quaternion joints. Their length is kept and need not be 1; next to one of length 0, which is no
 * rotation, components are interpolated separately.
 */
export function betweenQuaternions(
  samples: Samples,
  { quaternionDofs, quaternionColumns }: SampledJoints,
  row: number,
  part: number,
  out: Float64Array,
): void {
  const isCubic = samples.interpolation === 'cubic';
  for (let k = 0; k < quaternionDofs.length; k += 4) {
    const from = readQuaternion(samples, quaternionColumns, k, row, here);
    const to = readQuaternion(samples, quaternionColumns, k, row + 1, next);
    let length = from + (to - from) * part;
    if (from === 0 || to === 0) {
      for (let i = 0; i < 4; i++) turned[i] = here[i] * from * (1 - part) + next[i] * to * part;
      length = 1;
    } else {
      // In the second half with the sign of the next frame.
      const isTurned = align(next, here) < 0;
      if (isCubic) {
        const hasBefore = row > 0 && readQuaternion(samples, quaternionColumns, k, row - 1, before) > 0;
        const hasAfter =
          row + 2 < samples.frameCount && readQuaternion(samples, quaternionColumns, k, row + 2, after) > 0;
        spline(hasBefore, hasAfter, part);
      } else slerp(here, next, part, turned);
      length /= lengthOf(turned);
      if (isTurned && part >= 0.5) length = -length;
    }
    for (let i = 0; i < 4; i++) out[quaternionDofs[k + i]] = turned[i] * length;
  }
}

/** Writes a row's normalised quaternion to `out`. @returns its original length; 0, and zeros, if it has none */
function readQuaternion({ values, scales }: Samples, columns: Int32Array, k: number, row: number, out: Float64Array) {
  const at = row * scales.length;
  for (let i = 0; i < 4; i++) out[i] = values[at + columns[k + i]] * scales[columns[k + i]];
  const length = lengthOf(out);
  if (length > 0) for (let i = 0; i < 4; i++) out[i] /= length;
  return length;
}

/** `Math.hypot` would allocate. */
function lengthOf(q: Float64Array): number {
  return Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

/**
 * Puts `turned` on the spline from `here` to `next`, which must be aligned. Its length is at least two thirds, not 1.
 * Without a frame before or after, the slope is extrapolated.
 */
function spline(hasBefore: boolean, hasAfter: boolean, part: number): void {
  if (hasBefore) align(before, here);
  if (hasAfter) align(after, next);
  for (let i = 0; i < 4; i++) {
    const first = hasBefore ? before[i] : 2 * here[i] - next[i];
    const last = hasAfter ? after[i] : 2 * next[i] - here[i];
    turned[i] = catmullRom(first, here[i], next[i], last, part);
  }
}

/** Changes q to −q if that is nearer to the other. @returns the cosine of the angle between them before that */
function align(q: Float64Array, to: Float64Array): number {
  const cosine = q[0] * to[0] + q[1] * to[1] + q[2] * to[2] + q[3] * to[3];
  if (cosine < 0) {
    q[0] = -q[0];
    q[1] = -q[1];
    q[2] = -q[2];
    q[3] = -q[3];
  }
  return cosine;
}
