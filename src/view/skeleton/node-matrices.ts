/**
 * Matrices of balls and bones for all nodes of a skeleton at one placement, used by the skeleton drawing every frame
 * and for every ghost. Allocates nothing.
 */
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { boneMatrix, type JointSizes, sphereMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { isVisible } from '../../evaluate/visible-points.ts';
import { multiplyAffine } from '../../math/mat4.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Nodes } from './drawn-skeletons.ts';
import { NODE_STRIDE } from './node-buffer.ts';

/**
 * Writes the scene matrices of all joints to `out`, 16 numbers each, followed by those of the End Sites, of which only
 * the translation is written.
 *
 * @param world 16 numbers per joint, in the character's space
 */
export function placeNodes(
  nodes: Nodes,
  placements: Float64Array,
  p: number,
  world: Float64Array,
  out: Float64Array,
): void {
  const { count, jointCount, owners, ends } = nodes;
  for (let j = 0; j < jointCount; j++) multiplyAffine(placements, p, world, 16 * j, out, 16 * j);
  for (let n = jointCount, e = 0; n < count; n++, e++) {
    const m = 16 * owners[e];
    const x = ends[3 * e];
    const y = ends[3 * e + 1];
    const z = ends[3 * e + 2];
    const o = 16 * n + 12;
    out[o] = out[m] * x + out[m + 4] * y + out[m + 8] * z + out[m + 12];
    out[o + 1] = out[m + 1] * x + out[m + 5] * y + out[m + 9] * z + out[m + 13];
    out[o + 2] = out[m + 2] * x + out[m + 6] * y + out[m + 10] * z + out[m + 14];
  }
}

/**
 * Writes the scene positions of all joints and End Sites, x y z each, from node `first` on: all that balls and bones
 * need, at a third of the cost.
 *
 * @param world 16 numbers per joint, in the character's space
 */
export function placePositions(
  { count, jointCount, owners, ends }: Nodes,
  placements: Float64Array,
  p: number,
  world: Float64Array,
  out: Float64Array,
  first: number,
): void {
  const m0 = placements[p];
  const m1 = placements[p + 1];
  const m2 = placements[p + 2];
  const m4 = placements[p + 4];
  const m5 = placements[p + 5];
  const m6 = placements[p + 6];
  const m8 = placements[p + 8];
  const m9 = placements[p + 9];
  const m10 = placements[p + 10];
  const m12 = placements[p + 12];
  const m13 = placements[p + 13];
  const m14 = placements[p + 14];
  for (let n = 0; n < count; n++) {
    const e = 3 * (n - jointCount);
    const m = n < jointCount ? 16 * n : 16 * owners[n - jointCount];
    let x = world[m + 12];
    let y = world[m + 13];
    let z = world[m + 14];
    if (e >= 0) {
      const a = ends[e];
      const b = ends[e + 1];
      const c = ends[e + 2];
      x += world[m] * a + world[m + 4] * b + world[m + 8] * c;
      y += world[m + 1] * a + world[m + 5] * b + world[m + 9] * c;
      z += world[m + 2] * a + world[m + 6] * b + world[m + 10] * c;
    }
    const o = 3 * (first + n);
    out[o] = m0 * x + m4 * y + m8 * z + m12;
    out[o + 1] = m1 * x + m5 * y + m9 * z + m13;
    out[o + 2] = m2 * x + m6 * y + m10 * z + m14;
  }
}

/** Finds which points are missing in a pose, and draws no balls for these, from node `first` on. */
export function hideMissing(
  skeleton: Skeleton,
  dofs: Float64Array,
  missing: Uint8Array,
  out: Float32Array | undefined,
  first: number,
): void {
  const compiled = compileSkeleton(skeleton);
  for (let p = 0; p < missing.length; p++) {
    missing[p] = isVisible(compiled, p, dofs) ? 0 : 1;
    if (missing[p] && out) out[NODE_STRIDE * (first + p) + 3] = 0;
  }
}

/** `placeNodes` with only translations for joints too, which is all that balls and bones need: a third of the cost. */
export function placePoints(
  nodes: Nodes,
  placements: Float64Array,
  p: number,
  world: Float64Array,
  out: Float64Array,
): void {
  const { count, jointCount, owners, ends } = nodes;
  for (let j = 0; j < jointCount; j++) {
    const o = 16 * j + 12;
    placePoint(placements, p, world[o], world[o + 1], world[o + 2], out, o);
  }
  for (let n = jointCount, e = 0; n < count; n++, e++) {
    const m = 16 * owners[e];
    const x = ends[3 * e];
    const y = ends[3 * e + 1];
    const z = ends[3 * e + 2];
    const endX = world[m] * x + world[m + 4] * y + world[m + 8] * z + world[m + 12];
    const endY = world[m + 1] * x + world[m + 5] * y + world[m + 9] * z + world[m + 13];
    const endZ = world[m + 2] * x + world[m + 6] * y + world[m + 10] * z + world[m + 14];
    placePoint(placements, p, endX, endY, endZ, out, 16 * n + 12);
  }
}

function placePoint(m: Float64Array, p: number, x: number, y: number, z: number, out: Float64Array, o: number): void {
  out[o] = m[p] * x + m[p + 4] * y + m[p + 8] * z + m[p + 12];
  out[o + 1] = m[p + 1] * x + m[p + 5] * y + m[p + 9] * z + m[p + 13];
  out[o + 2] = m[p + 2] * x + m[p + 6] * y + m[p + 10] * z + m[p + 14];
}

/** A placement's uniform scale, applied to balls and thicknesses: the length of its x column. */
export function placementScale(placements: Float64Array, p: number): number {
  const x = placements[p];
  const y = placements[p + 1];
  const z = placements[p + 2];
  return Math.sqrt(x * x + y * y + z * z);
}

/**
 * Writes the ball of every node and the bone to it, from instance `first` on.
 *
 * @param world from `placeNodes` or `placePoints`
 */
export function fillBones(
  nodes: Nodes,
  parents: Int32Array,
  sizes: JointSizes,
  scale: number,
  world: Float64Array,
  balls: Float32Array,
  bones: Float32Array,
  first: number,
): void {
  const { count, jointCount, owners } = nodes;
  const { radii, endRadii } = sizes;
  for (let n = 0; n < count; n++) {
    const o = 16 * n;
    const to = 16 * (first + n);
    const isJoint = n < jointCount;
    const radius = isJoint ? radii[n] : endRadii[n - jointCount];
    const parent = isJoint ? parents[n] : owners[n - jointCount];
    sphereMatrix(world[o + 12], world[o + 13], world[o + 14], radius * scale, balls, to);
    const thick = parent < 0 ? 0 : 0.8 * Math.min(radii[parent], 1.6 * radius) * scale;
    boneMatrix(world, 16 * Math.max(parent, 0), o, thick, bones, to);
  }
}

/**
 * `fillBones` for a `NodeBuffer`: the ball of every node and the bone to it, from node `first` on.
 *
 * @param positions from `placePositions`
 */
export function fillNodes(
  { count, jointCount, parents }: Nodes,
  { radii, endRadii }: JointSizes,
  scale: number,
  positions: Float64Array,
  out: Float32Array,
  first: number,
): void {
  for (let n = 0; n < count; n++) {
    const radius = n < jointCount ? radii[n] : endRadii[n - jointCount];
    const parent = parents[n];
    const end = 3 * (first + n);
    const start = parent < 0 ? end : 3 * (first + parent);
    const o = NODE_STRIDE * (first + n);
    out[o] = positions[end];
    out[o + 1] = positions[end + 1];
    out[o + 2] = positions[end + 2];
    out[o + 3] = radius * scale;
    out[o + 4] = positions[start];
    out[o + 5] = positions[start + 1];
    out[o + 6] = positions[start + 2];
    out[o + 7] = parent < 0 ? 0 : 0.8 * Math.min(radii[parent], 1.6 * radius) * scale;
  }
}
