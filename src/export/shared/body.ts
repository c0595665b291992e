/**
 * Bones to see a character without a skin by: an octahedron from each joint to each of its children, End Sites and
 * tips, moved rigidly by the joint. With them every viewer shows something, and Blender makes an armature.
 */

import { acrossOf, cross, scaled, subtract, unit, type Vec3 } from '../../math/vec3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { oneSurface, type Skin } from '../../model/skin.ts';

/** Width of a bone and where it is widest, as fractions of its length. */
const WIDTH = 0.1;
const WIDEST = 0.15;
/** Length of a joint without children, as a fraction of the mean of the others. */
const SHORT = 0.3;

/**
 * A skin that shows a skeleton by its bones, an octahedron each.
 * @param worlds of the joints in the pose that the body is made in, 16 numbers each
 * @param lastOf which of the matrices is a joint's
 * @param name of the mesh
 */
export function bodyOf(skeleton: Skeleton, worlds: Float64Array, lastOf: Int32Array, name: string): Skin {
  const bindings = new Float64Array(16 * lastOf.length);
  lastOf.forEach((node, joint) => {
    bindings.set(worlds.subarray(16 * node, 16 * node + 16), 16 * joint);
  });
  return skinOf(bonesOf(skeleton, worlds, lastOf), bindings, name);
}

/**
 * Points, in the world, of the bones of joints that have nothing else to see their turning by: no child elsewhere, no
 * End Site, no tip.
 */
export function stubPoints(
  skeleton: Skeleton,
  worlds: Float64Array,
  lastOf: Int32Array,
): readonly { readonly joint: number; readonly point: Vec3 }[] {
  return bonesOf(skeleton, worlds, lastOf)
    .filter(({ isStub }) => isStub)
    .flatMap(({ joint, from, to }) => {
      const [beside, before] = ringOf(from, to);
      return [to, beside, before].map((point) => ({ joint, point }));
    });
}

interface Bone {
  readonly joint: number;
  readonly from: Vec3;
  readonly to: Vec3;
  /** Whether it is there only to be seen. */
  readonly isStub: boolean;
}

function bonesOf({ joints }: Skeleton, worlds: Float64Array, lastOf: Int32Array): readonly Bone[] {
  const at = (j: number): Vec3 => {
    const o = 16 * lastOf[j] + 12;
    return [worlds[o], worlds[o + 1], worlds[o + 2]];
  };
  const toWorld = (j: number, [x, y, z]: Vec3): Vec3 => {
    const o = 16 * lastOf[j];
    const on = (r: number) => worlds[o + r] * x + worlds[o + 4 + r] * y + worlds[o + 8 + r] * z + worlds[o + 12 + r];
    return [on(0), on(1), on(2)];
  };
  const bones: Bone[] = [];
  const isThick = (from: Vec3, to: Vec3) => Math.hypot(...subtract(to, from)) > 1e-9;
  joints.forEach(({ parent, endSites = [], length }, j) => {
    const from = at(j);
    if (parent >= 0 && isThick(at(parent), from))
      bones.push({ joint: parent, from: at(parent), to: from, isStub: false });
    const ends = length ? [...endSites, [0, length, 0] as const] : endSites;
    for (const end of ends) {
      const to = toWorld(j, end);
      if (isThick(from, to)) bones.push({ joint: j, from, to, isStub: false });
    }
  });
  const lengths = bones.map(({ from, to }) => Math.hypot(...subtract(to, from)));
  const mean = lengths.length ? lengths.reduce((sum, l) => sum + l, 0) / lengths.length : 1;
  const hasBone = new Set(bones.map(({ joint }) => joint));
  joints.forEach((_, j) => {
    if (hasBone.has(j)) return;
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

function skinOf(bones: readonly Bone[], bindings: Float64Array, name: string): Skin {
  const positions: number[] = [];
  const normals: number[] = [];
  const joints: number[] = [];
  for (const { joint, from, to } of bones) {
    const ring = ringOf(from, to);
    ring.forEach((corner, i) => {
      const next = ring[(i + 1) % 4];
      for (const [a, b, c] of [
        [from, next, corner],
        [to, corner, next],
      ] as const) {
        const normal = unit(cross(subtract(b, a), subtract(c, a))) ?? [0, 1, 0];
        positions.push(...a, ...b, ...c);
        normals.push(...normal, ...normal, ...normal);
        joints.push(joint, joint, joint);
      }
    });
  }
  const count = joints.length;
  const triangles = Uint32Array.from({ length: count }, (_, v) => v);
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
