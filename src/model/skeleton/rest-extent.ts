/** How large a skeleton is, before anything poses it. */
import { boneEnds } from './bone-ends.ts';
import type { Skeleton } from './skeleton.ts';

/** Diagonal of the box around all joints and bone ends in the pose given by offsets alone; in the skeleton's units. */
export function restExtent(skeleton: Skeleton): number {
  const { joints } = skeleton;
  const at = new Float64Array(3 * joints.length);
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  joints.forEach((joint, j) => {
    for (let k = 0; k < 3; k++) {
      at[3 * j + k] = joint.offset[k] + (joint.parent < 0 ? 0 : at[3 * joint.parent + k]);
      min[k] = Math.min(min[k], at[3 * j + k]);
      max[k] = Math.max(max[k], at[3 * j + k]);
    }
  });
  for (const end of boneEnds(skeleton)) {
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k], at[3 * end.joint + k] + end.at[k]);
      max[k] = Math.max(max[k], at[3 * end.joint + k] + end.at[k]);
    }
  }
  return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}
