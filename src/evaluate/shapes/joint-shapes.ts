/**
 * Instance matrices of the shapes drawn for joints: from a unit shape to the box, sphere or bone of a joint. All are
 * column-major, read doubles and write floats, and allocate nothing. (`Math.hypot` boxes its arguments and results,
 * which was most of a frame's garbage; it is only used outside of frames.)
 *
 *     box      unit cube −½…½          J · T((min + max) / 2) · S(|max − min|)
 *     sphere   radius 1 at the origin  T(joint) · S(radius)
 *     bone     from y = 0, radius 1, to y = 1, tapering: rotated from +y to the direction from parent to joint
 *     axes     unit segments           the joint's directions, normalised, · S(length)
 *
 * Only boxes use the joint's whole matrix, including shear and mirroring; the others show where joints are.
 */
import { boneEnds } from '../../model/skeleton/bone-ends.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import { restExtent } from '../../model/skeleton/rest-extent.ts';
import type { Box, Joint, Skeleton } from '../../model/skeleton/skeleton.ts';

/** Sizes that suit a skeleton, from its rest offsets: small enough for finger bones, but always visible. */
export interface JointSizes {
  /** Radius of each joint's sphere, in the skeleton's units. */
  readonly radii: Float32Array;
  /** Radius of the ball at each end of a bone that no joint continues, in the order of `boneEnds`. */
  readonly endRadii: Float32Array;
  /** Length of drawn axes. */
  readonly axis: number;
  /** Rough size of the whole skeleton: twice the distance of its farthest joint from the centre. */
  readonly extent: number;
}

/** Maximum radius of a ball as a fraction of the bones that it ends. */
const SHARE_OF_BONE = 0.22;
/** Radius of points, by the size of all of them: there are many, close to one another. */
const OF_POINTS = 0.009;
/** Maximum ratio to the radius at the bone's other end. */
const MAX_BESIDE = 1.4;
/**
 * Bones side by side cover at most this many times a square as large as the skeleton. Thousands of long ones, as of a
 * star, would hide each other, and take a graphics card's time for what no one sees.
 */
const MAX_COVER = 20;

/**
 * The sizes in which a skeleton's joints and bones are drawn, from its file pose: in lengths, thin enough not to hide
 * one another.
 */
export function jointSizes(skeleton: Skeleton): JointSizes {
  const joints = skeleton.joints;
  const lengths = joints.map((j) => (j.parent < 0 ? 0 : Math.hypot(...j.offset)));
  const ends = boneEnds(skeleton).map(({ joint, at }) => ({ joint, length: Math.hypot(...at) }));
  const sorted = [...lengths, ...ends.map((e) => e.length)].filter((l) => l > 0).sort((a, b) => a - b);
  const median = sorted[sorted.length >> 1] ?? 0;
  const extent = restExtent(skeleton) || largestBox(joints) || 1;
  // Based on the long bones: most joints may be those of fingers, which are reduced below.
  const long = sorted[Math.floor(0.93 * sorted.length)] ?? 0;
  const alone = arePoints(skeleton) ? OF_POINTS : 0.03;
  const usual = median > 0 ? Math.min(0.09 * long, 0.014 * extent) : alone * extent;
  const allLengths = sorted.reduce((sum, length) => sum + length, 0);
  const thickest = extent * ((MAX_COVER * extent) / (2 * allLengths));
  const visible = Math.max(usual, 0.003 * extent);
  // No number for the largest offsets, and without bones.
  const radii = new Float32Array(joints.length).fill(thickest < visible ? thickest : visible);
  // A short bone (of a finger, or a toe's End Site) has small balls at both ends; a limb that ends in fingers does not.
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
  // Keeps bones from looking like clubs, thin at the shoulder and with the largest ball at the elbow.
  const evenOut = (j: number, beside: number) => {
    radii[j] = Math.min(radii[j], Math.max(MAX_BESIDE * radii[beside], 0.5 * usual));
  };
  for (let j = joints.length - 1; j > 0; j--) if (lengths[j] > 0) evenOut(joints[j].parent, j);
  for (let j = 1; j < joints.length; j++) if (lengths[j] > 0) evenOut(j, joints[j].parent);
  const endRadii = Float32Array.from(ends, ({ joint, length }) => Math.min(0.6 * radii[joint], SHARE_OF_BONE * length));
  return { radii, endRadii, axis: Math.min(0.35 * (median || 0.3 * extent), 0.08 * extent), extent };
}

function largestBox(joints: readonly Joint[]): number {
  return joints.reduce(
    (largest, { box: { min, max } }) =>
      Math.max(largest, Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2])),
    0,
  );
}

/**
 * A box with min > max is drawn like its opposite, since a cube is symmetric. A side of length 0 gets `least`, so that
 * a flat box's faces still have normals.
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
 * A ball of this radius at (x, y, z); radius 0 draws nothing. Off-diagonal elements of `out` are not written: they must
 * be 0 already.
 */
export function sphereMatrix(x: number, y: number, z: number, radius: number, out: Float32Array, to: number): void {
  out[to] = out[to + 5] = out[to + 10] = radius;
  out[to + 12] = x;
  out[to + 13] = y;
  out[to + 14] = z;
  out[to + 15] = 1;
}

/** From joint `p` to joint `j` (offsets of their matrices), `radius` at the thick end; empty if they coincide. */
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
  // Duff et al., "Building an Orthonormal Basis, Revisited" (2017), with (dx, dz, dy): no special case except the sign.
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

/** The joint's axes, all of the same length; an axis that its matrix flattens has length 0. */
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
