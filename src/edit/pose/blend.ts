/**
 * Blends two poses: rotations along the shortest arc at constant speed (Shoemake 1985), three Euler angles through
 * their quaternion and back to the nearest angles; everything else linearly.
 */
import { appliedDofs, renamedAxes, turnedDofs } from '../../evaluate/rotations/euler-dofs.ts';
import { eulerNear, quaternionOfEuler } from '../../math/euler.ts';
import { slerp } from '../../math/slerp.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/**
 * The pose between two others: DOFs blended by `share`.
 * @param from the character's DOFs
 * @param to as many
 * @param share 0: exactly `from`, 1: exactly `to`
 */
export function blendPoses(
  skeleton: Skeleton | undefined,
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  share: number,
): number[] {
  if (share === 0 || share === 1) return Array.from(share === 0 ? from : to);
  const out = Array.from(from, (value, d) => value + share * (to[d] - value));
  if (!skeleton) return out;
  const first = firstDofs(skeleton);
  skeleton.joints.forEach(({ motion }, j) => {
    const euler = turnedDofs(motion);
    const [x] = quaternionDofs(motion);
    if (x !== undefined) blendQuaternions(from, to, share, first[j] + x, out);
    if (!euler) return;
    const applied = appliedDofs(euler).map((dof) => first[j] + dof);
    blendEulers(from, to, share, applied, renamedAxes(euler.order).sign, out);
  });
  return out;
}

/** Scratch; never escapes. */
const p = new Float64Array(4);
const q = new Float64Array(4);
const angles = new Float64Array(3);

function blendQuaternions(
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  share: number,
  at: number,
  out: number[],
): void {
  const lengths = [length4(from, at), length4(to, at)];
  if (lengths[0] === 0 || lengths[1] === 0) return;
  for (let k = 0; k < 4; k++) {
    p[k] = from[at + k] / lengths[0];
    q[k] = to[at + k] / lengths[1];
  }
  slerp(p, q, share, p);
  // With interpolated length.
  const length = lengths[0] + share * (lengths[1] - lengths[0]);
  for (let k = 0; k < 4; k++) out[at + k] = length * p[k];
}

/** `sign` turns the angles, in order of application, into those of Rz(γ)·Ry(β)·Rx(α) with renamed axes. */
function blendEulers(
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  share: number,
  applied: readonly number[],
  sign: number,
  out: number[],
): void {
  const [a, b, c] = applied;
  if (from[a] === to[a] && from[b] === to[b] && from[c] === to[c]) return;
  const half = sign / 2;
  quaternionOfEuler(half * from[a], half * from[b], half * from[c], p, 0);
  quaternionOfEuler(half * to[a], half * to[b], half * to[c], q, 0);
  slerp(p, q, share, p);
  applied.forEach((dof, i) => {
    angles[i] = sign * from[dof];
  });
  eulerNear(p, angles, 0);
  applied.forEach((dof, i) => {
    out[dof] = sign * angles[i];
  });
}

function length4(values: ArrayLike<number>, at: number): number {
  return Math.hypot(values[at], values[at + 1], values[at + 2], values[at + 3]);
}
