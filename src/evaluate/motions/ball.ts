/** Three angles about x, y and z, multiplied in any order: balljoints, and other joints with such a rotation. */
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import { renamedAxes } from '../rotations/euler-dofs.ts';
import { type JointMotion, turnScrew } from './motion.ts';

type BallMotion = JointMotion & Required<Pick<JointMotion, 'screws'>>;

/**
 * `xyz`: Rz·Ry·Rx. With s and c the sine and cosine of each angle:
 *
 *     │ cy·cz   sx·sy·cz − cx·sz   cx·sy·cz + sx·sz │
 *     │ cy·sz   sx·sy·sz + cx·cz   cx·sy·sz − sx·cz │
 *     │  −sy         sx·cy              cx·cy       │
 */
const PLAIN_BALL: BallMotion = {
  groups: 'right',
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
  screws: [turnScrew(2, 2), turnScrew(1, 1), turnScrew(0, 0)],
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
  return spreadBall(order, 0, 1, 2);
}

/**
 * The motion of three Euler angles, if the angles about x, y and z are a joint's DOFs `x`, `y` and `z`, in the order of
 * their screws. Read in place rather than gathered first, since most joints of motion capture are such balls.
 */
export function spreadBall(order: EulerOrder, x: number, y: number, z: number): BallMotion {
  const places = [x, y, z];
  const {
    axes: [i, j, k],
    sign,
  } = renamedAxes(order);
  const atI = places[i];
  const atJ = places[j];
  const atK = places[k];
  // Position in the matrix of each element of `xyz`.
  const ii = 5 * i;
  const ij = 4 * i + j;
  const ik = 4 * i + k;
  const ji = 4 * j + i;
  const jj = 5 * j;
  const jk = 4 * j + k;
  const ki = 4 * k + i;
  const kj = 4 * k + j;
  const kk = 5 * k;
  const ball: BallMotion = {
    groups: 'right',
    write(dofs, first, out, o) {
      const alpha = dofs[first + atI];
      const beta = dofs[first + atJ];
      const gamma = dofs[first + atK];
      const sx = sign * Math.sin(alpha);
      const cx = Math.cos(alpha);
      const sy = sign * Math.sin(beta);
      const cy = Math.cos(beta);
      const sz = sign * Math.sin(gamma);
      const cz = Math.cos(gamma);
      out[o + ii] = cy * cz;
      out[o + ij] = cy * sz;
      out[o + ik] = -sy;
      out[o + ji] = sx * sy * cz - cx * sz;
      out[o + jj] = sx * sy * sz + cx * cz;
      out[o + jk] = sx * cy;
      out[o + ki] = cx * sy * cz + sx * sz;
      out[o + kj] = cx * sy * sz - sx * cz;
      out[o + kk] = cx * cy;
      out[o + 3] = out[o + 7] = out[o + 11] = out[o + 12] = out[o + 13] = out[o + 14] = 0;
      out[o + 15] = 1;
    },
    writeDerivative(dofs, first, dof, out, o) {
      ball.write(dofs, first, out, o);
      turnAsOrdered(out, o, dof === x ? 0 : dof === y ? 1 : 2, i, j, k, sign, dofs[first + atK]);
    },
    screws: [turnScrew(k, atK), turnScrew(j, atJ), turnScrew(i, atI)],
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
 * Turns J = R_k·R_j·R_i into ∂J/∂φ = [a]×·J, with `a` the axis about which the angle rotates the factors to its right:
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

/** Scratch; never escapes. */
const axis = new Float64Array(3);

/**
 * Replaces the rotation in `m` by its rate of change about an axis: each column c becomes a × c, and the rest 0.
 * @param o start of the 16 numbers of `m`
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
