/**
 * How each kind of joint moves: one rule a kind, from a motion to the matrix J(φ) of its DOFs.
 *
 * A new kind of joint is one more entry in `MOTION_RULES` (and its DOFs in `model/skeleton.ts`); nothing else asks
 * what kind a joint is. A short cut past the rule for the most common kind was tried: it gained nothing, since calls
 * to one and the same function are inlined anyway.
 */
import type { EulerOrder, Motion } from '../model/skeleton.ts';

/** A joint's own rule, with what its motion says (axes, order) worked out. */
export interface JointMotion {
  /** Writes J(φ) as 16 numbers at `out[o]`; φ begins at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array, o: number): void;
}

type Rules = { readonly [K in Motion['kind']]: (motion: Extract<Motion, { kind: K }>) => JointMotion };

const MOTION_RULES: Rules = {
  ball: (motion) => BALLS[motion.order],
};

/** The rule of one joint. */
export function jointMotion(motion: Motion): JointMotion {
  return MOTION_RULES[motion.kind](motion);
}

/**
 * `xyz`: Rz·Ry·Rx. With s and c the sine and cosine of each angle:
 *
 *     │ cy·cz   sx·sy·cz − cx·sz   cx·sy·cz + sx·sz │
 *     │ cy·sz   sx·sy·sz + cx·cz   cx·sy·sz − sx·cz │
 *     │  −sy         sx·cy              cx·cy       │
 */
const PLAIN_BALL: JointMotion = {
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
};

/**
 * Any order ijk: R_k·R_j·R_i, φ in the order rx ry rz.
 *
 * Renaming the axes i j k to x y z turns it into the matrix of `xyz`, where the renaming mirrors space if ijk is an odd
 * permutation (xzy, yxz, zyx), so that all angles change sign. Hence
 *
 *     R_k(φk)·R_j(φj)·R_i(φi) [row p(r)] [column p(c)]  =  Rz(±φk)·Ry(±φj)·Rx(±φi) [r] [c]      p = i, j, k
 */
function orderedBall(order: EulerOrder): JointMotion {
  const i = 'xyz'.indexOf(order[0]);
  const j = 'xyz'.indexOf(order[1]);
  const k = 'xyz'.indexOf(order[2]);
  const sign = (j - i + 3) % 3 === 1 ? 1 : -1;
  return {
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
  };
}

const BALLS: Readonly<Record<EulerOrder, JointMotion>> = {
  xyz: PLAIN_BALL,
  xzy: orderedBall('xzy'),
  yxz: orderedBall('yxz'),
  yzx: orderedBall('yzx'),
  zxy: orderedBall('zxy'),
  zyx: orderedBall('zyx'),
};
