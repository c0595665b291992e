/**
 * The shapes drawn for joints, as matrices of instances: what turns a unit shape into the box, sphere or bone of one
 * joint. All take and give column-major matrices, read doubles and write floats, and allocate nothing. (`Math.hypot`
 * does: numbers that it is given and gives are boxed, which was most of the garbage of a frame. It is for what is done
 * once.)
 *
 *     box      unit cube −½…½          J · T((min + max) / 2) · S(|max − min|)
 *     sphere   radius 1 at the origin  T(joint) · S(radius)
 *     bone     from y = 0, radius 1, to y = 1, tapering: turned from +y onto the way from parent to joint
 *     axes     unit segments           the joint's own directions without their lengths, · S(length)
 *
 * Only a box takes the joint's matrix as it is, shear, mirroring and all: the others show where joints are.
 */
import { boneEnds } from '../../model/bone-ends.ts';
import type { Box, Joint, Skeleton } from '../../model/skeleton.ts';

/** Sizes that suit a skeleton, from its rest offsets: as small as a finger's bone wants, and never a speck. */
export interface JointSizes {
  /** Radius of each joint's sphere, in the skeleton's units. */
  readonly radii: Float32Array;
  /** Of the ball at each end of a bone that no joint continues, in the order of `boneEnds`. */
  readonly endRadii: Float32Array;
  /** Length of drawn axes. */
  readonly axis: number;
  /** Rough size of the whole skeleton: twice the distance of its furthest joint from the middle. */
  readonly extent: number;
}

/** A ball's radius is at most so much of a bone that it is at an end of. */
const SHARE_OF_BONE = 0.22;
/** And at most so many times that at the bone's other end. */
const MAX_BESIDE = 1.4;

export function jointSizes(skeleton: Skeleton): JointSizes {
  const joints = skeleton.joints;
  const lengths = joints.map((j) => (j.parent < 0 ? 0 : Math.hypot(...j.offset)));
  const ends = boneEnds(skeleton).map(({ joint, at }) => ({ joint, length: Math.hypot(...at) }));
  const sorted = [...lengths, ...ends.map((e) => e.length)].filter((l) => l > 0).sort((a, b) => a - b);
  const median = sorted[sorted.length >> 1] ?? 0;
  const extent = restExtent(skeleton) || largestBox(joints) || 1;
  // By the long bones: most of a figure's joints may be those of its fingers, which are made smaller below.
  const long = sorted[Math.floor(0.93 * sorted.length)] ?? 0;
  const usual = median > 0 ? Math.min(0.09 * long, 0.014 * extent) : 0.03 * extent;
  const radii = new Float32Array(joints.length).fill(Math.max(usual, 0.003 * extent));
  // A short bone (a finger's, the End Site of a toe) has small balls at both ends; a limb stays a limb where it ends in
  // fingers.
  const meets = (j: number, length: number) => {
    radii[j] = Math.min(radii[j], Math.max(SHARE_OF_BONE * length, 0.5 * usual));
  };
  joints.forEach((joint, j) => {
    if (lengths[j] === 0) return;
    radii[j] = Math.min(radii[j], SHARE_OF_BONE * lengths[j]);
    meets(joint.parent, lengths[j]);
  });
  for (const { joint, length } of ends) meets(joint, length);
  const goesOn = new Set([...joints.map((j) => j.parent), ...ends.map((e) => e.joint)]);
  joints.forEach(({ parent }, j) => {
    if (parent >= 0 && !goesOn.has(j)) radii[j] *= 0.7;
  });
  // And no bone looks like a club: thin at the shoulder and with the largest ball of all at its elbow.
  const evenOut = (j: number, beside: number) => {
    radii[j] = Math.min(radii[j], Math.max(MAX_BESIDE * radii[beside], 0.5 * usual));
  };
  for (let j = joints.length - 1; j > 0; j--) if (lengths[j] > 0) evenOut(joints[j].parent, j);
  for (let j = 1; j < joints.length; j++) if (lengths[j] > 0) evenOut(j, joints[j].parent);
  const endRadii = Float32Array.from(ends, ({ joint, length }) => Math.min(0.6 * radii[joint], SHARE_OF_BONE * length));
  return { radii, endRadii, axis: Math.min(0.35 * (median || 0.3 * extent), 0.08 * extent), extent };
}

