/**
 * Extracts angles from a rotation matrix, in the order that most motion capture uses:
 *
 *     R = Rz(a) · Rx(b) · Ry(c)        row 2: −cos b · sin c   sin b   cos b · cos c
 *
 * c comes from row 2; if cos b is zero (gimbal lock) any c will do, and the previous one is kept. Then a comes from R ·
 * Ry(−c), whatever c is, so that the product equals the matrix to the last bits even near gimbal lock. Of the two
 * solutions and all their whole turns, the one nearest to the previous angles is used, so that interpolation between
 * frames doesn't spin.
 */
import { turnedNear } from '../../math/euler.ts';

const LOCKED = 1e-12;

/**
 * The angles of a rotation as Zrotation Xrotation Yrotation of a `.bvh`, near the previous ones.
 * @param m column-major, 16 numbers at `o`, whose upper left 3×3 is a rotation
 * @param angles a, b, c at `at`: the previous angles, overwritten
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
 * The angles of a rotation as Zrotation Yrotation Xrotation: R = Rz(a) · Ry(b) · Rx(c), found in the same way; row 2 is
 * −sin b, cos b · sin c, cos b · cos c. Arguments as of `zxyAngles`.
 */
export function zyxAngles(m: Float64Array, o: number, angles: Float64Array, at: number): void {
  const [beforeA, beforeB, beforeC] = [angles[at], angles[at + 1], angles[at + 2]];
  const [m20, m21, m22] = [m[o + 2], m[o + 6], m[o + 10]];
  const cosB = Math.hypot(m21, m22);
  const b = Math.atan2(-m20, cosB);
  const c = cosB > LOCKED ? Math.atan2(m21, m22) : beforeC;
  const [cosC, sinC] = [Math.cos(c), Math.sin(c)];
  // Of R · Rx(−c), whose column 1 is −sin a, cos a, 0.
  const a = Math.atan2(-(m[o + 4] * cosC - m[o + 8] * sinC), m[o + 5] * cosC - m[o + 9] * sinC);
  writeNearestForm(a, b, c, beforeA, beforeB, beforeC, angles, at);
}

/**
 * Chooses among the equivalent forms of three angles about different axes the one nearest to the previous angles, whole
 * turns and (a + π, π − b, c + π) included.
 * @param out receives the three angles at `at`
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
