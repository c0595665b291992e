/**
 * How each kind of joint moves: one rule a kind, from a motion to the matrix J(φ) of its DOFs.
 *
 * A new kind of joint is one more entry in `MOTION_RULES` (and its DOFs in `model/skeleton.ts`); nothing else asks
 * what kind a joint is. A short cut past the rule for the most common kind was tried: it gained nothing, since calls
 * to one and the same function are inlined anyway.
 */
import type { BvhMotion, EulerOrder, Motion } from '../model/skeleton.ts';

/** A joint's own rule, with what its motion says (axes, order) worked out. */
export interface JointMotion {
  /** Writes J(φ) as 16 numbers at `out[o]`; φ begins at `dofs[first]`. */
  write(dofs: Float64Array, first: number, out: Float64Array, o: number): void;
}

type Rules = { readonly [K in Motion['kind']]: (motion: Extract<Motion, { kind: K }>) => JointMotion };

const MOTION_RULES: Rules = {
  ball: (motion) => BALLS[motion.order],
  bvh: bvhMotion,
};

/** The rule of one joint. */
export function jointMotion(motion: Motion): JointMotion {
  // Each rule takes its own kind, and is looked up by it.
  const rule = MOTION_RULES[motion.kind] as (motion: Motion) => JointMotion;
  return rule(motion);
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

/**
 * T(tx, ty, tz) · R_first · R_second · R_third, whatever of them there is. Three rotations are a ball: BVH multiplies in
 * the order it lists, a ball's order names what is applied first, so ZXY here is `yxz` there.
 */
function bvhMotion({ channels }: BvhMotion): JointMotion {
  const translations = (['tx', 'ty', 'tz'] as const).map((name) => channels.indexOf(name));
  const turns = channels.flatMap((name, at) => (name.startsWith('r') ? [{ axis: 'xyz'.indexOf(name[1]), at }] : []));
  const rotation = turns.length === 3 ? spreadBall(turns) : productOf(turns);
  return {
    write(dofs, first, out, o) {
      rotation.write(dofs, first, out, o);
      for (let k = 0; k < 3; k++) {
        const at = translations[k];
        if (at >= 0) out[o + 12 + k] = dofs[first + at];
      }
    },
  };
}

interface Turn {
  /** 0, 1, 2 for x, y, z. */
  readonly axis: number;
  /** Where its angle stands among the joint's DOFs. */
  readonly at: number;
}

/** The angles of a ball, gathered from where they stand. Scratch, never escapes. */
const gathered = new Float64Array(3);

function spreadBall(turns: readonly Turn[]): JointMotion {
  const name = turns.map(({ axis }) => 'xyz'[axis]);
  // The three letters of a permutation, which is what the orders are.
  const ball = BALLS[name.reverse().join('') as EulerOrder];
  const [x, y, z] = [0, 1, 2].map((axis) => turns.find((turn) => turn.axis === axis)?.at ?? 0);
  return {
    write(dofs, first, out, o) {
      gathered[0] = dofs[first + x];
      gathered[1] = dofs[first + y];
      gathered[2] = dofs[first + z];
      ball.write(gathered, 0, out, o);
    },
  };
}

/** Any rotations about axes, multiplied one after the other. */
function productOf(turns: readonly Turn[]): JointMotion {
  return {
    write(dofs, first, out, o) {
      out.fill(0, o, o + 16);
      out[o] = out[o + 5] = out[o + 10] = out[o + 15] = 1;
      for (const { axis, at } of turns) turnColumns(out, o, axis, dofs[first + at]);
    },
  };
}

/** M ← M · R(axis, angle): mixes the two columns of the other axes. */
function turnColumns(m: Float64Array, o: number, axis: number, angle: number): void {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  const u = o + 4 * ((axis + 1) % 3);
  const v = o + 4 * ((axis + 2) % 3);
  for (let r = 0; r < 3; r++) {
    const a = m[u + r];
    const b = m[v + r];
    m[u + r] = a * c + b * s;
    m[v + r] = b * c - a * s;
  }
}
