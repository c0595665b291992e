/**
 * What gives off heat when weights are found: the bones of a skeleton, as segments, each one of the joint that it turns
 * with. From a joint's pivot to that of each child, to its tip and its End Sites, and through its box where none of these
 * goes that way: a hand ends with no joint, and of a head the joints are the ears. Last joints with nothing of all this
 * are points here; how far they reach the mesh tells (`last-bones.ts`).
 */
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import { boneEnds } from '../../model/bone-ends.ts';
import { hasBox } from '../../model/boxes.ts';
import type { Box, Skeleton } from '../../model/skeleton.ts';

export interface BoneSegments {
  /** The joint of each bone. */
  readonly joints: Uint32Array;
  /** x y z of both ends of each bone, from the pivot outwards; both are one for a joint that is only a point. */
  readonly ends: Float64Array;
}

/** Shorter bones, as a part of the skeleton's size, are none. */
const SHORTEST = 1e-6;
/** From the end of a box to the joint's other bones, beside its own length: less, and they run through it. */
const APART = 0.3;

/**
 * Every joint has a bone, but for those whose children all stand where they do: the children's bones begin there.
 * @param frames 16 numbers a joint, column-major: where the joints are as the skin is bound
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
  // All joints in one place.
  if (bones.length === 0) bones.push({ joint: 0, ends: [...pivot(frames, 0), ...pivot(frames, 0)] });
  return {
    joints: Uint32Array.from(bones, (bone) => bone.joint),
    ends: Float64Array.from(bones.flatMap((bone) => bone.ends)),
  };
}

/** Whether a bone has no length. */
export function isPoint(ends: Float64Array, bone: number): boolean {
  const o = 6 * bone;
  return ends[o] === ends[o + 3] && ends[o + 1] === ends[o + 4] && ends[o + 2] === ends[o + 5];
}

/** Whether a bone ends at another that has no length: the pivot of a last joint. */
export function endsAt(ends: Float64Array, bone: number, point: number): boolean {
  if (bone === point || !isPoint(ends, point)) return false;
  for (let k = 0; k < 3; k++) if (ends[6 * bone + 3 + k] !== ends[6 * point + k]) return false;
  return true;
}

/**
 * The square of the distance from a point to a bone, with how far along the bone the nearest point is, 0 to 1, in
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

/** Where the line from the pivot through the middle of the box leaves it; the pivot, where it is that middle. */
function boxEnd({ min, max }: Box): Vec3 {
  const middle = [0, 1, 2].map((k) => (min[k] + max[k]) / 2);
  const half = [0, 1, 2].map((k) => Math.abs(max[k] - min[k]) / 2);
  let reach = Infinity;
  for (let k = 0; k < 3; k++) {
    // Hardly off the middle: it leaves by another face.
    if (Math.abs(middle[k]) > 1e-3 * half[k]) reach = Math.min(reach, 1 + half[k] / Math.abs(middle[k]));
  }
  if (!Number.isFinite(reach)) return ORIGIN;
  return [reach * middle[0], reach * middle[1], reach * middle[2]];
}

/** Whether a box reaches where no other bone of its joint does. */
function isApart(end: Vec3, from: Vec3, far: readonly Vec3[]): boolean {
  const length = Math.hypot(end[0] - from[0], end[1] - from[1], end[2] - from[2]);
  const others = Float64Array.from(far.flatMap((to) => [...from, ...to]));
  return length > 0 && far.every((_, b) => squareToBone(others, b, ...end) > (APART * length) ** 2);
}

function pivot(frames: Float64Array, joint: number): Vec3 {
  const o = 16 * joint + 12;
  return [frames[o], frames[o + 1], frames[o + 2]];
}

/** The diagonal of the box around all pivots; 1 where that is nothing. */
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
