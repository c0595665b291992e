/**
 * What a character without a skin is seen by, moved rigidly by its joints: its boxes, and bones where joints have none.
 * A bone is an octahedron from a joint to each of its children, End Sites and tips. With them every viewer shows
 * something, and Blender makes an armature.
 */

import { acrossOf, cross, scaled, subtract, transformPoint, unit, type Vec3 } from '../../math/vec3.ts';
import { hasOwnBox } from '../../model/skeleton/axis-angle.ts';
import { areBoxesOversized, areBoxesPlain, BOX_FACES, boxCorner, hasBox } from '../../model/skeleton/boxes.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { oneSurface, type Skin } from '../../model/skin.ts';

/** Width of a bone and where it is widest, as fractions of its length. */
const WIDTH = 0.1;
const WIDEST = 0.15;
/** Length of a joint without children, as a fraction of the mean of the others. */
const SHORT = 0.3;

/** A skeleton in the pose that its body is made in. */
export interface Bare {
  readonly skeleton: Skeleton;
  /** World matrices, 16 numbers each. */
  readonly worlds: Float64Array;
  /** Which of the matrices is a joint's. */
  readonly lastOf: Int32Array;
  /** Of the character. */
  readonly size: number;
}

/**
 * A skin that shows a skeleton by its boxes and bones.
 * @param name of the mesh
 */
export function bodyOf(bare: Bare, name: string): Skin {
  const { worlds, lastOf } = bare;
  const bindings = new Float64Array(16 * lastOf.length);
  lastOf.forEach((node, joint) => {
    bindings.set(worlds.subarray(16 * node, 16 * node + 16), 16 * joint);
  });
  const { boxes, bones } = partsOf(bare);
  return skinOf([...boxes.flatMap(boxFaces), ...bones.flatMap(boneFaces)], bindings, name);
}

/**
 * Points, in the world, that show how joints turn: corners of boxes, and of the bones of joints that have nothing else,
 * no child elsewhere, no End Site, no tip.
 */
export function bodyPoints(bare: Bare): readonly { readonly joint: number; readonly point: Vec3 }[] {
  const { boxes, bones } = partsOf(bare);
  const ofStubs = bones
    .filter(({ isStub }) => isStub)
    .map(({ joint, from, to }) => ({ joint, corners: [to, ...ringOf(from, to).slice(0, 2)] }));
  return [...boxes, ...ofStubs].flatMap(({ joint, corners }) => corners.map((point) => ({ joint, point })));
}

interface Box {
  readonly joint: number;
  /** Eight, in the order of `boxCorner`. */
  readonly corners: readonly Vec3[];
}

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7];

function partsOf(bare: Bare) {
  const { skeleton, worlds, lastOf } = bare;
  const boxed = new Set(boxedJoints(bare));
  return {
    boxes: [...boxed].map((joint): Box => {
      const { box } = skeleton.joints[joint];
      const corners = CORNERS.map((i) => transformPoint(worlds, boxCorner(box, i), 16 * lastOf[joint]));
      return { joint, corners };
    }),
    bones: boxed.size < skeleton.joints.length ? bonesOf(bare, boxed) : [],
  };
}

/** Larger boxes, as fractions of the character's size, would be all that is seen, and need keys without end. */
const LARGEST_BOX = 10;

/** The joints that are shown by their boxes: not by default ones where most are, nor by such as hide the skeleton. */
export function boxedJoints({ skeleton, size }: Pick<Bare, 'skeleton' | 'size'>): readonly number[] {
  if (areBoxesOversized(skeleton)) return [];
  const arePlain = areBoxesPlain(skeleton);
  const isShown = (joint: Joint) =>
    hasBox(joint) &&
    (hasOwnBox(joint) || !arePlain) &&
    Math.max(...joint.box.min.map(Math.abs), ...joint.box.max.map(Math.abs)) <= LARGEST_BOX * size;
  return skeleton.joints.flatMap((joint, j) => (isShown(joint) ? [j] : []));
}

interface Bone {
  readonly joint: number;
  readonly from: Vec3;
  readonly to: Vec3;
  /** Whether it is there only to be seen. */
  readonly isStub: boolean;
}

