/**
 * Chooses the point of a joint at a position on screen: a nearby characteristic one (origin, tip, End Site, end of its
 * box), or else the visible point of its bone or box.
 */
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { add, dot, subtract, transformVector, type Vec3, ZERO } from '../../../math/vec3.ts';
import { boneEnds } from '../../../model/skeleton/bone-ends.ts';
import { hasBox } from '../../../model/skeleton/boxes.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { pointAt } from '../set-up.ts';

/** The ray under the pointer, in the space of the world matrices. */
export interface LineOfSight {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

/**
 * The point of a joint seen along a ray: on a bone that the ray passes nearby; else where the ray enters its box; else
 * the nearest point on a bone.
 *
 * @param world from `worldMatrices`
 * @param near the distance, in world units, up to which a bone counts as hit
 * @returns in the joint's space
 */
export function seenPoint(
  skeleton: Skeleton,
  joint: number,
  world: Float64Array,
  line: LineOfSight,
  near: number,
  boxesAreSeen: boolean,
): Vec3 {
  if (isSingular(world, 16 * joint)) return ZERO;
  const inverse = new Float64Array(16);
  invertAffine(world, 16 * joint, inverse, 0);
  const pivot = pointAt(world, joint, ZERO);
  let best: Vec3 = pivot;
  let least = Infinity;
  for (const end of boneEndsOf(skeleton, joint, world)) {
    const { point, distance } = nearestOnBone(pivot, end, line);
    if (distance >= least) continue;
    best = point;
    least = distance;
  }
  if (boxesAreSeen && least > near) {
    const own = skeleton.joints[joint];
    const entered =
      hasBox(own) && enterBox(own.box, pointAt(inverse, 0, line.origin), transformVector(inverse, line.direction));
    if (entered) return entered;
  }
  return pointAt(inverse, 0, best);
}

/** Ends of the bones that start at a joint, in the space of the world matrices. */
function boneEndsOf(skeleton: Skeleton, joint: number, world: Float64Array): Vec3[] {
  const ends: Vec3[] = [];
  skeleton.joints.forEach(({ parent }, child) => {
    if (parent === joint) ends.push(pointAt(world, child, ZERO));
  });
  for (const end of boneEnds(skeleton)) if (end.joint === joint) ends.push(pointAt(world, joint, end.at));
  return ends;
}

/** The point of a segment nearest to a ray, and its distance. */
function nearestOnBone(a: Vec3, b: Vec3, { origin, direction }: LineOfSight): { point: Vec3; distance: number } {
  const way = subtract(b, a);
  const from = subtract(a, origin);
  // Only distances perpendicular to the ray count.
  const d2 = dot(direction, direction);
  const across = (v: Vec3) => add(v, direction, -dot(v, direction) / d2);
  const flatWay = across(way);
  const flatFrom = across(from);
  const length2 = dot(flatWay, flatWay);
  const part = length2 > 0 ? Math.min(1, Math.max(0, -dot(flatWay, flatFrom) / length2)) : 0;
  return {
    point: add(a, way, part),
    distance: Math.hypot(...add(flatFrom, flatWay, part)),
  };
}

/** Where a ray enters a box in the box's space (slab method, Kay and Kajiya 1986); undefined if it misses. */
function enterBox(
  { min, max }: { readonly min: Vec3; readonly max: Vec3 },
  origin: Vec3,
  direction: Vec3,
): Vec3 | undefined {
  let enters = -Infinity;
  let leaves = Infinity;
  for (let k = 0; k < 3; k++) {
    const a = (min[k] - origin[k]) / direction[k];
    const b = (max[k] - origin[k]) / direction[k];
    // Parallel to a slab: inside it always or never.
    if (direction[k] === 0) {
      if (origin[k] < min[k] || origin[k] > max[k]) return undefined;
      continue;
    }
    enters = Math.max(enters, Math.min(a, b));
    leaves = Math.min(leaves, Math.max(a, b));
  }
  if (!(enters <= leaves && enters > -Infinity)) return undefined;
  return add(origin, direction, enters);
}
