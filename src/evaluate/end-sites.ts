/** Ends of a posed skeleton's bones: BVH's End Sites, and the tips of bones along +y. */
import { transformPoint, type Vec3 } from '../math/vec3.ts';
import { firstDofs } from '../model/skeleton/dofs.ts';
import { perSkeleton } from '../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { stretchOf } from '../model/skeleton/stretch.ts';

/** Where the end of a bone is in a pose. */
export interface EndSitePosition {
  /** Index of its joint. */
  readonly joint: number;
  /** In the space of the world matrices. */
  readonly position: readonly [number, number, number];
}

/**
 * In joint order, and in file order within each joint.
 * @param world 16 per joint, column-major (`worldMatrices`)
 * @param dofs of the character, which may lengthen bones; absent: at their own length
 */
export function endSitePositions(skeleton: Skeleton, world: Float64Array, dofs?: Float64Array): EndSitePosition[] {
  const { owners, ends } = endSitesOf(skeleton);
  const now = (dofs && endsAt(skeleton, owners, ends, dofs, 0)) ?? ends;
  return Array.from(owners, (joint, e) => ({
    joint,
    position: endSitePosition([now[3 * e], now[3 * e + 1], now[3 * e + 2]], world, joint),
  }));
}

/** Points in the spaces of joints. */
export interface JointPoints {
  /** The joint of each. */
  readonly owners: Int32Array;
  /** x y z of each. */
  readonly ends: Float64Array;
}

/** All End Sites of a skeleton, in joint order, at their bones' own length. Cached. */
export const endSitesOf = perSkeleton(
  ({ joints }): JointPoints => ({
    owners: Int32Array.from(joints.flatMap(({ endSites = [] }, j) => endSites.map(() => j))),
    ends: Float64Array.from(joints.flatMap(({ endSites = [] }) => endSites.flat())),
  }),
);

/** DOFs that lengthen bones. */
interface Stretches {
  /** For each joint the character's DOF; -1 for none. */
  readonly dofs: Int32Array;
  /** x y z per joint: where its tip goes. */
  readonly along: Float64Array;
}

/** Undefined if no bone has any. Cached. */
const stretchesOf = perSkeleton((skeleton): Stretches | undefined => {
  const starts = firstDofs(skeleton);
  const all = skeleton.joints.map(stretchOf);
  if (!all.some((stretch) => stretch)) return undefined;
  return {
    dofs: Int32Array.from(all, (stretch, j) => (stretch ? starts[j] + stretch.dof : -1)),
    along: Float64Array.from(all.flatMap((stretch) => stretch?.along ?? [0, 0, 0])),
  };
});

/** Whether a DOF lengthens any bone of a skeleton. */
export function hasStretches(skeleton: Skeleton): boolean {
  return stretchesOf(skeleton) !== undefined;
}

/**
 * The ends of bones, longer by what the DOFs say; undefined if no DOF lengthens a bone.
 * @param owners the joint of each end
 * @param ends x y z of each, in its joint's space
 * @param dofs those of the character, from `first` on
 * @param out to be filled and returned; absent: a new array
 */
export function endsAt(
  skeleton: Skeleton,
  owners: Int32Array,
  ends: Float64Array,
  dofs: Float64Array,
  first: number,
  out?: Float64Array,
): Float64Array | undefined {
  const stretches = stretchesOf(skeleton);
  if (!stretches) return undefined;
  const moved = out ?? new Float64Array(ends.length);
  for (let e = 0; e < owners.length; e++) {
    const j = owners[e];
    const by = stretches.dofs[j] < 0 ? 0 : dofs[first + stretches.dofs[j]];
    for (let k = 0; k < 3; k++) moved[3 * e + k] = ends[3 * e + k] + by * stretches.along[3 * j + k];
  }
  return moved;
}

/**
 * The position of an End Site that is at `end` in its joint's space.
 * @param world as above
 */
function endSitePosition(end: Vec3, world: Float64Array, joint: number): Vec3 {
  return transformPoint(world, end, 16 * joint);
}

/**
 * The far end of a joint's own bone, along its +y.
 * @param world as above
 */
export function tipPosition(length: number, world: Float64Array, joint: number): readonly [number, number, number] {
  const along = (k: number) => world[16 * joint + 4 + k] * length + world[16 * joint + 12 + k];
  return [along(0), along(1), along(2)];
}
