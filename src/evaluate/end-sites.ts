/** Ends of a posed skeleton's bones: BVH's End Sites, and the tips of bones along +y. */
import { add, transformPoint, type Vec3 } from '../math/vec3.ts';
import { firstDofs } from '../model/skeleton/dofs.ts';
import { perSkeleton } from '../model/skeleton/per-skeleton.ts';
import type { Joint, Skeleton } from '../model/skeleton/skeleton.ts';
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
  const lengths = lengthDofs(skeleton);
  return skeleton.joints.flatMap((joint, j) =>
    (joint.endSites ?? []).map((end) => ({
      joint: j,
      position: endSitePosition(dofs && lengths[j] >= 0 ? lengthened(joint, end, dofs[lengths[j]]) : end, world, j),
    })),
  );
}

/** For each joint the character's DOF that lengthens its bone; -1 for none. Cached. */
const lengthDofs = perSkeleton((skeleton): Int32Array => {
  const starts = firstDofs(skeleton);
  return Int32Array.from(skeleton.joints, (joint, j) => {
    const stretch = stretchOf(joint);
    return stretch ? starts[j] + stretch.dof : -1;
  });
});

/** An End Site of a bone that is longer by `by`. */
function lengthened(joint: Joint, end: Vec3, by: number): Vec3 {
  const stretch = stretchOf(joint);
  return stretch ? add(end, stretch.along, by) : end;
}

/**
 * The position of an End Site that is at `end` in its joint's space.
 * @param world as above
 */
export function endSitePosition(end: Vec3, world: Float64Array, joint: number): Vec3 {
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
