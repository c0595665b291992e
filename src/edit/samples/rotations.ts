/**
 * Rotations of sampled joints: which angles rotate a joint together, angles that don't jump, and quaternions.
 *
 *     R = R_i(α) · R_j(β) · R_k(γ)      i j k the axes from left to right, each of x y z once
 *
 * The same rotation is (α, β, γ), plus whole turns, and (α + π, π − β, γ + π). With σ the sign of ijk as a permutation
 * of xyz, and R's entry [row i][column k]:
 *
 *     sin β = σ·R[i][k]      α = atan2(−σ·R[j][k], R[k][k])      γ = atan2(−σ·R[i][j], R[i][i])
 */
import { writeNearestForm } from '../../evaluate/rotations/euler-angles.ts';
import { appliedDofs, renamedAxes, rigidEulerDofs } from '../../evaluate/rotations/euler-dofs.ts';
import { turnedNear } from '../../math/euler.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** A joint that rotates about three axes. */
export interface JointRotation {
  readonly joint: number;
  /** The channels of α, β, γ. */
  readonly channels: readonly [number, number, number];
  /** i, j, k: 0, 1, 2 for x, y, z. */
  readonly axes: readonly [number, number, number];
}

/** The joints of a skeleton that rotate about three axes by three angles. */
export function jointRotations(skeleton: Skeleton): JointRotation[] {
  const starts = firstDofs(skeleton);
  return skeleton.joints.flatMap(({ motion }, joint) => {
    const euler = rigidEulerDofs(motion);
    if (!euler) return [];
    // The last one applied is the first from the left.
    const [k, j, i] = renamedAxes(euler.order).axes;
    const [c, b, a] = appliedDofs(euler).map((dof) => starts[joint] + dof);
    return [{ joint, channels: [a, b, c], axes: [i, j, k] }];
  });
}

/** Brings each angle within half a turn of the previous one, in place. */
export function unroll(angles: Float64Array): void {
  for (let f = 1; f < angles.length; f++) angles[f] = turnedNear(angles[f], angles[f - 1]);
}

/**
 * Replaces each triple by the form of its rotation nearest to the previous one, in place.
 * @param from the first frame to process, with those before it done; up to (excluding) `to`
 */
export function unrollTriples(
  [a, b, c]: readonly [Float64Array, Float64Array, Float64Array],
  from = 0,
  to: number = a.length,
): void {
  for (let f = Math.max(1, from); f < to; f++) {
    nearestForm(a[f], b[f], c[f], a[f - 1], b[f - 1], c[f - 1]);
    a[f] = form[0];
    b[f] = form[1];
    c[f] = form[2];
  }
}

/** Results of `nearestForm` and `anglesOf`. */
const form = new Float64Array(3);

/**
 * The form of a rotation, including whole turns and the other triple, nearest to given angles.
 * @returns scratch that the next call overwrites, shared with `anglesOf`
 */
export function nearestForm(a: number, b: number, c: number, a0: number, b0: number, c0: number): Float64Array {
  writeNearestForm(a, b, c, a0, b0, c0, form, 0);
  return form;
}

/**
 * The rotations of frames `from` up to (excluding) `to` as quaternions x y z w, four per frame, each with the sign
 * nearest to the previous one.
 * @param out of all frames, those before `from` already filled in
 */
export function putQuaternions(
  [a, b, c]: readonly [Float64Array, Float64Array, Float64Array],
  axes: JointRotation['axes'],
  out: Float64Array,
  from: number,
  to: number,
): void {
  const q = new Float64Array(4);
  for (let f = from; f < to; f++) {
    q.fill(0);
    q[3] = 1;
    turnBy(q, axes[0], a[f]);
    turnBy(q, axes[1], b[f]);
    turnBy(q, axes[2], c[f]);
    const o = 4 * f;
    const dot = f === 0 ? 1 : q[0] * out[o - 4] + q[1] * out[o - 3] + q[2] * out[o - 2] + q[3] * out[o - 1];
    for (let n = 0; n < 4; n++) out[o + n] = dot < 0 ? -q[n] : q[n];
  }
}

/** q ← q · (axis, angle) */
function turnBy(q: Float64Array, axis: number, angle: number): void {
  const s = Math.sin(angle / 2);
  const w = Math.cos(angle / 2);
  const u = (axis + 1) % 3;
  const v = (axis + 2) % 3;
  const [qa, qu, qv, qw] = [q[axis], q[u], q[v], q[3]];
  q[axis] = qa * w + qw * s;
  q[u] = qu * w + qv * s;
  q[v] = qv * w - qu * s;
  q[3] = qw * w - qa * s;
}

/**
 * The angles of a quaternion (of any length but 0), in the form nearest to given angles.
 * @param o where it starts in `q`
 * @returns scratch that the next call overwrites
 */
export function anglesOf(
  q: Float64Array,
  o: number,
  [i, j, k]: JointRotation['axes'],
  a0: number,
  b0: number,
  c0: number,
): Float64Array {
  const size = q[o] * q[o] + q[o + 1] * q[o + 1] + q[o + 2] * q[o + 2] + q[o + 3] * q[o + 3];
  const t = 2 / size;
  const w = q[o + 3];
  const sign = (j - i + 3) % 3 === 1 ? 1 : -1;
  // R[r][c] for r ≠ c is t·(q_r·q_c ∓ w·q_other), minus if r c other is an even permutation.
  const entry = (r: number, c: number) => {
    if (r === c) return 1 - t * (q[o + ((r + 1) % 3)] ** 2 + q[o + ((r + 2) % 3)] ** 2);
    const even = (c - r + 3) % 3 === 1;
    return t * (q[o + r] * q[o + c] + (even ? -1 : 1) * w * q[o + 3 - r - c]);
  };
  const sin = Math.min(1, Math.max(-1, sign * entry(i, k)));
  const b = Math.asin(sin);
  if (Math.abs(sin) > 1 - 1e-9) {
    // Gimbal lock: α and γ rotate about the same axis, and only α + σ·γ matters (α − σ·γ if sin β is −1). γ is kept.
    const together = Math.atan2(sign * entry(k, j), entry(j, j));
    nearestForm(together - (sin > 0 ? sign : -sign) * c0, b, c0, a0, b0, c0);
    return form;
  }
  nearestForm(
    Math.atan2(-sign * entry(j, k), entry(k, k)),
    b,
    Math.atan2(-sign * entry(i, j), entry(i, i)),
    a0,
    b0,
    c0,
  );
  return form;
}