/** Diagonal of the box around all joints and ends of bones in the pose of offsets alone. */
function restExtent(skeleton: Skeleton): number {
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

function largestBox(joints: readonly Joint[]): number {
  return Math.max(
    ...joints.map(({ box: { min, max } }) => Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2])),
  );
}

/**
 * min > max is drawn like its opposite, for a cube is the same either way. A side of length 0 gets `least`, so that a
 * flat box's faces still have a normal.
 */
export function boxMatrix(j: Float64Array, o: number, box: Box, least: number, out: Float32Array, to: number): void {
  const { min, max } = box;
  for (let c = 0; c < 3; c++) {
    const size = Math.max(Math.abs(max[c] - min[c]), least);
    out[to + 4 * c] = j[o + 4 * c] * size;
    out[to + 4 * c + 1] = j[o + 4 * c + 1] * size;
    out[to + 4 * c + 2] = j[o + 4 * c + 2] * size;
    out[to + 4 * c + 3] = 0;
  }
  const x = (min[0] + max[0]) / 2;
  const y = (min[1] + max[1]) / 2;
  const z = (min[2] + max[2]) / 2;
  out[to + 12] = j[o] * x + j[o + 4] * y + j[o + 8] * z + j[o + 12];
  out[to + 13] = j[o + 1] * x + j[o + 5] * y + j[o + 9] * z + j[o + 13];
  out[to + 14] = j[o + 2] * x + j[o + 6] * y + j[o + 10] * z + j[o + 14];
  out[to + 15] = 1;
}

/**
 * A ball of this radius at (x, y, z); radius 0 draws nothing. Of `out` the elements off the diagonal are left alone: there
 * must have been nothing but 0 or balls in it.
 */
export function sphereMatrix(x: number, y: number, z: number, radius: number, out: Float32Array, to: number): void {
  out[to] = out[to + 5] = out[to + 10] = radius;
  out[to + 12] = x;
  out[to + 13] = y;
  out[to + 14] = z;
  out[to + 15] = 1;
}

/** From joint `p` to joint `j` (offsets of their matrices), `radius` at the thick end; nothing between equal places. */
export function boneMatrix(
  world: Float64Array,
  p: number,
  j: number,
  radius: number,
  out: Float32Array,
  to: number,
): void {
  const x = world[j + 12] - world[p + 12];
  const y = world[j + 13] - world[p + 13];
  const z = world[j + 14] - world[p + 14];
  const length = Math.sqrt(x * x + y * y + z * z);
  out[to + 3] = out[to + 7] = out[to + 11] = 0;
  out[to + 12] = world[p + 12];
  out[to + 13] = world[p + 13];
  out[to + 14] = world[p + 14];
  out[to + 15] = 1;
  if (!(length > 0)) {
    out.fill(0, to, to + 12);
    return;
  }
  const perLength = 1 / length;
  const dx = x * perLength;
  const dy = y * perLength;
  const dz = z * perLength;
  // Duff et al., "Building an Orthonormal Basis, Revisited" (2017), about (dx, dz, dy): no special case but the sign.
  const sign = dy >= 0 ? 1 : -1;
  const a = -1 / (sign + dy);
  const b = dx * dz * a;
  out[to] = (1 + sign * dx * dx * a) * radius;
  out[to + 1] = -sign * dx * radius;
  out[to + 2] = sign * b * radius;
  out[to + 4] = x;
  out[to + 5] = y;
  out[to + 6] = z;
  out[to + 8] = b * radius;
  out[to + 9] = -dz * radius;
  out[to + 10] = (sign + dz * dz * a) * radius;
}

/** The joint's axes, all of one length; an axis that its matrix flattens away has none. */
export function axesMatrix(j: Float64Array, o: number, length: number, out: Float32Array, to: number): void {
  for (let c = 0; c < 12; c += 4) {
    const size = Math.sqrt(j[o + c] ** 2 + j[o + c + 1] ** 2 + j[o + c + 2] ** 2);
    const s = size > 0 ? length / size : 0;
    out[to + c] = j[o + c] * s;
    out[to + c + 1] = j[o + c + 1] * s;
    out[to + c + 2] = j[o + c + 2] * s;
    out[to + c + 3] = 0;
  }
  out[to + 12] = j[o + 12];
  out[to + 13] = j[o + 13];
  out[to + 14] = j[o + 14];
  out[to + 15] = 1;
}
