/** Three angles about x, y and z, multiplied in any order: balljoints, and the rotation of what has one within it. */
import type { EulerOrder } from '../../model/skeleton.ts';
import { type JointMotion, turnAbout } from './motion.ts';

type BallMotion = JointMotion & Required<Pick<JointMotion, 'screws'>>;

/**
 * `xyz`: Rz·Ry·Rx. With s and c the sine and cosine of each angle:
 *
 *     │ cy·cz   sx·sy·cz − cx·sz   cx·sy·cz + sx·sz │
 *     │ cy·sz   sx·sy·sz + cx·cz   cx·sy·sz − sx·cz │
 *     │  −sy         sx·cy              cx·cy       │
 */
const PLAIN_BALL: BallMotion = {
  write(dofs, first, out, o) {
    const sx = Math.sin(dofs[first]);
    const cx = Math.cos(dofs[first]);
    const sy = Math.sin(dofs[first + 1]);
    const cy = Math.cos(dofs[first + 1]);
    const sz = Math.sin(dofs[first + 2]);
    const cz = Math.cos(dofs[first + 2]);
    out[o] = cy * cz;
    out[o + 1] = cy * sz;
    out[o + 2] = -sy;
    out[o + 3] = 0;
    out[o + 4] = sx * sy * cz - cx * sz;
    out[o + 5] = sx * sy * sz + cx * cz;
    out[o + 6] = sx * cy;
    out[o + 7] = 0;
    out[o + 8] = cx * sy * cz + sx * sz;
    out[o + 9] = cx * sy * sz - sx * cz;
    out[o + 10] = cx * cy;
    out[o + 11] = out[o + 12] = out[o + 13] = out[o + 14] = 0;
    out[o + 15] = 1;
  },
  writeDerivative(dofs, first, dof, out, o) {
    PLAIN_BALL.write(dofs, first, out, o);
    turnAsOrdered(out, o, dof, 0, 1, 2, 1, dofs[first + 2]);
  },
  screws: [turnAbout(2, 2), turnAbout(1, 1), turnAbout(0, 0)],
};

/**
 * Any order ijk: R_k·R_j·R_i, φ in the order rx ry rz.
 *
 * Renaming the axes i j k to x y z turns it into the matrix of `xyz`, where the renaming mirrors space if ijk is an odd
 * permutation (xzy, yxz, zyx), so that all angles change sign. Hence
 *
 *     R_k(φk)·R_j(φj)·R_i(φi) [row p(r)] [column p(c)]  =  Rz(±φk)·Ry(±φj)·Rx(±φi) [r] [c]      p = i, j, k
 */
function orderedBall(order: EulerOrder): BallMotion {
  const i = 'xyz'.indexOf(order[0]);
  const j = 'xyz'.indexOf(order[1]);
  const k = 'xyz'.indexOf(order[2]);
  const sign = (j - i + 3) % 3 === 1 ? 1 : -1;
  const ball: BallMotion = {
    write(dofs, first, out, o) {
      const sx = sign * Math.sin(dofs[first + i]);
      const cx = Math.cos(dofs[first + i]);
      const sy = sign * Math.sin(dofs[first + j]);
      const cy = Math.cos(dofs[first + j]);
      const sz = sign * Math.sin(dofs[first + k]);
      const cz = Math.cos(dofs[first + k]);
      const ci = o + 4 * i;
      const cj = o + 4 * j;
      const ck = o + 4 * k;
      out[ci + i] = cy * cz;
      out[ci + j] = cy * sz;
      out[ci + k] = -sy;
      out[cj + i] = sx * sy * cz - cx * sz;
      out[cj + j] = sx * sy * sz + cx * cz;
      out[cj + k] = sx * cy;
      out[ck + i] = cx * sy * cz + sx * sz;
      out[ck + j] = cx * sy * sz - sx * cz;
      out[ck + k] = cx * cy;
      out[o + 3] = out[o + 7] = out[o + 11] = out[o + 12] = out[o + 13] = out[o + 14] = 0;
      out[o + 15] = 1;
    },
    writeDerivative(dofs, first, dof, out, o) {
      ball.write(dofs, first, out, o);
      turnAsOrdered(out, o, dof, i, j, k, sign, dofs[first + k]);
    },
    screws: [turnAbout(k, k), turnAbout(j, j), turnAbout(i, i)],
  };
  return ball;
}

/** By order. */
export const BALLS: Readonly<Record<EulerOrder, BallMotion>> = {
  xyz: PLAIN_BALL,
  xzy: orderedBall('xzy'),
  yxz: orderedBall('yxz'),
  yzx: orderedBall('yzx'),
  zxy: orderedBall('zxy'),
  zyx: orderedBall('zyx'),
};

/**
 * J = R_k·R_j·R_i becomes ∂J/∂φ = [a]×·J, with the axis `a` about which the angle turns what stands to its right:
 *
 *     of k  e_k        of j  R_k·e_j = cos φk · e_j ∓ sin φk · e_i        of i  R_k·R_j·e_i = J·e_i
 */
function turnAsOrdered(
  m: Float64Array,
  o: number,
  dof: number,
  i: number,
  j: number,
  k: number,
  sign: number,
  angleK: number,
): void {
  if (dof === i) crossColumns(m, o, m[o + 4 * i], m[o + 4 * i + 1], m[o + 4 * i + 2]);
  else if (dof === j) {
    axis[k] = 0;
    axis[j] = Math.cos(angleK);
    axis[i] = -sign * Math.sin(angleK);
    crossColumns(m, o, axis[0], axis[1], axis[2]);
  } else crossColumns(m, o, k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0);
}

/** Scratch, never escapes. */
const axis = new Float64Array(3);

/**
 * The rotation in `m` becomes how fast it turns about an axis: each column c becomes a × c, and the rest 0.
 * @param o where the 16 numbers of `m` begin
 */
export function crossColumns(m: Float64Array, o: number, ax: number, ay: number, az: number): void {
  for (let c = o; c < o + 12; c += 4) {
    const x = m[c];
    const y = m[c + 1];
    const z = m[c + 2];
    m[c] = ay * z - az * y;
    m[c + 1] = az * x - ax * z;
    m[c + 2] = ax * y - ay * x;
  }
  m[o + 12] = m[o + 13] = m[o + 14] = m[o + 15] = 0;
}