/** @param boxed joints that need no bone to be seen by */
function bonesOf({ skeleton: { joints }, worlds, lastOf }: Bare, boxed: ReadonlySet<number>): readonly Bone[] {
  const at = (j: number): Vec3 => {
    const o = 16 * lastOf[j] + 12;
    return [worlds[o], worlds[o + 1], worlds[o + 2]];
  };
  const bones: Bone[] = [];
  const isThick = (from: Vec3, to: Vec3) => Math.hypot(...subtract(to, from)) > 1e-9;
  joints.forEach(({ parent, endSites = [], length }, j) => {
    const from = at(j);
    if (parent >= 0 && isThick(at(parent), from))
      bones.push({ joint: parent, from: at(parent), to: from, isStub: false });
    const ends = length ? [...endSites, [0, length, 0] as const] : endSites;
    for (const end of ends) {
      const to = transformPoint(worlds, end, 16 * lastOf[j]);
      if (isThick(from, to)) bones.push({ joint: j, from, to, isStub: false });
    }
  });
  const lengths = bones.map(({ from, to }) => Math.hypot(...subtract(to, from)));
  const mean = lengths.length ? lengths.reduce((sum, l) => sum + l, 0) / lengths.length : 1;
  const hasBone = new Set(bones.map(({ joint }) => joint));
  joints.forEach((_, j) => {
    if (hasBone.has(j) || boxed.has(j)) return;
    const from = at(j);
    bones.push({ joint: j, from, to: [from[0], from[1] + SHORT * mean, from[2]], isStub: true });
  });
  return bones;
}

/** The four corners of a bone where it is widest. */
function ringOf(from: Vec3, to: Vec3): readonly [Vec3, Vec3, Vec3, Vec3] {
  const along = subtract(to, from);
  const direction = unit(along) ?? [0, 1, 0];
  const across = acrossOf(direction);
  const other = cross(direction, across);
  const size = WIDTH * Math.hypot(...along);
  const middle = from.map((v, k) => v + WIDEST * along[k]);
  const corner = (side: Vec3): Vec3 => [
    middle[0] + size * side[0],
    middle[1] + size * side[1],
    middle[2] + size * side[2],
  ];
  return [corner(across), corner(other), corner(scaled(across, -1)), corner(scaled(other, -1))];
}

/** A flat polygon, counter-clockwise from outside, in the world. */
interface Face {
  readonly joint: number;
  readonly corners: readonly Vec3[];
}

function boneFaces({ joint, from, to }: Bone): readonly Face[] {
  const ring = ringOf(from, to);
  return ring.flatMap((corner, i) => {
    const next = ring[(i + 1) % 4];
    return [
      { joint, corners: [from, next, corner] },
      { joint, corners: [to, corner, next] },
    ];
  });
}

function boxFaces({ joint, corners }: Box): readonly Face[] {
  return BOX_FACES.map((face) => ({ joint, corners: face.map((i) => corners[i]) }));
}

function skinOf(faces: readonly Face[], bindings: Float64Array, name: string): Skin {
  const positions: number[] = [];
  const normals: number[] = [];
  const joints: number[] = [];
  const corners: number[] = [];
  for (const { joint, corners: own } of faces) {
    const [a, b, c] = own;
    const normal = unit(cross(subtract(b, a), subtract(c, a))) ?? [0, 1, 0];
    const first = joints.length;
    for (const corner of own) {
      positions.push(...corner);
      normals.push(...normal);
      joints.push(joint);
    }
    for (let i = 2; i < own.length; i++) corners.push(first, first + i - 1, first + i);
  }
  const count = joints.length;
  const triangles = Uint32Array.from(corners);
  return {
    name,
    positions: Float64Array.from(positions),
    normals: Float64Array.from(normals),
    triangles,
    surfaces: oneSurface(triangles),
    attachments: {
      start: Uint32Array.from({ length: count + 1 }, (_, v) => v),
      joints: Uint32Array.from(joints),
      weights: new Float64Array(count).fill(1),
    },
    bindings,
  };
}
