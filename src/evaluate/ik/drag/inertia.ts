/**
 * How much of a character each DOF moves. Of all poses that satisfy the pins, the most natural is not the one with the
 * smallest angles but the one that moves the least of the body: pulling a hip should bend the knees, not tip the whole
 * person over, although that takes fewer degrees.
 *
 *     I_j = Σ over bones below j   length · (distance of the bone's middle from j's pivot)²
 *
 * This is the moment of inertia of everything below a joint, at rest, with bones as heavy as they are long. A joint's
 * DOFs are stiffer in proportion to its I relative to the largest.
 */

import { perObject } from '../../../model/per-object.ts';
import { boneEnds } from '../../../model/skeleton/bone-ends.ts';
import { restPose } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton, worldMatrices } from '../../kinematics.ts';
import { pointAt } from '../set-up.ts';

/** Stiffness of the DOF that moves everything, relative to a fingertip. */
const MOST = 60;

/** By DOF of the character, without morphs; at least 1. Root translation is as stiff as the root's rotation. */
export const inertia = perObject((skeleton: Skeleton): Float64Array => {
  const compiled = compileSkeleton(skeleton);
  const { parent, firstDof, jointCount, travel } = compiled;
  const dofs = Float64Array.from(restPose(skeleton, 0));
  const world = new Float64Array(16 * jointCount);
  worldMatrices(compiled, dofs, world);
  // For a joint and its descendants: mass, mass times position (3), mass times squared position.
  const sums = new Float64Array(5 * jointCount);
  const add = (joint: number, end: readonly number[]) => {
    const start = world.subarray(16 * joint + 12, 16 * joint + 15);
    const middle = end.map((v, k) => (v + start[k]) / 2);
    const length = Math.hypot(...end.map((v, k) => v - start[k]));
    sums[5 * joint] += length;
    for (let k = 0; k < 3; k++) sums[5 * joint + 1 + k] += length * middle[k];
    sums[5 * joint + 4] += length * middle.reduce((sum, v) => sum + v * v, 0);
  };
  for (let j = 0; j < jointCount; j++)
    if (parent[j] >= 0) add(parent[j], Array.from(world.subarray(16 * j + 12, 16 * j + 15)));
  for (const { joint, at } of boneEnds(skeleton)) add(joint, pointAt(world, joint, at));
  const moments = new Float64Array(jointCount);
  for (let j = jointCount - 1; j >= 0; j--) {
    const [mass, x, y, z, squares] = sums.subarray(5 * j, 5 * j + 5);
    const [px, py, pz] = world.subarray(16 * j + 12, 16 * j + 15);
    moments[j] = Math.max(0, squares - 2 * (x * px + y * py + z * pz) + mass * (px * px + py * py + pz * pz));
    if (parent[j] >= 0) for (let k = 0; k < 5; k++) sums[5 * parent[j] + k] += sums[5 * j + k];
  }
  const most = moments.reduce((a, b) => Math.max(a, b), 0);
  const list = new Float64Array(firstDof[jointCount]).fill(1);
  if (most > 0) {
    for (let j = 0; j < jointCount; j++) list.fill(1 + (MOST * moments[j]) / most, firstDof[j], firstDof[j + 1]);
    for (const dof of travel) list[dof] = 1 + MOST;
  }
  return list;
});
