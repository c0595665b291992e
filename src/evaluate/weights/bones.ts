/**
 * The heat sources for computing weights: a skeleton's bones as segments, each assigned to the joint that it rotates
 * with. From a joint's pivot to each child, to its tip and its End Sites, and through its box if none of these runs
 * that way: a hand may end without a joint, and a head's only joints may be its ears. Leaf joints with none of these
 * are points here; the mesh determines their length (`last-bones.ts`).
 */
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import { boneEnds } from '../../model/skeleton/bone-ends.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { Box, Skeleton } from '../../model/skeleton/skeleton.ts';

/** A skeleton's bones as segments, in the space of the matrices that they were made from. */
export interface BoneSegments {
  /** The joint of each bone. */
  readonly joints: Uint32Array;
  /** x y z of both ends of each bone, from the pivot outwards; equal for a joint that is only a point. */
  readonly ends: Float64Array;
}

/** Shorter bones, as a fraction of the skeleton's size, are ignored. */
const SHORTEST = 1e-6;
/**
 * Minimum distance from the end of a box to the joint's other bones, relative to the box's length; if less, they run
 * through the box already.
 */
const APART = 0.3;

/**
 * Every joint has a bone, except those whose children all coincide with it: the children's bones start there.
 * @param frames 16 numbers per joint, column-major: the joints in the binding pose
 */
export function boneSegments(skeleton: Skeleton, frames: Float64Array): BoneSegments {
  const { joints } = skeleton;
  const least = SHORTEST * sizeOf(frames);
  const bones: { joint: number; ends: readonly number[] }[] = [];
  const ends = boneEnds(skeleton);
  joints.forEach((joint, j) => {
    const from = pivot(frames, j);
    const children = joints.flatMap((child, c) => (child.parent === j ? [pivot(frames, c)] : []));
    const own = ends.filter((end) => end.joint === j).map(({ at }) => transformPoint(frames, at, 16 * j));
    const far = [...children, ...own].filter((to) => Math.hypot(...to.map((x, k) => x - from[k])) > least);
    const end = hasBox(joint) ? transformPoint(frames, boxEnd(joint.box), 16 * j) : from;
    if (far.length === 0 && children.length === 0) far.push(end);
    else if (isApart(end, from, far)) far.push(end);
    for (const to of far) bones.push({ joint: j, ends: [...from, ...to] });
  });
  // All joints coincide.
  if (bones.length === 0) bones.push({ joint: 0, ends: [...pivot(frames, 0), ...pivot(frames, 0)] });
  return {
    joints: Uint32Array.from(bones, (bone) => bone.joint),
    ends: Float64Array.from(bones.flatMap((bone) => bone.ends)),
  };
}

/** Whether a bone has length 0. */
export function isPoint(ends: Float64Array, bone: number): boolean {
  const o = 6 * bone;
  return ends[o] === ends[o + 3] && ends[o + 1] === ends[o + 4] && ends[o + 2] === ends[o + 5];
}

/** Whether a bone ends at a bone of length 0: the pivot of a leaf joint. */
export function endsAt(ends: Float64Array, bone: number, point: number): boolean {
  if (bone === point || !isPoint(ends, point)) return false;
  for (let k = 0; k < 3; k++) if (ends[6 * bone + 3 + k] !== ends[6 * point + k]) return false;
  return true;
}

/**
 * Squared distance from a point to a bone; writes the position of the nearest point along the bone, 0 to 1, to
 * `nearest.along`. Allocates nothing.
 */
export function squareToBone(ends: Float64Array, bone: number, x: number, y: number, z: number): number {
  const o = 6 * bone;
  const dx = ends[o + 3] - ends[o];
  const dy = ends[o + 4] - ends[o + 1];
  const dz = ends[o + 5] - ends[o + 2];
  const px = x - ends[o];
  const py = y - ends[o + 1];
  const pz = z - ends[o + 2];
  const square = dx * dx + dy * dy + dz * dz;
  const t = square > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy + pz * dz) / square)) : 0;
  nearest.along = t;
  const rx = px - t * dx;
  const ry = py - t * dy;
  const rz = pz - t * dz;
  return rx * rx + ry * ry + rz * rz;
}

/** Written by `squareToBone`. */
export const nearest = { along: 0 };

const ORIGIN = [0, 0, 0] as const;

/** Where the line from the pivot through the centre of the box leaves it; the pivot if it is the centre. */
function boxEnd({ min, max }: Box): Vec3 {
  const middle = [0, 1, 2].map((k) => (min[k] + max[k]) / 2);
  const half = [0, 1, 2].map((k) => Math.abs(max[k] - min[k]) / 2);
  let reach = Infinity;
  for (let k = 0; k < 3; k++) {
    // Almost at the centre: it leaves through another face.
    if (Math.abs(middle[k]) > 1e-3 * half[k]) reach = Math.min(reach, 1 + half[k] / Math.abs(middle[k]));
  }
  if (!Number.isFinite(reach)) return ORIGIN;
  return [reach * middle[0], reach * middle[1], reach * middle[2]];
}

/** Whether a box extends where no other bone of its joint does. */
function isApart(end: Vec3, from: Vec3, far: readonly Vec3[]): boolean {
  const length = Math.hypot(end[0] - from[0], end[1] - from[1], end[2] - from[2]);
  const others = Float64Array.from(far.flatMap((to) => [...from, ...to]));
  return length > 0 && far.every((_, b) => squareToBone(others, b, ...end) > (APART * length) ** 2);
}

function pivot(frames: Float64Array, joint: number): Vec3 {
  const o = 16 * joint + 12;
  return [frames[o], frames[o + 1], frames[o + 2]];
}

/** The diagonal of the box around all pivots; 1 if that is 0. */
function sizeOf(frames: Float64Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let o = 12; o < frames.length; o += 16) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], frames[o + k]);
      high[k] = Math.max(high[k], frames[o + k]);
    }
  }
  const size = Math.hypot(...high.map((h, k) => h - low[k]));
  return size > 0 && Number.isFinite(size) ? size : 1;
}
