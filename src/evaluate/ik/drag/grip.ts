/**
 * Which point of a joint is meant by a place on the screen: the natural one that is near (its origin, its tip, an End
 * Site, a box's end), else what is seen there of its bone or its box.
 */
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { add, dot, subtract, transformVector, type Vec3, ZERO } from '../../../math/vec3.ts';
import { boneEnds } from '../../../model/bone-ends.ts';
import { hasBox } from '../../../model/boxes.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { pointAt } from '../set-up.ts';

/** What lies under the pointer, in the space of the world matrices. */
export interface LineOfSight {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

/**
 * The point of a joint that is seen along a line: of its bones the one that the line passes, where it passes near; else
 * where the line enters its box; else the nearest point of a bone again.
 *
 * @param world as of `worldMatrices`
 * @param near how near a bone has to be passed to be what is seen, in the unit of the world
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

/** Where bones that start at a joint end, in the space of the world matrices. */
function boneEndsOf(skeleton: Skeleton, joint: number, world: Float64Array): Vec3[] {
  const ends: Vec3[] = [];
  skeleton.joints.forEach(({ parent }, child) => {
    if (parent === joint) ends.push(pointAt(world, child, ZERO));
  });
  for (const end of boneEnds(skeleton)) if (end.joint === joint) ends.push(pointAt(world, joint, end.at));
  return ends;
}

/** The point of a segment that a line passes nearest to, and how near that is. */
function nearestOnBone(a: Vec3, b: Vec3, { origin, direction }: LineOfSight): { point: Vec3; distance: number } {
  const way = subtract(b, a);
  const from = subtract(a, origin);
  // Only what is across the line of sight counts.
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

/** Where a line enters a box of its own space (the slabs of Kay and Kajiya 1986); undefined where it misses it. */
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
    // Along a slab: within it always or never.
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
