/**
 * Angles out of a rotation matrix, in the order that most motion capture has:
 *
 *     R = Rz(a) · Rx(b) · Ry(c)        row 2: −cos b · sin c   sin b   cos b · cos c
 *
 * c comes from row 2; where cos b is nothing (gimbal lock) any c will do, and the one before is kept. Then a comes from
 * R · Ry(−c), whatever c is, so that the product is the matrix to the last bits near the lock too. Of the two triples
 * that stand for a rotation, and all whole turns of each, the one nearest to the angles before is taken: what lies
 * between frames doesn't spin.
 */
import { turnedNear } from '../math/euler.ts';

const LOCKED = 1e-12;

/**
 * @param m column-major, 16 numbers at `o`, whose upper left 3×3 is a rotation
 * @param angles a, b, c at `at`: those before, to be overwritten
 */
export function zxyAngles(m: Float64Array, o: number, angles: Float64Array, at: number): void {
  const [beforeA, beforeB, beforeC] = [angles[at], angles[at + 1], angles[at + 2]];
  const [m20, m21, m22] = [m[o + 2], m[o + 6], m[o + 10]];
  const cosB = Math.hypot(m20, m22);
  const b = Math.atan2(m21, cosB);
  const c = cosB > LOCKED ? Math.atan2(-m20, m22) : beforeC;
  const [cosC, sinC] = [Math.cos(c), Math.sin(c)];
  const a = Math.atan2(m[o + 1] * cosC + m[o + 9] * sinC, m[o] * cosC + m[o + 8] * sinC);
  writeNearestForm(a, b, c, beforeA, beforeB, beforeC, angles, at);
}

/**
 * Of a rotation by three angles, each about another axis: the form that is nearest to other angles, whole turns and
 * (a + π, π − b, c + π) included.
 * @param out where the three are written, at `at`
 */
export function writeNearestForm(
  a: number,
  b: number,
  c: number,
  a0: number,
  b0: number,
  c0: number,
  out: Float64Array,
  at: number,
): void {
  const [pa, pb, pc] = [turnedNear(a, a0), turnedNear(b, b0), turnedNear(c, c0)];
  const [fa, fb, fc] = [turnedNear(a + Math.PI, a0), turnedNear(Math.PI - b, b0), turnedNear(c + Math.PI, c0)];
  const plain = (pa - a0) ** 2 + (pb - b0) ** 2 + (pc - c0) ** 2;
  const flipped = (fa - a0) ** 2 + (fb - b0) ** 2 + (fc - c0) ** 2;
  const isFlipped = flipped < plain - 1e-9;
  out[at] = isFlipped ? fa : pa;
  out[at + 1] = isFlipped ? fb : pb;
  out[at + 2] = isFlipped ? fc : pc;
}

/**
 * The rotation nearest to hand in a matrix that may scale, shear or mirror, in place: the first column's direction, the
 * second one's at right angles to it, and the third that makes it right-handed. Columns without a direction get the
 * axes that are left.
 */
export function rotationPart(m: Float64Array, o: number): void {
  let [x, y, z] = [m[o], m[o + 1], m[o + 2]];
  let length = Math.hypot(x, y, z);
  if (!(length > 0)) [x, y, z, length] = [1, 0, 0, 1];
  x /= length;
  y /= length;
  z /= length;
  let [u, v, w] = [m[o + 4], m[o + 5], m[o + 6]];
  const size = Math.hypot(u, v, w);
  const along = u * x + v * y + w * z;
  u -= along * x;
  v -= along * y;
  w -= along * z;
  if (!(Math.hypot(u, v, w) > 1e-12 * size)) {
    // Any direction at right angles.
    if (Math.abs(x) < 0.9) [u, v, w] = [1 - x * x, -x * y, -x * z];
    else [u, v, w] = [-y * x, 1 - y * y, -y * z];
  }
  length = Math.hypot(u, v, w);
  u /= length;
  v /= length;
  w /= length;
  m[o] = x;
  m[o + 1] = y;
  m[o + 2] = z;
  m[o + 4] = u;
  m[o + 5] = v;
  m[o + 6] = w;
  m[o + 8] = y * w - z * v;
  m[o + 9] = z * u - x * w;
  m[o + 10] = x * v - y * u;
}
