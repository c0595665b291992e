/**
 * The rotation of a quaternion x y z w of any length: R(u), u = q/|q|, as in `math/quaternion.ts`. A quaternion of
 * length 0 gives the identity. N = |q|²·R is quadratic in q, so that
 *
 *     ∂R/∂q_d = (∂N/∂q_d (u) − 2·u_d·R) / |q|
 */
import { setIdentity } from '../../math/mat4.ts';
import { writeRotation } from '../../math/quaternion.ts';
import type { JointMotion } from './motion.ts';

/** u, then |q|. Scratch; never escapes. */
const unit = new Float64Array(5);

/**
 * Whether there is a direction to normalise to. Divides by the largest component first, or squares could underflow or
 * overflow.
 */
function normalise(dofs: Float64Array, first: number): boolean {
  const largest = Math.max(
    Math.abs(dofs[first]),
    Math.abs(dofs[first + 1]),
    Math.abs(dofs[first + 2]),
    Math.abs(dofs[first + 3]),
  );
  if (!(largest > 0)) return false;
  let sum = 0;
  for (let i = 0; i < 4; i++) {
    unit[i] = dofs[first + i] / largest;
    sum += unit[i] * unit[i];
  }
  const length = Math.sqrt(sum);
  for (let i = 0; i < 4; i++) unit[i] /= length;
  unit[4] = length * largest;
  return true;
}

/** The motion of a quaternion joint, with the derivative for each of x y z w. */
export const QUATERNION: JointMotion = {
  write(dofs, first, out, o) {
    setIdentity(out, o);
    if (!normalise(dofs, first)) return;
    writeRotation(unit[0], unit[1], unit[2], unit[3], out, o, 4);
  },
  writeDerivative(dofs, first, dof, out, o) {
    QUATERNION.write(dofs, first, out, o);
    out[o + 15] = 0;
    if (!normalise(dofs, first)) {
      // The identity jumps to any rotation here: it has no slope.
      out.fill(0, o, o + 16);
      return;
    }
    const u = unit[dof];
    const scale = 2 / unit[4];
    const [x, y, z, w] = [unit[0], unit[1], unit[2], unit[3]];
    // For the diagonal of N, w²+x²−y²−z² and so on; half of each derivative.
    const onDiagonal = [x, y, z];
    for (let c = 0; c < 3; c++) {
      for (let r = 0; r < 3; r++) {
        const n = r === c ? diagonal(dof, r, u) : offDiagonal(dof, r, c, onDiagonal, w);
        out[o + 4 * c + r] = scale * (n - u * out[o + 4 * c + r]);
      }
    }
  },
};

/** Half the derivative of N[r][r], which has +q_d² for d = r and d = w, −q_d² for the others. */
function diagonal(dof: number, r: number, u: number): number {
  return dof === r || dof === 3 ? u : -u;
}

/** Half the derivative of N[r][c] = 2·(q_r·q_c ∓ w·q_t), t the third axis; minus if c follows r. */
function offDiagonal(dof: number, r: number, c: number, v: readonly number[], w: number): number {
  const third = 3 - r - c;
  const sign = (c - r + 3) % 3 === 1 ? -1 : 1;
  if (dof === 3) return sign * v[third];
  if (dof === r) return v[c];
  if (dof === c) return v[r];
  return sign * w;
}
