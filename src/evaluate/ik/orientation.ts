/**
 * The orientation of a joint, ignoring scale and shear in its matrix: the frame that its x and y axes span,
 *
 *     x = W_x/|W_x|        y = n/|n|, n = W_y − (W_y·x)·x        z = x × y        (`writeRotationPart`)
 *
 * and its error: φ with R(φ) = F·Tᵀ, a vector along the axis of the remaining rotation with the angle as its length.
 * The sine of that angle is cheaper and often used, but is 0 again at half a turn.
 *
 * When the frame rotates with angular velocity ω, φ changes by
 *
 *     dφ = ω − ½·φ×ω + c·φ×(φ×ω)        c = (1 − (θ/2)·cot(θ/2)) / θ²,  θ = |φ|
 *
 * (the inverse of the left Jacobian of SO(3): Barfoot, State Estimation for Robotics, 2017, § 7.1.5).
 */
import { writeRotationPart } from '../../math/mat3.ts';
import { quaternionOfRotation, writeRotation } from '../../math/quaternion.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { Turn } from './pins.ts';

/** Numbers per frame: x y z as columns, then |W_x|, W_y·x and |n|, which are 0 if the axes span no frame. */
export const FRAME_SIZE = 12;

/**
 * The frame of the matrix at `w[o]`, 16 numbers, to `out[to]`. A matrix whose axes span no frame gives the identity.
 */
export function writeFrame(w: Float64Array, o: number, out: Float64Array, to: number): void {
  writeRotationPart(w, o, out, to, 3, out, to + 9);
  const lengthX = out[to + 9];
  const along = out[to + 10];
  const lengthY = out[to + 11];
  if (lengthX > 1e-100 && lengthY > 1e-12 * (lengthY + Math.abs(along))) return;
  out.fill(0, to, to + FRAME_SIZE);
  out[to] = out[to + 4] = out[to + 8] = 1;
}

/**
 * The angular velocity of a frame whose matrix's x and y columns change by `dx` and `dy`, to `out`. From dx = ω×x and
 * dy = ω×y: ω·z = dx·y, ω·y = −dx·z, ω·x = dy·z.
 */
export function writeFrameSpeed(
  frame: Float64Array,
  f: number,
  dx: Float64Array,
  dy: Float64Array,
  out: Float64Array,
): void {
  const lengthX = frame[f + 9];
  if (lengthX === 0) {
    out[0] = out[1] = out[2] = 0;
    return;
  }
  const aboutZ = (dx[0] * frame[f + 3] + dx[1] * frame[f + 4] + dx[2] * frame[f + 5]) / lengthX;
  const xToZ = (dx[0] * frame[f + 6] + dx[1] * frame[f + 7] + dx[2] * frame[f + 8]) / lengthX;
  const yToZ = dy[0] * frame[f + 6] + dy[1] * frame[f + 7] + dy[2] * frame[f + 8];
  const aboutX = (yToZ - frame[f + 10] * xToZ) / frame[f + 11];
  for (let k = 0; k < 3; k++) out[k] = aboutX * frame[f + k] - xToZ * frame[f + 3 + k] + aboutZ * frame[f + 6 + k];
}

/** φ of the frame at `f` relative to the target's at `t` (its first 9 numbers), 3 numbers at `out[o]`. */
export function writeOrientationError(
  frame: Float64Array,
  f: number,
  target: Float64Array,
  t: number,
  out: Float64Array,
  o: number,
): void {
  for (let r = 0; r < 3; r++) {
    for (let c = 0; c < 3; c++) {
      relative[3 * c + r] =
        frame[f + r] * target[t + c] + frame[f + 3 + r] * target[t + 3 + c] + frame[f + 6 + r] * target[t + 6 + c];
    }
  }
  quaternionOfRotation(relative, 0, quaternion);
  const sign = quaternion[3] < 0 ? -1 : 1;
  const sine = Math.sqrt(quaternion[0] * quaternion[0] + quaternion[1] * quaternion[1] + quaternion[2] * quaternion[2]);
  const angle = 2 * Math.atan2(sine, sign * quaternion[3]);
  const scale = sign * (sine > 1e-12 ? angle / sine : 2);
  for (let k = 0; k < 3; k++) out[o + k] = scale * quaternion[k];
}

/** Scratch; never escapes. */
const relative = new Float64Array(9);
const quaternion = new Float64Array(4);

/** Replaces ω by dφ, for φ at `turn[o]`. */
export function orientationErrorSpeed(turn: Float64Array, o: number, w: Float64Array): void {
  const [x, y, z] = [turn[o], turn[o + 1], turn[o + 2]];
  const square = x * x + y * y + z * z;
  const half = Math.sqrt(square) / 2;
  const c = half < 1e-3 ? 1 / 12 : (1 - half / Math.tan(half)) / square;
  const a = y * w[2] - z * w[1];
  const b = z * w[0] - x * w[2];
  const d = x * w[1] - y * w[0];
  w[0] += c * (y * d - z * b) - a / 2;
  w[1] += c * (z * a - x * d) - b / 2;
  w[2] += c * (x * b - y * a) - d / 2;
}

/** The frame of a quaternion of any length but 0: 9 numbers at `out[o]`. */
export function writeTurnFrame(turn: ArrayLike<number>, first: number, out: Float64Array, o: number): void {
  const length = Math.hypot(turn[first], turn[first + 1], turn[first + 2], turn[first + 3]);
  const x = turn[first] / length;
  const y = turn[first + 1] / length;
  const z = turn[first + 2] / length;
  const w = turn[first + 3] / length;
  writeRotation(x, y, z, w, out, o, 3);
}

/** The orientation of a joint, as held by a pin. @param world from `worldMatrices` */
export function orientationAt(world: Float64Array, joint: number): Turn {
  const frame = new Float64Array(FRAME_SIZE);
  const turn = new Float64Array(4);
  writeFrame(world, 16 * joint, frame, 0);
  quaternionOfRotation(frame, 0, turn);
  return [turn[0], turn[1], turn[2], turn[3]];
}

/** An orientation that is turned further, by radians about an axis of unit length. */
export function turnedAbout([ax, ay, az]: Vec3, angle: number, [x, y, z, w]: Turn): Turn {
  const s = Math.sin(angle / 2);
  const [i, j, k, r] = [s * ax, s * ay, s * az, Math.cos(angle / 2)];
  return [
    r * x + i * w + j * z - k * y,
    r * y - i * z + j * w + k * x,
    r * z + i * y - j * x + k * w,
    r * w - i * x - j * y - k * z,
  ];
}
