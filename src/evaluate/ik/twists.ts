/**
 * How a joint that doesn't stretch moves its descendants: an angular velocity ω and a velocity v for each DOF.
 *
 *     J = (R, t)        ∂J/∂φ = ([ω]×·R, v)        so a point x = R·y + t of the result moves with v + ω × (x − t)
 *
 * Valid for any such joint, whatever its rule: [ω]× is R′·Rᵀ.
 */
import type { JointMotion } from '../motions/motion.ts';

/** ω and v of all DOFs of a joint, 6 numbers each. @param local the joint's matrix; its translation is ignored */
export function writeTwists(
  motion: JointMotion,
  dofs: Float64Array,
  first: number,
  count: number,
  local: Float64Array,
  o: number,
  out: Float64Array,
): void {
  for (let dof = 0; dof < count; dof++) {
    motion.writeDerivative(dofs, first, dof, d, 0);
    const to = 6 * dof;
    out[to] = d[2] * local[o + 1] + d[6] * local[o + 5] + d[10] * local[o + 9];
    out[to + 1] = d[0] * local[o + 2] + d[4] * local[o + 6] + d[8] * local[o + 10];
    out[to + 2] = d[1] * local[o] + d[5] * local[o + 4] + d[9] * local[o + 8];
    out[to + 3] = d[12];
    out[to + 4] = d[13];
    out[to + 5] = d[14];
  }
}

/** Scratch; never escapes. */
const d = new Float64Array(16);
