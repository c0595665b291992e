/**
 * Which joints have boxes. Skeleton formats give every joint one, whose default suits the course's units. Other files
 * have none: joints of glTF and FBX carry a box without size, those of BVH and of the axis-angle form a default one
 * that doesn't count. They are drawn as bones, sized by the skeleton, and the box is not used to measure size. A joint
 * with a bone of its own has a box only if someone set one.
 */

import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../per-object.ts';
import { hasOwnBox } from './axis-angle.ts';
import { isOfBvh } from './joint-types.ts';
import { restExtent } from './rest-extent.ts';
import type { Box, Joint, Skeleton } from './skeleton.ts';

/**
 * Whether the joint has a box of its own that is drawn and measured; a joint with a bone has one only if someone set
 * it.
 */
export function hasBox(joint: Joint): boolean {
  if (joint.length !== undefined && !hasOwnBox(joint)) return false;
  return !isOfBvh(joint.motion) && !isNoBox(joint.box);
}

/** Called every frame, so it allocates nothing. */
export function isNoBox({ min, max }: Box): boolean {
  for (let k = 0; k < 3; k++) if (min[k] !== 0 || max[k] !== 0) return false;
  return true;
}

/** Whether every joint has a box; a joint without one is drawn only as a bone. */
export function hasAllBoxes({ joints }: Skeleton): boolean {
  return joints.every(hasBox);
}

/**
 * Whether most boxes are the small default cubes of newly made joints and of files without boxes. These show where
 * joints are, but not how they connect.
 */
export function areBoxesPlain({ joints }: Skeleton): boolean {
  const plain = joints.filter((joint) => !hasOwnBox(joint)).length;
  return joints.length > 1 && 2 * plain > joints.length;
}

/** Boxes this many times as long as the bones hide the skeleton: those of some exports are ten times. */
const FAR_LARGER = 5;
/** With fewer joints their boxes are looked at one by one. */
const MANY_JOINTS = 12;

/** Number of joints above which even small boxes may overlap hundreds of times. */
const CROWD = 1000;
/** Sides of all boxes, beside each other, to a square as large as the skeleton. */
const MAX_COVER = 50;

/**
 * Whether most boxes are far larger than the bones between the joints, as in exports that give every joint the same
 * box, whatever the unit, or are thousands in one place. They overlap all over the character, and say nothing about it.
 */
export const areBoxesOversized = perObject((skeleton: Skeleton): boolean => {
  const { joints } = skeleton;
  if (joints.length < MANY_JOINTS) return false;
  const boxes = joints
    .filter(hasBox)
    .map(({ box: { min, max } }) => Math.max(...max.map((m, k) => Math.abs(m - min[k]))));
  const bones = joints.flatMap(({ parent, offset }) => (parent >= 0 ? [Math.hypot(...offset)] : []));
  if (boxes.length === 0) return false;
  const side = middleOf(boxes);
  if (side > FAR_LARGER * middleOf(bones.filter((length) => length > 0))) return true;
  return boxes.length > CROWD && boxes.length * (side / restExtent(skeleton)) ** 2 > MAX_COVER;
});

/** The median; infinite of nothing. */
function middleOf(lengths: readonly number[]): number {
  return lengths.length ? [...lengths].sort((a, b) => a - b)[Math.floor(lengths.length / 2)] : Number.POSITIVE_INFINITY;
}

/** Whether at least one joint has a box that is drawn and measured. */
export function hasBoxes({ joints }: Skeleton): boolean {
  return joints.some(hasBox);
}

/** The faces of a box, counter-clockwise from outside, by its corners: `boxCorner`. */
export const BOX_FACES: readonly (readonly number[])[] = [
  [0, 4, 6, 2],
  [1, 3, 7, 5],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 2, 3, 1],
  [4, 5, 7, 6],
];

/**
 * A corner of a box in its joint's space. A box with min > max is the same as the other way round.
 * @param i from 0 to 7; its bits are the sides of x, y and z, 1 for the greater
 */
export function boxCorner({ min, max }: Box, i: number): Vec3 {
  const side = (k: 0 | 1 | 2) => (i & (1 << k) ? Math.max(min[k], max[k]) : Math.min(min[k], max[k]));
  return [side(0), side(1), side(2)];
}
