/**
 * Joints between two frames that turn as a whole: three Euler angles, or a quaternion's four numbers, that samples
 * drive all together. They go by quaternions, and back to their DOFs.
 *
 *     linear     slerp(q₀, q₁, t), along the shortest arc at an even pace (Shoemake 1985)
 *     cubic      Catmull and Rom's spline (1974) of q₋₁ q₀ q₁ q₂ as vectors of four numbers, normalised
 *
 * Of q and −q, which are one rotation, each frame takes the one nearer to its neighbour. So angles that jump in the file
 * (179° to −179°, or all three of them past gimbal lock) neither spin the joint nor put a corner into the spline, which
 * passes through all frames and has a steady speed there. (Shoemake's squad wants logarithms and three slerps for that,
 * and is no smoother.)
 *
 * Of the angles of a rotation those are chosen that are nearest to the frames' own: a pose is its DOFs, for limits,
 * couples, sliders and files alike. The quaternions are kept beside them, for whoever makes the matrices at once.
 */
import { eulerNear, quaternionOfEuler, quaternionsOfEulers, turnEuler } from '../math/euler.ts';
import { slerp } from '../math/slerp.ts';
import type { Samples } from '../model/samples.ts';
import { nearEuler, readRows } from './near-eulers.ts';
import type { PoseRotations } from './pose-rotations.ts';
import type { SampledJoints } from './sampled-joints.ts';
import { catmullRom } from './sampling.ts';

/** Quaternions x y z w of the four frames around a time, and of the time itself. Scratch, never escapes. */
const before = new Float64Array(4);
const here = new Float64Array(4);
const next = new Float64Array(4);
const after = new Float64Array(4);
const turned = new Float64Array(4);
const angles = new Float64Array(3);

/** Writes the DOFs of joints that turn by three Euler angles; `part`, of the way to the next row, is not 0. */
export function betweenEulers(
  samples: Samples,
  joints: SampledJoints,
  row: number,
  part: number,
  out: Float64Array,
  rotations?: PoseRotations,
): void {
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

/** Writes `angles` and their rotation `turned`, of length 1, as `PoseRotations` has them; the axes are at `axes[i]`. */
function keepTurned(out: Float64Array, o: number, sign: number, axes: Int32Array, i: number): void {
  for (let k = 0; k < 3; k++) {
    out[o + k] = sign * angles[k];
    out[o + 3 + axes[i + k]] = sign * turned[k];
  }
  out[o + 6] = turned[3];
}

/** From the angles of `here`, which are in `angles`, to those of `turned`; α β γ are those of `next`. */
function turnAngles(alpha: number, beta: number, gamma: number, part: number): void {
  const a = alpha - angles[0];
  const b = beta - angles[1];
  const c = gamma - angles[2];
  const isSmooth = a < 1 && a > -1 && b < 1 && b > -1 && c < 1 && c > -1;
  if (isSmooth && turnEuler(here, turned, angles, 0)) return;
  angles[0] = between(angles[0], alpha, part);
  angles[1] = between(angles[1], beta, part);
  angles[2] = between(angles[2], gamma, part);
  eulerNear(turned, angles, 0);
}

/** Where an angle is looked for: on the way from frame to frame, but beside the nearer one where the file jumps. */
function between(from: number, to: number, part: number): number {
  const step = to - from;
  if (step <= Math.PI && step >= -Math.PI) return from + step * part;
  return part < 0.5 ? from : to;
}

/**
 * Writes the DOFs of joints that turn by the numbers of a quaternion. Those need not be of length 1, and keep what
 * length they have; beside one of length 0, which is no rotation, each goes by itself.
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
      // In the second half with the sign to which it comes.
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

/** Makes `out` the quaternion of a row, of length 1. @returns the length that it had; 0, and zeros, if it has none */
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
 * `turned` on the spline from `here` to `next`, which are aligned. Its length is not 1: two thirds at the least.
 * Without a frame before or after them the way goes on as it came.
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

/** Turns q to −q if that is nearer to the other one. @returns the cosine of the angle between them, as it was */
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
