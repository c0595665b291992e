/** Blends two poses: rotations along the shortest arc, single angles the short way, everything else linearly. */

import { turnedNear } from '../../math/euler.ts';
import { slerp } from '../../math/slerp.ts';
import type { CharacterDof } from '../../model/skeleton/dofs.ts';
import { anglesOf, type JointRotation, putQuaternions } from './rotations.ts';

const p = new Float64Array(4);
const q = new Float64Array(4);
const angles = [new Float64Array(1), new Float64Array(1), new Float64Array(1)] as const;

/**
 * Writes the blend, of which `weight` is that of `b`.
 * @param previous the frame before the result: angles are those nearest to its own
 * @param out may not be `a` or `b`
 */
export function blendPoses(
  dofs: readonly CharacterDof[],
  rotations: readonly JointRotation[],
  a: Float64Array,
  b: Float64Array,
  weight: number,
  previous: Float64Array,
  out: Float64Array,
): void {
  for (let d = 0; d < out.length; d++) {
    const to = dofs[d]?.unit === 'angle' ? turnedNear(b[d], a[d]) : b[d];
    out[d] = a[d] + weight * (to - a[d]);
  }
  for (const { channels, axes } of rotations) {
    quaternionIn(a, channels, axes, p);
    quaternionIn(b, channels, axes, q);
    slerp(p, q, weight, p);
    const found = anglesOf(p, 0, axes, previous[channels[0]], previous[channels[1]], previous[channels[2]]);
    for (let k = 0; k < 3; k++) out[channels[k]] = found[k];
  }
  blendQuaternions(dofs, a, b, weight, out);
}

function quaternionIn(
  pose: Float64Array,
  channels: JointRotation['channels'],
  axes: JointRotation['axes'],
  out: Float64Array,
): void {
  for (let k = 0; k < 3; k++) angles[k][0] = pose[channels[k]];
  putQuaternions(angles, axes, out, 0, 1);
}

/** Joints with quaternions as DOFs, four in a row. */
function blendQuaternions(
  dofs: readonly CharacterDof[],
  a: Float64Array,
  b: Float64Array,
  weight: number,
  out: Float64Array,
): void {
  for (let d = 0; d < out.length; d++) {
    if (!isQuaternion(dofs[d]) || dofs[d + 3]?.joint !== dofs[d].joint) continue;
    let dot = 0;
    for (let k = 0; k < 4; k++) dot += a[d + k] * b[d + k];
    const side = dot < 0 ? -weight : weight;
    for (let k = 0; k < 4; k++) out[d + k] = (1 - weight) * a[d + k] + side * b[d + k];
    const length = Math.hypot(out[d], out[d + 1], out[d + 2], out[d + 3]) || 1;
    for (let k = 0; k < 4; k++) out[d + k] /= length;
    d += 3;
  }
}

function isQuaternion(dof: CharacterDof | undefined): boolean {
  return dof?.name.startsWith('q') ?? false;
}
